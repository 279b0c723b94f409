// SPDX-License-Identifier: Apache-2.0
// What the measurement shows of the machine, and what it does not.

const machineVerdicts = {
  ideal: 'No errors were found in addition to the errors of location.',
  effects: 'In addition to the errors of location the machine has the errors listed below.',
  unexplained: 'In addition to the errors of location the machine has a deviation that no catalogued cause explains fully.',
};

/** k of U = k u. */
const coverageFactor = () => data.diagnosis.options.coverage_factor;

/** mm as µm, degrees as µrad: the sizes that errors of machines have. */
function errorSize({value, u, unit}) {
  if (!isNumber(value)) return 'not determined';
  const [factor, shown] = unit === 'deg' ? [1e6 * Math.PI / 180, 'µrad'] : unit === 'mm' ? [1000, 'µm'] : [1, unit];
  const decimals = isNumber(u) && u > 0 ? decimalsFor(coverageFactor() * u * factor) : null;
  const text = decimals === null ? significant(value * factor, 3) : fixed(value * factor, decimals);
  return isNumber(u) && u > 0 ? `${text} ± ${significant(coverageFactor() * u * factor, 2)}${nbsp}${shown}` : `${text}${nbsp}${shown}`;
}

const titleOf = (id) => data.titles[id] ?? id;
const withTitle = (id) => titled(data.titles, id);
worded = (text) => text.replace(/(?<![\w.(])[\w*]+(?:\.\w+)*(?![\w.]\w|\))/g, (id) => id in data.titles ? `${data.titles[id]} (${id})` : id);

const planWords = (code) => data.words.measurements[code] ?? code;

function machineFindingCard(finding, number) {
  const list = [['Size', errorSize(finding.size)], ...Object.entries(finding.parameters).map(([name, p]) => [name, errorSize(p)]),
    ['Part of the readings (RMS)', micrometres(finding.rms.value)], falseAlarm(finding)];
  return element('div', {class: 'card'}, element('h4', {}, `${number}. ${sentence(titleOf(finding.effect))}`, element('small', {}, finding.effect)), facts(list),
    classTable(finding, data.titles),
    finding.alias ? paragraph(`These positions read ${worded(finding.alias)} alike.`) : null,
    finding.pairs?.length ? paragraph(`Two together would also look like them: ${finding.pairs.map((pair) => pair.join(' with ')).join('; ')}.`, 'quiet') : null,
    finding.rivals.length ? paragraph(finding.separate_with ? `To tell these causes apart: ${planWords(finding.separate_with)}.` : 'None of the plans tells them apart.') : null);
}

function gainBlock({gain, noise, hypotheses, false_alarm: alarm}) {
  const held = ({value, low, high}) => `${micrometres(value)} (${significant(low * 1000, 2)} … ${significant(high * 1000, 2)})`;
  return block('Gain', facts([['RMS of the readings, before → after', `${micrometres(gain.rms_before.value)} → ${micrometres(gain.rms_after.value)}`],
    ['Cross-validated, before', held(gain.held_out_rms_before)], ['Cross-validated, after', held(gain.held_out_rms_after)], ['Excluded in turn', gain.blocks],
    ['σ of one number', micrometres(noise.sigma.value)], ['Tested', `${hypotheses} hypotheses, false alarm ${percent(alarm)}`]]));
}

function locationTable({extended, baseline}) {
  const rows = Object.entries(extended.parameters).map(([name, p]) => [withTitle(name), errorSize(p)]);
  if (!rows.length) return null;
  return block('Errors of location', paragraph(`Fitted together with what was found, ± U with k = ${coverageFactor()}. ${sentence(baseline.gauge)}`, 'quiet'),
    table('Positions and directions of the axes, compared with the machine file', ['Error', 'Size ± U'], rows));
}

/** What might be taken for certain and is not, and checks of the data that found something. */
const mindedOf = ({remarks = [], checks = []}) => [...remarks, ...checks.filter((check) => check.found).map((check) => check.text)];

/** What was found, in a line each, with what fits the readings equally well. */
function findingsSection({diagnosis}) {
  const {verdict, findings, unexplained, consequences} = diagnosis;
  const items = findings.map((f) => {
    const rivals = f.rivals.slice(0, 3).map((r) => `${titleOf(r.effect)} (probability ${probabilityOf(r.probability)})`);
    return element('li', {}, element('strong', {}, sentence(titleOf(f.effect))), ` ${errorSize(f.size)}${f.rivals.length ? `, probability ${probabilityOf(f.probability)}` : ''}.`,
      rivals.length ? ` Or: ${rivals.join('; ')}${f.rivals.length > 3 ? `; or ${f.rivals.length - 3} more` : ''}.` : '',
      consequences[f.effect] ? ` ${sentence(consequences[f.effect])}` : '');
  });
  unexplained.forEach((u) => items.push(element('li', {}, element('strong', {}, `Unexplained: ${u.pattern}`), ` ${errorSize(u.amplitude)}.`)));
  return section('diagnosis', 'What the measurement shows', paragraph(machineVerdicts[verdict] ?? verdict), items.length ? element('ul', {class: 'seen'}, items) : null);
}

function findingsFold({diagnosis}) {
  const {findings, unexplained} = diagnosis;
  const cards = findings.map((f, i) => machineFindingCard(f, i + 1));
  unexplained.forEach((u) => cards.push(element('div', {class: 'card'}, element('h4', {}, `Unexplained: ${u.pattern}`), facts([['Amplitude', errorSize(u.amplitude)]]),
    paragraph('No known cause explains it, so the program does not correct it. Its amplitude is part of the uncertainty.', 'quiet'))));
  return fold('findings', 'Full diagnosis', cards.length ? element('div', {class: 'cards'}, cards) : null, gainBlock(diagnosis), locationTable(diagnosis));
}

/** Effects that share their reason and the plans that show them. */
function notObservableRows({not_observable: all}) {
  const alike = new Map();
  all.forEach((one) => { const key = JSON.stringify([one.why, one.separate_with]); alike.set(key, [...(alike.get(key) ?? []), one]); });
  return [...alike.values()].map((group) => [group.map((one) => `${titleOf(one.effect)} (${one.effect})`).join(', '), sentence(worded(group[0].why)), group[0].separate_with.length ? group[0].separate_with.map(planWords).join('; ') : 'none of the plans']);
}

function rangesTable(ranges) {
  const rows = Object.entries(ranges).map(([name, {measured, program, unit}]) => {
    const text = (pair) => pair ? `${pair.map((v) => tick(Number(v.toPrecision(4)))).join(' … ')}${unit === 'deg' ? '' : nbsp}${unit === 'deg' ? '°' : unit}` : '–';
    return [name, text(measured), text(program)];
  });
  return block('Where it was measured', table('Positions of the axes', ['Axis', 'Measured', 'Program'], rows));
}

function unknownFold({diagnosis, ranges}) {
  const held = diagnosis.baseline.not_determined, unseen = notObservableRows(diagnosis), next = diagnosis.next_measurement;
  return fold('unknown', 'What is not known',
    block('Hidden at these positions', unseen.length
      ? table('Causes that would stay hidden at 10 µm or 50 µrad, and the measurement that shows them', ['Cause', 'Why', 'Shown by'], unseen, 3)
      : paragraph('Every effect that is looked for would have been found at 10 µm or 50 µrad.'),
    paragraph(next.plan ? `Next measurement: ${next.what} (${tick(Math.round(next.minutes))}${nbsp}min).` : 'No plan shows or separates anything more.')),
    held.length ? block('Held, because the measurement does not determine it', table('Errors of location that stay as they were given', ['Error', 'Why'], held.map((one) => [withTitle(one.class[0]), sentence(worded(one.why))]), 2)) : null,
    rangesTable(ranges));
}
