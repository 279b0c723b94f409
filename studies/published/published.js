// SPDX-License-Identifier: Apache-2.0
// Published single runs in the distribution of the sweep, and what their numbers may mean.

/** Runs that were published, by the cell they belong to. */
function runsByCell(sweep) {
  const by = new Map();
  sweep.published.runs.forEach((run, row) => {
    const placed = sweep.published.readings[0].runs.find((r) => r.row === row);
    if (isNumber(run.cell) && placed) by.set(run.cell, {...run, ...placed});
  });
  return by;
}

/** [place, value] of the published runs of one quantity. */
function publishedPoints(sweep, view, quantity, value) {
  const parameter = sweep.published.parameters.indexOf(quantity.name);
  if (parameter < 0) return [];
  const runs = runsByCell(sweep);
  return view.curves.flatMap((curve) => curve.cells.filter((c) => runs.has(c.index))
    .map((c) => [view.place(c.point), value(runs.get(c.index), parameter)])).filter(([, v]) => isNumber(v));
}

const publishedSeries = (name, data) => data.length ? [{name, type: 'scatter', symbol: 'diamond', symbolSize: 12, z: 6, data,
  itemStyle: {color: colours.model, borderColor: colours.paper, borderWidth: 1}}] : [];

const pEquals = (p) => pText(p).startsWith('>') ? `p ${pText(p)}` : `p = ${pText(p)}`;
const pText = (p) => !isNumber(p) ? '–' : p > 0.995 ? '> 0.995' : p < 1e-3 ? scientific(p, 1) : significant(p, 2);

/** One run next to the distribution of its cell. */
function runTable(sweep, row) {
  const {published} = sweep;
  const run = published.runs[row];
  const placed = published.readings[0].runs.find((r) => r.row === row);
  if (!placed || !isNumber(run.cell)) return null;
  const cell = sweep.cells[run.cell];
  const rows = published.parameters.map((name, p) => {
    const q = sweep.quantities.findIndex((one) => one.name === name);
    const of = cell.rows[q], unit = sweep.quantities[q].unit;
    const [error, ...spread] = amounts([placed.error[p], of.bias, of.sd, of.rmse, of.q05, of.q50, of.q95, of.bound], unit, of.bound);
    return [unitOf(name, unit), run.printed[p], error, fixed(placed.in_sd[p], 2), `${fixed(100 * run.share_below[p], 1)}${nbsp}%`, ...spread, fixed(of.ratio, 3)];
  });
  const degrees = published.parameters.length;
  return table(`${placeWords(run.name)}; χ²(${degrees}) = ${significant(placed.chi_squared)}, ${pEquals(placed.p_value)}; ${fixed(100 * run.share_as_far, 1)}${nbsp}% of the repeats are as far out.`,
    ['Error of', 'Printed', 'Error', 'In SD', 'Repeats below', 'Bias', 'SD', 'RMSE', '5 %', 'Median', '95 %', 'Bound', 'RMSE / bound'], rows);
}

const factorText = (reading) => `× ${significant(reading.factor)}` + (!reading.fitted ? ''
  : ` (${isNumber(reading.factor_low) ? significant(reading.factor_low) : '…'} to ${isNumber(reading.factor_high) ? significant(reading.factor_high) : '…'})`);

function readingsTable(published) {
  const degrees = published.parameters.length * published.readings[0].runs.length;
  const runs = published.readings[0].runs.map((r) => placeWords(published.runs[r.row].name));
  return table(`Gain: log-likelihood over the first reading. χ²(${degrees}): all runs; noise: true over stated, 95 % interval where it is fitted; then χ²(${published.parameters.length}) of each run and its p.`,
    ['Reading', 'Gain', `χ²(${degrees})`, 'p', 'Noise', ...runs],
    published.readings.map((reading, i) => [`${i + 1}. ${reading.name}`, fixed(reading.gain, 1), significant(reading.chi_squared), pText(reading.p_value), factorText(reading),
      ...reading.runs.map((r) => `${significant(r.chi_squared)} (${pText(r.p_value)})`)]));
}

function gainChart(published) {
  const data = published.readings.map((reading, i) => [reading.gain, i]);
  const words = 'Log-likelihood of the printed numbers over that of the first reading; the numbers are those of the table.';
  return figure({caption: words, description: words, size: 'short', build: () => ({
    grid: grid({top: 12}),
    xAxis: axis('gain in log-likelihood'),
    yAxis: axis('', {type: 'category', inverse: true, data: published.readings.map((_, i) => String(i + 1)), axisLabel: {color: colours.ink}, splitLine: {show: false}}),
    series: [{name: 'gain', type: 'bar', data, encode: {x: 0, y: 1}, barMaxWidth: 18, itemStyle: {color: colours.measured},
      label: {show: true, position: 'right', color: colours.ink, formatter: ({value}) => fixed(value[0], 1)}}]})});
}

/** Levels that print has lost, by reading. */
function unknownBlock(published, row) {
  const found = published.unknown.filter((u) => u.row === row);
  if (!found.length) return null;
  const unit = axisWords(found[0].axis);
  const end = (value) => isNumber(value) ? significant(value) : 'open';
  const low = (u) => isNumber(u.low) ? u.low : u.best / 10;
  const high = (u) => isNumber(u.high) ? u.high : u.best * 10;
  const words = `${unit}: best value and 95 % interval (profile likelihood) under each reading.`;
  const chart = figure({caption: words, description: words, size: 'short', build: () => ({
    grid: grid({top: 12}),
    xAxis: axis(unit, {type: 'log', minorTick: {show: true}}),
    yAxis: axis('', {type: 'category', inverse: true, data: found.map((u) => String(u.reading + 1)), axisLabel: {color: colours.ink}, splitLine: {show: false}}),
    series: [{name: 'level', type: 'custom', encode: {x: [0, 1, 2], y: 3}, data: found.map((u, i) => [low(u), u.best, high(u), i]),
      renderItem: (_, api) => {
        const [a, b, c] = [0, 1, 2].map((k) => api.coord([api.value(k), api.value(3)]));
        return {type: 'group', children: [
          {type: 'line', shape: {x1: a[0], x2: c[0], y1: a[1], y2: a[1]}, style: {stroke: colours.measured, lineWidth: 3}},
          {type: 'circle', shape: {cx: b[0], cy: b[1], r: 5}, style: {fill: colours.model}}]};
      }}]})});
  return block(`Lost in print: ${placeWords(published.runs[row].name)}`, chart,
    table('Log-likelihood lost at the points of the axis.', ['Reading', 'Best', '95 % interval', ...found[0].labels],
      found.map((u) => [`${u.reading + 1}. ${published.readings[u.reading].name}`, significant(u.best), `${end(u.low)} to ${end(u.high)}`, ...u.lost.map((l) => fixed(l, 1))])));
}

function publishedSection(sweep) {
  const {published} = sweep;
  return section('published', 'The published runs', paragraph(`${published.source}. In SD: error over the bound’s standard deviation. Below: share of the repeats, ` +
    'rounded as printed, with a smaller number. χ²: Mahalanobis distance squared over all parameters, rounding in print included.'),
  ...published.runs.map((_, row) => runTable(sweep, row)).filter(Boolean),
  block('What the printed numbers may mean', gainChart(published), readingsTable(published)),
  ...published.runs.map((_, row) => unknownBlock(published, row)).filter(Boolean));
}

studies.push({
  sections: (sweep) => [publishedSection(sweep)],
  errorSeries: (sweep, view, quantity) => publishedSeries('published |error|',
    publishedPoints(sweep, view, quantity, (run, p) => shown(quantity.unit)[0] * Math.abs(run.error[p])).filter(([, v]) => v > 1e-9)),
  spreadSeries: (sweep, view, quantity) => publishedSeries('published', publishedPoints(sweep, view, quantity, (run, p) => run.in_sd[p])),
});
