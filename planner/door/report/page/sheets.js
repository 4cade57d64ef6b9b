'use strict';
// What is printed: a sheet per set-up, to pin to the machine. It is made when the page is about to be printed.
function sheet(setup, n) {
  const steps = stepsOf(n), tools = [...new Set(steps.map(i => toolOf(DATA.steps[i])))].filter(t => t !== null);
  const about = [DATA.file, DATA.material, DATA.machine, ...(DATA.program.name ? ['program ' + DATA.program.name] : [])].join(', ');
  return el('section', {class: 'sheet'}, el('h2', {}, 'Set-up ' + (n + 1) + ' of ' + DATA.setups.length), el('p', {}, about),
    el('div', {class: 'pictures'}, ...sheetPictures(setup, n, steps)), setupList(setup, n),
    el('h3', {}, 'Tools'), toolsTable(tools), el('h3', {}, 'Operations'), operationsTable(steps));
}

// As it is clamped, from above with the paths, and as it comes off. Flat alone where nothing draws in three dimensions.
function sheetPictures(setup, n, steps) {
  const out = [setupDrawing(setup, n)], picture = (after, title) => el('figure', {}, view.picture(n, after, 720, 540), el('figcaption', {}, title));
  if (view.flat || !steps.length) return out;
  return [picture(steps[0] - 1, 'as it is clamped'), ...out, picture(steps[steps.length - 1], 'as it comes off')];
}

// Once: what they show does not change. The stock of the pictures goes on from one to the next.
function makeSheets() {
  if (by('sheets').firstChild) return;
  by('sheets').append(...DATA.setups.map(sheet));
  view.restore();
}
window.addEventListener('beforeprint', makeSheets);
