// SPDX-License-Identifier: Apache-2.0
// Roundness, cylindricity and run-out as an instrument prints them, with what the machine did and without.

const formNames = {RONt: 'Roundness RONt', CYLt: 'Cylindricity CYLt', CONt: 'Conicity CONt', STRsa: 'Straightness of the axis', FLTt: 'Flatness FLTt',
  runout_circular: 'Circular run-out', runout_total: 'Total run-out', axial_runout_circular: 'Axial run-out', coaxiality: 'Coaxiality'};
const formReferences = {MZCI: 'minimum zone circle', MZCY: 'minimum zone cylinder', MZCO: 'minimum zone cone', MZPL: 'minimum zone planes'};
const conformityWords = {met: 'met', not_met: 'not met', not_proven: 'not proven', not_judged: 'not judged'};

/** A value ± U with the digits of its U. */
const formCell = (one, k) => !one ? '–' : isNumber(one.at_most_mm) ? atMost(one.at_most_mm) : Math.abs(one.mm) < 1e-9 ? '0' : plusMinus(one.mm, one.u_mm, k, 'no U');

/** What the columns of a table are: as probed, less what is not of the part, less what may not be. */
function formCases({motion, open}) {
  const heads = ['as probed'];
  if (motion.length) heads.push('without what is not of the part');
  if (open.length) heads.push(motion.length ? 'nor what may not be' : 'without what may not be of the part');
  return heads;
}

function formCasesWords({motion, open}, diagnosed) {
  if (!diagnosed) return 'The readings as they are: no diagnosis was made, so that a motion of the spindle is in the values.';
  if (!motion.length && !open.length) return 'Nothing was found that is not of the part. A motion of the spindle too small to be found, or one that looks like form, is in the values.';
  const words = [];
  if (motion.length) words.push(`Not of the part, and taken off the readings: ${motion.join(', ')}.`);
  if (open.length) words.push(`The readings do not tell whether what looks like ${open.join(', ')} is of the part. The part's own form lies between both columns, and a tolerance is held against both.`);
  return words.join(' ');
}

/** Trace, filtered profile and the two circles of the minimum zone. */
function formPolar(form) {
  const {worst} = form, place = isNumber(worst.z_mm) ? `Z = ${millimetres(worst.z_mm, 2)}` : 'the section';
  const kept = (um) => worst.c_deg.map((c, i) => [um[i], c]);
  const all = form.surface_readings;
  const parts = [{name: all ? 'before the filter' : 'readings', um: worst.raw_um, colour: colours.grey, width: 1, dots: true}, {name: form.filter, um: worst.um, colour: colours.measured, width: 1.8}];
  if (worst.outer_um) parts.push({name: 'minimum zone', um: worst.outer_um, colour: colours.model, width: 1, dashed: true}, {name: 'minimum zone', um: worst.inner_um, colour: colours.model, width: 1, dashed: true});
  const most = largest(parts.flatMap(({um}) => um)), step = roundUp(most / 3), out = step * Math.max(1, Math.ceil(most * 1.02 / step)), base = 1.5 * out;
  const closed = (values) => [...values, [values[0][0], values[0][1] + 360]];
  const series = parts.map(({name, um, colour, width, dots, dashed}) => dots
    ? {name, type: 'scatter', coordinateSystem: 'polar', symbolSize: um.length > 120 ? 2 : 4, itemStyle: {color: colour}, emphasis: {disabled: true}, data: kept(um)}
    : {name, type: 'line', coordinateSystem: 'polar', symbol: 'none', emphasis: {disabled: true}, lineStyle: {color: colour, width, type: dashed ? 'dashed' : 'solid'}, itemStyle: {color: colour}, data: closed(kept(um))});
  const build = (width) => ({
    legend: legendOf(series.slice(0, 3), {left: 'center', right: 'auto', ...(width < 400 ? {itemWidth: 12, itemGap: 6, textStyle: {color: colours.ink, fontSize: 10}} : {})}),
    polar: {radius: width < 400 ? '64%' : '76%', center: ['50%', width < 400 ? '59%' : '54%']},
    angleAxis: {type: 'value', min: 0, max: 360, interval: width < 300 ? 90 : 45, startAngle: 0, clockwise: false,
      axisLabel: {color: colours.grey, formatter: (v) => v === 360 ? '' : `${v}°`}, axisLine: {lineStyle: {color: colours.line}}, axisTick: {show: false}, splitLine: {lineStyle: {color: colours.grid}}},
    radiusAxis: {min: step * -Math.floor(base / step), max: out, interval: step, axisLine: {show: false}, axisTick: {show: false}, axisLabel: {show: false}, splitLine: {lineStyle: {color: colours.grid}}},
    series,
  });
  const what = all ? `The surface of all ${all} readings where its RONt is largest, at ${place}: the profile` : `The section with the largest RONt, at ${place}: ${worst.readings} readings`;
  return figure({caption: `${what} about the least-squares circle, filtered, between the two circles of the minimum zone. ${tick(step)} µm a ring.`,
    description: `Roundness plot at ${place}, up to ${micrometres(most / 1000)} from the least-squares circle.`, size: 'polar', renderer: 'svg', build});
}

function formHarmonics({worst, high_upr: high}) {
  const {orders} = worst, most = orders.length ? orders[orders.length - 1].order : 0;
  if (orders.length < 2) return null;
  const step = (width) => Math.min(most, high) > 100 ? 50 : width < 480 ? 10 : 5;
  const build = (width) => ({grid: grid(), xAxis: axis('undulations per revolution', {type: 'category', data: orders.map((o) => String(o.order)), splitLine: {show: false},
    axisLabel: {color: colours.ink, interval: (i) => most < 16 || orders[i].order % step(width) === 0 || orders[i].order === 2}}),
    yAxis: uprightAxis('amplitude in µm', {min: 0}),
    series: [{name: 'amplitude', type: 'bar', barWidth: '70%', emphasis: {disabled: true}, itemStyle: {color: colours.series[0]}, data: orders.map((o) => o.amplitude_um)}]});
  const highest = [...orders].sort((a, b) => b.amplitude_um - a.amplitude_um).slice(0, 3).map((o) => `${o.order} (${micrometres(o.amplitude_um / 1000)})`).join(', ');
  return figure({caption: `Harmonics of this section before the filter, 2 to ${Math.min(most, high)} undulations a turn.`, description: `Harmonics of the section. The largest: ${highest}.`, size: 'map', renderer: 'svg', build});
}

/** Form of the part: tolerances, values, the worst section, a row a section. */
function partFormBlock(form, diagnosed = true) {
  const judged = form.judgements.map(({conformity, text}) => element('li', {}, pill(conformityWords[conformity], conformity === 'met'), ` ${joined(sentence(text))}`));
  const parts = judged.length ? [element('ul', {class: 'judged'}, judged)] : [];
  if (form.why_not) return block('Form of the part', ...parts, paragraph(`Not assessed: ${form.why_not}.`, 'quiet'));
  const heads = formCases(form), {k} = form;
  parts.push(paragraph(formCasesWords(form, diagnosed)));
  parts.push(table(`Values ± U (k = ${tick(k)}), ${form.filter}`, ['Value', 'About', ...heads],
    form.values.map((row) => [formNames[row.name] ?? row.name, formReferences[row.reference] ?? '–', ...row.cases.map((one) => formCell(one, k))]), 2, true));
  if (!form.worst) return block('Form of the part', ...parts);
  parts.push(element('div', {class: 'pair'}, [formPolar(form), formHarmonics(form)].filter(Boolean)));
  parts.push(table(`This section about each circle ± U, ${form.filter}`, ['Value', 'least squares (LSCI)', 'minimum zone (MZCI)'],
    form.worst.values.map((row) => [row.name, ...row.about.map((one) => formCell(one, k))])));
  if (form.section_count > 1) {
    const more = form.section_count > form.sections.length ? `, the ${form.sections.length} largest of ${form.section_count}` : '';
    parts.push(table(`RONt of each ${form.surface_readings ? 'station of the surface' : 'section'} about the minimum zone circle${more}`, ['Z', ...heads, 'Lobes'],
      form.sections.map((row) => [isNumber(row.z_mm) ? millimetres(row.z_mm, 2) : '–', ...row.cases.map((one) => formCell(one, k)), row.lobes ? String(row.lobes) : '–']), 1, true));
  }
  if (form.notes.length) parts.push(element('ul', {class: 'quiet'}, form.notes.map((text) => element('li', {}, joined(sentence(text))))));
  return block('Form of the part', ...parts);
}

const associationWords = {gaussian: 'least squares (Gaussian)', minimum_zone: 'minimum zone', minimum_circumscribed: 'minimum circumscribed', maximum_inscribed: 'maximum inscribed', constrained: 'least squares outside of the material'};

/** What another association would give: a measuring machine that is set otherwise finds another axis. */
function datumsBlock(datums, association) {
  const found = datums.find((one) => one.ends);
  const heads = found ? found.ends.map((end) => `off at Z = ${millimetres(end.z.value, 2)}`) : ['off'];
  return block('The axis by other associations', paragraph(`The axis of this job is that of ${associationWords[association] ?? 'least squares along the probe line'}, without what was found. A coordinate measuring machine that is set to another association finds an axis that is so far off; ` +
    'those that rest on few readings contain all of their noise, and do not have a U here.'),
  table('How far the axis would be off', ['Association', ...heads], datums.map((one) => ({cells: [`${associationWords[one.association] ?? one.association}${one.of_iso_5459 ? ' (default of ISO 5459:2011)' : ''}`,
    ...(one.ends ? one.ends.map((end) => micrometres(end.off.value)) : heads.map(() => '–'))], note: one.why ? sentence(one.why) : null, lost: false}))));
}
