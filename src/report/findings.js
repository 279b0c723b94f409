// SPDX-License-Identifier: Apache-2.0
// What the pages of a part and of a machine say alike of findings: their causes, how probable each is, how sure they are.

const probabilityOf = (p) => !isNumber(p) ? '–' : p < 0.001 ? '< 0.1 %' : `${significant(100 * p, 2)}${nbsp}%`;
const falseAlarm = ({p_value: p}) => ['False-alarm probability (all hypotheses counted)', !isNumber(p) ? '–' : p < 0.001 ? '< 0.001' : significant(p, 2)];

/** A cause by its title, its id next to it. */
const titled = (titles, id, ...notes) => element('span', {}, titles[id] ?? id, ...notes, element('small', {}, id));

/** The named cause, and all that fit the readings equally well. */
const membersOf = ({effect, probability, rivals}) => [{effect, probability}, ...rivals];

function classTable(finding, titles) {
  const members = membersOf(finding);
  return table(members.length > 1 ? 'The data cannot tell these causes apart' : 'The one cause that explains it',
    ['Cause', 'Probability'], members.map(({effect, probability, structural}) => [
      titled(titles, effect, structural ? '; the same readings, no amount of such data helps' : ''), probabilityOf(probability)]));
}
