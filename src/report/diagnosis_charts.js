// SPDX-License-Identifier: Apache-2.0
// Charts of a diagnosis: measured against both simulations, spectrum, plans.

/** The readings of the reference with what was simulated: measured less the difference. */
function diagnosisReadings({readings, diagnosis}) {
  const {maps} = diagnosis.simulation;
  const less = (a, b) => a?.map((value, i) => isNumber(value) && isNumber(b[i]) ? value - b[i] : null);
  const columns = {...maps, simulated_before_um: less(maps.measured_um, maps.before_um),
    simulated_after_um: less(maps.measured_um, maps.after_um), gained_um: less(maps.before_um, maps.after_um)};
  return readings.thinned ? {...readings, cells: {...readings.cells, ...columns}} : {...readings, points: {...readings.points, ...columns}};
}

const simulatedWords = {
  measured_um: 'Measured: deviation from a true-running surface.',
  simulated_before_um: 'Simulated before: the ideal fit.',
  simulated_after_um: 'Simulated after: with the causes.',
};
const idealWords = {
  measured_um: simulatedWords.measured_um,
  simulated_before_um: 'Simulated: the ideal fit.',
  before_um: 'Measured minus simulated.',
};
const differenceWords = {
  before_um: 'Measured minus simulated before.',
  after_um: 'Measured minus simulated after.',
  gained_um: 'Simulated after minus before: what the model gained.',
};

/** Rows of maps side by side: readings share a colour scale, and differences another. */
function simulationMaps(reference, extended) {
  const readings = diagnosisReadings(reference);
  if (!readings.has_position) return [element('div', {class: 'pair'}, sectionOverlay(readings, extended), sectionDifferences(readings, extended))];
  const values = (key) => readings.thinned ? readings.cells[key] : split(readings.points).kept.map((i) => readings.points[key][i]);
  const scale = (keys) => roundUpFinely(Math.max(...keys.map((key) => largest(values(key)))));
  const read = scale(Object.keys(simulatedWords)), differs = scale(Object.keys(differenceWords));
  const row = (words) => element('div', {class: 'triple'}, Object.entries(words).map(([key, said]) =>
    readingMap(readings, key, said, key in simulatedWords ? read : differs, '')));
  return extended ? [row(simulatedWords), row(differenceWords)] : [row(idealWords)];
}

/** One section without Z: columns over C. */
function sectionChart(readings, columns, words) {
  if (readings.thinned) return paragraph('Too many readings of one section to draw one by one.', 'quiet');
  const {points} = readings;
  const {kept} = split(points);
  const series = columns.map(([key, name, colour]) => ({
    name, type: 'scatter', symbolSize: 4, progressive: 0, progressiveThreshold: oneCanvas, emphasis: {disabled: true}, itemStyle: {color: colour, opacity: 0.7},
    data: pairs(points.c_deg, points[key], kept)}));
  return figure({caption: words, description: words,
    build: (width) => ({grid: grid({top: 60}), legend: legend({left: 0, right: 0}), xAxis: angleAxis(width), yAxis: uprightAxis('µm'), series})});
}

const sectionOverlay = (readings, extended) => sectionChart(readings, [['measured_um', 'measured', colours.grey],
  ['simulated_before_um', extended ? 'simulated before' : 'simulated', colours.measured], ...(extended ? [['simulated_after_um', 'simulated after', colours.model]] : [])],
'Deviation from a true-running surface over the spindle angle: measured and simulated.');

const sectionDifferences = (readings, extended) => sectionChart(readings, [['before_um', extended ? 'measured − before' : 'measured − simulated', colours.measured],
  ...(extended ? [['after_um', 'measured − after', colours.model]] : [])],
'Measured minus simulated over the spindle angle.');

/** Orders that have a name, for harmonics found and unexplained patterns. */
const foundLines = ({findings, unexplained}) => [
  ...findings.map((f) => ({order: f.parameters.order?.value, name: f.name})).filter(({order}) => isNumber(order)),
  ...unexplained.map((u) => ({order: Math.abs(u.term.pattern.order ?? 0), name: 'unexplained'})).filter(({order}) => order > 0)];

function spectrumChart(diagnosis, extended) {
  const {spectrum} = diagnosis.simulation;
  const {order, before_um: before, after_um: after} = spectrum;
  const most = Math.max(largest(before), largest(after));
  const nearest = (line) => order.reduce((best, o, i) => Math.abs(o - line.order) < Math.abs(order[best] - line.order) ? i : best, 0);
  // One mark a bin: several names there share it.
  const marks = new Map();
  foundLines(diagnosis).forEach((line) => {
    const i = nearest(line);
    marks.set(i, [...(marks.get(i) ?? []), `${line.name} (${tick(Number(line.order.toPrecision(4)))})`]);
  });
  const end = tidy(Math.ceil(largest(order)));
  // Above the mark if there is room on either side, else next to it.
  const beside = (width, i, names) => {
    const half = 3.3 * Math.max(...names.map((name) => name.length)), place = (width - 56) * order[i] / end;
    return place + half > width - 40 ? 'left' : place < half - 30 ? 'right' : 'top';
  };
  const labelled = (width) => [...marks].map(([i, names]) => ({value: [order[i], before[i]], label: {formatter: names.join('\n'), position: beside(width, i, names)}}));
  const curve = (name, values, colour, width) => ({name, type: 'line', symbol: 'none', emphasis: {disabled: true},
    itemStyle: {color: colour}, lineStyle: {color: colour, width}, data: order.map((o, i) => [o, values[i]])});
  const curves = [curve(extended ? 'before' : 'measured − simulated', before, colours.measured, 1.6), ...(extended ? [curve('after', after, colours.model, 1.6)] : [])];
  const found = (width) => ({name: 'found', type: 'scatter', symbol: 'triangle', symbolSize: 9, symbolOffset: [0, -8], z: 5, emphasis: {disabled: true},
    itemStyle: {color: colours.series[2]}, labelLayout: {moveOverlap: 'shiftY'},
    label: {show: true, distance: 8, color: colours.ink, fontSize: 11, lineHeight: 14}, data: labelled(width)});
  const seriesFor = (width) => marks.size ? [...curves, found(width)] : curves;
  const build = (width) => ({
    grid: grid({top: 64}),
    legend: legendOf(seriesFor(width), {left: 0, right: 0}),
    xAxis: axis('order: undulations per revolution', {min: 0, max: end}),
    yAxis: uprightAxis('amplitude in µm', {min: 0, max: roundUpFinely(most * 1.25)}),
    series: seriesFor(width),
  });
  return figure({caption: `Spectrum of measured minus simulated${extended ? ', before and after the model was extended. Marks are the lines that were found.' : '.'}` +
    (spectrum.grouped ? ' Each point is the highest of its neighbours.' : ''),
    description: `Amplitude over the order${extended ? ' before and after' : ''}, at most ${micrometres(largest(before) / 1000)}${extended ? ` before and ${micrometres(largest(after) / 1000)} after` : ''}${marks.size ? `; found: ${[...marks.values()].flat().join(', ')}` : ''}.`, size: 'map', renderer: 'svg', build});
}

/** Plans that can be carried out and whose gain is known. */
const feasible = (plans) => plans.filter((plan) => !plan.why_not && isNumber(plan.power_before) && isNumber(plan.power));

/** What every plan would do to the probability of the right name. */
function plansChart(plans) {
  const shown = feasible(plans);
  if (!shown.length) return null;
  const share = (v) => Number((100 * v).toPrecision(4));
  const bars = (name, key, colour) => ({name, type: 'bar', barWidth: '34%', emphasis: {disabled: true}, itemStyle: {color: colour},
    data: shown.map((plan) => share(plan[key]))});
  const build = (width) => ({
    grid: grid({top: 48}),
    legend: legend({left: 0, right: 0}),
    xAxis: axis('probability of the right name in %', {min: 0, max: 100}),
    yAxis: axis('', {type: 'category', inverse: true, data: shown.map((plan) => plan.what || data.words.measurements[plan.plan]),
      axisTick: {show: false}, splitLine: {show: false}, axisLabel: {color: colours.ink, interval: 0, width: width < 480 ? 130 : 300, overflow: 'break', lineHeight: 15, fontSize: width < 480 ? 10 : 12}}),
    series: [bars('with the data at hand', 'power_before', colours.grey), bars('with the measurement added', 'power', colours.series[2])],
  });
  return figure({caption: 'What each measurement would do, as predicted from its geometry and the noise found here.',
    description: `Probability of the right name with each measurement: ${shown.map((plan) => `${plan.what} ${probabilityOf(plan.power_before)}, then ${probabilityOf(plan.power)}`).join('; ')}.`, size: 'short', renderer: 'svg', build, height: (width) => 100 + (width < 480 ? 70 : 46) * shown.length});
}
