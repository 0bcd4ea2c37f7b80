'use strict';
// Numbers, commands and elements, as every part of the page writes them.

const superscript = number => String(number).replace(/[-0-9]/g, c => c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]);
const withMinusSign = text => text.replace(/^-/, '−');
const plural = (count, noun) => `${count} ${noun}${count === 1 ? '' : 's'}`;

// Significant digits; powers of ten below 0.0001 and from a million on; "–" for a number that is missing.
function numberText(value, significant = 3) {
  if (value === null || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const [mantissa, exponent] = value.toExponential(significant - 1).split('e');
  const power = Number(exponent);
  return power >= -4 && power < 6 ? withMinusSign(value.toFixed(Math.max(0, significant - 1 - power)))
                                  : `${withMinusSign(mantissa)}×10${superscript(power)}`;
}

const fixedText = (value, decimals) => Number.isFinite(value) ? withMinusSign(value.toFixed(decimals))
                                                              : numberText(value);

// Decimals that keep three significant digits of the smallest value that is neither zero nor infinite, 6 at most.
function columnDecimals(values) {
  const needed = values.filter(v => Number.isFinite(v) && v !== 0).map(v => 2 - Math.floor(Math.log10(Math.abs(v))));
  return Math.min(6, Math.max(0, ...needed));
}

// One word of a shell, in quotes only where they are needed: for sh, on Windows for cmd.exe, which replaces %NAME% within
// quotes and ends them at \". A terminal acts on control characters that are pasted; cmd.exe has no notation for them.
const control = /[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/gu;
const codeOf = c => c.codePointAt(0).toString(16).padStart(8, '0');
const shWord = text => /^[A-Za-z0-9_.\/=,:+@%-]+$/.test(text) ? text
  : text.match(control) ? `$'${text.replace(/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}'\\]/gu, c => `\\U${codeOf(c)}`)}'`
    : `'${text.replaceAll("'", "'\\''")}'`;
const cmdWord = text => /^[A-Za-z0-9_.\/\\=:+@-]+$/.test(text) ? text
  : `"${text.replace(control, c => `\\U${codeOf(c)}`)
    .replace(/(\\*)(["%]|$)/g, (_, slashes, end) => slashes + slashes + ({ '"': '"\\^""', '%': '"^%"' }[end] ?? ''))}"`;
const shellWord = navigator.userAgent.includes('Windows') ? cmdWord : shWord;

const setOption = (key, value) => `--set ${shellWord(`${key}=${value}`)}`;
const setOptions = settings => Object.entries(settings).map(([key, value]) => setOption(key, value)).join(' ');

function fillElement(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== false && value !== undefined) {
      element.setAttribute(key, value === true ? '' : value);
    }
  }
  element.append(...children.flat().filter(child => child !== null && child !== ''));
  return element;
}

// An element with attributes (null, false and undefined leave one out) and children; strings become text.
const make = (name, attributes = {}, ...children) =>
  fillElement(document.createElement(name), attributes, children);
const makeSvg = (name, attributes = {}, ...children) =>
  fillElement(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

// The key that is selected in every part of the page; `listen` also calls at once.
function makeSelection(key) {
  const listeners = [];
  return {
    get key() { return key; },
    set(next) {
      key = next;
      listeners.forEach(listener => listener(key));
    },
    listen(listener) {
      listeners.push(listener);
      listener(key);
    },
  };
}
