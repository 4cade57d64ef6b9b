'use strict';
// A step's path as points. Data: entry i of kind 0 rapid, 1 line, 2 arc clockwise, 3 counter-clockwise, 4 dwell runs from
// point i - 1 to point i; lengths are micrometres. Arcs become chords, 6 degrees at most.
const KIND = {rapid: 0, line: 1, cw: 2, ccw: 3, dwell: 4};
const CHORD = 6 * Math.PI / 180;

function pointsOf(step) {
  if (step.points) return step.points;
  const p = step.path || {x: [], y: [], z: [], cx: [], cy: [], kind: [], feed: []};
  const out = {x: [], y: [], z: [], move: [], rapid: [], feed: [], length: []};
  let length = 0;
  const add = (x, y, z, i) => {
    const n = out.x.length;
    if (n) length += Math.hypot(x - out.x[n - 1], y - out.y[n - 1], z - out.z[n - 1]);
    out.x.push(x); out.y.push(y); out.z.push(z);
    out.move.push(i); out.rapid.push(p.kind[i] === KIND.rapid); out.feed.push(p.feed[i]); out.length.push(length);
  };
  for (let i = 0; i < p.x.length; ++i) {
    const x = p.x[i] / 1000, y = p.y[i] / 1000, z = p.z[i] / 1000;
    if (i && (p.kind[i] === KIND.cw || p.kind[i] === KIND.ccw)) {
      const x0 = p.x[i - 1] / 1000, y0 = p.y[i - 1] / 1000, z0 = p.z[i - 1] / 1000;
      const cx = p.cx[i] / 1000, cy = p.cy[i] / 1000, r = Math.hypot(x0 - cx, y0 - cy);
      const sense = p.kind[i] === KIND.ccw ? 1 : -1;
      const a0 = Math.atan2(y0 - cy, x0 - cx);
      let sweep = sense * (Math.atan2(y - cy, x - cx) - a0);
      if (p.x[i] === p.x[i - 1] && p.y[i] === p.y[i - 1]) sweep = 2 * Math.PI;
      while (sweep <= 1e-9) sweep += 2 * Math.PI;
      const n = Math.ceil(sweep / CHORD);
      for (let k = 1; k < n; ++k) {
        const a = a0 + sense * sweep * k / n;
        add(cx + r * Math.cos(a), cy + r * Math.sin(a), z0 + (z - z0) * k / n, i);
      }
    }
    add(x, y, z, i);
  }
  step.points = out;
  return out;
}

function lastPoint(i) { return pointsOf(DATA.steps[i]).x.length - 1; }

// The largest value of a load's column per move.
function byMove(step, column) {
  const out = new Map(), loads = step.loads;
  if (!loads || !loads.columns) return out;
  loads.move.forEach((m, k) => out.set(m, Math.max(out.get(m) || 0, loads.columns[column][k])));
  return out;
}

// What paths may be coloured by: how a share of 0 to 1 comes of a point, and what 1 stands for.
const COLOURS = {
  step: {title: 'step', legend: () => 'each step its own colour'},
  feed: {title: 'feed', legend: top => 'feed from 0 to ' + number(top, 0) + ' mm/min',
    top: steps => most(steps.map(s => most(pointsOf(s).feed.filter((f, i) => !pointsOf(s).rapid[i]))), 1),
    of: step => { const p = pointsOf(step); return i => p.feed[i]; }},
};
for (const [name, unit] of [['power', 'W'], ['torque', 'Nm'], ['force', 'N'], ['width', 'mm'], ['depth', 'mm']]) {
  COLOURS[name] = {title: name, legend: top => name + ' from 0 to ' + number(top, 2) + ' ' + unit,
    top: steps => most(steps.map(s => (s.loads && s.loads.columns ? most(s.loads.columns[name]) : 0)), 1e-9),
    of: step => { const m = byMove(step, name), p = pointsOf(step); return i => m.get(p.move[i]) || 0; }};
}
function stepColour(i) {
  const hue = (i * 0.618034) % 1, f = n => { const k = (n + hue * 12) % 12; return 0.45 - 0.33 * Math.max(-1, Math.min(k - 3, 9 - k, 1)); };
  return [f(0), f(8), f(4)];
}
