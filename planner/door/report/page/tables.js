'use strict';
// Tables: what the plan is, operations, tools, findings, decisions, program.
function aboutList() {
  const rows = [['material', DATA.material], ['machine', DATA.machine],
    ['raw piece', [0, 1, 2].map(k => number(DATA.stock.box[1][k] - DATA.stock.box[0][k], 3)).join(' x ') + ' mm' + (DATA.stock.source ? ', ' + DATA.stock.source : '')],
    ['steps', DATA.steps.length + (DATA.setups.length > 1 ? ' in ' + DATA.setups.length + ' set-ups' : '') + ', with ' + DATA.tools.length + ' tools'],
    ...(DATA.time ? [['time', DATA.time.text]] : []), ...DATA.marks];
  return rows.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]);
}

// The step or feature that a text names in quotes, as messages do; a member of a pattern stands for it.
function namedIn(...texts) {
  for (const text of texts) {
    for (const [, quoted] of [...text.matchAll(/'([^']+)'/g), [null, text]]) {
      const step = DATA.steps.findIndex(s => s.id === quoted);
      if (step >= 0) return {step};
      const id = quoted.replace(/\[\d+\]$/, ''), feature = DATA.features.find(f => f.id === quoted || f.id === id);
      if (feature) return {feature: feature.id};
    }
  }
  return null;
}
// A line that leads to what it is about.
function leading(kind, about, show, ...children) {
  const go = () => show(about);
  return el('p', {class: kind + (about ? ' step' : ''), tabindex: about ? 0 : null, onclick: about ? go : () => {}, onkeydown: e => { if (about && e.key === 'Enter') go(); }}, ...children);
}
// show: takes {step, finding} or {feature}
function findingsList(show) {
  const out = DATA.condemned.map(text => leading('error', namedIn(text), show, text));
  for (const f of DATA.findings) {
    const at = DATA.steps.findIndex(s => s.id === f.step), about = at >= 0 ? {step: at, finding: f} : namedIn(f.text);
    const of = (f.program ? 'program' : 'plan') + (f.place < 0 ? '' : (f.program ? ' line ' : ' move ') + f.place) + (at < 0 ? '' : ', step ' + stepTitle(DATA.steps[at], at));
    out.push(leading('finding', about, show, el('span', {class: f.severity}, f.severity), ' ' + of + ': ' + f.text + ' [' + f.code + ']'));
  }
  for (const t of DATA.told) {
    out.push(leading('told', namedIn(t.place, t.text), show, el('span', {class: t.severity}, t.severity), ' planning: ' + (t.place ? t.place + ': ' : '') + t.text + (t.hint ? '; ' + t.hint : '') + ' [' + t.code + ']'));
  }
  if (DATA.unplanned.length) {
    const row = u => { const go = () => show({feature: u.feature}); return {class: 'step unplanned', tabindex: 0, onclick: go, onkeydown: e => { if (e.key === 'Enter') go(); }}; };
    out.push(el('h3', {}, 'Not planned'), table([['feature', false, u => u.feature], ['why', false, u => u.reason], ['needed by', false, u => u.needed_by.join(', ')]], DATA.unplanned, row));
  }
  return out.length ? out : [el('p', {}, 'None.')];
}

// As `capstan explain` ends its table of steps.
function timesTogether(rows) {
  const sum = of => rows.reduce((t, i) => t + of(DATA.steps[i]), 0), steps = sum(stepTime);
  const between = [['tool changes', sum(s => s.tool_change_s)], ['ways from step to step', sum(s => s.link_s)], ['spindle', sum(s => s.spindle_s)]];
  return [['the steps together', duration(steps)], ['between them: ' + between.map(([name, t]) => name + ' ' + duration(t)).join(', '), duration(between.reduce((t, b) => t + b[1], 0))],
    ['with what lies between them', duration(steps + between.reduce((t, b) => t + b[1], 0))]];
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
    (s, k) => (pick ? {class: 'step', 'data-step': rows[k], tabindex: 0, onclick: () => pick(rows[k]), onkeydown: e => { if (e.key === 'Enter') pick(rows[k]); }} : {}), rows.length ? timesTogether(rows) : []);
}

// The tool with its holder from the tip up: [what, [[radius, height], ...]].
function toolParts(tool) {
  const edge = tool.outline[tool.outline.length - 1], r = edge[0], flutes = Math.max(tool.flutes, edge[1], 1), out = Math.max(tool.out, flutes), shank = (tool.shank || 2 * r) / 2;
  const holder = tool.holder.length ? tool.holder : tool.holder_diameter > 0 ? [[0.4 * out, tool.holder_diameter, tool.holder_diameter]] : [];
  const parts = [['edge', tool.outline.concat([[r, flutes]])], ['shank', [[shank, flutes], [shank, out]]]];
  let z = out;
  for (const [height, low, high] of holder) { parts.push(['holder', [[low / 2, z], [high / 2, z + height]]]); z += height; }
  return parts;
}
const TOOL_COLOURS = {edge: '#d9a441', shank: '#d7dce1', holder: '#9aa4af'};
function toolPicture(tool) {
  const parts = toolParts(tool), points = parts.flatMap(p => p[1]), top = most(points.map(p => p[1]), 1), wide = most(points.map(p => 2 * p[0]), 1);
  const scale = Math.min(80 / top, 42 / wide), at = ([d, z]) => number(23 + d * scale, 2) + ',' + number(88 - z * scale, 2);
  const root = svg('svg', {class: 'tool', viewBox: '0 0 46 92', role: 'img', 'aria-label': tool.class});
  for (const [what, line] of parts.reverse()) {
    root.append(svg('polygon', {points: line.concat(line.slice().reverse().map(([d, z]) => [-d, z])).map(at).join(' '), fill: TOOL_COLOURS[what], stroke: '#5b6570', 'stroke-width': 0.6}));
  }
  return root;
}

// Numbers of the offsets that the program calls with a tool: of its length (H, G43.1 Z), of its edge (D). Comments do not count.
function offsetsOf(tool) {
  const steps = programSteps(), found = {H: new Set(), D: new Set()};
  DATA.program.lines.forEach((line, i) => {
    if (steps[i] < 0 || toolOf(DATA.steps[steps[i]]) !== tool) return;
    const code = line.replace(/\([^)]*\)|;.*/g, ' ');
    for (const [, number] of code.matchAll(/\bG43\b[^H]*H0*([1-9]\d*)/g)) found.H.add(number);
    for (const [, number] of code.matchAll(/(?:^|\s)D0*([1-9]\d*)(?=\s|$)/g)) found.D.add(number);
  });
  return {H: [...found.H].join(', ') || '-', D: [...found.D].join(', ') || '-'};
}
// Minutes of the edge's life before the plan and after it; null where no life is known.
function lifeOf(tool) {
  if (!(tool.life_min > 0)) return null;
  const before = tool.life_min - tool.life_used_min;
  return {before, after: before - tool.used_min};
}
function lifeLeft(tool) {
  const life = lifeOf(tool);
  if (!life) return number(tool.used_min, 2) + ' min used';
  return el('span', {class: life.after < 0 ? 'error' : null}, number(life.after, 2) + ' of ' + number(tool.life_min, 1) + ' min');
}
function toolsTable(tools = DATA.tools) {
  const offsets = new Map(tools.map(t => [t, offsetsOf(t)]));
  const called = DATA.program.lines.length ? ['H', 'D'].map(name => [name, true, t => offsets.get(t)[name]]) : [];
  const held = tools.some(t => t.holder_id) ? [['holder', false, t => t.holder_id || 'assumed']] : [];
  return table([['', false, toolPicture], ['T', true, t => t.number], ...called, ['tool', false, t => t.id], ['class', false, t => t.class + ', ' + t.material],
    ['\u2300 mm', true, t => number(t.diameter, 3)], ['R mm', true, t => positive(t.corner, 3)], ['teeth', true, t => positive(t.teeth, 0)],
    ['flutes mm', true, t => positive(t.flutes, 2)], ['stick-out mm', true, t => positive(t.out, 2)], ['length mm', true, t => positive(t.length, 3)], ...held,
    ['least Z', true, t => (t.least_z === null ? '-' : number(t.least_z, 3))], ['edge used', true, t => number(t.used_min, 2) + ' min'], ['edge life left after', true, lifeLeft]], tools);
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
  return table([['what', false, p => p.what], ['value', false, p => p.value], ['from', false, p => p.source], ['SHA-256', false, p => p.sha256]], DATA.inputs);
}
