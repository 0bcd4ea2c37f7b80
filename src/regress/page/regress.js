'use strict';
// The report of a regression run: what failed with its pictures, then all cases.

const commandLine = words => words.map(shellWord).join(' ');
const kinds = ['expected', 'actual', 'difference', 'FLIP'];
const blinkMs = 500;

function caption(kind, { gain, picture, pictures }) {
  return { expected: `expected: ${picture}`, actual: pictures[0] ? 'actual; point at it for the expected one' : 'actual',
           difference: `difference ×${gain}; pixels over the limit drawn larger`,
           FLIP: 'FLIP: difference as the eye sees it' }[kind];
}

function marker({ region, size }) {
  const [left, top, width, height] = region;
  const percent = (pixels, of) => `${100 * pixels / of}%`;
  return make('div', { class: 'overlay', 'aria-hidden': 'true' }, region.length === 0 ? null
    : make('div', { class: 'region', style: `left:${percent(left, size[0])};top:${percent(top, size[1])};` +
                                            `width:${percent(width, size[0])};height:${percent(height, size[1])}` }));
}

function pictureOf(one, kind) {
  const uri = one.pictures[kinds.indexOf(kind)];
  return pictureOr(uri && { width: one.size[0], height: one.size[1], uri },
                   { class: kind, alt: `${kind} picture of ${one.name}` }, `There is no ${kind} picture.`);
}

function makePane(one, kind, panes) {
  const frame = make('div', { class: `frame ${kind}`, style: `aspect-ratio:${one.size.join('/')}`, tabindex: 0, role: 'group',
                              'aria-label': `${kind} picture; arrow keys move a zoomed view` },
                     pictureOf(one, kind), marker(one));
  followPointer(frame, panes);
  return { frame, pane: make('div', { class: 'pane' }, frame, make('p', {}, caption(kind, one))) };
}

// The ways to compare: the actual picture gives way to the expected one while the pointer is on it, or by turns, or both
// stand under a divider.
function makeModes(one, actual, panes) {
  const expected = pictureOf(one, 'expected');
  expected.classList.add('other');
  const split = makeSplitFrame({ size: one.size.join('/'), reference: pictureOf(one, 'actual'), left: 'expected', right: 'actual' });
  split.show(pictureOf(one, 'expected'));
  split.frame.append(marker(one));
  let timer = 0;
  let mode = 'swap';
  const text = actual.pane.querySelector('p');
  const showOther = shown => {
    expected.hidden = !shown;
    actual.frame.dataset.shows = shown ? 'expected' : 'actual';
    text.textContent = mode === 'slider' ? 'expected | actual; drag the divider'
      : shown ? 'expected, in the place of the actual one' : mode === 'blink' ? 'actual' : caption('actual', one);
  };
  actual.frame.querySelector('img').after(expected);
  const modes = ['swap', 'blink', 'slider'];
  const buttons = modes.map(mode => make('button', { type: 'button', 'data-mode': mode },
                                         { swap: 'Swap under the pointer', blink: 'Blink', slider: 'Slider' }[mode]));
  const choose = next => {
    mode = next;
    clearInterval(timer);
    showOther(false);
    if (mode === 'blink') timer = setInterval(() => showOther(expected.hidden), blinkMs);
    buttons.forEach(button => button.setAttribute('aria-pressed', button.dataset.mode === mode));
    split.frame.hidden = mode !== 'slider';
    actual.frame.hidden = mode === 'slider';
  };
  actual.pane.prepend(split.frame);
  actual.frame.addEventListener('pointerenter', () => mode === 'swap' && showOther(true));
  actual.frame.addEventListener('pointerleave', () => mode === 'swap' && showOther(false));
  buttons.forEach(button => button.addEventListener('click', () => choose(button.dataset.mode)));
  choose('swap');
  return make('span', { class: 'zoom', role: 'group', 'aria-label': 'Compare by' }, buttons);
}

function pictures(one) {
  if (!one.pictures) {
    return make('p', { class: 'missing' }, one.hasFiles
      ? `Its pictures would make this file too large: ${one.name}.actual.png and others stand beside it.`
      : 'There is no picture.');
  }
  const panes = make('div', { class: `panes four${one.size[0] <= 320 ? ' small' : ''}` });
  const made = new Map(kinds.filter(kind => one.pictures[kinds.indexOf(kind)])
    .map(kind => [kind, makePane(one, kind, panes)]));
  panes.append(...[...made.values()].map(({ pane }) => pane));
  const [left, top, width, height] = one.region.length ? one.region : [0, 0, ...one.size];
  panes.style.setProperty('--at-x', `${100 * (left + width / 2) / one.size[0]}%`);
  panes.style.setProperty('--at-y', `${100 * (top + height / 2) / one.size[1]}%`);
  const mark = make('button', { type: 'button', class: 'mark', 'aria-pressed': 'true' }, 'Mark');
  mark.addEventListener('click', () =>
    mark.setAttribute('aria-pressed', String(!panes.classList.toggle('unmarked'))));
  return make('div', {}, make('p', { class: 'controls' }, makeZoom(panes),
                              made.size === kinds.length ? makeModes(one, made.get('actual'), panes) : null,
                              one.region.length ? mark : null), panes);
}

function numbers({ figures }) {
  if (!figures.length) return null;
  return make('table', { class: 'numbers' },
    make('thead', {}, make('tr', {}, ['', 'Measured', 'Limit'].map(text => make('th', { scope: 'col' }, text)))),
    make('tbody', {}, figures.map(({ label, value, limit, over }) => make('tr', { class: over ? 'over' : null },
      make('th', { scope: 'row' }, label), make('td', {}, value), make('td', {}, limit)))));
}

function commands({ name, drawCommand, acceptCommand }) {
  const row = (title, words, label) => words.length
    ? [make('dt', {}, title), make('dd', {}, make('code', {}, commandLine(words)), makeCopyButton(commandLine(words), label))]
    : [];
  return make('dl', { class: 'commands' }, row('Draw it again', drawCommand, `Copy the command that draws ${name}`),
              row('Accept the actual picture', acceptCommand, `Copy the command that accepts ${name}`));
}

const verdictBadge = ({ verdict }) => make('span', { class: `verdict ${verdict}` }, verdict);

function article(one) {
  return make('section', { class: 'case', 'data-case': one.name },
    make('h2', {}, verdictBadge(one), ' ', one.name), make('p', { class: 'why' }, one.message),
    pictures(one), numbers(one), commands(one),
    one.log.length ? make('details', {}, make('summary', {}, 'What the worker wrote'), make('pre', {}, one.log.join('\n'))) : null);
}

function caseTable(cases, selection) {
  const figure = (one, start) => one.figures.find(({ label }) => label.startsWith(start))?.value ?? '–';
  const figureColumn = (heading, start) => ({ heading, number: true, cell: ({ one }) =>
    ({ content: figure(one, start), key: Number.parseFloat(figure(one, start)) || 0 }) });
  return makeTable({
    caption: 'Failures first. Click a heading to sort.', label: 'All cases', groups: [['', 6]], footer: [], sorted: 0,
    columns: [
      { heading: 'Result', cell: ({ one, index }) => ({ content: verdictBadge(one), key: index }) },
      { heading: 'Case', rowHeading: true, cell: ({ one }) =>
        ({ content: needsAttention(one) ? make('button', { type: 'button', class: 'name' }, one.name) : one.name, key: one.name }) },
      figureColumn('Pixels over', 'pixels over'),
      figureColumn('Largest', 'largest'),
      { heading: 'Seconds', number: true, cell: ({ one }) => ({ content: fixedText(one.seconds, 2), key: one.seconds }) },
      { heading: 'Why', style: 'why-cell', cell: ({ one }) => ({ content: one.message, key: one.message }) },
    ],
    rows: cases.map((one, index) => ({ one, index, key: one.name, style: one.verdict })),
  }, selection);
}

const needsAttention = ({ verdict }) => verdict === 'failed' || verdict === 'error';

function showRun(run) {
  const element = id => document.getElementById(id);
  const bad = run.cases.filter(needsAttention);
  element('title').textContent = bad.length ? `${bad.length} of ${plural(run.cases.length, 'case')} did not pass`
                                          : `${plural(run.cases.length, 'case')}, none failed`;
  document.title = `${element('title').textContent} – ${run.file}`;
  const drivers = [...new Set(run.cases.filter(one => one.driver).map(one => `${one.device}, ${one.driver}`))];
  const facts = { Cases: run.file, Results: run.summary, Driver: drivers.join('; ') || '–', Date: run.date,
                  Command: make('span', {}, make('code', {}, commandLine(run.command)), ' ',
                                makeCopyButton(commandLine(run.command), 'Copy the command of this run')) };
  element('facts').append(...Object.entries(facts).map(([title, content]) =>
    make('div', {}, make('dt', {}, title), make('dd', {}, content))));
  element('failures').append(...bad.map(article));
  const selection = makeSelection('');
  element('table').append(caseTable(run.cases, selection));
  selection.listen(key => key && document.querySelector(`[data-case="${CSS.escape(key)}"]`)?.scrollIntoView());
  element('made').textContent = `Made by Speculum ${run.version}.`;
}

showRun(JSON.parse(document.getElementById('data').textContent));
