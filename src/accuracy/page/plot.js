'use strict';
// Plots as inline SVG: axes, marks with tooltips, lines and rules.

const characterWidth = 6.3;
const labelHeight = 13;

// `mantissa` times a power of ten, correctly rounded.
const decimal = (mantissa, exponent) => Number(`${mantissa}e${exponent}`);

// Round values in [low, high], at most `most`: steps of 1, 2 or 5 times a power of ten.
function linearTicks(low, high, most) {
  if (!(high > low) || most < 1) return [low];
  for (let exponent = Math.floor(Math.log10((high - low) / most)); ; ++exponent) {
    for (const mantissa of [1, 2, 5]) {
      const step = decimal(mantissa, exponent);
      const ticks = [];
      for (let n = Math.ceil(low / step - 1e-9); n <= high / step + 1e-9; ++n) {
        ticks.push(Number((n * step).toPrecision(12)));
      }
      if (ticks.length <= most) return ticks;
    }
  }
}

function decadeTicks(low, high, mantissas, step) {
  const ticks = [];
  for (let exponent = Math.floor(Math.log10(low)); exponent <= Math.ceil(Math.log10(high)); ++exponent) {
    if (exponent % step === 0) {
      ticks.push(...mantissas.map(mantissa => decimal(mantissa, exponent)));
    }
  }
  return ticks.filter(tick => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

// The same for 0 < low <= high: 1, 2 and 5 of every decade, else decades; linear steps within less than a decade.
function logarithmicTicks(low, high, most) {
  const steps = decadeTicks(low, high, [1, 2, 5], 1);
  if (steps.length <= most) {
    if (steps.length >= 3) return steps;
    const linear = linearTicks(low, high, Math.min(most, 5));
    return linear.length > steps.length ? linear : steps;
  }
  for (let step = 1; ; ++step) {
    const decades = decadeTicks(low, high, [1], step);
    if (decades.length <= most) return decades;
  }
}

function powerText(value) {
  const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-9);
  const mantissa = String(Number((value / 10 ** exponent).toPrecision(6)));
  return (mantissa === '1' ? '' : `${withMinusSign(mantissa)}×`) + `10${superscript(exponent)}`;
}

// One style for all ticks of an axis: plain, or powers of ten if one is below 0.0001 or above 100000.
function tickLabels(ticks) {
  const plain = ticks.every(tick => tick === 0 || (Math.abs(tick) > 0.99e-4 && Math.abs(tick) < 1.01e5));
  return ticks.map(tick => plain || tick === 0 ? withMinusSign(String(Number(tick.toPrecision(6)))) : powerText(tick));
}

// The lowest and highest transformed value, widened so that no mark lies on the frame.
function axisRange(values, logarithmic) {
  if (!values.length) return logarithmic ? [-1, 0] : [0, 1];
  const low = Math.min(...values);
  const high = Math.max(...values);
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const single = high - low <= Math.max(1e-9 * largest, 1e-100);
  const around = logarithmic ? 0.4 : largest > 1e-100 ? 0.1 * largest : 1;
  const widening = single ? around : Math.max(0.06 * (high - low), logarithmic ? 0.05 : 0);
  return [low - widening, high + widening];
}

// Maps values to coordinates between `from` and `to`. axis: { scale: 'linear' or 'logarithmic', ticks, apart }.
// Values that are not positive lie on a strip before a logarithmic axis; from `apart` on they lie behind a break.
function makeScale(axis, values, from, to) {
  const logarithmic = axis.scale !== 'linear';
  const transformed = value => logarithmic ? Math.log10(value) : value;
  const isApart = value => axis.apart !== undefined && value >= axis.apart;
  const limit = logarithmic ? 250 : 1e150;  // so that a widened range stays finite
  const onAxis = values.filter(v => Number.isFinite(v) && !isApart(v) && (v > 0 || !logarithmic));
  const [low, high] = axisRange(onAxis.map(v => Math.max(-limit, Math.min(limit, transformed(v)))), logarithmic);
  const direction = Math.sign(to - from);
  const zero = logarithmic && values.some(value => value <= 0) ? from + direction * 10 : null;
  const apart = axis.apart === undefined ? null : to - direction * 25;
  const start = zero === null ? from : from + direction * 26;
  const end = apart === null ? to : to - direction * 62;

  // Not clamped, for lines that leave the plot.
  const unclampedAt = value => !Number.isFinite(value) || (logarithmic && value <= 0)
    ? null : start + (end - start) * (transformed(value) - low) / (high - low);
  const at = value => {
    if (value === null || value === undefined || Number.isNaN(value)) return null;
    if (isApart(value)) return apart;
    if (logarithmic && value <= 0) return zero ?? start;
    if (!Number.isFinite(value)) return value > 0 ? end : start;
    return Math.max(Math.min(start, end), Math.min(Math.max(start, end), unclampedAt(value)));
  };
  // A label takes `gap` along the axis and `characterSize` for each character; crowded labels are empty.
  const ticks = (characterSize, gap) => {
    const [least, greatest] = logarithmic ? [10 ** low, 10 ** high] : [low, high];
    const most = Math.max(2, Math.floor(Math.abs(end - start) / (4 * characterSize + gap)));
    let chosen = (axis.ticks ?? []).filter(tick => tick >= least && tick <= greatest);
    if (!chosen.length) {
      chosen = logarithmic ? logarithmicTicks(least, greatest, most) : linearTicks(least, greatest, most);
    }
    const labels = tickLabels(chosen);
    let occupied = -Infinity;
    const result = chosen.map((value, i) => {
      const along = Math.abs(at(value) - start);
      const half = 0.5 * (characterSize * labels[i].length + gap);
      const room = along - half >= occupied;
      occupied = room ? along + half : occupied;
      return { at: at(value), label: room ? labels[i] : '', offAxis: false };
    });
    if (zero !== null) result.push({ at: zero, label: '0', offAxis: true });
    if (apart !== null) result.push({ at: apart, label: numberText(axis.apart), offAxis: true });
    return result;
  };
  return { at, unclampedAt, ticks, start, end, hasZero: zero !== null, hasApart: apart !== null };
}

const rounded = value => Math.round(value * 10) / 10;
const svgLine = (style, x1, y1, x2, y2) =>
  makeSvg('line', { class: style, x1: rounded(x1), y1: rounded(y1), x2: rounded(x2), y2: rounded(y2) });
const svgText = (style, x, y, text) => makeSvg('text', { class: style, x: rounded(x), y: rounded(y) }, text);

function svgShape(shape, x, y) {
  const corners = {
    square: [[-4.5, -4.5], [4.5, -4.5], [4.5, 4.5], [-4.5, 4.5]],
    diamond: [[0, -6.5], [6.5, 0], [0, 6.5], [-6.5, 0]],
    triangle: [[-5.5, -4.5], [5.5, -4.5], [0, 5.5]],
  }[shape];
  if (corners) {
    const points = corners.map(([dx, dy]) => `${rounded(x + dx)},${rounded(y + dy)}`).join(' ');
    return makeSvg('polygon', { class: 'shape', points });
  }
  const ring = shape === 'ring';
  return makeSvg('circle', { class: ring ? 'shape hollow' : 'shape', cx: rounded(x), cy: rounded(y), r: ring ? 3.5 : 4.5 });
}

function drawLegend(entries, width) {
  const group = makeSvg('g');
  let x = 14;
  let y = 12;
  for (const entry of entries) {
    const needed = 24 + 6 + characterWidth * entry.label.length + 14;
    if (x > 14 && x + needed > width) {
      x = 14;
      y += 20;
    }
    group.append(makeSvg('g', { class: entry.style },
      entry.shape ? svgShape(entry.shape, x + 12, y) : svgLine('stroke', x, y, x + 24, y),
      svgText('text', x + 30, y + 4, entry.label)));
    x += needed;
  }
  return { group, height: entries.length ? y + 10 : 0 };
}

function drawAxes(plot) {
  const { spec, frame, x, y, height } = plot;
  const parts = [];
  for (const tick of x.ticks(characterWidth, 10)) {
    parts.push(svgLine(tick.offAxis ? 'grid apart' : 'grid', tick.at, frame.top, tick.at, frame.bottom),
               tick.label && svgText('text middle', tick.at, frame.bottom + 16, tick.label));
  }
  for (const tick of y.ticks(0, 20)) {
    parts.push(svgLine(tick.offAxis ? 'grid apart' : 'grid', frame.left, tick.at, frame.right, tick.at),
               tick.label && svgText('text end', frame.left - 8, tick.at + 4, tick.label));
  }
  parts.push(svgLine('axis', frame.left, frame.top, frame.left, frame.bottom),
             svgLine('axis', frame.left, frame.bottom, frame.right, frame.bottom));
  // Two slanted strokes where an axis leaves out a part of its range.
  const breaks = (atX, atY, dx, dy) => [-2.5, 2.5].forEach(shift => parts.push(
    svgLine('axis', atX + shift * dx - 2.5, atY + shift * dy + 4, atX + shift * dx + 2.5, atY + shift * dy - 4)));
  if (x.hasApart) breaks(x.end + 8, frame.bottom, 1, 0);
  if (x.hasZero) breaks(x.start - 6, frame.bottom, 1, 0);
  if (y.hasZero) breaks(frame.left, y.start + 6, 0, 1);
  const middle = rounded(0.5 * (frame.top + frame.bottom));
  parts.push(svgText('text middle title', 0.5 * (frame.left + frame.right), height - 10, spec.x.label),
             fillElement(svgText('text middle title', 12, middle, spec.y.label),
                         { transform: `rotate(-90 12 ${middle})` }, []));
  return parts;
}

function drawRules({ spec, frame, y, occupied }) {
  return (spec.rules ?? []).filter(rule => y.unclampedAt(rule.y) !== null).map(rule => {
    const at = y.at(rule.y);
    const left = frame.left + 6;
    const base = at - 14 > frame.top ? at - 5 : at + 14;
    occupied.push([frame.left, at - 1, frame.right, at + 1],
                  [left, base - 11, left + characterWidth * rule.label.length, base + 3]);
    return makeSvg('g', { class: rule.style }, svgLine('stroke', frame.left, at, frame.right, at),
                   svgText('text', left, base, rule.label));
  });
}

// The part of a segment between `top` and `bottom`; x never leaves the frame.
function cutAtFrame([ax, ay], [bx, by], top, bottom) {
  const dy = by - ay;
  if (dy === 0) return ay >= top && ay <= bottom ? [ax, ay, bx, by] : null;
  const first = Math.max(0, Math.min((top - ay) / dy, (bottom - ay) / dy));
  const last = Math.min(1, Math.max((top - ay) / dy, (bottom - ay) / dy));
  const at = t => [ax + t * (bx - ax), Math.max(top, Math.min(bottom, ay + t * dy))];
  return first > last ? null : [...at(first), ...at(last)];
}

function drawLines({ spec, frame, x, y, occupied }) {
  const top = Math.min(y.start, y.end);
  // A value off the axis has its strip; elsewhere a line keeps its slope up to the frame.
  const place = ([px, py]) => [x.at(px), py > 0 || !y.hasZero ? y.unclampedAt(py) : y.at(py)];
  return (spec.lines ?? []).map(line => {
    const places = line.points.map(place);
    let path = '';
    for (let i = 1; i < places.length; ++i) {
      const known = ![...places[i - 1], ...places[i]].includes(null);
      const cut = known && cutAtFrame(places[i - 1], places[i], top, frame.bottom);
      if (cut) {
        const [ax, ay, bx, by] = cut.map(rounded);
        path += `M${ax} ${ay}L${bx} ${by}`;
        occupied.push([Math.min(ax, bx) - 1, Math.min(ay, by) - 1, Math.max(ax, bx) + 1, Math.max(ay, by) + 1]);
      }
    }
    return path ? makeSvg('g', { class: line.style }, makeSvg('path', { class: 'stroke', d: path })) : null;
  });
}

// The quartiles as a bar, the minimum as a thin tick.
function drawSpread(mark, scale, y) {
  const [low, high, minimum] = [mark.spread.q1, mark.spread.q3, mark.spread.min].map(scale.at);
  if ([low, high, minimum].includes(null)) return null;
  return makeSvg('g', { class: `spread ${mark.style}` }, svgLine('bar', low, y, high, y),
                 svgLine('minimum', minimum, y, low, y), svgLine('minimum', minimum, y - 4, minimum, y + 4));
}

// The label at the first of eight places around its mark where it hides nothing; null without such a place.
function drawLabel(text, atX, atY, frame, occupied) {
  const width = characterWidth * text.length;
  const [right, left, centre] = [atX + 9, atX - 9 - width, atX - 0.5 * width];
  const [middle, above, below] = [atY - 0.5 * labelHeight, atY - 7 - labelHeight, atY + 7];
  const corners = [[right, middle], [right - 4, above], [centre, above], [right - 4, below],
                   [left, middle], [left + 4, below], [centre, below], [left + 4, above]];
  const free = corners.find(([x, y]) =>
    x >= frame.left && x + width <= frame.right && y >= frame.top && y + labelHeight <= frame.bottom &&
    !occupied.some(([l, t, r, b]) => x < r && l < x + width && y < b && t < y + labelHeight));
  if (!free) return null;
  occupied.push([free[0], free[1], free[0] + width, free[1] + labelHeight]);
  return svgText('text label', free[0], free[1] + 10, text);
}

// spec: { description, x, y: { label, scale, ticks, apart }, marks: [{ x, y, shape, style, label, tip, key, spread }],
// lines: [{ style, points }], rules: [{ y, style, label }], legend: [{ label, style, shape }] }. Later marks cover
// earlier ones and are labelled first. `style` is a class of the style sheet. Everything lies within the view box.
function drawPlot(spec, width, height) {
  const legend = drawLegend(spec.legend ?? [], width);
  const frame = { left: 62, top: legend.height + 10, right: width - 14, bottom: height - 46 };
  const spreads = mark => mark.spread ? [mark.spread.min, mark.spread.q1, mark.spread.q3] : [];
  const rules = (spec.rules ?? []).map(rule => rule.y).filter(y => y > 0 || spec.y.scale === 'linear');
  const x = makeScale(spec.x, spec.marks.flatMap(mark => [mark.x, ...spreads(mark)]), frame.left, frame.right);
  const y = makeScale(spec.y, [...spec.marks.map(mark => mark.y), ...rules], frame.bottom, frame.top);
  const occupied = [];
  const plot = { spec, frame, x, y, height, occupied };
  const marks = spec.marks.map(mark => ({ mark, x: x.at(mark.x), y: y.at(mark.y) }))
    .filter(placed => placed.x !== null && placed.y !== null);
  const under = [...drawAxes(plot), ...drawRules(plot), ...drawLines(plot)];
  occupied.push(...marks.map(placed => [placed.x - 6, placed.y - 6, placed.x + 6, placed.y + 6]));
  for (const placed of marks) {
    const ends = spreads(placed.mark).map(x.at).filter(end => end !== null);
    occupied.push([Math.min(...ends), placed.y - 2, Math.max(...ends), placed.y + 2]);
  }
  const labels = [...marks].reverse().filter(placed => placed.mark.label)
    .map(placed => drawLabel(placed.mark.label, placed.x, placed.y, frame, occupied));
  return makeSvg('svg', { class: 'plot', role: 'group', viewBox: `0 0 ${width} ${height}`, 'aria-label': spec.description },
    legend.group, ...under, ...marks.map(p => p.mark.spread ? drawSpread(p.mark, x, p.y) : null), ...labels,
    ...marks.map(p => makeSvg('g', {
      class: `mark ${p.mark.style}`, 'data-key': p.mark.key, role: p.mark.key === undefined ? 'img' : 'button',
      'aria-label': p.mark.tip.replaceAll('\n', ', '), 'data-tip': p.mark.tip, tabindex: '-1',
    }, makeSvg('circle', { class: 'hit', cx: rounded(p.x), cy: rounded(p.y), r: 10 }), svgShape(p.mark.shape, p.x, p.y))));
}

// One tooltip for all plots of the page.
const tooltip = {
  box: null,
  show(mark) {
    this.box ??= document.body.appendChild(make('div', { class: 'tip' }));
    this.box.textContent = mark.dataset.tip;
    this.box.hidden = false;
    const at = mark.querySelector('.hit').getBoundingClientRect();
    const room = document.documentElement.clientWidth - this.box.offsetWidth - 8;
    const above = at.top > this.box.offsetHeight + 12;
    this.box.style.left = `${scrollX + Math.max(8, Math.min(at.left + at.width / 2 - this.box.offsetWidth / 2, room))}px`;
    this.box.style.top = `${scrollY + (above ? at.top - this.box.offsetHeight - 6 : at.bottom + 6)}px`;
  },
  hide() {
    if (this.box) this.box.hidden = true;
  },
};

// One tab stop a plot; arrow keys go from mark to mark along x, Enter selects.
function activatePlot(plot, selection) {
  const x = mark => mark.querySelector('.hit').cx.baseVal.value;
  const marks = [...plot.querySelectorAll('.mark')].filter(m => m.querySelector('.hit')).sort((a, b) => x(a) - x(b));
  marks[0]?.setAttribute('tabindex', '0');
  marks.forEach((mark, i) => {
    const select = () => mark.dataset.key !== undefined && selection.set(mark.dataset.key);
    mark.addEventListener('pointerenter', () => tooltip.show(mark));
    mark.addEventListener('pointerleave', () => tooltip.hide());
    mark.addEventListener('focus', () => tooltip.show(mark));
    mark.addEventListener('blur', () => tooltip.hide());
    mark.addEventListener('click', select);
    mark.addEventListener('keydown', event => {
      const next = marks[i + ({ ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? NaN)];
      if (next) {
        mark.setAttribute('tabindex', '-1');
        next.setAttribute('tabindex', '0');
        next.focus();
      } else if (event.key === 'Enter' || event.key === ' ') {
        select();
      } else if (event.key === 'Escape') {
        tooltip.hide();
      } else {
        return;
      }
      event.preventDefault();
    });
  });
}

// A figure whose plot is drawn in pixels of the screen, again whenever its width changes.
function makeFigure({ style, title, text, plot, aspect }, selection) {
  const figure = make('figure', { class: style }, make('figcaption', {}, make('h3', {}, title), make('p', {}, text)));
  const mark = key => figure.querySelectorAll('.mark[data-key]').forEach(
    m => m.classList.toggle('selected', m.dataset.key === key));
  let drawnWidth = 0;
  const draw = () => {
    const width = Math.max(320, figure.clientWidth);
    if (width === drawnWidth) return;
    drawnWidth = width;
    figure.querySelector('svg')?.remove();
    figure.append(drawPlot(plot, width, Math.round(Math.max(320, Math.min(500, width * aspect)))));
    activatePlot(figure.querySelector('svg'), selection);
    mark(selection.key);
  };
  selection.listen(mark);
  addEventListener('resize', draw);
  return { figure, draw };
}

// Puts figures into the page and draws them there, where their widths are known.
function showFigures(parent, specs, selection) {
  const figures = specs.map(spec => makeFigure(spec, selection));
  parent.append(...figures.map(({ figure }) => figure));
  figures.forEach(({ draw }) => draw());
}
