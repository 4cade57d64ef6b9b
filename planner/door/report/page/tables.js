'use strict';
// Tables: what the plan is, operations, tools, findings, decisions, program.
function aboutList() {
  const rows = [['material', DATA.material], ['machine', DATA.machine],
    ['raw piece', [0, 1, 2].map(k => number(DATA.stock.box[1][k] - DATA.stock.box[0][k], 3)).join(' x ') + ' mm' + (DATA.stock.source ? ', ' + DATA.stock.source : '')],
    ['steps', DATA.steps.length + (DATA.setups.length > 1 ? ' in ' + DATA.setups.length + ' set-ups' : '') + ', with ' + DATA.tools.length + ' tools'],
    ...(DATA.time ? [['time', DATA.time.text]] : []), ...DATA.marks];
  return rows.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]);
}

function findingsList(pick) {
  const out = DATA.condemned.map(text => el('p', {class: 'error'}, text));
  const stepOf = id => DATA.steps.findIndex(s => s.id === id);
  const rows = DATA.findings.map(f => ({...f, at: stepOf(f.step)}));
  for (const f of rows) {
    const place = f.place < 0 ? '' : (f.program ? ' line ' : ' move ') + f.place;
    const of = (f.program ? 'program' : 'plan') + place + (f.at < 0 ? '' : ', step ' + stepTitle(DATA.steps[f.at], f.at));
    out.push(el('p', {class: 'finding' + (f.at < 0 ? '' : ' step'), onclick: () => { if (f.at >= 0) pick(f.at, f); }},
      el('span', {class: f.severity}, f.severity), ' ' + of + ': ' + f.text + ' [' + f.code + ']'));
  }
  for (const t of DATA.told) {
    out.push(el('p', {class: 'told'}, el('span', {class: t.severity}, t.severity), ' planning: ' + (t.place ? t.place + ': ' : '') + t.text + (t.hint ? '; ' + t.hint : '') + ' [' + t.code + ']'));
  }
  if (DATA.unplanned.length) {
    out.push(el('h3', {}, 'Not planned'), table([['feature', false, u => u.feature], ['why', false, u => u.reason], ['needed by', false, u => u.needed_by.join(', ')]], DATA.unplanned));
  }
  return out.length ? out : [el('p', {}, 'None.')];
}

// rows: indices of steps. Without `pick` it is for paper.
function operationsTable(rows, pick) {
  const longest = most(DATA.steps.map(stepTime), 1e-9);
  const bar = s => el('span', {class: 'timebar', style: 'width:' + number(100 * stepTime(s) / longest, 1) + '%'});
  return table([['', true, s => DATA.steps.indexOf(s) + 1], ['step', false, s => s.id], ['feature', false, s => s.feature], ['operation', false, s => plain(s.operation)],
    ['tool', false, s => toolName(toolOf(s))], ['D', true, s => (toolOf(s) ? number(toolOf(s).diameter, 3) : '-')],
    ['ap', true, s => positive(s.ap, 3)], ['ae', true, s => positive(s.ae, 3)], ['vc m/min', true, s => positive(s.vc, 0)], ['1/min', true, s => number(s.rpm, 0)],
    ['fz mm', true, s => positive(s.fz, 4)], ['mm/min', true, s => positive(s.feed, 0)], ['coolant', false, s => s.coolant],
    ['time', true, s => el('span', {}, duration(stepTime(s)), bar(s))]], rows.map(i => DATA.steps[i]),
    (s, k) => (pick ? {class: 'step', 'data-step': rows[k], tabindex: 0, onclick: () => pick(rows[k]), onkeydown: e => { if (e.key === 'Enter') pick(rows[k]); }} : {}));
}

// The tool with its holder, standing on its tip.
function toolPicture(tool) {
  const r = tool.outline[tool.outline.length - 1][0], flutes = Math.max(tool.flutes, 1), out = Math.max(tool.out, flutes);
  const holder = tool.holder.length ? tool.holder : tool.holder_diameter > 0 ? [[0.4 * out, tool.holder_diameter, tool.holder_diameter]] : [];
  const top = out + holder.reduce((sum, h) => sum + h[0], 0), wide = Math.max(2 * r, tool.shank, ...holder.flatMap(h => [h[1], h[2]]), 1);
  const scale = Math.min(80 / top, 42 / wide), x = d => 23 + d * scale, y = z => 88 - z * scale;
  const solid = (points, fill) => svg('polygon', {points: points.concat(points.slice().reverse().map(([d, z]) => [-d, z])).map(([d, z]) => number(x(d), 2) + ',' + number(y(z), 2)).join(' '), fill, stroke: '#5b6570', 'stroke-width': 0.6});
  const root = svg('svg', {class: 'tool', viewBox: '0 0 46 92', role: 'img', 'aria-label': tool.class});
  let z = out;
  for (const [height, low, high] of holder) { root.append(solid([[low / 2, z], [high / 2, z + height]], '#9aa4af')); z += height; }
  root.append(solid([[(tool.shank || 2 * r) / 2, Math.min(flutes, out)], [(tool.shank || 2 * r) / 2, out]], '#d7dce1'));
  root.append(solid(tool.outline.concat([[r, Math.max(flutes, tool.outline[tool.outline.length - 1][1])]]), '#d9a441'));
  return root;
}
function toolsTable(tools = DATA.tools) {
  const left = t => (t.life_min > 0 ? number(t.life_used_min + t.used_min, 2) + ' of ' + number(t.life_min, 1) + ' min' : number(t.used_min, 2) + ' min');
  return table([['', false, toolPicture], ['T', true, t => t.number], ['tool', false, t => t.id], ['class', false, t => t.class + ', ' + t.material],
    ['D mm', true, t => number(t.diameter, 3)], ['R mm', true, t => positive(t.corner, 3)], ['teeth', true, t => positive(t.teeth, 0)],
    ['flutes mm', true, t => positive(t.flutes, 2)], ['stick-out mm', true, t => positive(t.out, 2)], ['length mm', true, t => positive(t.length, 3)],
    ['least Z', true, t => (t.least_z === null ? '-' : number(t.least_z, 3))], ['edge used, of its life', true, left]], tools);
}

function stepsOf(setup) { return DATA.steps.map((s, i) => i).filter(i => DATA.steps[i].setup === setup); }
function setupList(setup, n) {
  const steps = stepsOf(n), hold = setup.holding, rows = [['zero', setup.offset + (setup.zero ? ': ' + setup.zero : '')], ['lies', setup.up + ' up, ' + setup.right + ' to the right' + (setup.turn ? '; ' + setup.turn : '')],
    ['pick-up', hold.pickup_text || '-'], ['held by', hold.id ? hold.id + (hold.text ? ', ' + hold.text : '') : 'not stated: fixtures and clamps are not checked'],
    ['security plane', 'Z ' + number(setup.security, 3)], ['steps', String(steps.length)],
    ['least Z', number(least(steps.map(i => (DATA.steps[i].path ? least(DATA.steps[i].path.z) : Infinity))) / 1000, 3)]];
  return el('dl', {}, ...rows.flatMap(([a, b]) => [el('dt', {}, a), el('dd', {}, b)]));
}
function setupDrawing(setup, n) {
  const steps = stepsOf(n).map(i => ({step: DATA.steps[i], colour: css(stepColour(i)), upTo: Infinity}));
  return el('figure', {}, flatView(setup, steps, 'set-up ' + (n + 1)), el('figcaption', {}, 'from above; rapids dashed'));
}
function setupFigure(setup, n) {
  return el('div', {class: 'flat'}, el('div', {}, el('h3', {}, 'Set-up ' + (n + 1)), setupList(setup, n)), setupDrawing(setup, n));
}

function decisionsList() {
  const whole = el('details', {}, el('summary', {}, 'the plan as a whole'), el('pre', {}, DATA.explained));
  return [whole, ...DATA.steps.map((s, i) => el('details', {id: 'why' + i}, el('summary', {}, stepTitle(s, i)), el('pre', {}, s.explained)))];
}

// Lines of the program with the step that they belong to: a marker opens each, in capitals where the control has no others.
function programSteps() {
  let step = -1;
  return DATA.program.lines.map(line => {
    const marker = /CAPSTAN STEP .*\bn=(\d+)/i.exec(line);
    if (marker) step = Number(marker[1]) - 1;
    return step;
  });
}
function programText(pick) {
  if (!DATA.program.lines.length) return [el('p', {}, 'No program was written with this report.')];
  const steps = programSteps();
  const rows = DATA.program.lines.map((line, i) => el('div', {class: 'line', 'data-n': i + 1, 'data-step': steps[i], onclick: () => { if (steps[i] >= 0) pick(steps[i]); }}, line));
  return [el('p', {}, DATA.program.name), el('pre', {}, ...rows)];
}
function inputsTable() {
  return table([['what', false, p => p.what], ['value', false, p => p.value], ['from', false, p => p.source]], DATA.inputs);
}
