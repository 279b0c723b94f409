// SPDX-License-Identifier: Apache-2.0
// The page is built from elements whose text is set as text: nothing of the data is read as HTML.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value);
  }
  for (const child of children.flat()) {
    if (child !== null && child !== undefined && child !== '') made.append(child);
  }
  return made;
}

const paragraph = (text, kind) => element('p', {class: kind}, joined(text));

function section(id, title, ...children) {
  return element('section', {id}, element('h2', {}, title), ...children);
}

/** A section that shows its title alone until it is opened. */
function fold(id, title, ...children) {
  return element('details', {id, class: 'fold'}, element('summary', {}, element('h2', {}, title)), ...children);
}

const list = (items, tag = 'ul') => element(tag, {}, items.map((item) => element('li', {}, typeof item === 'string' ? joined(item) : item)));

const block = (title, ...children) =>
    element('div', {class: 'block'}, element('h3', {}, title), ...children);

/** Maker, title, and what the job says of part, machine and people. */
function pageHeader(what, title, header = []) {
  return element('header', {}, element('p', {class: 'maker'}, `TrueAxis ${data.version} ${what}`), element('h1', {}, title), header.length ? facts(header, 'facts head') : null);
}

function contents(sections) {
  return element('nav', {'aria-label': 'Contents'}, sections.map((s) => element('a', {href: `#${s.id}`}, s.querySelector('h2').textContent)));
}

const pageFooter = (origin = []) => element('footer', {}, origin.length ? facts(origin, 'facts origin') : null, element('p', {}, `TrueAxis ${data.version} · ${data.schema} · charts by Apache ECharts`));

let tables = 0;

/**
 * A table that scrolls inside its own box, its title above; of more than four columns each row is a card on a phone. `head` and `rows` hold texts or
 * elements; numeric columns are aligned right. A row that is {cells, note, lost} has a remark over
 * its whole width below.
 */
function table(caption, head, rows, textColumns = 1, cards = head.length > 4) {
  const kind = (i) => i < textColumns ? 'text' : 'number';
  const cell = (text, i) =>
      element(i === 0 ? 'th' : 'td', {class: kind(i), scope: i === 0 ? 'row' : null, 'data-label': i === 0 ? null : head[i]}, text);
  const body = [];
  for (const row of rows) {
    body.push(element('tr', {class: row.note ? 'noted' : null}, (row.cells ?? row).map(cell)));
    if (row.note)
      body.push(element(
          'tr', {class: row.lost ? 'note lost' : 'note'},
          element('td', {colspan: head.length}, row.note)));
  }
  tables += 1;
  const id = `table-${tables}`;
  return element(
      'div', {class: cards ? 'table many' : 'table'}, element('p', {class: 'title', id}, caption),
      element(
          'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-labelledby': id},
          element(
              'table', {'aria-labelledby': id},
              element(
                  'thead', {},
                  element(
                      'tr', {},
                      head.map((text, i) => element('th', {class: kind(i), scope: 'col'}, text)))),
              element('tbody', {}, body))));
}

/** Label and value pairs. */
function facts(pairs, kind = 'facts') {
  return element(
      'dl', {class: kind},
      pairs.map(
          ([label, value]) =>
              element('div', {}, element('dt', {}, label), element('dd', {}, value))));
}

const pill = (text, good) => element('span', {class: `pill ${good ? 'good' : 'bad'}`}, text);
