// SPDX-License-Identifier: Apache-2.0
// Charts of a diagnosis: measured against both simulations, spectrum, plans.

/** The readings of the reference with the columns of its diagnosis. */
function diagnosisReadings({readings, diagnosis}) {
  const merged = {...readings};
  if (readings.thinned) merged.cells = {...readings.cells, ...diagnosis.maps};
  else merged.points = {...readings.points, ...diagnosis.maps};
  return merged;
}

const mapWords = {
  before_um: 'Measured minus the simulation of the ideal surface.',
  after_um: 'Measured minus the simulation of the extended model.',
  effect_um: 'What the extended model adds to the ideal one.',
};

/** Three maps on one colour scale: what was wrong, what is left, what was added. */
function diagnosisMaps(reference) {
  const readings = diagnosisReadings(reference);
  const values = (key) => readings.thinned ? readings.cells[key] : split(readings.points).kept.map((i) => readings.points[key][i]);
  const keys = Object.keys(mapWords);
  const limit = roundUpFinely(Math.max(...keys.map((key) => largest(values(key)))));
  if (!readings.has_position) return [sectionDifferences(readings)];
  return keys.map((key) => readingMap(readings, key, mapWords[key], limit));
}

/** One section without Z: both differences over C. */
function sectionDifferences(readings) {
  if (readings.thinned) return paragraph('Too many readings of one section to draw one by one.', 'quiet');
  const {points} = readings;
  const {kept} = split(points);
  const series = [['before_um', 'ideal', colours.measured], ['after_um', 'extended', colours.model]].map(([key, name, colour]) => ({
    name: `measured − ${name}`, type: 'scatter', symbolSize: 4, progressive: 0, emphasis: {disabled: true}, itemStyle: {color: colour, opacity: 0.7},
    data: pairs(points.c_deg, points[key], kept)}));
  return figure({caption: 'Measured minus the simulations of the ideal and of the extended model over the spindle angle.',
    description: 'Differences of measured and simulated readings over C.',
    build: (width) => ({grid: grid({top: 60}), legend: legend({left: 0, right: 0}), xAxis: angleAxis(width), yAxis: uprightAxis('µm'), series})});
}

function spectrumChart({spectrum, lines}) {
  const {order, before_um: before, after_um: after} = spectrum;
  const most = Math.max(largest(before), largest(after));
  const nearest = (line) => order.reduce((best, o, i) => Math.abs(o - line.order) < Math.abs(order[best] - line.order) ? i : best, 0);
  // One mark a bin: several names there share it.
  const marks = new Map();
  lines.forEach((line) => {
    const i = nearest(line);
    marks.set(i, [...(marks.get(i) ?? []), `${line.name.split('.').pop().replaceAll('_', ' ')} (${tick(Number(line.order.toPrecision(4)))})`]);
  });
  const labelled = [...marks].map(([i, names]) => ({value: [order[i], before[i]], label: {formatter: names.join('\n')}}));
  const curve = (name, values, colour, width) => ({name, type: 'line', symbol: 'none', emphasis: {disabled: true},
    itemStyle: {color: colour}, lineStyle: {color: colour, width}, data: order.map((o, i) => [o, values[i]])});
  const series = [curve('before', before, colours.measured, 1.6), curve('after', after, colours.model, 1.6)];
  if (labelled.length) {
    series.push({name: 'found', type: 'scatter', symbol: 'triangle', symbolSize: 9, symbolOffset: [0, -8], z: 5, emphasis: {disabled: true},
      itemStyle: {color: colours.series[2]}, labelLayout: {moveOverlap: 'shiftY'},
      label: {show: true, position: 'top', distance: 8, color: colours.ink, fontSize: 11}, data: labelled});
  }
  const build = () => ({
    grid: grid({top: 64}),
    legend: legendOf(series, {left: 0, right: 0}),
    xAxis: axis('order: undulations per revolution', {min: 0, max: tidy(Math.ceil(largest(order)))}),
    yAxis: uprightAxis('amplitude in µm', {min: 0, max: roundUp(most * 1.25)}),
    series,
  });
  return figure({caption: 'Spectrum of what the simulation leaves, before and after the model was extended. Marks are the lines that were found.' +
    (spectrum.grouped ? ' Each point is the highest of its neighbours.' : ''),
    description: 'Amplitude over the order before and after, with the found lines.', size: 'map', renderer: 'svg', build});
}

/** What every plan would do to the chance of the right name. */
function plansChart(plans) {
  const shown = plans.filter((plan) => !plan.why_not && isNumber(plan.before) && isNumber(plan.after));
  if (!shown.length) return null;
  const share = (v) => Number((100 * v).toPrecision(4));
  const bars = (name, key, colour) => ({name, type: 'bar', barWidth: '34%', emphasis: {disabled: true}, itemStyle: {color: colour},
    data: shown.map((plan) => share(plan[key]))});
  const build = () => ({
    grid: grid({top: 48}),
    legend: legend({left: 0, right: 0}),
    xAxis: axis('chance of the right name in %', {min: 0, max: 100}),
    yAxis: axis('', {type: 'category', inverse: true, data: shown.map((plan) => `${plan.plan}, ${tick(Number(plan.minutes.toPrecision(3)))} min`),
      axisTick: {show: false}, splitLine: {show: false}, axisLabel: {color: colours.ink}}),
    series: [bars('with the data at hand', 'before', colours.grey), bars('with the measurement added', 'after', colours.series[2])],
  });
  return figure({caption: 'What each measurement would do, as predicted from its geometry and the noise found here.',
    description: 'Chance of the right name before and after each plan.', size: shown.length > 5 ? 'map' : 'short', renderer: 'svg', build});
}
