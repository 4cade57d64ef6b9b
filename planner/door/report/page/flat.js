'use strict';
// A set-up seen from above, flat: raw piece, fixtures, zero, and paths where they are asked for.
function pieceCorners(setup) {
  const [lo, hi] = DATA.stock.box, [o, ex, ey, ez] = setup.piece, out = [];
  for (const x of [lo[0], hi[0]]) for (const y of [lo[1], hi[1]]) for (const z of [lo[2], hi[2]]) {
    out.push([0, 1, 2].map(k => o[k] + x * ex[k] + y * ey[k] + z * ez[k]));
  }
  return out;
}
function pieceBox(setup) {
  const c = pieceCorners(setup), at = (f, k) => f(...c.map(p => p[k]));
  return [[0, 1, 2].map(k => at(Math.min, k)), [0, 1, 2].map(k => at(Math.max, k))];
}
function flatBounds(setup, steps) {
  const [lo, hi] = pieceBox(setup), b = [lo[0], lo[1], hi[0], hi[1]];
  // Of a fixture so much as lies near the piece: a bed is many times as long.
  const far = 0.5 * Math.max(b[2] - b[0], b[3] - b[1]), near = (v, k) => Math.max(b[k] - far, Math.min(b[k + 2] + far, v));
  const fixed = setup.holding.solids.flatMap(s => s.outline.map(([x, y]) => [near(x, 0), near(y, 1)]));
  const take = (x, y) => { b[0] = Math.min(b[0], x); b[1] = Math.min(b[1], y); b[2] = Math.max(b[2], x); b[3] = Math.max(b[3], y); };
  for (const [x, y] of fixed) take(x, y);
  for (const step of steps) { const p = pointsOf(step); p.x.forEach((x, i) => take(x, p.y[i])); }
  take(0, 0);
  return b;
}

function flatPath(step, colour, upTo) {
  const p = pointsOf(step), out = [];
  let d = '', rapid = false;
  const end = () => {
    if (d) out.push(svg('path', {d, fill: 'none', stroke: rapid ? '#9aa4af' : colour, 'stroke-width': rapid ? 0.7 : 1.2,
      'stroke-dasharray': rapid ? '4 3' : null, 'vector-effect': 'non-scaling-stroke'}));
  };
  for (let i = 1; i < p.x.length && i <= upTo; ++i) {
    if (!d || p.rapid[i] !== rapid) {
      end(); rapid = p.rapid[i];
      d = 'M' + number(p.x[i - 1], 3) + ' ' + number(-p.y[i - 1], 3);
    }
    d += 'L' + number(p.x[i], 3) + ' ' + number(-p.y[i], 3);
  }
  end();
  return out;
}

// steps: [{step, colour, upTo}]; feature: the one that is marked, or null
function flatView(setup, steps, title, feature = null) {
  const b = flatBounds(setup, steps.map(s => s.step)), margin = 0.06 * Math.max(b[2] - b[0], b[3] - b[1], 1);
  const [lo, hi] = pieceBox(setup), size = Math.max(b[2] - b[0], b[3] - b[1]);
  const view = [b[0] - margin, -b[3] - margin, b[2] - b[0] + 2 * margin, b[3] - b[1] + 2 * margin].map(v => number(v, 3)).join(' ');
  const hair = {'vector-effect': 'non-scaling-stroke', 'stroke-width': 1};
  const root = svg('svg', {viewBox: view, role: 'img', 'aria-label': title}, svg('title', {}, title));
  for (const s of setup.holding.solids) {
    root.append(svg('polygon', {points: s.outline.map(([x, y]) => x + ',' + -y).join(' '), fill: s.presses ? '#c9b18a' : '#d8d2c4', stroke: '#8a7a58', ...hair},
      svg('title', {}, s.id + ' (' + s.kind + '), Z ' + number(s.bottom, 2) + ' to ' + number(s.top, 2))));
  }
  root.append(svg('rect', {x: lo[0], y: -hi[1], width: hi[0] - lo[0], height: hi[1] - lo[1], fill: '#dbe4ee', 'fill-opacity': 0.8, stroke: '#6c7f94', ...hair}));
  for (const s of steps) root.append(...flatPath(s.step, s.colour, s.upTo));
  if (feature !== null) {
    const [o, ex, ey, ez] = setup.piece, at = p => [0, 1].map(k => o[k] + p[0] * ex[k] + p[1] * ey[k] + p[2] * ez[k]);
    for (const s of featureOf(feature).solids) root.append(svg('polygon', {class: 'marked', points: s.outline.map(at).map(([x, y]) => number(x, 3) + ',' + number(-y, 3)).join(' '), fill: '#e4572e', 'fill-opacity': 0.45, stroke: '#e4572e', ...hair}));
  }
  const a = 0.09 * size, arrow = (dx, dy, colour) => svg('line', {x1: 0, y1: 0, x2: dx, y2: dy, stroke: colour, 'stroke-width': 2, 'vector-effect': 'non-scaling-stroke'});
  root.append(arrow(a, 0, '#c0392b'), arrow(0, -a, '#2c8a4a'), svg('circle', {cx: 0, cy: 0, r: 0.012 * size, fill: '#1b1f24'}, svg('title', {}, 'zero ' + setup.offset)));
  const high = 0.05 * Math.max(b[2] - b[0], b[3] - b[1]), words = {style: `font-size:${number(high, 3)}px;paint-order:stroke;stroke:#fff;stroke-width:${number(0.2 * high, 3)}px`};
  root.append(svg('text', {...words, x: -0.3 * high, y: high, 'text-anchor': 'end'}, setup.offset), svg('text', {...words, x: a, y: 0.9 * high}, 'X'), svg('text', {...words, x: 0.2 * high, y: -a}, 'Y'));
  return root;
}
