'use strict';
// Elements, numbers and the data of the page. All text is set as text, never as HTML.
const DATA = JSON.parse(document.getElementById('data').textContent);
const SVG = 'http://www.w3.org/2000/svg';

function fill(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined) element.setAttribute(key, value);
  }
  for (const child of children) {
    if (child === null || child === undefined) continue;
    element.append(child.nodeType ? child : String(child));
  }
  return element;
}
function el(name, attributes, ...children) { return fill(document.createElement(name), attributes, children); }
function svg(name, attributes, ...children) { return fill(document.createElementNS(SVG, name), attributes, children); }
function by(id) { return document.getElementById(id); }
function drop(element) { while (element.firstChild) element.removeChild(element.firstChild); return element; }

// Of lists of any length; a call may have only so many arguments.
function most(values, least = 0) { return values.reduce((a, b) => (b > a ? b : a), least); }
function least(values, most = Infinity) { return values.reduce((a, b) => (b < a ? b : a), most); }
function number(value, digits) {
  if (value === null || value === undefined || !isFinite(value)) return '-';
  return String(Number(Number(value).toFixed(digits)));
}
function positive(value, digits) { return value > 0 ? number(value, digits) : '-'; }
function duration(seconds) {
  const tenths = Math.round(10 * seconds), minutes = Math.floor(tenths / 600), rest = (tenths - 600 * minutes) / 10;
  return (minutes ? minutes + ' min ' : '') + number(rest, 1) + ' s';
}
function plain(name) { return name.split('_').join(' ').toLowerCase(); }
function stepTime(step) { return step.cutting_s + step.rapid_s; }
function toolOf(step) { return step.tool === null ? null : DATA.tools[step.tool]; }
function toolName(tool) { return tool === null ? '-' : 'T' + tool.number; }
function stepTitle(step, i) { return (i + 1) + ' ' + step.id; }

// A table whose columns are [title, is a number, cell of a row].
// `foot`: rows of [words, text of the last column] below them.
function table(columns, rows, each, foot = []) {
  const head = el('tr', {}, ...columns.map(c => el('th', {class: c[1] ? 'n' : null}, c[0])));
  const body = rows.map((row, i) => {
    const cells = columns.map(c => el('td', {class: c[1] ? 'n' : null}, c[2](row, i)));
    return el('tr', each ? each(row, i) : {}, ...cells);
  });
  return el('div', {class: 'scroll'}, el('table', {}, el('thead', {}, head), el('tbody', {}, ...body),
    ...(foot.length ? [el('tfoot', {}, ...foot.map(([words, last]) => el('tr', {}, el('td', {colspan: columns.length - 1}, words), el('td', {class: 'n'}, last))))] : [])));
}

// Blue to red over 0 to 1; what lies above is dark.
function ramp(share) {
  if (share > 1) return [0.35, 0.05, 0.1];
  const s = Math.max(0, Math.min(1, share));
  const stops = [[0.16, 0.35, 0.75], [0.1, 0.62, 0.6], [0.85, 0.7, 0.1], [0.82, 0.2, 0.15]];
  const at = s * (stops.length - 1), i = Math.min(Math.floor(at), stops.length - 2), t = at - i;
  return stops[i].map((v, k) => v + t * (stops[i + 1][k] - v));
}
function css(rgb) { return 'rgb(' + rgb.map(v => Math.round(255 * v)).join(',') + ')'; }
