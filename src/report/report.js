// SPDX-License-Identifier: Apache-2.0
// Reads the data in the page, builds it top to bottom, then draws the charts.

const data = JSON.parse(document.getElementById('data').textContent);
worded = (text) => text.replace(/\b[a-z]+\.[a-z_]+/g, (id) => data.words.effects[id] ?? id);
// What was seen is next to the diagnosis, which is as in its file.
for (const {diagnosis} of data.references) {
  diagnosis?.findings.forEach((f, i) => { f.seen = diagnosis.seen.findings[i]; });
  diagnosis?.unexplained.forEach((u, i) => { u.seen = diagnosis.seen.unexplained[i]; });
}
const outcomes = {go: ['GO', 'good', '✓'], reserved: ['GO with reservations', 'warning', '!'],
  'not-proven': ['NOT PROVEN', 'warning', '?'], 'no-go': ['NO-GO', 'bad', '✗'], done: ['DONE', 'neutral', '–'],
  fitted: ['FITTED', 'neutral', '–'], ideal: ['IDEAL', 'good', '✓'], effects: ['CAUSES FOUND', 'warning', '!'], unexplained: ['UNEXPLAINED', 'warning', '?'],
  'not-determined': ['NOT DETERMINED', 'bad', '✗']};
const outcomeWords = /^(NO-GO|NOT PROVEN|NOT DIAGNOSED|GO with reservations|GO|DONE|IDEAL|EFFECTS|UNEXPLAINED)[:,.]?\s+/;

/** Of a part that is only measured: where its axis is, and what the surface leaves. */
function measuredNumbers({k}) {
  const [reference] = data.references, axis = data.target.references[0]?.axis;
  if (data.references.length !== 1 || !axis) return null;
  const {face} = data.target.references[0], at = (end) => `${plusMinus(offsetOf(end), end.u_mm, k, 'u unknown')}`;
  const place = (end) => reference.roundness ? 'Eccentricity' : `Axis offset at Z = ${millimetres(end.z_mm, 2)}`;
  const numbers = face ? [['Tilt', slopeWords(axis, k)]] : [[place(axis.start), at(axis.start)]];
  if (!face && !reference.roundness) numbers.push([place(axis.end), at(axis.end)]);
  if (reference.roundness) numbers.push(['Direction', direction(axis.start, k)], ['Roundness, peak to valley', micrometres((reference.roundness.peak_um + reference.roundness.valley_um) / 1000)]);
  else numbers.push(['Residuals, RMS', micrometres(reference.diagnosis?.rms_shown_mm ?? reference.rms.value)]);
  return facts(numbers, 'numbers');
}

function keyNumbers(verdict) {
  const k = verdict.k;
  if (!data.target.of_cut) return measuredNumbers(verdict);
  const tolerance = isNumber(verdict.tolerance_mm) ? `${tick(verdict.tolerance_mm * 1000)}${nbsp}µm` : 'none given';
  const of = data.target.references, face = of.length && of.every((r) => r.face), what = face ? 'Axial run-out' : 'Coaxiality';
  const wanted = [face ? 'Tolerance (axial run-out)' : 'Tolerance (coaxiality, a diameter)', tolerance];
  if (!isNumber(verdict.coaxiality_after_mm)) {
    return facts([[what, 'not determined: there is no target axis'], wanted], 'numbers');
  }
  const worst = (data.target.datum ? [data.target.datum] : data.target.references).map((r) => r.before).filter(Boolean)
    .reduce((most, b) => !most || b.coaxiality_mm > most.coaxiality_mm ? b : most, null);
  const sameAsWorst = worst && Math.abs(worst.coaxiality_mm - verdict.coaxiality_before_mm) <= 1e-6 + 1e-3 * worst.coaxiality_mm;
  return facts([
    [`${what} before: cut about the spindle axis`, plusMinus(verdict.coaxiality_before_mm, sameAsWorst ? worst.u_mm : null, k, 'U as after')],
    [`${what} after: cut with the correction`, `${atMost(verdict.coaxiality_at_most_mm)} (95 % confidence)`],
    wanted,
  ], 'numbers');
}

function banner() {
  const [word, kind, sign] = outcomes[data.verdict.outcome];
  const numbers = keyNumbers(data.verdict);
  return element('div', {class: `banner ${kind}`, role: 'status'},
    element('div', {class: 'word'}, element('span', {'aria-hidden': 'true'}, sign), ` ${word}`),
    paragraph(capital(data.verdict.line.replace(outcomeWords, '')), 'line'), ...data.verdict.tap.map((tap) => paragraph(sentence(capital(tap)))), numbers,
    numbers ? paragraph(`± is the expanded uncertainty U = k u with k = ${tick(data.verdict.k)}.`, 'quiet') : null);
}

function warningsSection() {
  if (!data.warnings.length) return null;
  return section('warnings', 'Warnings', list(data.warnings.map(({text, of}) => sentence(`${text}${of.length ? ` (${of.join(', ')})` : ''}`))));
}

const nextSection = () => data.next.length ? section('next', 'Next step', list(data.next.map(sentence), data.next.length > 1 ? 'ol' : 'ul')) : null;

const inputsFold = () => data.inputs.length ? fold('inputs', 'Inputs', element('div', {class: 'columns'}, data.inputs.map((part) =>
  block(part.title, facts(part.lines))))) : null;

function build() {
  const each = (make) => data.references.map(make);
  // Of one section its roundness is what is looked for.
  const forms = each(formSection), axes = axesSection(data);
  const open = [warningsSection(), nextSection(), ...(data.references.some((r) => r.roundness) ? [...forms, axes] : [axes, ...forms]), correctionSection(data)].filter(Boolean);
  const folded = [axesFold(data), ...each((r, i) => [diagnosisFold(r, i), referenceFold(r, i)]).flat(), correctionFold(data), inputsFold(), glossaryFold()].filter(Boolean);
  const details = element('section', {id: 'details'}, element('h2', {}, 'Details'), ...folded);
  document.getElementById('page').replaceChildren(pageHeader('report', data.title, data.header), banner(), contents([...open, details]), ...open, details, pageFooter([[data.of_stream ? 'Stream' : 'Job', data.file], ...data.references.map((r) => ['Input', r.input.hash || 'no hash'])]));
}

startPage(build);
