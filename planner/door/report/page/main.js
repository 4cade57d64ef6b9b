'use strict';
// What is picked, and the way from one part of the page to the others.
const view = new View(by('view'));
const state = {setup: 0, steps: [], step: 0, point: 0, all: true, charts: -1, colour: 'step', stock: true, part: true, rapids: true, feature: null};

function pick(step, finding) {
  by('step').value = String(step);
  chosen();
  if (!finding || finding.place < 0) return;
  if (finding.program) {
    const line = document.querySelector('.line[data-n="' + finding.place + '"]');
    if (line) line.scrollIntoView({block: 'center'});
    return;
  }
  const p = pointsOf(DATA.steps[step]), at = p.move.findIndex(m => m >= finding.place);
  if (at >= 0) { by('way').value = String(Math.round(1000 * at / Math.max(1, p.x.length - 1))); moved(); }
}

// What a finding is about: a step, and a place in it, or a feature, which is marked in the view.
function show(about) {
  state.feature = null;
  if (about.feature === undefined) pick(about.step, about.finding);
  else {
    const step = DATA.steps.findIndex(s => s.feature === about.feature);
    if (step >= 0) by('step').value = 'all' + DATA.steps[step].setup;
    chosen();
    state.feature = about.feature;
    shown();
    document.querySelectorAll('#operations [data-step]').forEach(row => row.classList.toggle('picked', DATA.steps[Number(row.dataset.step)].feature === about.feature));
  }
  if (!about.finding || !about.finding.program || about.finding.place < 0) by('look').scrollIntoView({block: 'start'});
}

function chosen() {
  state.feature = null;
  const value = by('step').value;
  state.all = value.startsWith('all');
  state.setup = state.all ? Number(value.slice(3)) : DATA.steps[Number(value)].setup;
  state.steps = DATA.steps.map((s, i) => i).filter(i => (state.all ? DATA.steps[i].setup === state.setup : i === Number(value)));
  const shown = state.all ? -1 : Number(value);
  document.querySelectorAll('[data-step]').forEach(row => row.classList.toggle('picked', Number(row.dataset.step) === shown));
  state.charts = shown;
  drawCharts();
  by('way').value = '1000';
  moved();
}

// The scrubber: along the step, or along all steps of the set-up by their points.
function moved() {
  const share = Number(by('way').value) / 1000;
  const counts = state.steps.map(i => Math.max(1, pointsOf(DATA.steps[i]).x.length));
  let left = Math.round(share * counts.reduce((a, b) => a + b, 0)), k = 0;
  while (k < counts.length - 1 && left > counts[k]) left -= counts[k++];
  if (!state.steps.length) return;
  state.step = state.steps[k];
  state.point = Math.max(0, Math.min(left, counts[k]) - 1);
  const p = pointsOf(DATA.steps[state.step]), i = state.point;
  by('where').textContent = stepTitle(DATA.steps[state.step], state.step)
    + (p.x.length ? '  X' + number(p.x[i], 3) + ' Y' + number(p.y[i], 3) + ' Z' + number(p.z[i], 3) + (p.rapid[i] ? ' rapid' : ' F' + number(p.feed[i], 0)) : '');
  shown();
}

function shown() {
  state.colour = by('colour').value;
  state.stock = by('stock').checked;
  state.rapids = by('rapids').checked;
  state.part = by('part').checked;
  view.show(Object.assign({}, state, {all: false}));
  const colours = COLOURS[state.colour], steps = state.steps.map(i => DATA.steps[i]);
  const tilted = DATA.setups[state.setup].piece[3][2];
  drop(by('legend')).append(colours.legend(colours.top ? colours.top(steps) : 1),
    ...(colours.of ? [0, 0.33, 0.67, 1].flatMap(s => [el('span', {class: 'swatch', style: 'background:' + css(ramp(s))}), number(s * colours.top(steps), 2)]) : []),
    Math.abs(tilted) < 0.999 ? '; what this set-up cuts is not shown in the stock: it looks along another axis than Z of the workpiece' : '',
    state.part && DATA.part.beside.length ? '; not drawn in the finished part, as columns along Z do not show it: ' + DATA.part.beside.join(', ') : '',
    state.feature === null ? '' : '; marked: ' + state.feature + (featureOf(state.feature).solids.length ? '' : ', whose region is not known'));
}

by('about').append(...aboutList());
by('findings').append(...findingsList(show));
by('operations').append(operationsTable(DATA.steps.map((s, i) => i), pick));
by('times').append(el('div', {id: 'bars'}));
by('loads').append(el('div', {id: 'charts'}));
fitted(by('bars'), width => [gantt(pick, width)]);
const drawCharts = fitted(by('charts'), width => (state.charts < 0 ? [el('p', {}, 'Pick a step in the table of operations.')] : chartsOf(DATA.steps[state.charts], width)));
by('setups').append(...DATA.setups.map(setupFigure));
by('tools').append(toolsTable());
by('decisions').append(...decisionsList());
by('program').append(...programText(pick));
by('inputs').append(inputsTable());
by('step').append(...DATA.setups.map((s, n) => el('option', {value: 'all' + n}, 'all of set-up ' + (n + 1))), ...DATA.steps.map((s, i) => el('option', {value: i}, stepTitle(s, i))));
by('colour').append(...Object.entries(COLOURS).map(([value, c]) => el('option', {value}, c.title)));
by('step').addEventListener('change', chosen);
by('way').addEventListener('input', moved);
for (const id of ['colour', 'stock', 'part', 'rapids']) by(id).addEventListener('change', shown);
if (DATA.setups.length) chosen();
