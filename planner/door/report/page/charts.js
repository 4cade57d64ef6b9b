'use strict';
// Bars of time, and loads along the path of a step with their limits.

// A drawing as wide as its place, so that its text keeps its size: drawn anew when the window changes, and for paper.
const PAPER = 700;
function fitted(host, draw) {
  let drawn = 0;
  const again = width => { if (width > 0 && width !== drawn) { drawn = width; drop(host).append(...draw(width)); } };
  window.addEventListener('resize', () => again(host.clientWidth));
  window.addEventListener('beforeprint', () => again(PAPER));
  window.addEventListener('afterprint', () => again(host.clientWidth));
  again(host.clientWidth);
  return () => { drawn = 0; again(host.clientWidth); };
}

// What a step takes of the whole time, in order: [seconds, words, colour].
function sharesOf(s, i) {
  return [[s.tool_change_s, 'tool change to ' + toolName(toolOf(s)), '#c3cad2'], [s.link_s, 'way from the step before', '#e0e4e9'],
    [s.spindle_s, 'spindle up, down or stopped', '#8d98a5'], [stepTime(s), stepTitle(s, i), css(stepColour(i))]];
}
function gantt(pick, width) {
  const left = 60, row = 22, setups = DATA.setups.length, all = DATA.steps.map(sharesOf);
  const total = all.flat().reduce((sum, [t]) => sum + t, 0) || 1;
  const x = t => left + (width - left - 10) * t / total;
  const root = svg('svg', {viewBox: `0 0 ${width} ${row * setups + 34}`, role: 'img', 'aria-label': 'time of each step'});
  let t = 0;
  for (let n = 0; n < setups; ++n) root.append(svg('text', {x: 4, y: row * n + 19}, 'set-up ' + (n + 1)));
  DATA.steps.forEach((s, i) => {
    const y = row * s.setup + 6;
    all[i].forEach(([takes, words, fill], k) => {
      const step = k === all[i].length - 1, inset = step ? 0 : 5;
      if (takes > 0) {
        root.append(svg('rect', {x: x(t), y: y + inset, width: Math.max(0.5, x(t + takes) - x(t)), height: row - 6 - 2 * inset, fill, 'data-from': t, 'data-to': t + takes,
          style: step ? 'cursor:pointer' : null, onclick: step ? () => pick(i) : () => {}}, svg('title', {}, words + ', ' + duration(takes))));
      }
      t += takes;
    });
  });
  const ticks = Math.max(1, Math.min(6, Math.floor((width - left) / 90)));
  for (let k = 0; k <= ticks; ++k) {
    root.append(svg('text', {x: x(total * k / ticks), 'text-anchor': k === ticks ? 'end' : k ? 'middle' : 'start', y: row * setups + 26},
      duration(k === ticks ? total : Math.round(total * k / ticks))));
  }
  return root;
}

const CHARTS = [['feed', 'mm/min'], ['depth', 'mm'], ['width', 'mm'], ['force', 'N'], ['torque', 'Nm'], ['power', 'W'], ['deflection', 'mm']];

// A load over the length of the path with its limit over the margin; a feed is compared as it is. A limit far above is drawn
// at the upper edge, with its number.
function chart(step, name, unit, w) {
  const l = step.loads, values = l.columns[name], stated = l.limits[name], margin = name === 'feed' ? 1 : l.margin;
  const limits = values.map((v, i) => (Array.isArray(stated) ? stated[i] : stated || 0) / margin);
  const peak = most(values), low = least(limits.filter(v => v > 0)), known = isFinite(low), near = known && low < 4 * peak;
  const top = 1.08 * Math.max(peak, near ? Math.min(most(limits), 2 * peak) : 0) || 1, h = 150, left = 46, bottom = 18, above = 16;
  const length = Math.max(l.at[l.at.length - 1], 1e-9), x = at => left + (w - left - 6) * at / length, y = v => h - bottom - (h - bottom - above) * Math.min(v, top) / top;
  const line = column => column.map((v, i) => (i ? 'L' : 'M') + number(x(l.at[i]), 1) + ' ' + number(y(v), 1)).join('');
  const words = v => number(v, v < 1 ? 3 : v < 100 ? 1 : 0);
  const root = svg('svg', {viewBox: `0 0 ${w} ${h}`, role: 'img', 'aria-label': name + ' along the path'});
  for (const v of [0, top / 2.16, top / 1.08]) root.append(svg('line', {x1: left, x2: w - 6, y1: y(v), y2: y(v), stroke: '#e3e7eb'}), svg('text', {x: 2, y: y(v) + 4}, words(v)));
  root.append(svg('path', {d: line(values), fill: 'none', stroke: '#3b6ea5', 'stroke-width': 1.2}));
  const red = {class: 'limit', fill: 'none', stroke: '#c0392b', 'stroke-dasharray': '5 3'};
  if (near) root.append(svg('path', {d: line(limits), ...red}));
  else if (known) root.append(svg('path', {d: `M${left} 2L${w - 6} 2`, ...red}));
  if (known) root.append(svg('text', {class: 'limit', x: w - 6, y: 13, 'text-anchor': 'end', style: 'fill:#c0392b'}, (near ? 'limit from ' : 'limit, far above: ') + words(low)));
  root.append(svg('text', {x: left, y: h - 4}, '0'), svg('text', {x: w - 6, y: h - 4, 'text-anchor': 'end'}, number(length, 0) + ' mm'));
  const said = known ? '; limit ' + (margin > 1 ? 'of the expected load ' : '') + words(low) + (most(limits) > 1.01 * low ? ' or more' : '') : '';
  return el('figure', {}, root, el('figcaption', {}, name + ', ' + unit + ': at most ' + number(peak, peak < 1 ? 4 : 1) + said));
}

// `width`: of the place; as many charts stand side by side as have room (style.css, .charts).
function chartsOf(step, width) {
  if (!step.loads || !step.loads.move || !step.loads.move.length) return [el('p', {}, 'The plan holds no sections of this step.')];
  const held = step.held_by.map(h => plain(h.name) + ' ' + number(100 * h.share, 0) + ' %').join(', ');
  const about = 'Expected loads: sharp edge, mean coefficients. What is compared with a limit is ' + number(step.loads.margin, 2) + ' times as much; a feed is compared as it is.'
    + (held ? ' The feed is held by: ' + held + ' of the time.' : '');
  const gap = 8, least = 330, beside = Math.max(1, Math.floor((width + gap) / (least + gap)));
  const w = Math.floor((width - gap * (beside - 1)) / beside);
  return [el('p', {}, about), el('div', {class: 'charts', style: `grid-template-columns:repeat(${beside}, 1fr);gap:${gap}px`}, ...CHARTS.map(([name, unit]) => chart(step, name, unit, w)))];
}
