'use strict';
// Bars of time, and loads along the path of a step with their limits.
function gantt(pick) {
  const width = 1200, left = 60, row = 22, setups = DATA.setups.length;
  const change = DATA.time && DATA.time.tool_changes ? DATA.time.tool_change_s / DATA.time.tool_changes : 0;
  const total = DATA.steps.reduce((sum, s, i) => sum + stepTime(s) + (changes(i) ? change : 0), 0) || 1;
  const x = t => left + (width - left - 10) * t / total;
  const root = svg('svg', {viewBox: `0 0 ${width} ${row * setups + 34}`, role: 'img', 'aria-label': 'time of each step'});
  let t = 0;
  for (let n = 0; n < setups; ++n) root.append(svg('text', {x: 4, y: row * n + 19}, 'set-up ' + (n + 1)));
  DATA.steps.forEach((s, i) => {
    const y = row * s.setup + 6;
    if (changes(i)) {
      root.append(svg('rect', {x: x(t), y: y + 5, width: Math.max(0.5, x(t + change) - x(t)), height: row - 14, fill: '#c3cad2'}, svg('title', {}, 'tool change to ' + toolName(toolOf(s)) + ', ' + duration(change))));
      t += change;
    }
    root.append(svg('rect', {x: x(t), y, width: Math.max(0.8, x(t + stepTime(s)) - x(t)), height: row - 6, fill: css(stepColour(i)), style: 'cursor:pointer', onclick: () => pick(i)},
      svg('title', {}, stepTitle(s, i) + ', ' + duration(stepTime(s)))));
    t += stepTime(s);
  });
  for (let k = 0; k <= 6; ++k) root.append(svg('text', {x: x(total * k / 6), 'text-anchor': k === 6 ? 'end' : k ? 'middle' : 'start', y: row * setups + 26}, duration(Math.round(total * k / 6))));
  return root;
}
// True if another tool is put in before step i.
function changes(i) { return i === 0 || DATA.steps[i].tool !== DATA.steps[i - 1].tool; }

const CHARTS = [['feed', 'mm/min'], ['depth', 'mm'], ['width', 'mm'], ['force', 'N'], ['torque', 'Nm'], ['power', 'W'], ['deflection', 'mm']];

// A load over the length of the path, and its limit over the margin where one is stated and near.
function chart(step, name, unit) {
  const l = step.loads, values = l.columns[name], stated = l.limits[name];
  const limits = values.map((v, i) => (Array.isArray(stated) ? stated[i] : stated || 0) / l.margin);
  const peak = most(values), low = least(limits.filter(v => v > 0)), near = low < 4 * peak;
  const top = 1.08 * Math.max(peak, near ? Math.min(most(limits), 2 * peak) : 0) || 1, w = 480, h = 150, left = 46, bottom = 18;
  const length = Math.max(l.at[l.at.length - 1], 1e-9), x = at => left + (w - left - 6) * at / length, y = v => h - bottom - (h - bottom - 8) * Math.min(v, top) / top;
  const line = column => column.map((v, i) => (i ? 'L' : 'M') + number(x(l.at[i]), 1) + ' ' + number(y(v), 1)).join('');
  const root = svg('svg', {viewBox: `0 0 ${w} ${h}`, role: 'img', 'aria-label': name + ' along the path'});
  for (const v of [0, top / 2.16, top / 1.08]) root.append(svg('line', {x1: left, x2: w - 6, y1: y(v), y2: y(v), stroke: '#e3e7eb'}), svg('text', {x: 2, y: y(v) + 4}, number(v, v < 1 ? 3 : v < 100 ? 1 : 0)));
  root.append(svg('path', {d: line(values), fill: 'none', stroke: '#3b6ea5', 'stroke-width': 1.2}));
  if (near) root.append(svg('path', {d: line(limits), fill: 'none', stroke: '#c0392b', 'stroke-dasharray': '5 3'}));
  root.append(svg('text', {x: left, y: h - 4}, '0'), svg('text', {x: w - 60, y: h - 4}, number(length, 0) + ' mm'));
  const said = isFinite(low) ? '; limit of the expected load ' + number(low, low < 1 ? 3 : 1) : '';
  return el('figure', {}, root, el('figcaption', {}, name + ', ' + unit + ': at most ' + number(peak, peak < 1 ? 4 : 1) + said));
}

function chartsOf(step) {
  if (!step.loads || !step.loads.move || !step.loads.move.length) return [el('p', {}, 'The plan holds no sections of this step.')];
  const held = step.held_by.map(h => plain(h.name) + ' ' + number(100 * h.share, 0) + ' %').join(', ');
  const about = 'Expected loads: sharp edge, mean coefficients. What is compared with a limit is ' + number(step.loads.margin, 2) + ' times as much.'
    + (held ? ' The feed is held by: ' + held + ' of the time.' : '');
  return [el('p', {}, about), el('div', {class: 'charts'}, ...CHARTS.map(([name, unit]) => chart(step, name, unit)))];
}
