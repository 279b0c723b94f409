// SPDX-License-Identifier: Apache-2.0
// One reference surface: what was found, how well, and the charts that show it.

const statusWords = {
  converged: 'converged',
  max_iterations: 'stopped at the iteration limit',
  rank_deficient: 'not determined by these readings (rank-deficient)',
  too_few: 'too few readings',
};

const parameterWords = {
  x0: ['x₀', 'axis in the part frame at Z = 0'],
  y0: ['y₀', 'axis in the part frame at Z = 0'],
  l: ['l', 'direction cosine of the axis along x'],
  m: ['m', 'direction cosine of the axis along y'],
  k: ['k', 'apex along the axis'],
  d: ['d', 'distance of the plane from the origin'],
  half_angle: ['α/2', 'half angle'],
  radius: ['R', 'radius'],
  radius_mid: ['R mid', 'radius at mid length'],
  offset_at_min_z: ['e at least Z', 'offset from the spindle axis, lower end of the data'],
  offset_at_max_z: ['e at greatest Z', 'offset from the spindle axis, upper end of the data'],
  tilt: ['θ', 'tilt of the axis against the spindle'],
};

function parameterName(name) {
  const [symbol, words] = parameterWords[name] ?? [name.replaceAll('_', ' '), ''];
  return element('span', {}, symbol, words ? element('small', {}, words) : null);
}

/** U, or both sides of an interval that is not symmetric. */
function bothSides({value, u, unit, interval}, k) {
  if (!interval) return uncertainty(isNumber(u) ? k * u : null, unit);
  const [below, above] = [value - interval[0], interval[1] - value].map((side) => uncertainty(side, unit));
  return below === above ? above : `+ ${above}, − ${below}`;
}

/** Rows of value, u and U; what is not determined says why. */
function parameterRow({name, value, u, unit, why, interval}, k) {
  const has = isNumber(value);
  const cells = [parameterName(name), has ? quantity(value, u, unit) : 'not determined', has ? uncertainty(u, unit) : '–',
    has ? bothSides({value, u, unit, interval}, k) : '–'];
  const missing = !has || !isNumber(u);
  return {cells, lost: !has, note: missing ? `${has ? 'no uncertainty: ' : ''}${why || 'the readings do not fix it'}` : null};
}

/** Named quantities of the files, {NAME: {value, u, unit, why}}, as a list. */
const named = (quantities) => Object.entries(quantities).map(([name, quantity]) => ({name, ...quantity}));

const parameterTable = (caption, quantities, k) =>
  table(caption, ['Quantity', 'Value', 'u', `U (k${nbsp}=${nbsp}${tick(k)})`], named(quantities).map((p) => parameterRow(p, k)));

/** How many readings count nowhere: the diagnosis may exclude some that the ideal fit has. */
const excludedOf = (reference) => Math.max(reference.rejected.count, reference.diagnosis?.noise?.masked ?? 0);

function statusBlock(reference) {
  const good = reference.status === 'converged';
  const size = (mm) => micrometres(mm);
  const list = [
    ['Status', pill(statusWords[reference.status] ?? reference.status, good)],
    ['Surface', `${reference.surface}${reference.feature === 'bore' ? ' (bore)' : ''}`],
    ['Readings', `${reference.points}, ${excludedOf(reference)} excluded`],
  ];
  if (good || reference.status === 'max_iterations') {
    list.push(['RMS of the residuals', size(reference.rms.value)],
      ['σ of one reading', `${size(reference.noise.sigma.value)} (from ${reference.noise.source || 'the fit'})`],
      ['Correlation of neighbours', `${fixed(reference.noise.autocorrelation ?? 0, 2)} (widens u ${fixed(reference.noise.u_factor ?? 1, 2)} times)`],
      ['Iterations', String(reference.iterations)]);
  }
  const parts = [facts(list)];
  if (reference.notes?.length) parts.push(element('ul', {class: 'quiet'}, reference.notes.map((text) => element('li', {}, sentence(text)))));
  return element('div', {}, parts);
}

function budgetTable(reference) {
  const parameters = named(reference.parameters);
  const names = parameters.map((p) => parameterWords[p.name]?.[0] ?? p.name);
  const rows = reference.budget.map((line) => [line.source, line.type,
    ...parameters.map((p) => uncertainty(line.u[p.name].value, p.unit))]);
  rows.push(['together', '', ...parameters.map((p) => uncertainty(p.u, p.unit))]);
  return table('Uncertainty budget: what each source adds to the standard uncertainty u (A: from the readings, B: other knowledge)',
    ['Source', 'Type', ...names], rows, 2);
}

/** Share of each source in the variance of each parameter. */
function budgetChart(reference) {
  const share = (line, name) => line.u[name].value ?? 0;
  const determined = Object.keys(reference.parameters).filter((name) => reference.budget.some((line) => share(line, name) > 0));
  const total = (name) => reference.budget.reduce((sum, line) => sum + share(line, name) ** 2, 0);
  const build = (width) => ({
    grid: grid({top: width < 480 ? 76 : 40, bottom: 34}),
    legend: legend({left: 0, right: 0}),
    xAxis: axis('share of the variance u² in %', {min: 0, max: 100}),
    yAxis: axis('', {type: 'category', inverse: true, data: determined.map((name) => parameterWords[name]?.[0] ?? name), axisTick: {show: false}, splitLine: {show: false},
      axisLabel: {color: colours.ink}}),
    series: reference.budget.map((line, s) => ({name: line.source, type: 'bar', stack: 'u', barWidth: '60%', emphasis: {disabled: true},
      itemStyle: {color: colours.series[s % colours.series.length]},
      data: determined.map((name) => 100 * share(line, name) ** 2 / total(name))})),
  });
  return figure({caption: 'Which source an uncertainty comes from. A long bar is where better knowledge pays.',
    description: 'Share of each source in the variance of each parameter.', size: 'short', renderer: 'svg', build});
}

function rejectedBlock(reference) {
  const {count, listed} = reference.rejected, excluded = excludedOf(reference);
  if (count === 0) return paragraph(excluded ? `The diagnosis excluded ${excluded}, the ideal fit none.` : 'No reading was excluded.', 'quiet');
  const more = count > listed.length ? ` The first ${listed.length} are listed, ${count - listed.length} more are not.` : '';
  return element('div', {}, paragraph(`${count} excluded ${count === 1 ? 'reading' : 'readings'}.${more}`, 'quiet'),
    table('Excluded readings: data row of the stream and reason', ['Row', 'Reason'], listed.map((r) => [String(r.row), r.why]), 2));
}

function mapFigures(readings) {
  if (!readings.has_position) return [paragraph('One section without Z: there is no map along the axis.', 'quiet')];
  const against = readings.has_model
    ? (readings.face ? 'Face unrolled: readings against a face square to the spindle axis. One wave over C is the tilt, growing with X.'
      : 'Surface unrolled: readings against the same surface running true. One wave over C is the eccentricity; that it changes along Z is the tilt.')
    : 'Surface unrolled: readings minus their straight line along the feed, since there is no usable model.';
  const list = [readingMap(readings, 'deviation_um', against)];
  if (readings.has_model) {
    list.push(readingMap(readings, 'residual_um', 'Residuals unrolled: measured minus model. Noise looks like grain; stripes or patches are form or motion that the model lacks.'));
  }
  return list;
}

function chartBlocks(reference) {
  const readings = reference.readings;
  if (!readings || readings.count === 0) return [paragraph('There are no readings to show.', 'quiet')];
  const thin = readings.thinned ? [paragraph(`${readings.count} readings are too many to draw one by one: charts show means and envelopes of bins. The numbers in the tables use every reading.`, 'quiet')] : [];
  const blocks = [block('Measured and model', ...thin, element('div', {class: 'pair'}, mapFigures(readings)))];
  if (readings.sections.length) {
    blocks.push(block('Polar sections with the eccentricity', paragraph('The part frame seen along −Z, C counter-clockwise from +x. ' +
      `Outside the dashed circle is ${readings.face ? 'towards +Z' : 'away from the spindle axis'}.`, 'quiet'),
      element('div', {class: 'triple'}, readings.sections.map((part) => polarChart(readings, part, reference.relative)))));
  }
  if (!readings.has_model) {
    blocks.push(paragraph('There are no residuals to show: the fit gave no surface that could be compared with the readings.', 'quiet'));
    return blocks;
  }
  const residuals = residualCharts(readings);
  if (readings.histogram) residuals.push(histogramChart(readings.histogram, reference.noise.sigma.value, reference.noise.source));
  blocks.push(block('Residuals', element('div', {class: 'pair'}, residuals)));
  return blocks;
}

/** The residuals of the surface: causes first, then polar plots. */
function formSection(reference, index) {
  const {readings, diagnosis, roundness} = reference;
  const solved = reference.status === 'converged' || reference.status === 'max_iterations';
  const parts = [paragraph(`${diagnosis ? `${diagnosisWords[diagnosis.verdict] ?? diagnosis.verdict} ` : ''}${fitWords(reference)}`)];
  if (diagnosis) parts.push(seenList(diagnosis, readings?.face));
  if (diagnosis?.limit) parts.push(paragraph(`What limits the axis: ${worded(sentence(diagnosis.limit))}`, 'quiet'));
  if (roundness) return section(`form-${index + 1}`, `Roundness: ${reference.name}`, ...parts, ...(reference.form ? [partFormBlock(reference.form, Boolean(reference.diagnosis))] : []), ...roundnessBlock(reference));
  const polars = solved && readings ? residualPolars(readings) : [];
  if (polars.length) {
    parts.push(paragraph(`Residuals about the fitted surface, which is the dashed circle; outside is ${readings.face ? 'towards +Z' : 'away from the axis'}.` +
      (polars.length && readings.sections.some((part) => part.found) ? ' The orange line is the causes found.' : ''), 'quiet'), element('div', {class: 'triple'}, polars));
  } else {
    parts.push(paragraph('There are no residuals to show: the fit gave no surface that could be compared with the readings.', 'quiet'));
  }
  return section(`form-${index + 1}`, `Form: ${reference.name}`, ...parts);
}

/** The fit in a sentence. */
function fitWords(reference) {
  const {points, surface, feature, status} = reference, count = excludedOf(reference);
  const words = `${points} readings of a ${surface}${feature === 'bore' ? ', a bore' : ''}, ${count ? `${count} excluded` : 'none excluded'}`;
  if (status !== 'converged' && status !== 'max_iterations') return `${words}: ${statusWords[status] ?? status}.`;
  return `${words}; residuals ${micrometres(reference.rms.value)} RMS of the ideal fit${isNumber(reference.diagnosis?.rms_shown_mm) ? `, ${micrometres(reference.diagnosis.rms_shown_mm)} of the final one` : ''}.`;
}

function referenceFold(reference, index) {
  const k = reference.coverage_factor;
  const relative = reference.relative ? [paragraph('The stream is of a gauge that reads differences: the radius is not measured, it is the nominal one.', 'quiet')] : [];
  const tables = element('div', {class: 'pair tables'},
    element('div', {}, parameterTable('Parameters of the associated surface', reference.parameters, k)),
    element('div', {}, Object.keys(reference.derived).length ? parameterTable('Derived quantities', reference.derived, k) : null,
      reference.budget.length > 1 && reference.budget.some((line) => Object.values(line.u).some((u) => u.value > 0)) ? budgetChart(reference) : null));
  const budget = reference.budget.length ? [budgetTable(reference)] : [];
  const measured = [reference.form && !reference.roundness ? partFormBlock(reference.form) : null, reference.datums ? datumsBlock(reference.datums, reference.association) : null].filter(Boolean);
  return fold(`reference-${index + 1}`, `Full results: ${reference.name}`, ...measured, statusBlock(reference), ...relative, tables, ...budget,
    block('Excluded readings', rejectedBlock(reference)), ...(reference.roundness?.orders.length ? [roundnessTable(reference.roundness)] : []), ...chartBlocks(reference));
}
