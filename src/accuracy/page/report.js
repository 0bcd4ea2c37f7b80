'use strict';
// The report of an accuracy sweep, from the JSON that the page embeds: `results` is results.json, `fronts` the points on
// the front of each error, `changed` the base settings that are not the defaults, `pictures` those to show.

const costOf = point => point.gpu_ms.repeats > 0 ? point.gpu_ms : point.frame_ms;
const timedOnGpu = results => results.points.every(point => point.gpu_ms.repeats > 0);
const isBase = point => Object.keys(point.settings).length === 0;
const settingsOf = point => isBase(point) ? 'base settings' : setOptions(point.settings);
const byCost = points => [...points].sort((a, b) => costOf(a).median - costOf(b).median);
// JSON has no infinity: null stands for it where a figure can be infinite.
const orInfinity = value => value ?? Infinity;

// The errors that have a plot of their own; `of` gives null for a point that has none.
const measures = {
  flip: { name: 'mean FLIP', of: error => error.whole.flip },
  rmse: { name: 'RMSE', of: error => error.whole.rmse },
  mirrors: { name: 'RMSE over mirrors', of: error => error.mirrors?.rmse ?? null },
  flicker: { name: 'flicker', of: error => error.flicker ?? null },
};

const priceText = point => `${numberText(costOf(point).median)} ms and mean FLIP ${numberText(point.error.whole.flip)}`;

function frontSentence(points) {
  const front = byCost(points.filter(point => point.on_front));
  const all = plural(points.length, 'configuration');
  if (!front.length) return `Of ${all}, none is on the front`;
  const [first, last] = [front[0], front.at(-1)];
  return front.length === 1
    ? `Of ${all}, one is worth its price: ${first.name} at ${priceText(first)}`
    : `Of ${all}, ${front.length} are worth their price, from ${priceText(first)} (${first.name}) ` +
      `to ${priceText(last)} (${last.name})`;
}

// The finding in one sentence.
function summary({ points, ground_truth: truth }) {
  if (!points.length) return 'No configuration was measured.';
  const base = points.find(isBase);
  const floor = truth.noise_floor.whole.flip;
  let text = frontSentence(points);
  if (base) text += `; the base settings take ${priceText(base)}, ${base.on_front ? 'on' : 'off'} the front`;
  text += `; the reference itself is known to ${numberText(floor)}`;
  if (base && floor > 0) {
    const error = base.error.whole.flip;
    text += error > floor ? `, ${numberText(error / floor, 2)} times below that` : ', which is no better than that';
  }
  return `${text}.`;
}

function facts(results) {
  const truth = results.ground_truth;
  const entries = {
    Scene: results.scene,
    Picture: `${results.size.join(' × ')}\u00a0pixels, ` +
             (results.motion ? 'the last frame of the movement' : `time\u00a0${results.time}\u00a0s`),
    ...results.motion ? { Motion: `${results.motion.path}, ${plural(results.motion.frames, 'frame')} at ` +
                                  `${numberText(results.motion.fps)} a second` } : {},
    Sweep: `${results.sweep}, ${plural(results.points.length, 'configuration')}`,
    Device: results.device,
    Driver: results.driver,
    'Render path': results.render_path,
    Machine: results.machine,
    Reference: `${numberText(truth.ms / 1000)} s on ${plural(truth.threads, 'thread')}`,
    Date: results.date,
    Speculum: results.version,
  };
  return Object.entries(entries).map(([term, text]) => make('div', {}, make('dt', {}, term), make('dd', {}, text || '–')));
}

function tipOf(point, measure, error) {
  const cost = costOf(point);
  return `${point.name}\n${settingsOf(point)}\n${numberText(cost.median)} ms [${numberText(cost.q1)}, ` +
         `${numberText(cost.q3)}], at least ${numberText(cost.min)} ms\n${measure} ${numberText(error)}`;
}

function frontMark(point, key, measure, onFront) {
  const error = measure.of(point.error);
  const base = isBase(point);
  return {
    x: costOf(point).median, y: error, key,
    shape: error <= 0 ? 'triangle' : base ? 'square' : onFront ? 'disc' : 'ring',
    style: (onFront ? 'front' : 'dominated') + (base ? ' base' : ''),
    label: onFront || base ? point.name : '',
    tip: tipOf(point, measure.name, error),
    spread: costOf(point).repeats > 1 ? costOf(point) : null,
  };
}

// The parts of each name that tell it from the others, the rarest first; "…" stands for the rest.
function shortLabels(names) {
  const parts = names.map(name => name.split(', '));
  const holders = part => parts.filter(other => other.includes(part)).length;
  return names.map((name, i) => {
    const rarest = [...parts[i]].sort((a, b) => holders(a) - holders(b));
    const tell = shown => names.every((other, k) => other === name || !shown.every(part => parts[k].includes(part)));
    let count = 1;
    while (count < rarest.length && !tell(rarest.slice(0, count))) count += 1;
    return count < rarest.length ? `${rarest.slice(0, count).join(', ')}, …` : name;
  });
}

// Each error holds until the next point of the front can be paid for.
function stairs(results, front, measure) {
  const points = [];
  for (const index of front) {
    const at = [costOf(results.points[index]).median, measure.of(results.points[index].error)];
    if (points.length) points.push([at[0], points.at(-1)[1]]);
    points.push(at);
  }
  return { style: 'front-line', points };
}

function frontLegend(marks) {
  const base = marks.find(mark => mark.style.endsWith('base'));
  return [
    { label: 'on the front', style: 'mark front', shape: 'disc' },
    { label: 'dominated', style: 'mark dominated', shape: 'ring' },
    ...base ? [{ label: 'base settings', style: `mark ${base.style}`, shape: 'square' }] : [],
    ...marks.some(mark => mark.shape === 'triangle')
      ? [{ label: 'no difference', style: 'mark dominated', shape: 'triangle' }] : [],
  ];
}

// The ray tracer's own time, behind a break of the axis where it is far above all others.
function addTruth(plot, { points, ground_truth: truth }, measure, floor) {
  if (!(truth.ms > 0) || floor === null) return;
  const dearest = Math.max(...points.map(point => costOf(point).median));
  if (truth.ms > 20 * dearest && dearest > 0) plot.x.apart = truth.ms;
  plot.marks.push({
    x: truth.ms, y: floor, shape: 'diamond', style: 'truth', label: 'ray traced',
    tip: `Ray-traced reference\n${numberText(truth.ms / 1000)} s on ${plural(truth.threads, 'thread')}, ` +
         `wall clock\nnoise floor, ${measure.name} ${numberText(floor)}`,
  });
  plot.legend.push({ label: 'ray traced, CPU', style: 'truth', shape: 'diamond' });
}

const floorRule = floor => ({ y: floor, style: 'floor', label: `noise floor ${numberText(floor)}` });

function frontPlot(results, front, measure) {
  const layer = mark => mark.style.endsWith('base') ? 2 : mark.style === 'front' ? 1 : 0;
  const marks = results.points
    .map((point, i) => measure.of(point.error) === null ? null : frontMark(point, String(i), measure, front.includes(i)))
    .filter(Boolean).sort((a, b) => layer(a) - layer(b));
  shortLabels(marks.map(mark => mark.label)).forEach((label, i) => { marks[i].label = label; });
  const floor = measure.of(results.ground_truth.noise_floor);
  const time = timedOnGpu(results) ? 'GPU time, ms a frame' : 'frame time, ms';
  const plot = {
    x: { label: time }, y: { label: measure.name }, marks, lines: [stairs(results, front, measure)],
    rules: floor === null ? [] : [floorRule(floor)], legend: frontLegend(marks),
    description: `${measure.name} against ${time}, both logarithmic: ${plural(results.points.length, 'configuration')}, ` +
                 `${front.length} of them on the front. The table below has every value.`,
  };
  addTruth(plot, results, measure, floor);
  return plot;
}

function frontFigures({ results, fronts }) {
  const figures = [
    { style: 'main', title: 'Visible error against time', text: 'Mean FLIP of the whole picture. Lower left is better.',
      plot: frontPlot(results, fronts.flip, measures.flip), aspect: 0.53 },
    ...results.motion ? [{
      style: 'main', title: 'Flicker against time', text: 'Error of what changes from frame to frame, on the scale of FLIP.',
      plot: frontPlot(results, fronts.flicker, measures.flicker), aspect: 0.53 }] : [],
    { style: 'half', title: 'Linear error against time', text: 'Root mean square error of linear light, whole picture.',
      plot: frontPlot(results, fronts.rmse, measures.rmse), aspect: 0.79 },
  ];
  if (results.points.some(point => point.error.mirrors)) {
    figures.push({ style: 'half', title: 'Linear error in the mirrors',
                   text: 'The same, over the pixels that show a mirror’s front.',
                   plot: frontPlot(results, fronts.mirrors, measures.mirrors), aspect: 0.79 });
  }
  return figures;
}

function seriesFigure(results, series) {
  const points = series.points.map(index => results.points[index]);
  const mirrors = points.length > 0 && points.every(point => point?.error.mirrors);
  const measure = mirrors ? measures.mirrors : measures.rmse;
  const floor = measure.of(results.ground_truth.noise_floor);
  const marks = points.map((point, i) => {
    const y = point ? measure.of(point.error) : null;
    return y === null ? null : {
      x: series.x[i], y, key: String(series.points[i]), shape: y <= 0 ? 'triangle' : 'disc',
      style: 'front', tip: tipOf(point, measure.name, y),
    };
  }).filter(Boolean);
  const plot = {
    x: { label: series.key, scale: series.axis, ticks: series.x }, y: { label: measure.name }, marks, lines: [],
    rules: floor === null ? [] : [floorRule(floor)],
    description: `${measure.name} against ${series.key} at ${plural(points.length, 'setting')}.`,
  };
  return { style: 'half', title: series.name, text: series.note, plot, aspect: 0.75 };
}

const columnsOfErrors = [
  { heading: 'FLIP', of: error => error.whole.flip },
  { heading: 'RMSE', of: error => error.whole.rmse },
  { heading: 'rel. RMSE', of: error => orInfinity(error.whole.relative_rmse) },
  { heading: 'PSNR, dB', of: error => orInfinity(error.whole.psnr), decimals: 2, descendingFirst: true },
  { heading: 'SSIM', of: error => error.whole.ssim, decimals: 5, descendingFirst: true },
  { heading: 'max', of: error => error.whole.max_diff },
  { heading: 'p99', of: error => error.whole.p99_diff },
  { heading: '> 2/255, %',
    of: error => error.whole.pixels > 0 ? 100 * error.whole.pixels_over / error.whole.pixels : 0 },
  { heading: 'RMSE', of: measures.mirrors.of },
];

function errorColumn({ heading, of, decimals, descendingFirst }, points) {
  const values = points.map(point => of(point.error) ?? 0);
  const digits = values.every(Number.isInteger) ? 0 : decimals ?? columnDecimals(values);
  const text = error => of(error) === null ? '–' : fixedText(of(error), digits);
  return { heading, number: true, descendingFirst, text,
           cell: ({ point }) => ({ content: text(point.error), key: of(point.error) }) };
}

function timeColumn(heading, key, points, quartiles) {
  const decimals = Math.min(3, columnDecimals(points.map(point => point[key].median)));
  return { heading, number: true, cell: ({ point }) => {
    const { median, q1, q3, repeats } = point[key];
    if (!repeats) return { content: '–', key: null };
    const range = `[${fixedText(q1, decimals)}, ${fixedText(q3, decimals)}]`;
    return { content: [fixedText(median, decimals), quartiles ? make('span', { class: 'quartiles' }, ` ${range}`) : ''],
             key: median };
  } };
}

function settingsCell({ point }) {
  const options = setOptions(point.settings);
  if (isBase(point)) return { content: make('span', { class: 'none' }, 'base settings'), key: '' };
  const parts = Object.entries(point.settings).flatMap(([key, value]) => [make('span', {}, setOption(key, value)), ' ']);
  return { content: [make('code', {}, parts), makeCopyButton(options, `Copy the settings of ${point.name}`)], key: options };
}

function pointTable(results, selection) {
  const { points, ground_truth: truth } = results;
  const columns = results.motion ? [{ heading: 'Flicker', of: measures.flicker.of }, ...columnsOfErrors] : columnsOfErrors;
  const errors = columns.map(column => errorColumn(column, points));
  return makeTable({
    caption: ['Every configuration, blue dots: on the front. ', make('span', { class: 'hint' },
      'The headings sort; a name shows its picture and marks it in the plots.')],
    label: 'All configurations',
    groups: [['', 1], ['Configuration', 2], ['Median ms a frame', 2], ['Whole picture', columns.length - 4],
             ['Difference, 1/255', 3], ['Mirrors', 1]],
    columns: [
      { heading: 'Front', title: 'on the front of mean FLIP', style: 'mark', descendingFirst: true, cell: ({ point }) => ({
        content: point.on_front ? make('span', { role: 'img', 'aria-label': 'on the front' }, '●') : '',
        key: Number(point.on_front) }) },
      { heading: 'Name', rowHeading: true, cell: ({ point }) =>
        ({ content: make('button', { type: 'button', class: 'name' }, point.name), key: point.name }) },
      { heading: 'Settings', style: 'settings', cell: settingsCell },
      timeColumn('GPU [quartiles]', 'gpu_ms', points, true),
      timeColumn('CPU', 'cpu_ms', points, false),
      ...errors,
    ],
    rows: byCost(points).map(point => ({
      point, key: String(points.indexOf(point)),
      style: (point.on_front ? 'front' : 'dominated') + (isBase(point) ? ' base' : ''),
    })),
    footer: [make('td'), make('th', { scope: 'row', colspan: 2 }, 'noise floor of the reference'),
             make('td', { class: 'number', colspan: 2 },
                  `${numberText(truth.ms / 1000)} s, ${plural(truth.threads, 'thread')}`),
             ...errors.map(column => make('td', { class: 'number' }, column.text(truth.noise_floor)))],
    sorted: 3,
  }, selection);
}

const missingText = (subject, file) =>
  `${subject} is not in this report; ${file ? `its lossless file is ${file}` : 'it was not kept'}.`;

function viewerItem(point, key, shown) {
  const name = `${point.name}: ${settingsOf(point)}`;
  const files = [point.picture, point.heat_map].filter(Boolean).map(file => make('code', {}, file));
  return {
    key, picture: shown?.picture, map: shown?.map,
    option: `${point.name} · ${numberText(costOf(point).median)} ms${point.on_front ? ' · on the front' : ''}`,
    pictureAlt: `Rendered picture of ${name}`,
    mapAlt: `FLIP error map of ${point.name}, mean ${numberText(point.error.whole.flip)}`,
    missingPicture: missingText(`The picture of ${point.name}`, point.picture),
    missingMap: missingText(`The error map of ${point.name}`, point.heat_map),
    caption: [make('strong', {}, point.name), ' ', make('code', {}, settingsOf(point)), make('br'),
              `${priceText(point)}, RMSE ${numberText(point.error.whole.rmse)}`,
              ...files.length ? ['. Lossless: ', files[0], ...files.slice(1).flatMap(file => [', ', file])] : [], '.'],
  };
}

function pictureViewer({ results, fronts, pictures }, selection) {
  if (!pictures.shown.length) {
    return make('p', { class: 'missing' }, 'No pictures were kept, or none could be read.');
  }
  const shown = new Map(pictures.shown.map(entry => [String(entry.point), entry]));
  const items = new Map(results.points.map((point, i) =>
    [String(i), viewerItem(point, String(i), shown.get(String(i)))]));
  const legend = pictures.legend
    ? pictureOr(pictures.legend, { class: 'legend', alt: 'Colors of the error map and the errors they stand for' }) : null;
  return makeViewer({
    items, size: results.size.map(pixels => Math.max(1, pixels)).join('/'), legend,
    choices: byCost(results.points).map(point => items.get(String(results.points.indexOf(point))))
      .filter(item => item.picture),
    choiceLabel: 'Configuration',
    stepper: { label: 'Point of the front', keys: fronts.flip.map(String), from: 'fast', to: 'exact',
               textOf: key => results.points[key].name },
    left: 'rendered', right: 'ray traced',
    reference: pictureOr(pictures.reference, { class: 'reference', alt: `Ray-traced reference picture of ${results.scene}` },
                         missingText('The reference picture', results.ground_truth.picture)),
    mapCaption: ['FLIP error of each pixel. ', make('span', { class: 'hint' },
      'Zoomed views follow the pointer on the map, or its arrow keys.')],
  }, selection);
}

function frameStrip({ results, pictures }, selection) {
  const frames = new Map(pictures.shown.map(entry => [String(entry.point), entry.frames]));
  return makeStrip({
    reference: pictures.frames, framesOf: key => frames.get(key) ?? [], nameOf: key => results.points[key].name,
    size: results.size.join('/'), fps: results.motion.fps,
  }, selection);
}

// Fills the elements of the page that carry a name in data-fill.
function fillTexts(texts) {
  for (const element of document.querySelectorAll('[data-fill]')) {
    element.textContent = texts[element.dataset.fill];
  }
}

function texts({ results, changed }) {
  const { points, ground_truth: truth } = results;
  const repeats = Math.max(0, ...points.map(point => costOf(point).repeats));
  const scene = `--scene ${shellWord(results.scene)} --size ${results.size.join('x')} --time ${results.time}`;
  const base = Object.keys(changed).length ? ` ${setOptions(changed)}` : '';
  // A part of the name is enough; llvmpipe's ends with the width of vectors, which another run may choose.
  const device = results.device ? ` --gpu ${shellWord(results.device.split(' (')[0])}` : '';
  const motion = results.motion
    ? ` --motion ${shellWord(results.motion.path)} --frames ${results.motion.frames} --fps ${results.motion.fps}` : '';
  return {
    title: results.title || results.scene,
    summary: summary(results),
    reference: truth.picture ? ` The reference is ${truth.picture}.` : '',
    samples: plural(truth.samples, 'sample'),
    repeats: repeats ? `up to ${plural(repeats, 'repeat')} each` : 'none',
    clock: timedOnGpu(results)
      ? 'GPU times come from the device’s timestamps; CPU times are the processor’s share of a frame.'
      : 'The device has no timestamps, so the time of the whole frame stands in for the GPU’s.',
    sweepCommand: `speculum accuracy ${scene}${motion} --sweep ${shellWord(results.sweep)}${base}${device} --out FOLDER`,
    pictureCommand: `speculum render ${scene}${base}${device} --out FOLDER/picture.png --set …`,
    baseSettings: Object.entries(results.settings).map(([key, value]) => `${key} = ${value || '(the scene’s)'}\n`).join(''),
    made: `Made by Speculum ${results.version} from results.json${results.date ? `, ${results.date}` : ''}.`,
  };
}

function showReport(report) {
  const { results } = report;
  const place = id => document.getElementById(id);
  document.documentElement.classList.add('js');
  document.title = `${results.title || results.scene} – accuracy sweep`;
  fillTexts(texts(report));
  place('facts').append(...facts(results));
  for (const id of ['front', 'pictures', 'all']) place(id).hidden = !results.points.length;
  place('again-picture').hidden = Boolean(results.motion);  // its pictures depend on the frames before
  place('base').hidden = !Object.keys(results.settings).length;
  const series = results.series.filter(one => one.points.length).map(one => seriesFigure(results, one));
  place('series').hidden = !series.length;
  if (!results.points.length) return;

  const key = report.pictures.shown[0]?.point ?? Math.max(0, results.points.findIndex(isBase));
  const selection = makeSelection(String(key));
  place('viewer').append(pictureViewer(report, selection));
  place('table').append(pointTable(results, selection));
  place('motion').hidden = !report.pictures.frames.length;
  if (report.pictures.frames.length) place('strip').append(frameStrip(report, selection));
  showFigures(place('front-figures'), frontFigures(report), selection);
  showFigures(place('series-figures'), series, selection);
}

showReport(JSON.parse(document.getElementById('data').textContent));
