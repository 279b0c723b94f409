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

/** Tilt as what it makes over a length, ± U. */
function slopeWords({tilt_deg: value, u_tilt_deg: u}, k) {
  const [slope, big] = [value, k * u].map((deg) => Math.tan(deg * Math.PI / 180) * 1000);
  return isNumber(slope) && big > 0 ? `${fixed(slope, decimalsFor(big) ?? 3)} ± ${significant(big, 2)}${nbsp}µm/mm` : 'not determined';
}

function axisRow(name, axis, k, face) {
  const at = (end) => face ? 'only its tilt counts' : element('span', {}, plusMinus(offsetOf(end), end.u_mm, k, 'u unknown'), element('small', {}, `towards ${direction(end, k)}`));
  return [name, at(axis.start), at(axis.end), element('span', {}, slopeWords(axis, k), element('small', {}, degrees(axis.tilt_deg, k * axis.u_tilt_deg)))];
}

function axesTable(target, references, k) {
  const rows = target.references.filter((r) => r.axis).map((r) => axisRow(references[r.index].name, r.axis, k, r.face));
  if (target.axis) rows.push(axisRow(target.datum ? `target axis, that of the datum ${target.datum.name}` : 'target axis', target.axis, k, false));
  return table(`Offsets from the spindle axis and tilt against it, ± U (k = ${tick(k)}); directions counted like C from +x`,
    ['Axis', `at Z = ${millimetres(target.z_start_mm, 2)}`, `at Z = ${millimetres(target.z_end_mm, 2)}`, 'Tilt'], rows, 1, true);
}

/** Each seat at the ends of its own length, and where to tap it. */
function seatAxesTable({seat_axes: axes, references, verdict: {k}}) {
  const rows = axes.map((axis, i) => [axis, references[i].name]).filter(([axis]) => axis?.ends).map(([{ends, tilt: {value, u}, tap}, name]) => ({
    cells: [name, ...ends.map((end) => element('span', {}, plusMinus(end.offset.value, end.offset.u, k, 'u unknown'), element('small', {}, `at Z = ${millimetres(end.z.value, 2)}, towards ${fixed(end.towards.value, 0)}°`))),
      slopeWords({tilt_deg: value, u_tilt_deg: u}, k)], note: tap ? sentence(capital(tap)) : null, lost: false}));
  return rows.length ? table(`Each seat at the ends of its own length: eccentricity and tilt ± U (k = ${tick(k)}). Without form a seat runs out by twice its eccentricity`,
    ['Seat', 'Eccentricity, lower end', 'Eccentricity, upper end', 'Tilt'], rows, 1, true) : null;
}

/** How far the axes of each two seats are from each other. */
function seatsApartTable({seats_apart: pairs, verdict: {k}}) {
  const size = ({value, u}) => plusMinus(value, u, k, 'u unknown');
  const slip = (a, b) => `Or the part slipped between ${a} and ${b}, which would look the same: probe ${a} again, and compare`;
  const rows = pairs.flatMap(({at: both, angle, slip_looks_alike: alike}) => both.map((one, i) => ({
    cells: [`${one.reference} from ${both[1 - i].reference}`, size(one.in_its_middle.offset), size(one.coaxiality_about_the_other),
      slopeWords({tilt_deg: angle.value, u_tilt_deg: angle.u}, k)], note: alike && i === 1 ? slip(both[0].reference, one.reference) : null, lost: false})));
  return rows.length ? table(`How far the axes of the seats are from each other, ± U (k = ${tick(k)}); coaxiality (a diameter) over the probed length with the other axis as datum`,
    ['Axis', 'In the middle of its length', 'Coaxiality', 'Angle'], rows, 1, true) : null;
}

function remaindersTable(target, references, k) {
  const rows = target.references.filter((r) => r.after).map((r) => [
    references[r.index].name, r.face ? 'axial run-out' : 'coaxiality',
    r.before ? plusMinus(r.before.coaxiality_mm, r.before.u_mm, k, 'u unknown') : 'not determined',
    isNumber(r.after.at_most_mm) ? `${micrometres(r.after.coaxiality_mm, r.after.at_most_mm)}, ${atMost(r.after.at_most_mm)} (95 % confidence)` : `${micrometres(r.after.coaxiality_mm)}, u unknown`,
    r.face ? '–' : micrometres(r.after.offset_start_mm), r.face ? '–' : micrometres(r.after.offset_end_mm), tilt(r.after.tilt_deg),
    isNumber(r.weight) ? tick(r.weight) : '–']);
  return table(`Residual coaxiality of each reference if the part is cut about the target axis, ± U (k = ${tick(k)})`,
    ['Reference', 'Measure', 'Cut about the spindle', 'Cut about the target axis', 'Offset at start', 'Offset at end', 'Tilt', 'Weight'], rows, 2);
}

function axesSection(all) {
  const {target, references, verdict: {k}} = all;
  const lines = axisLines(target, references), along = all.seats.seats.length > 0;
  if (!target.references.some((r) => r.axis)) return section('axes', 'Axes', paragraph('No reference gave an axis.', 'alert'));
  if (target.references.every((r) => r.face)) {
    return section('axes', 'Tilt', table(`Tilt against the spindle axis, ± U (k = ${tick(k)})`, ['Face', 'Tilt'],
      target.references.filter((r) => r.axis).map((r) => [references[r.index].name, axisRow('', r.axis, k, true)[3]])));
  }
  if (!along) {  // sections without Z
    return section('axes', 'Eccentricity', element('div', {class: 'pair insets'}, endChart(lines, 'start', k, '')),
      table(`Offset from the spindle axis, ± U (k = ${tick(k)}); directions counted like C from +x`, ['Section', 'Offset'],
        target.references.filter((r) => r.axis).map((r) => axisRow(references[r.index].name, r.axis, k, false).slice(0, 2))));
  }
  const words = target.datum ? `The target axis is that of the datum ${target.datum.name} (ISO 5459): ${target.datum.how}.` : target.axis ? 'The target axis is the one axis about which the part is cut so that the weighted squared distance from the reference axes is least.' : null;
  const one = Math.abs(target.z_end_mm - target.z_start_mm) < 1e-9;
  const insets = lines.length ? [endChart(lines, 'start', k, millimetres(target.z_start_mm, 2)), one ? null : endChart(lines, 'end', k, millimetres(target.z_end_mm, 2))].filter(Boolean) : [];
  return section('axes', 'Axes', words ? paragraph(words) : null, seatsChart(all),
    all.seats_apart ? [seatAxesTable(all), seatsApartTable(all)] : null,
    insets.length ? element('div', {class: 'pair insets'}, insets) : null, axesTable(target, references, k));
}

/** The residual at each reference, the axes along Z, and for diagnosed ones the final, named and ideal axis. */
function axesFold(all) {
  const {target, references, verdict: {k}} = all, lines = axisLines(target, references);
  const parts = [];
  if (target.references.some((r) => r.after)) {
    parts.push(element('div', {class: 'wide'}, remaindersTable(target, references, k)),
      paragraph(`Offsets and tilt of the remainder are what the ${target.datum ? 'datum leaves at each reference, without a tolerance' : 'weights leave'}; they follow from the two estimated axes, and their uncertainty is in that of the coaxiality.`, 'quiet'));
  }
  if (lines.length && target.z_end_mm !== target.z_start_mm) parts.push(element('div', {class: 'pair'}, alongChart(lines, 'x'), alongChart(lines, 'y')));
  for (const reference of references) {
    const axes = reference.diagnosis ? axesBlock(reference.diagnosis, reference.readings?.face) : null;
    if (axes) parts.push(references.length > 1 ? block(reference.name, axes) : axes);
  }
  return parts.length ? fold('axes-more', 'Full axes', ...parts) : null;
}
