// SPDX-License-Identifier: Apache-2.0
// Reads the data in the page, builds it top to bottom, then draws the charts.

const data = JSON.parse(document.getElementById('data').textContent);
const outcomes = {go: ['GO', 'good', '✓'], reserved: ['GO with reservations', 'warning', '!'],
  'not-proven': ['NOT PROVEN', 'warning', '?'], 'no-go': ['NO-GO', 'bad', '✗'], done: ['DONE', 'neutral', '–']};

function keyNumbers(verdict) {
  const k = verdict.k;
  const tolerance = isNumber(verdict.tolerance_mm) ? `${tick(verdict.tolerance_mm * 1000)}${nbsp}µm` : 'none given';
  if (!isNumber(verdict.coaxiality_after_mm)) {
    return facts([['Coaxiality', 'not determined: there is no target axis'], ['Tolerance (coaxiality, a diameter)', tolerance]], 'numbers');
  }
  const worst = data.target.references.map((r) => r.before).filter(Boolean)
    .reduce((most, b) => !most || b.coaxiality_mm > most.coaxiality_mm ? b : most, null);
  const sameAsWorst = worst && Math.abs(worst.coaxiality_mm - verdict.coaxiality_before_mm) <= 1e-6 + 1e-3 * worst.coaxiality_mm;
  return facts([
    ['Coaxiality before: cut about the spindle axis', plusMinus(verdict.coaxiality_before_mm, sameAsWorst ? worst.u_mm : null, k, 'U as after')],
    ['Coaxiality after: cut with the correction', `${micrometres(verdict.coaxiality_after_mm)} expected, at most ${micrometres(verdict.coaxiality_at_most_mm)} in 95 of 100`],
    ['Tolerance (coaxiality, a diameter)', tolerance],
  ], 'numbers');
}

function banner() {
  const [word, kind, sign] = outcomes[data.verdict.outcome];
  return element('div', {class: `banner ${kind}`, role: 'status'},
    element('div', {class: 'word'}, element('span', {'aria-hidden': 'true'}, sign), ` ${word}`),
    paragraph(data.verdict.line.replace(/^(NO-GO|NOT PROVEN|GO with reservations|GO|DONE)[:,.]?\s+/, ''), 'line'), keyNumbers(data.verdict),
    paragraph(`± is the expanded uncertainty U = k u with k = ${tick(data.verdict.k)}.`, 'quiet'));
}

function contents(sections) {
  return element('nav', {'aria-label': 'Contents'}, sections.map((s) =>
    element('a', {href: `#${s.id}`}, s.querySelector('h2').textContent.replace('Reference surface: ', ''))));
}

function inputsSection() {
  return section('inputs', 'What went in', element('div', {class: 'columns'}, data.inputs.map((part) =>
    block(part.title, facts(part.lines)))));
}

function build() {
  const sections = [...data.references.flatMap((r, i) => [diagnosisSection(r, i), referenceSection(r, i)]), targetSection(data), correctionSection(data), marginSection(data),
    inputsSection(), glossarySection()].filter(Boolean);
  const hashes = data.references.map((r) => r.input.hash).filter(Boolean).join('\n');
  document.getElementById('page').replaceChildren(
    element('header', {}, element('p', {class: 'maker'}, `TrueAxis ${data.version} report`), element('h1', {}, data.title),
      facts([['Job', data.file], ['Input', hashes || 'no hash']], 'facts origin')),
    banner(), contents(sections), ...sections,
    element('footer', {}, `TrueAxis ${data.version} · ${data.schema} · charts by Apache ECharts`));
}

build();
startPage();
