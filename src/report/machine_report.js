// SPDX-License-Identifier: Apache-2.0
// Reads the data of a machine's job in the page, builds it top to bottom, then draws the charts.

const data = JSON.parse(document.getElementById('data').textContent);
const outcomes = {
  go: ['GO', 'good', '✓'],
  reserved: ['GO with reservations', 'warning', '!'],
  'not-proven': ['NOT PROVEN', 'warning', '?'],
  'no-go': ['NO-GO', 'bad', '✗'],
  done: ['DONE', 'neutral', '–'],
  ideal: ['IDEAL', 'good', '✓'],
  effects: ['CAUSES FOUND', 'warning', '!'],
  unexplained: ['UNEXPLAINED', 'bad', '?']
};

function keyNumbers(verdict) {
  if (!isNumber(verdict.before_um)) return null;
  return facts(
      [
        ['Tip off with the program as it is, on its path', micrometres(verdict.path_before_um / 1000, verdict.path_before_um / 1000)],
        ['Tip off with the new program', `${atMost(verdict.at_most_um / 1000)} (95 % confidence)`],
        [
          'Tolerance',
          isNumber(verdict.tolerance_um) ? `${tick(verdict.tolerance_um)}${nbsp}µm` : 'none given'
        ]
      ],
      'numbers');
}

function banner({verdict}) {
  const [word, kind, sign] = outcomes[verdict.outcome];
  const [line] = verdict.reservations.length && verdict.outcome === 'reserved' ?
      [verdict.line.split('; ')[0]] :
      [verdict.line];
  return element(
      'div', {class: `banner ${kind}`, role: 'status'},
      element('div', {class: 'word'}, element('span', {'aria-hidden': 'true'}, sign), ` ${word}`),
      paragraph(
          capital(line.replace(/^(NO-GO|NOT PROVEN|GO with reservations|GO|DONE|IDEAL|EFFECTS|UNEXPLAINED)[:,.]?\s+/, '')), 'line'),
      keyNumbers(verdict));
}

function warningsSection({verdict: {reservations, remarks}, diagnosis}) {
  const all = [...new Set([...reservations, ...remarks, ...mindedOf(diagnosis)])];
  return all.length ? section('warnings', 'Warnings', list(all.map(sentence))) : null;
}

const nextSection = ({verdict: {next}}) =>
    next ? section('next', 'Next step', list([sentence(next)])) : null;

function programFacts({compensation: c, part, verdict, program}) {
  const angle = ({value}) =>
      isNumber(value) ? `${significant(value * 1e6 * Math.PI / 180, 3)}${nbsp}µrad` : '–';
  const vector = (list, unit) => `${list.map((v) => fixed(v, 1)).join(', ')}${nbsp}${unit}`;
  const list = [
    ['Program', program],
    [
      'Blocks',
      `${c.blocks.read} read, ${c.blocks.rewritten} rewritten, ${c.blocks.inserted} inserted`
    ],
    ['Method', c.method === 'exact' ? 'exact (Newton)' : 'total differential']
  ];
  if (isNumber(verdict.before_um))
    list.push(
        [
          'Direction of the tool, before → after',
          `${angle(c.error_before.direction)} → ${angle(c.error_after.direction)}`
        ],
        [
          'Tip at the ends of blocks, before → after',
          `${um(verdict.before_um)} → ${um(verdict.after_um)}`
        ],
        [
          'Tip between the ends, before → after',
          `${um(verdict.between_before_um)} → ${um(verdict.between_um)}`
        ],
        ['U of the tip (k = 2), without the position of the part', um(verdict.U_um)]);
  if (verdict.not_corrected_um > 0)
    list.push(['Found, and not to be corrected', um(verdict.not_corrected_um)]);
  if (part)
    list.push(
        ['Part as a whole: shift x, y, z', vector(part.shift_um, 'µm')],
        ['Part as a whole: turn about x, y, z', vector(part.turn_urad, 'µrad')]);
  return facts(list);
}

function programSection(all) {
  const {compensation: c, tips, verdict} = all;
  if (!c) return null;
  const lost = c.unreachable.slice(0, 10).map(({line, why}) => [`line ${line}`, why]);
  return section(
      'program', 'The program before and after',
      lost.length ?
          table(
              `Blocks that cannot be reached: ${lost.length < c.unreachable.length ? `the first ${lost.length} of ` : ''}${c.unreachable.length}`,
              ['Block', 'Why'], lost, 2) :
          null,
      tips ? alongProgram(tips, verdict) : null);
}

/** What each effect alone does on a program, found or hidden; of a diagnosis that is given one. */
function harmSection({harm}) {
  if (!harm) return null;
  const rows = harm.by_effect.filter((one) => one.tip.value > 0).slice(0, 12).map((one) => [
    withTitle(one.effect), `${one.found ? 'found' : 'may hide'}: ${errorSize(one.size)}`,
    micrometres(one.tip.value), one.tip.line
  ]);
  const U = `U (k${nbsp}=${nbsp}${harm.coverage_factor}) of the tip`;
  const plans = harm.plans.map(
      ({plan, U_without_place_of_part: after}) => `${micrometres(after.value)} after measuring ${planWords(plan)}`);
  return section(
      'program', 'On the program',
      paragraph(`${harm.file}, ${harm.blocks} positions. ${U}: ${micrometres(harm.U_without_place_of_part.value)}, without the position of the part${plans.length ? `; ${plans.join('; ')}` : ''}.`),
      rows.length ? table('The tip off by each cause alone', ['Cause', 'Size', 'Tip off by', 'Block'], rows, 2) : null);
}

const programFold = (all) => all.compensation ?
    fold(
        'program-more', 'Full program data', programFacts(all),
        all.tips ? pathViews(all.tips) : null) :
    null;

function errorsSection({compensation: c}) {
  const bars = c ? errorBars(c.by_error) : null;
  return bars ? section('errors', 'The largest errors by name', bars) : null;
}

function mapFold({maps}) {
  if (!maps.length) return null;
  const drawn = (map, key, words) => volumeMap(
      map, key, `${words}, ${map.across.name}–${map.up.name}`, roundUpFinely(largest(map[key])));
  return fold(
      'map', 'The error over the volume',
      paragraph(
          'How far the tip is off in the part over what was measured and what the program uses. After: the remaining error, and U (k = 2) of the tip. Mind the scales: every map has its own.'),
      ...maps.map(
          (map) => element(
              'div', {class: 'pair maps'}, drawn(map, 'before_um', 'Before'),
              drawn(map, 'after_um', 'After, at most'))));
}

const inputsFold = ({inputs, file, machine, chain}) => fold(
    'inputs', 'Inputs',
    facts([[data.of ? 'Measured' : 'Job', file], ['Machine', `${machine || 'without a name'}: ${chain}`]], 'facts origin'),
    table(
        'Files', ['What', 'File', 'Hash'], inputs.map(({what, file, hash}) => [what, file, hash]),
        3));

const machineGlossary = [
  [
    'Tip off by',
    'The distance in the part of the tool\'s tip from where the program has it on a machine without errors, at the end of a block that cuts.'
  ],
  [
    'Part as a whole',
    'The one displacement that a rigid part would have had to make the tips\' errors least. It is subtracted: probing the part\'s zero point finds it, a measurement of balls does not.'
  ],
  [
    'At most (95 % confidence)',
    'The remaining error, what was found and cannot be corrected, and U = 2u of the tip, with u² the trace of its covariance (ISO 14253-1: a go has a risk of 5 % at most).'
  ],
  ['Component error', 'EXC: the error along X as axis C moves (ISO 230-1); EAC: about X.'],
  [
    'Error of location',
    'Y0A: the position of axis A along Y; C0A: its rotation about Z. X0S: the spindle, X0W: the workpiece.'
  ],
  [
    'Held',
    'An error that moves these readings as others do, or not at all. It stays as it was given, and what depends on it is not known.'
  ],
  [
    'Class',
    'If rival causes fit the readings equally well, all are listed with their probabilities.'
  ],
  ['Cross-validated RMS', 'The residuals in blocks of positions that it was not fitted to.']
];

function build() {
  const open = [
    warningsSection(data), nextSection(data), programSection(data), errorsSection(data),
    findingsSection(data), harmSection(data)
  ].filter(Boolean);
  const folded = [
    programFold(data), mapFold(data), findingsFold(data), unknownFold(data), inputsFold(data),
    fold('terms', 'Terms and conventions', facts(machineGlossary, 'terms'))
  ].filter(Boolean);
  const details = element('section', {id: 'details'}, element('h2', {}, 'Details'), ...folded);
  document.getElementById('page').replaceChildren(
      pageHeader(data.of ?? 'report', data.title, data.header), banner(data), contents([...open, details]),
      ...open, details,
      pageFooter());
}

startPage(build);
