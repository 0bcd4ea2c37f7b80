'use strict';
// The frames of a movement: a strip of those that the reference and a configuration have, and one of them in full size.

// reference: pictures { width, height, uri } by frame; framesOf(key): the same of a configuration, empty without;
// nameOf(key): its name; size: "width/height"; fps: at which the strip is played.
function makeStrip({ reference, framesOf, nameOf, size, fps }, selection) {
  const moment = makeSelection(0);
  const last = reference.length - 1;
  const number = make('output');
  const slider = make('input', { type: 'range', class: 'stepper', min: 0, max: last, value: 0, 'aria-label': 'Frame' });
  const play = make('button', { type: 'button', 'aria-pressed': 'false' }, 'play');
  const large = make('div', { class: 'panes' });
  const strip = make('div', { class: 'strip' });
  const frames = () => [['ray traced', reference], [nameOf(selection.key), framesOf(selection.key)]];
  const alt = (name, frame) => `Frame ${frame + 1}, ${name}`;

  const showMoment = () => {
    slider.value = moment.key;
    number.textContent = `${moment.key + 1} of ${last + 1}`;
    large.replaceChildren(...frames().map(([name, pictures]) => make('div', { class: 'pane' },
      make('div', { class: 'frame', style: `aspect-ratio:${size}` },
           pictureOr(pictures[moment.key], { alt: alt(name, moment.key) }, 'Its frames are not in this report.')),
      make('p', { class: 'shown' }, name))));
    strip.querySelectorAll('img').forEach(image => image.classList.toggle('now', image.dataset.frame === String(moment.key)));
  };
  const showStrip = () => {
    strip.replaceChildren(...frames().map(([name, pictures]) => make('div', {}, pictures.map((picture, frame) =>
      pictureOr(picture, { alt: alt(name, frame), 'data-frame': String(frame) }, '–')))));
    showMoment();
  };
  strip.addEventListener('click', event => event.target.dataset.frame && moment.set(Number(event.target.dataset.frame)));
  slider.addEventListener('input', () => moment.set(Number(slider.value)));
  let timer = 0;
  play.addEventListener('click', () => {
    clearInterval(timer);
    timer = timer ? 0 : setInterval(() => moment.set(moment.key < last ? moment.key + 1 : 0), 1000 / Math.min(fps, 60));
    play.setAttribute('aria-pressed', String(timer !== 0));
  });
  moment.listen(showMoment);
  selection.listen(showStrip);
  return make('div', {}, make('p', { class: 'controls' }, make('label', {}, 'Frame ', slider, ' ', number), play), large,
              strip);
}
