// SPDX-License-Identifier: Apache-2.0
// The correction table and what the actuator has left.

const works = (correction) => correction.face ? 'Z_fts' : 'X_fts';

function profileChart(correction) {
  const series = correction.turns.map((turn, i) => ({
    name: `revolution ${turn.revolution}, ${correction.face ? 'X' : 'Z'} = ${millimetres(turn.position_mm, 2)}`, type: 'line', symbol: 'none',
    lineStyle: {width: 1.8, type: ['solid', 'dashed', 'dotted'][i % 3]}, emphasis: {disabled: true},
    data: turn.c_deg.map((c, j) => [c, turn.wanted_um[j]])}));
  const build = (width) => ({
    grid: grid({top: width < 480 ? 96 : 72}),
    legend: legendOf(series, {left: 0, right: 0}),
    xAxis: angleAxis(width),
    yAxis: uprightAxis(`${works(correction)} in µm`),
    series,
  });
  return figure({caption: `The correction ${works(correction)} over one turn, at the first, the middle and the last revolution. Positive is ${correction.face ? 'towards +Z' : 'away from the spindle axis'}.`,
    description: `Correction over the spindle angle for three revolutions, up to ${micrometres(largest(correction.turns.flatMap((turn) => turn.wanted_um)) / 1000)}.`, size: 'map', renderer: 'svg', build});
}

function correctionMap(correction) {
  const values = correction.map.wanted_um;
  const words = `The whole table unrolled: ${works(correction)} over C and ${correction.face ? 'X' : 'Z'}, ${correction.rows} rows in ${correction.revolutions} revolutions` +
    ` as means of ${correction.map.columns} × ${correction.map.rows} cells. The wave that leans or fades along ${correction.face ? 'X' : 'Z'} is the tilt.`;
  return figure({caption: words, description: words, size: 'map',
    build: (width) => cellMap(correction.map, values, {limit: roundUpFinely(largest(values)), positionName: correction.face ? 'X in mm' : 'Z in mm', width})});
}

const middleTurn = (correction) => correction.turns[Math.floor(correction.turns.length / 2)];

/** Lines over one turn: `lines` of [name, values in µm, type]. */
function turnChart(turn, lines, {caption, description, name}) {
  const series = lines.map(([label, values, type]) => ({name: label, type: 'line', symbol: 'none', emphasis: {disabled: true},
    lineStyle: {width: 1.8, type}, data: turn.c_deg.map((c, i) => [c, values[i]])}));
  const build = (width) => ({
    grid: grid({top: 60}),
    legend: legendOf(series, {left: 0, right: 0}),
    xAxis: angleAxis(width),
    yAxis: uprightAxis(name),
    series,
  });
  return figure({caption, description, renderer: 'svg', build});
}

function commandCharts(correction) {
  const turn = middleTurn(correction);
  const difference = turn.command_um.map((um, i) => um - turn.wanted_um[i]);
  const why = correction.precompensated
    ? 'The command leads the wanted motion by what the actuator lags at this speed.'
    : 'Precompensation is off: the command is the wanted motion, and the lag is left in the part.';
  return [
    turnChart(turn, [['wanted', turn.wanted_um, 'solid'], ['command', turn.command_um, 'dashed']], {name: 'µm',
      caption: `What is sent and what is wanted, revolution ${turn.revolution}. ${why}`, description: 'Wanted correction and command over the spindle angle.'}),
    turnChart(turn, [['command − wanted', difference, 'solid']], {name: 'command − wanted in µm',
      caption: `The difference of the two, magnified: at most ${micrometres(largest(difference) / 1000)} in revolution ${turn.revolution}.`,
      description: `Command minus wanted correction over the spindle angle, at most ${micrometres(largest(difference) / 1000)}.`}),
  ];
}

function harmonicsTable(correction) {
  const deg = (value) => `${fixed(value, 2)}${nbsp}°`;
  const phase = (order, amplitude, value) => order === 0 || amplitude < 5e-7 || !isNumber(value) ? '–' : deg(value);
  return table(`Harmonics of the correction, A cos(nC − φ), and the actuator at ${tick(correction.speed_rpm)} rpm`,
    ['Per revolution', 'A at start', 'φ at start', 'A at end', 'φ at end', 'Frequency', 'Actuator gain', 'Actuator lag'],
    correction.harmonics.map((h) => [String(h.order), um(h.amplitude_start.value), phase(h.order, h.amplitude_start.value, h.phase_start.value),
      um(h.amplitude_end.value), phase(h.order, h.amplitude_end.value, h.phase_end.value), `${significant(h.order * correction.speed_rpm / 60, 3)}${nbsp}Hz`,
      fixed(h.actuator_gain, 5), deg(h.actuator_lag.value)]));
}

/** A profile number, which the machine runs as it is: 1 nm steps. */
const um = (mm) => isNumber(mm) ? `${fixed(mm * 1000, 3)}${nbsp}µm` : 'not determined';

const marginLines = (m) => [
  {name: 'stroke', used: m.stroke_used.value, limit: m.stroke_available.value, show: (v) => micrometres(v), what: 'peak to peak, after the reserve'},
  {name: 'slew rate', used: m.slew_used.value, limit: m.slew_available.value, show: (v) => `${significant(v, 3)}${nbsp}mm/s`, what: 'fastest motion'},
  {name: 'bandwidth', used: m.highest_frequency.value, limit: m.bandwidth.value, show: (v) => `${significant(v, 3)}${nbsp}Hz`, what: 'highest harmonic above 10 nm'},
  {name: 'following error', used: m.following.value, limit: m.following_limit.value, show: (v) => micrometres(v), what: 'predicted peak'},
].map((line) => ({...line, share: line.limit > 0 && isNumber(line.used) ? line.used / line.limit : null}));

function marginChart(lines) {
  const most = Math.max(100, ...lines.map((line) => (line.share ?? 0) * 100));
  const max = most > 100 ? roundUp(most * 1.15) : 100;
  const build = (width) => ({
    grid: grid({top: 24, right: width < 480 ? 56 : 70}),
    xAxis: axis('used share in %', {min: 0, max}),
    yAxis: axis('', {type: 'category', inverse: true, data: lines.map((line) => line.name), axisTick: {show: false}, splitLine: {show: false}, axisLabel: {color: colours.ink}}),
    series: [{type: 'bar', barWidth: '52%', emphasis: {disabled: true}, showBackground: max === 100, backgroundStyle: {color: colours.soft},
      data: lines.map((line) => ({value: line.share === null ? null : Number((line.share * 100).toPrecision(6)),
        itemStyle: {color: line.share > 1 ? colours.rejected : colours.series[2]}})),
      label: {show: true, position: 'right', color: colours.ink, backgroundColor: colours.veil, padding: [1, 2], formatter: ({value}) => isNumber(value) ? `${significant(value, 3)} %` : 'no limit known'},
      markLine: {silent: true, symbol: 'none', data: [{xAxis: 100}], lineStyle: {color: colours.ink, type: 'dashed'}, label: {formatter: 'limit', position: 'start', color: colours.ink}}}],
  });
  return figure({caption: 'How much of each limit the correction uses. A bar beyond the dashed line breaks the limit.',
    description: `Used share of each limit: ${lines.map((line) => `${line.name} ${percent(line.share)}`).join(', ')}.`, size: 'short', renderer: 'svg', build});
}

/** What is cut with: the profile, and what the actuator has left. */
function correctionSection(all) {
  const {correction, target} = all;
  if (!correction) return target.of_cut ? section('correction', 'The correction', paragraph('No target axis could be found, so there is no correction.')) : null;
  if (!correction.turns.length) return section('correction', 'The correction', paragraph('The table has no rows.', 'alert'));
  const {margin, speed_rpm: speed} = correction;
  const rpm = (value) => `${tick(Number(value.toPrecision(4)))}${nbsp}rpm`;
  const words = margin.follows ? `The actuator can follow it at ${rpm(speed)}.` : `The actuator cannot follow it at ${rpm(speed)}: do not run the table.${margin.breaks ? ` What breaks: ${margin.breaks}.` : ''}`;
  return section('correction', 'The correction',
    paragraph(`${works(correction)} is what a fast tool servo adds to the programmed ${correction.face ? 'Z' : 'X'} so that the tool follows the target axis.`), paragraph(words, margin.follows ? null : 'alert'),
    element('div', {class: 'pair'}, profileChart(correction), marginChart(marginLines(margin))));
}

function correctionFold(all) {
  const {correction, target, verdict} = all;
  if (!correction?.turns.length) return null;
  const {margin, speed_rpm: speed} = correction;
  const rpm = (value) => `${tick(Number(value.toPrecision(4)))}${nbsp}rpm`;
  const U = target.axis ? `U (k = ${tick(verdict.k)}) is ${uncertainty(verdict.k * target.axis.start.u_mm, 'mm')} at the start and ${uncertainty(verdict.k * target.axis.end.u_mm, 'mm')} at the end` : 'it is not known';
  return fold('correction-more', 'Full correction', facts([
    ['Speed of the job', rpm(speed)],
    ['Highest speed that works', margin.max_speed.value > 0 ? rpm(margin.max_speed.value) : 'none'],
    ['Following error if sent uncorrected', micrometres(margin.following_uncompensated.value)],
    ['Following error with this table', micrometres(margin.following.value)],
    ['Set-points per revolution', tick(Number(margin.set_points_per_revolution.toPrecision(4)))],
  ]), table('What the actuator has left', ['Limit', 'Used', 'Available', 'Share'],
    marginLines(margin).map((line) => [element('span', {}, line.name, element('small', {}, line.what)), line.show(line.used), line.show(line.limit), percent(line.share)])),
  paragraph("Predictions from the actuator's data in the job, which state no uncertainty; the stroke reserve covers it.", 'quiet'),
  element('div', {class: 'pair'}, correctionMap(correction), commandCharts(correction)), harmonicsTable(correction),
  paragraph(`The profile carries the uncertainty of the target axis: ${U}. The actuator's gain and lag follow from the data of the job, which state no uncertainty.`, 'quiet'));
}
