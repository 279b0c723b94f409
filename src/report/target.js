// SPDX-License-Identifier: Apache-2.0
// Where the axes are, and what is left at each reference when the part is cut about the target axis.

const expanded = (u, k) => isNumber(u) ? k * u : null;

/** "value ± U", or the value and why there is no U. */
function plusMinus(mm, u_mm, k, why) {
  if (!isNumber(mm)) return 'not determined';
  if (!isNumber(u_mm)) return `${micrometres(mm)} (${why})`;
  const big = k * u_mm;
  return `${micrometres(mm, big).replace(nbsp + 'µm', '')} ± ${uncertainty(big, 'mm')}`;
}

const offsetOf = (end) => Math.hypot(end.x_mm, end.y_mm);
const directionOf = (end) => (Math.atan2(end.y_mm, end.x_mm) * 180 / Math.PI + 360) % 360;

/** Direction of an offset ± U; none where the offset drowns in its own uncertainty. */
function direction(end, k) {
  const big = k * end.u_mm / offsetOf(end) * 180 / Math.PI;
  if (!isNumber(big) || big > 90) return 'open: offset below U';
  return `${fixed(directionOf(end), decimalsFor(big) ?? 1)} ± ${uncertainty(big, 'deg')}`;
}

function axisRow(name, axis, k, face) {
  const at = (end) => face ? 'only its tilt counts' : plusMinus(offsetOf(end), end.u_mm, k, 'u unknown');
  const toward = (end) => face ? '–' : direction(end, k);
  return [name, at(axis.start), toward(axis.start), at(axis.end), toward(axis.end),
    `${tilt(axis.tilt_deg, k * axis.u_tilt_deg)} ± ${uncertainty(k * axis.u_tilt_deg, 'deg')}`];
}

function axesTable(target, references, k) {
  const rows = target.references.filter((r) => r.axis).map((r) => axisRow(references[r.index].name, r.axis, k, r.face));
  if (target.axis) rows.push(axisRow('target axis', target.axis, k, false));
  return table(`Axes against the spindle axis, ± U (k = ${tick(k)}); direction counted like C from +x`,
    ['Axis', `Offset at Z = ${millimetres(target.z_start_mm, 2)}`, 'towards', `Offset at Z = ${millimetres(target.z_end_mm, 2)}`, 'towards', 'Tilt'], rows);
}

function remaindersTable(target, references, k) {
  const rows = target.references.filter((r) => r.after).map((r) => [
    references[r.index].name, r.face ? 'axial run-out' : 'coaxiality',
    r.before ? plusMinus(r.before.coaxiality_mm, r.before.u_mm, k, 'u unknown') : 'not determined',
    isNumber(r.after.at_most_mm) ? `${micrometres(r.after.coaxiality_mm, r.after.at_most_mm)}, at most ${micrometres(r.after.at_most_mm, r.after.at_most_mm)} in 95 of 100` : `${micrometres(r.after.coaxiality_mm)}, u unknown`,
    r.face ? '–' : micrometres(r.after.offset_start_mm), r.face ? '–' : micrometres(r.after.offset_end_mm), tilt(r.after.tilt_deg),
    isNumber(r.weight) ? tick(r.weight) : '–']);
  return table(`What is left at each reference when the part is cut about the target axis, ± U (k = ${tick(k)})`,
    ['Reference', 'Measure', 'Cut about the spindle', 'Cut about the target axis', 'Offset at start', 'Offset at end', 'Tilt', 'Weight'], rows, 2);
}

/** The axes that are drawn, each with its colour; the target axis is the broad one behind. */
function axisLines(target, references) {
  const lines = target.references.filter((r) => r.axis && !r.face)
    .map((r, i) => ({name: references[r.index].name, axis: r.axis, width: 2, mark: 8, opacity: 1, colour: [0, 1, 3, 4, 5].map((c) => colours.series[c])[i % 5]}));
  if (target.axis) lines.push({name: 'target axis', axis: target.axis, width: 6, mark: 13, opacity: 0.5, colour: colours.series[2]});
  return lines;
}

/** The axes seen along the spindle: a line from the start (full mark) to the end (open mark) of the length. */
function axesChart(target, lines) {
  const um = (end) => [end.x_mm * 1000, end.y_mm * 1000];
  const limit = roundUp(largest(lines.flatMap(({axis: a}) => [...um(a.start), ...um(a.end)])) * 1.1);
  const series = lines.map(({name, axis: a, width, mark, opacity, colour}) => ({
    name, type: 'line', emphasis: {disabled: true}, z: name === 'target axis' ? 2 : 3, symbol: 'circle', symbolSize: mark, showAllSymbol: true,
    lineStyle: {width, color: colour, opacity}, itemStyle: {color: colour, opacity},
    data: [{value: um(a.start)}, {value: um(a.end), itemStyle: {color: '#fff', borderColor: colour, borderWidth: 2}}]}));
  series.push({name: 'spindle axis', type: 'scatter', data: [[0, 0]], z: 4, symbolSize: 18, emphasis: {disabled: true},
    symbol: 'path://M-1,-10 L1,-10 L1,-1 L10,-1 L10,1 L1,1 L1,10 L-1,10 L-1,1 L-10,1 L-10,-1 L-1,-1 Z', itemStyle: {color: colours.ink}});
  const same = {min: -limit, max: limit, interval: limit / 2};
  const build = () => ({
    grid: grid({top: 64}),
    legend: legend({left: 0, right: 0}),
    xAxis: axis('x in µm', same),
    yAxis: uprightAxis('y in µm', same),
    series,
  });
  return figure({caption: `The axes in the part frame, seen along −Z, from Z = ${millimetres(target.z_start_mm, 2)} (full mark) to ${millimetres(target.z_end_mm, 2)} (open mark). ` +
    'The cross is the spindle axis: the distance to it is the eccentricity that the correction takes out.',
    description: 'Position of the axes in the plane across the spindle.', size: 'square', renderer: 'svg', build});
}

/** x and y of each axis along Z: their slope is the tilt. */
function alongChart(target, lines) {
  const series = lines.flatMap(({name, axis: a, width, opacity, colour}) => ['x', 'y'].map((letter) => ({
    name: `${letter} of ${name}`, type: 'line', symbol: 'none', emphasis: {disabled: true},
    lineStyle: {width, opacity, color: colour, type: letter === 'x' ? 'solid' : 'dashed'}, itemStyle: {color: colour},
    data: [a.start, a.end].map((end) => [end.z_mm, end[`${letter}_mm`] * 1000])})));
  const build = (width) => ({
    grid: grid({top: width < 480 ? 110 : 84}),
    legend: legendOf(series, {left: 0, right: 0}),
    xAxis: axis('Z in mm', spanning(lines.flatMap(({axis: a}) => [a.start.z_mm, a.end.z_mm]))),
    yAxis: uprightAxis('x, y in µm', {scale: true}),
    series,
  });
  return figure({caption: 'x and y of the axes along Z. A level line runs true to the spindle; its slope is the tilt.',
    description: 'x and y of the axes along Z.', size: 'map', renderer: 'svg', build});
}

function targetSection(data) {
  const {target, references, verdict} = data;
  const k = verdict.k;
  const solved = target.references.some((r) => r.axis);
  const words = target.of_cut ? 'The length is the one to be cut.' : 'The length is the one that was probed.';
  const parts = [];
  if (target.axis) {
    parts.push(paragraph(`The target axis is the one axis about which the part is cut so that the weighted squared distance from the reference axes is least. ${words}`));
  } else {
    parts.push(paragraph(`No target axis was asked for, or none could be found. ${words}`));
  }
  if (!solved) parts.push(paragraph('No reference gave an axis.', 'alert'));
  if (solved) parts.push(axesTable(target, references, k));
  for (const apart of target.apart) parts.push(paragraph(`Beyond U, half-way between them, ${apart}.`, 'quiet'));
  if (target.references.some((r) => r.after)) {
    parts.push(element('div', {class: 'wide'}, remaindersTable(target, references, k)),
      paragraph('Offsets and tilt of the remainder are what the weights leave; they follow from the two estimated axes, and their uncertainty is in that of the coaxiality.', 'quiet'));
  }
  const lines = axisLines(target, references);
  if (lines.length) parts.push(element('div', {class: 'pair'}, axesChart(target, lines), alongChart(target, lines)));
  return section('axes', 'References and target axis', ...parts);
}
