// SPDX-License-Identifier: Apache-2.0
// What the model gets wrong: findings, gain, what cannot be seen, noise, the next measurement.

const diagnosisWords = {
  ideal: 'No deviation from the ideal fit was detected.',
  effects: 'The readings deviate from the ideal fit. The causes are listed below.',
  unexplained: 'The readings deviate from the ideal fit, and no cause of the catalogue explains it fully.',
};

const spoken = (name) => name.replaceAll('_', ' ');

/** "value ± U" of an estimate in the unit that suits its size, or why it is not there. */
function estimated({value, u, unit, why}, k) {
  if (!isNumber(value)) return `not determined${why ? `: ${why}` : ''}`;
  if (u === 0 && (unit === '1' || unit === '')) return tick(Number(value.toPrecision(6)));
  const shown = quantity(value, isNumber(u) ? k * u : null, unit);
  return isNumber(u) && u > 0 ? `${shown} ± ${uncertainty(k * u, unit)}` : shown;
}

const minutes = (plan) => `${tick(Number(plan.minutes.toPrecision(2)))}${nbsp}min`;

/** With `power` or, of the next measurement, `power_after`. */
function measurementWords(plan) {
  if (!plan) return null;
  if (!plan.plan) return `No plan does it${plan.why_not ? `: ${plan.why_not}` : ''}.`;
  return `${plan.what || data.words.measurements[plan.plan]}: probability of the right name ${probabilityOf(plan.power_before)} → ${probabilityOf(plan.power ?? plan.power_after)}, ${minutes(plan)}${otherPlans(plan)}.`;
}

function otherPlans({others = []}) {
  return others.map((o) => `; or ${o.what || data.words.measurements[o.plan]} (→ ${probabilityOf(o.power)}, ${minutes(o)})`).join('');
}

function findingCard(finding, number, k, titles, face) {
  const {axis_shift: shift, cosmetic} = finding.axis_bias;
  const list = named(finding.parameters).map((p) => [spoken(p.name), estimated(p, k)]);
  list.push(['Part of the readings (RMS)', micrometres(finding.rms.value)],
    [face ? 'Tilt at the outer end if ignored' : 'Axis shift if ignored', estimated(shift, k)],
    falseAlarm(finding));
  const parts = [element('h4', {}, `${number}. ${finding.seen}`, cosmetic ? element('span', {class: 'pill neutral'}, face ? 'cosmetic for the run-out' : 'cosmetic for coaxiality') : null),
    facts(list), classTable(finding, titles)];
  if (finding.alias) parts.push(paragraph(`The sampling cannot tell it from ${finding.alias}.`, 'quiet'));
  if (finding.separate_with) parts.push(paragraph(`To tell apart: ${measurementWords(finding.separate_with)}`));
  return element('div', {class: 'card'}, parts);
}

function findingsBlock({findings, unexplained, titles, options: {coverage_factor: k}}, face) {
  if (!findings.length && !unexplained.length) return null;
  const cards = findings.map((f, i) => findingCard(f, i + 1, k, titles, face));
  unexplained.forEach((u) => cards.push(element('div', {class: 'card'},
    element('h4', {}, `Unexplained: ${u.seen}`), facts([['Amplitude', estimated(u.amplitude, k)]]),
    paragraph('No catalogued cause explains it. The final fit includes it, so that it does not move the axis.', 'quiet'))));
  return block('Causes, the most harmful first', paragraph(`± is U = k u, k = ${tick(k)}.`, 'quiet'), element('div', {class: 'cards'}, cards));
}

const spread = ({value, low, high}) => isNumber(value) && value > 0
  ? `${micrometres(value)}${isNumber(low) && high > low ? ` (95 % ${micrometres(low).replace(nbsp + 'µm', '')} to ${micrometres(high)})` : ''}` : 'not determined';

function gainFacts({gain, options: {coverage_factor: k}}, face) {
  const ratio = gain.held_out_ratio;
  return facts([
    ['Cross-validated RMS, ideal fit', spread(gain.held_out_rms_before)],
    ['Cross-validated RMS, with the causes', spread(gain.held_out_rms_after)],
    ['Ratio (95 %)', isNumber(ratio.value) && ratio.value > 0 ? `${fixed(ratio.value, 2)} (${fixed(ratio.low ?? ratio.value, 2)} to ${fixed(ratio.high ?? ratio.value, 2)})` : 'not determined'],
    ['Noise floor', micrometres(gain.noise_floor.value)],
    [face ? 'What the tilt moved by, at the outer end' : 'Shift of the axis', estimated(gain.axis_shift, k)],
    [face ? 'Expected axial run-out at the outer end, cut square to the axis of the ideal fit'
      : 'Expected coaxiality over the probed length, cut about the axis of the ideal fit', estimated(gain.coaxiality_before, k)],
    [`The same ${face ? 'square to the final axis' : 'about the final axis'}`, estimated(gain.coaxiality_after, k)],
  ]);
}

const axisNames = {stated: ['final axis', 'the average over the possible causes'], named: ['named causes', 'if every named cause is the right one'], ideal: ['ideal fit', 'without any cause']};

function shareWords({effect, instead_of: instead, probability, axis_shift: shift}, k) {
  const [name, other] = [effect, instead].map((id) => id ? worded(id) : '');
  const what = !effect ? `no ${other} at all` : instead ? `${name} instead of ${other}` : `${name}, too small to be found,`;
  return `${what} (probability ${significant(probability, 2)}) would move the axis by ${estimated(shift, k)}`;
}

/** For a face the named model stays; what the others would make of its tilt is in its U. */
function faceAxisBlock({shares, options: {coverage_factor: k}}) {
  const telling = shares.filter((s) => isNumber(s.axis_shift.value) && s.axis_shift.value > 0 && s.probability >= 0.01).slice(0, 5);
  if (!telling.length) return null;
  return block('The axis', paragraph('This is the axis of the named causes, at the outer end of the probed length. Its U includes other possible causes:', 'quiet'),
    element('ul', {}, telling.map((s) => element('li', {}, shareWords(s, k)))));
}

/** The final axis, with those of the named model and of the ideal fit, and what moved it. */
function axesBlock({verdict, axes, shares, axis_of_cut: cut, options: {coverage_factor: k}}, face) {
  if (face) return faceAxisBlock({shares, options: {coverage_factor: k}});
  if (!axes.stated.length) return null;
  const ideal = verdict === 'ideal';
  const noted = (text, note) => element('span', {}, text, element('small', {}, note));
  const place = ({x, y, u}) => noted(`(${micrometres(x, u).replace(`${nbsp}µm`, '')}, ${micrometres(y, u).replace(`${nbsp}µm`, '')})${nbsp}µm`, `± ${uncertainty(k * u, 'mm')}`);
  const rows = Object.entries(axisNames).filter(([key]) => axes[key].length && !(ideal && key === 'named'))
    .map(([key, [name, meaning]]) => [noted(name, ideal && key === 'stated' ? 'that of the ideal fit; its U includes causes that may hide in the readings' : meaning), ...axes[key].map(place)]);
  const words = ideal ? 'No cause was found, so the final axis is that of the ideal fit. Its U includes causes that are too small to be found.'
    : 'The final axis is an average over the possible causes, each weighted by its probability. Its U contains what the data cannot decide.';
  return block('The axis', paragraph(`${words}${!cut ? '' : cut === 'stated' ? ' The correction uses the final axis.' : ` The correction uses the ${cut} axis, as the job asks.`}`),
    table(`x and y of the axis; ± is U = k u, k = ${tick(k)}`, ['Axis', ...axes.stated.map(({z}) => `at Z = ${millimetres(z, 2)}`)], rows),
    shares.length ? paragraph(ideal ? 'What widens its U:' : 'What moves it from the axis of the named causes, or widens its U:') : null,
    shares.length ? element('ul', {}, shares.map((s) => element('li', {}, shareWords(s, k)))) : null);
}

/** How far the simulation is from the measurement, before and after, in words. */
function discrepancyWords({simulation}, extended) {
  const {rms_before_mm: before, rms_after_mm: after, noise_mm: noise, left_share: left, noise_share: noiseShare} = simulation;
  const missed = `The simulation of the ideal fit misses the measured readings by ${micrometres(before)} (RMS)`;
  if (!extended) return `${missed}; noise alone would by ${micrometres(noise)}. Nothing was found that a better simulation would need.`;
  if (!isNumber(left)) return `${missed}, that with the causes by ${micrometres(after)}.`;
  const explained = left <= 1
    ? `The causes explain ${percent(1 - left)} of the variance of this discrepancy and leave ${percent(left)}`
    : `The causes explain nothing of this discrepancy: its variance grows to ${percent(left)}`;
  const alone = noiseShare >= 1 ? '; noise alone could make a discrepancy as large as the first' : left <= 1.1 * noiseShare ? `, about what noise alone would leave (${percent(noiseShare)})` : `; noise alone would leave ${percent(noiseShare)}`;
  return `${missed}, that with the causes by ${micrometres(after)}. ${explained}${alone}.`;
}

function simulatedBy({by_lathe: lathe, why_not: why}) {
  if (lathe) return 'Simulated by the virtual lathe without noise, at the angle, place and time of every reading; it shares no formula with the model that was fitted.';
  return `Simulated by the fitted model itself${why ? `, for the virtual lathe could not: ${why}` : ''}.`;
}

function simulationBlock(reference) {
  const {diagnosis} = reference;
  const {simulation} = diagnosis;
  if (!simulation) return paragraph('There are no differences to draw: the model was not evaluated at every reading.', 'quiet');
  const extended = diagnosis.findings.length > 0 || diagnosis.unexplained.length > 0;
  const [first, second] = simulationMaps(reference, extended);
  const parts = [paragraph(discrepancyWords(diagnosis, extended)),
    paragraph(`${simulatedBy(simulation)} ${mapNote(diagnosisReadings(reference))}`, 'quiet'), first, second,
    simulation.spectrum.order.length ? spectrumChart(diagnosis, extended) : null];
  return block('Measured against simulated, before and after', ...parts);
}

const axisBiasUnit = ({value, unit, why}) => {
  if (!isNumber(value)) return why || 'not known';
  const per = unit.startsWith('mm/') ? unit.slice(3).replace(/[()]/g, '') : null;
  if (per === null) return `${significant(value, 3)} ${unit}`;
  return per === 'mm' ? `${significant(value, 2)} µm per µm` : `${significant(value * 1000, 3)} µm per ${per === '1' ? 'unit' : per}`;
};

/** The size that would be found, two digits. */
function seenFrom({detectable: {value: size, unit}}) {
  if (!isNumber(size)) return 'no size';
  if (unit === 'mm' && size < 1) return `${significant(size * 1000, 2)} µm`;
  return `${significant(size, 2)}${unit === '1' || unit === '' ? '' : ` ${unit}`}`;
}

const harmlessMm = 1e-5;

function notObservableTable({not_observable: all, titles}) {
  if (!all.length) return null;
  const isHarmless = (n) => isNumber(n.axis_bias_typical?.value) && n.axis_bias_typical.value < harmlessMm;
  const list = all.filter((n) => !isHarmless(n)), harmless = all.filter(isHarmless);
  const rest = harmless.length
    ? paragraph(`Also hidden, but without effect on the axis (below 0.01 µm): ${harmless.map((n) => worded(n.effect)).join('; ')}.`, 'quiet') : null;
  if (!list.length) return block('What these readings cannot show', rest);
  return block('What these readings cannot show', table('Causes that would stay hidden at their typical size, and what they would do to the axis',
    ['Cause', 'Why', 'Shown by', 'Axis shift', 'Smallest size found'], list.map((n) => [
      titled(titles, n.effect), worded(n.why),
      n.separate_with?.plan ? n.separate_with.what || data.words.measurements[n.separate_with.plan] : '–',
      axisBiasUnit(n.axis_bias_per_unit), seenFrom(n)]), 3), rest);
}

function noiseBlock({noise, checks, remarks, titles, options: {coverage_factor: k}}) {
  const list = [['σ of one reading', estimated(noise.sigma, k)], ['Source', noise.source || 'none']];
  for (const [name, key] of [['stationary capture', 'stationary'], ['repeated passes', 'repeated'], ['revolution differences', 'revolutions'], ['stated', 'stated']]) {
    if (isNumber(noise[key].value)) list.push([`σ, ${name}`, micrometres(noise[key].value)]);
  }
  list.push(['Autoregression', noise.autoregression.length ? noise.autoregression.map((phi) => fixed(phi, 2)).join(', ') : 'none: white'],
    ['Excluded readings', String(noise.masked)]);
  if (noise.interruptions > 0) list.push(['Interruptions', String(noise.interruptions)]);
  if (noise.gaps.length) list.push(['Gaps', noise.gaps.join('; ')]);
  const found = checks.filter((check) => check.found);
  return block('Noise and quality of the data', facts(list), noise.note ? paragraph(noise.note, 'quiet') : null,
    found.length ? table('Checks that found something', ['Check', 'Result'],
      found.map((check) => [titled(titles, check.effect), check.text]), 2)
      : paragraph('No check of the data found anything.', 'quiet'),
    ...remarks.map((remark) => paragraph(`Not a cause: ${remark}.`)));
}

function plansTable(plans) {
  const rows = feasible(plans).map((plan) => [plan.what || data.words.measurements[plan.plan],
    `${probabilityOf(plan.power_before)} → ${probabilityOf(plan.power)}`, minutes(plan)]);
  return rows.length ? table('The measurements, the best first', ['Measurement', 'Right name', 'Time'], rows) : null;
}

function nextBlock({next_measurement: next, plans}) {
  if (!next.plan && !next.why_not && !plans.length) return null;
  const what = next.plan ? measurementWords(next) + (next.separates.length ? ` It separates ${next.separates.map(worded).join(', ')}.` : '')
    : next.why_not ? `None: ${next.why_not}.` : 'None: there is nothing to tell apart.';
  const impossible = plans.filter((plan) => plan.why_not);
  return block('Next measurement', paragraph(what), plansChart(plans), plansTable(plans),
    impossible.length ? paragraph(`Not possible here: ${impossible.map((plan) => `${plan.what || data.words.measurements[plan.plan]} (${plan.why_not})`).join('; ')}.`, 'quiet') : null);
}

/** What was seen, each with its causes, their probabilities and what follows: the page's short form of the diagnosis. */
function seenList({findings, unexplained, consequences = {}, options: {coverage_factor: k}}, face) {
  const most = 3;
  const cause = ({effect, probability}, alone) => element('li', {}, joined(`${worded(effect)}${alone ? '' : ` (probability ${probabilityOf(probability)})`}`), consequences[effect] ? `: ${consequences[effect]}` : '');
  const items = findings.map((f) => {
    const all = membersOf(f), {axis_shift: shift, cosmetic} = f.axis_bias;
    return element('li', {}, element('strong', {}, sentence(f.seen)), cosmetic ? ` Without effect on the ${face ? 'run-out' : 'coaxiality'}.` : isNumber(shift?.value) ? joined(` If ignored, it moves the ${face ? 'tilt' : 'axis'} by ${estimated(shift, k)}.`) : '',
      element('ul', {}, all.slice(0, most).map((one) => cause(one, all.length === 1)), all.length > most ? element('li', {}, `or ${all.length - most} more, less likely`) : null));
  });
  unexplained.forEach((u) => items.push(element('li', {}, element('strong', {}, sentence(u.seen)))));
  return items.length ? element('ul', {class: 'seen'}, items) : null;
}

function diagnosisFold(reference, index) {
  const {diagnosis, readings} = reference;
  const title = `Full diagnosis: ${reference.name}`;
  if (!diagnosis) return null;
  const {verdict, findings, hypotheses, false_alarm: alarm} = diagnosis;
  const parts = [paragraph(diagnosisWords[verdict] ?? verdict, 'lead')];
  if (hypotheses) {
    parts.push(paragraph(`${hypotheses} hypotheses were tried; the probability of a false alarm is ${percent(alarm)}.` +
      (reference.extended && readings?.face ? ' The correction uses the final axis.' : ''), 'quiet'));
  }
  const {status, message} = diagnosis.extended;
  if (status !== 'converged') parts.push(paragraph(`The final model: ${statusWords[status] ?? status}. ${message}`, 'alert'));
  if (findings.length || diagnosis.unexplained.length) parts.push(gainFacts(diagnosis, readings?.face));
  parts.push(findingsBlock(diagnosis, readings?.face), simulationBlock(reference), notObservableTable(diagnosis), noiseBlock(diagnosis), nextBlock(diagnosis));
  return fold(`diagnosis-${index + 1}`, title, ...parts);
}
