// SPDX-License-Identifier: Apache-2.0
// Reads the data of a sweep in the page, builds it top to bottom, then draws the charts.

const data = JSON.parse(document.getElementById('data').textContent);
const mostRows = 400;
document.body.classList.add('landscape');  // its tables have many columns

/** Small amounts of an edge unit in that of shown(), with the decimals that three digits of `size` have. */
function amounts(values, unit, size) {
  const [factor] = shown(unit);
  const decimals = size > 0 ? 2 - Math.floor(Math.log10(size * factor)) : 3;
  return values.map((value) => isNumber(value) ? fixed(value * factor, decimals) : '–');
}

const unitOf = (name, unit) => `${name}${nbsp}in${nbsp}${shown(unit)[1].replace(' ', nbsp)}`;

/** A true value in its edge unit. */
const trueText = (value, unit) => isNumber(value) ? `${tick(Number(value.toPrecision(7)))}${unit === '1' ? '' : nbsp + (unit === 'deg' ? '°' : unit)}` : '–';

const range = (low, high, digits, factor = 1) => isNumber(low) ? ` (${fixed(low * factor, digits)} … ${fixed(high * factor, digits)})` : '';

/** Why cells have no bound: reasons with the number of cells that each holds for. */
function whyNoBound() {
  const count = new Map();
  for (const {why_no_bound: why} of data.cells) if (why) count.set(why, (count.get(why) ?? 0) + 1);
  return [...count].map(([why, cells]) => `${why}${cells < data.cells.length ? ` (${cells} of ${data.cells.length} cells)` : ''}`).join('; ');
}

/** Word and line of the banner. */
function verdict(rows, tested, good) {
  const leastForAnInterval = 100;
  if (tested) return [`${good} of ${tested} ratios at the bound`, 'RMSE over the Cramér-Rao bound is 1 within what the number of repeats leaves (1 % over all ratios together).'];
  if (data.cells.every((cell) => cell.failures === data.repeats)) return ['No result', 'Every repeat failed; the reason is below the table.'];
  if (!rows.some((row) => isNumber(row.bound))) return ['No bound', `There is no bound to compare with: ${whyNoBound() || 'none is known here'}.`];
  if (!rows.some((row) => isNumber(row.ratio))) return ['No ratio', 'No parameter has both an error and a bound.'];
  return ['Ratios without an interval', data.drawn.length && data.repeats < leastForAnInterval
    ? `There are bounds, but where numbers are drawn a ratio has an interval from ${leastForAnInterval} repeats on: whether it is 1 within chance is not known.`
    : 'There are bounds, but too few repeats to say whether a ratio is 1 within the noise.'];
}

function summary() {
  const rows = data.cells.flatMap((cell) => cell.rows);
  const tested = rows.filter((row) => row.at_bound !== null);
  const good = tested.filter((row) => row.at_bound).length;
  const ratios = rows.map((row) => row.ratio).filter(isNumber);
  const covers = rows.map((row) => row.coverage).filter(isNumber);
  const failures = data.cells.reduce((sum, cell) => sum + cell.failures, 0);
  const all = tested.length > 0 && good === tested.length;
  const [word, line] = verdict(rows, tested.length, good);
  const ends = (list, show) => list.length ? `${show(list.reduce((a, b) => Math.min(a, b)))} to ${show(list.reduce((a, b) => Math.max(a, b)))}` : 'none';
  return element('div', {class: `banner ${all ? 'good' : 'neutral'}`, role: 'status'}, element('div', {class: 'word'}, word),
    paragraph(line, 'line'),
    facts([['RMSE / bound', ends(ratios, (r) => fixed(r, 3))], ['U (k = 2) covers', ends(covers, (c) => `${fixed(100 * c, 1)}${nbsp}%`)],
      ['Repeats that failed', `${failures} of ${data.cells.length * data.repeats}`]], 'numbers'));
}

const drawnText = () => data.drawn.length ? data.drawn.map(axisWords).join(', ') : 'nothing but the noise';

function chartSections(view) {
  const drawn = view.panels.flatMap((panel) => panel.curves);
  const note = view.all.length > drawn.length ? paragraph(`${drawn.length} of ${view.all.length} curves are drawn; the table and sweep.csv have all.`, 'quiet') : null;
  const row = (charts) => element('div', {class: 'triple'}, charts.filter(Boolean));
  const each = (make) => view.panels.length === 1 ? row(data.quantities.map((quantity, q) => make(data, view.panels[0], quantity, q)))
    : data.quantities.map((quantity, q) => row(view.panels.map((panel) => make(data, panel, quantity, q)))).filter((r) => r.childElementCount);
  const shares = (options) => view.all.slice(0, drawn.length).map((curve) => shareChart(data, view, curve, options)).filter(Boolean);
  const efficiency = shares({keys: ['ratio_low', 'ratio', 'ratio_high'], factor: 1, reference: 1, name: 'RMSE / bound', words: 'RMSE over the bound with its 95 % interval.'});
  const coverage = shares({keys: ['coverage_low', 'coverage', 'coverage_high'], factor: 100, reference: 95.45, name: '%', words: 'Share of the repeats with |error| ≤ U (k = 2), 95 % interval; dashed: 95.45 %.'});
  const said = {found: 'Found: the diagnosis reports anything at all. If nothing is hidden, these are false alarms.', named: 'Named: every hidden effect is among the causes listed for a deviation.'};
  const detection = view.panels.flatMap((panel) => Object.keys(said).map((key) => detectionChart(data, panel, key, said[key]))).filter(Boolean);
  return [detection.length ? section('detection', 'What the diagnosis finds', row(detection)) : null,
    section('error', 'Error and bound', note, ...[each(errorChart)].flat()),
    efficiency.length ? section('efficiency', 'Efficiency', ...efficiency) : null,
    coverage.length ? section('coverage', 'Does U cover?', ...coverage) : null,
    section('spread', 'Spread', paragraph('Dashed where there is a bound: where 5 % and 95 % of a normal distribution at the bound lie.', 'quiet'), ...[each(spreadChart)].flat())];
}

function tableSection() {
  const many = data.methods.length > 1;
  const diagnosed = data.cells.some((cell) => cell.found);
  const share = (one) => one ? `${fixed(100 * one[1], 1)}${range(one[0], one[2], 1, 100)}${nbsp}%` : '–';
  const rows = data.cells.flatMap((cell) => cell.rows.map((row, q) => {
    const {name, unit} = data.quantities[q];
    return [unitOf(name, unit), ...data.axes.map((a, i) => a.labels[cell.at[i]]), ...(many ? [cell.method] : []), String(cell.readings), trueText(row.truth, unit),
      ...amounts(['bias', 'sd', 'rmse', 'q05', 'q50', 'q95', 'bound'].map((key) => row[key]), unit, row.bound ?? row.rmse),
      isNumber(row.ratio) ? `${fixed(row.ratio, 3)}${range(row.ratio_low, row.ratio_high, 3)}${row.at_bound === false ? ' !' : ''}` : '–',
      isNumber(row.coverage) ? `${fixed(100 * row.coverage, 1)}${range(row.coverage_low, row.coverage_high, 1, 100)}${nbsp}%` : '–', String(data.repeats - row.estimates),
      ...(diagnosed ? [share(cell.found), share(cell.named)] : [])];
  }));
  const failed = data.cells.filter((cell) => cell.why).map((cell) => paragraph(`${cell.failures} failed: ${cell.why}`, 'quiet')).slice(0, 12);
  const without = whyNoBound();
  return section('table', 'Table', without ? paragraph(`No bound: ${without}.`, 'quiet') : null, rows.length > mostRows ? paragraph(`The first ${mostRows} of ${rows.length} rows; sweep.csv has all.`, 'quiet') : null,
    element('div', {class: 'wide'}, table('Errors are estimate − truth; in brackets 95 % intervals; ! is not at the bound.',
      ['Error of', ...data.axes.map((a) => axisWords(a.name)), ...(many ? ['Method'] : []), 'Readings', 'True', 'Bias', 'SD', 'RMSE', '5 %', 'Median', '95 %', 'Bound', 'RMSE / bound', 'U covers', 'Failed', ...(diagnosed ? ['Found', 'Named'] : [])],
      rows.slice(0, mostRows), 1, false)), ...failed);
}

function build() {
  const view = gridView(data);
  const sections = [...chartSections(view), ...studies.flatMap((study) => study.sections(data)), tableSection()].filter(Boolean);
  document.getElementById('page').replaceChildren(
    element('header', {}, element('p', {class: 'maker'}, `TrueAxis ${data.version} sweep`), element('h1', {}, data.title),
      facts([['Grid', `${data.cells.length} cells of ${data.repeats} repeats`], ['Surface', data.surface], ['Drawn', drawnText()], ['Seed', data.seed], ['Input', data.input_hash || 'no hash']], 'facts origin')),
    summary(), contents(sections),
    ...sections, element('footer', {}, `TrueAxis ${data.version} · ${data.schema} · charts by Apache ECharts`));
}

startPage(build);
