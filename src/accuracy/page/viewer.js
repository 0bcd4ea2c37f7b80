'use strict';
// Two pictures under a divider, beside a map of their difference that can be zoomed.

const clampPercent = value => Math.max(0, Math.min(100, value));

function pictureOr(image, attributes, missing) {
  return image ? make('img', { ...attributes, width: image.width, height: image.height, src: image.uri })
               : make('p', { class: 'missing' }, missing);
}

// The divider is a range input over both pictures, so that it works by pointer, touch and keys.
function makeSplitFrame({ size, reference, left, right }) {
  const test = make('div', { class: 'test' });
  const divider = make('input', { type: 'range', class: 'divider', min: 0, max: 1000, value: 500,
                                  'aria-label': `Divider between the ${left} and the ${right} picture` });
  const frame = make('div', { class: 'frame split', style: `aspect-ratio:${size}` }, reference, test,
    make('span', { class: 'side left', 'aria-hidden': 'true' }, left),
    make('span', { class: 'side right', 'aria-hidden': 'true' }, right),
    make('span', { class: 'handle', 'aria-hidden': 'true' }), divider);
  const show = () => {
    frame.style.setProperty('--split', `${divider.value / 10}%`);
    divider.setAttribute('aria-valuetext', `${Math.round(divider.value / 10)} % ${left}, the rest ${right}`);
  };
  divider.addEventListener('input', show);
  divider.addEventListener('keydown', event => {
    const step = { ArrowLeft: -20, ArrowDown: -20, ArrowRight: 20, ArrowUp: 20 }[event.key];
    if (step) {
      divider.value = Number(divider.value) + step * (event.shiftKey ? 5 : 1);
      show();
      event.preventDefault();
    }
  });
  show();
  return { frame, show: content => test.replaceChildren(content) };
}

// The zoomed view of all panes follows the pointer on this frame, or its arrow keys.
function followPointer(frame, panes) {
  const now = () => ['--at-x', '--at-y'].map(name => Number.parseFloat(panes.style.getPropertyValue(name) || '50%'));
  const move = (x, y) => {
    panes.style.setProperty('--at-x', `${clampPercent(x)}%`);
    panes.style.setProperty('--at-y', `${clampPercent(y)}%`);
  };
  const follow = event => {
    const box = frame.getBoundingClientRect();
    move(100 * (event.clientX - box.left) / box.width, 100 * (event.clientY - box.top) / box.height);
  };
  frame.addEventListener('pointermove', follow);
  frame.addEventListener('pointerdown', follow);
  frame.addEventListener('keydown', event => {
    const step = { ArrowLeft: [-4, 0], ArrowRight: [4, 0], ArrowUp: [0, -4], ArrowDown: [0, 4] }[event.key];
    if (step) {
      const [x, y] = now();
      move(x + step[0], y + step[1]);
      event.preventDefault();
    }
  });
}

function makeMapFrame(size, panes) {
  const map = make('div', { class: 'frame map', style: `aspect-ratio:${size}`, tabindex: 0, role: 'group',
                            'aria-label': 'Error map; arrow keys move a zoomed view' });
  followPointer(map, panes);
  return map;
}

function makeZoom(panes) {
  const buttons = [1, 2, 4, 8].map(zoom => make('button', { type: 'button', 'aria-pressed': String(zoom === 1) }, `${zoom}×`));
  buttons.forEach((button, i) => button.addEventListener('click', () => {
    buttons.forEach(other => other.setAttribute('aria-pressed', other === button));
    panes.style.setProperty('--zoom', 2 ** i);
    panes.classList.toggle('zoomed', i > 0);
  }));
  return make('span', { class: 'zoom', role: 'group', 'aria-label': 'Zoom' }, buttons);
}

function makeChoice(label, items, selection) {
  const select = make('select', {}, items.map(item => make('option', { value: item.key }, item.option)),
                      make('option', { value: '', hidden: true }, 'one without a picture in this report'));
  select.addEventListener('change', () => selection.set(select.value));
  selection.listen(key => {
    select.value = key;
    if (select.selectedIndex < 0) select.value = '';
  });
  return make('label', {}, `${label} `, select);
}

// A slider through `keys`, from one end's name to the other's.
function makeStepper({ label, keys, from, to, textOf }, selection) {
  const slider = make('input', { type: 'range', class: 'stepper', min: 0, max: keys.length - 1, 'aria-label': label });
  slider.addEventListener('input', () => selection.set(keys[slider.value]));
  selection.listen(key => {
    const index = keys.indexOf(key);
    if (index >= 0) slider.value = index;
    slider.classList.toggle('off', index < 0);
    slider.setAttribute('aria-valuetext', textOf(key));
  });
  return make('label', {}, from, ' ', slider, ' ', to);
}

// items: [{ key, option, picture, map, pictureAlt, mapAlt, missingPicture, missingMap, caption }] by key, where
// pictures are { width, height, uri } or absent; choices: those offered in the list; size: "width/height";
// legend: of the map's colors.
function makeViewer({ items, choices, choiceLabel, stepper, size, left, right, reference, legend, mapCaption }, selection) {
  const panes = make('div', { class: 'panes' });
  const split = makeSplitFrame({ size, reference, left, right });
  const map = makeMapFrame(size, panes);
  const caption = make('p', { class: 'shown', 'aria-live': 'polite' });
  panes.append(make('div', { class: 'pane' }, split.frame, caption),
               make('div', { class: 'pane' }, map, legend, make('p', { class: 'shown' }, mapCaption)));
  selection.listen(key => {
    const item = items.get(key);
    split.show(pictureOr(item.picture, { alt: item.pictureAlt }, item.missingPicture));
    map.replaceChildren(pictureOr(item.map, { alt: item.mapAlt }, item.missingMap));
    caption.replaceChildren(...item.caption);
  });
  const controls = make('p', { class: 'controls' }, makeChoice(choiceLabel, choices, selection),
                        stepper.keys.length > 1 ? makeStepper(stepper, selection) : null, makeZoom(panes));
  return make('div', {}, controls, panes);
}
