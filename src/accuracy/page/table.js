'use strict';
// A table whose headings sort its rows.

function compareKeys(a, b) {
  return typeof a === 'string' ? a.localeCompare(b, 'en', { numeric: true }) : Math.sign(a - b) || 0;
}

// Rows by the keys of one column; missing keys (null) come last in either direction, equal ones keep their order.
function sortRows(body, column, descending) {
  const rows = [...body.rows].map(row => [row.cells[column].sortKey, row]);
  rows.sort(([a], [b]) => a === null || b === null ? (a === null) - (b === null)
                                                   : descending ? compareKeys(b, a) : compareKeys(a, b));
  body.append(...rows.map(([, row]) => row));
}

function makeHeading(column, index, table) {
  const button = make('button', { type: 'button' }, column.heading);
  const heading = make('th', { scope: 'col', title: column.title, class: column.number ? 'number' : null }, button);
  button.addEventListener('click', () => {
    const before = heading.getAttribute('aria-sort');
    const descending = before ? before === 'ascending' : Boolean(column.descendingFirst);
    table.querySelectorAll('thead th').forEach(th => th.removeAttribute('aria-sort'));
    heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
    sortRows(table.tBodies[0], index, descending);
  });
  return heading;
}

function makeCell(column, row) {
  const { content, key } = column.cell(row);
  const cell = make(column.rowHeading ? 'th' : 'td',
    { class: column.number ? 'number' : column.style, scope: column.rowHeading ? 'row' : null }, content);
  cell.sortKey = key;
  return cell;
}

// columns: [{ heading, title, number, rowHeading, style, descendingFirst, cell(row) -> { content, key } }];
// groups: [[heading, columns it spans]]; rows: [{ key, style, ... }]; footer: cells of the last row; `sorted` is the
// index of the column that the rows are already sorted by. A click selects a row, unless it is on code or a button
// of its own.
function makeTable({ caption, label, groups, columns, rows, footer, sorted }, selection) {
  const table = make('table', {}, make('caption', {}, caption));
  const headings = columns.map((column, i) => makeHeading(column, i, table));
  headings[sorted].setAttribute('aria-sort', 'ascending');
  table.append(
    make('thead', {},
      make('tr', { class: 'groups' }, groups.map(([heading, span]) =>
        heading ? make('th', { scope: 'colgroup', colspan: span }, heading) : make('td', { colspan: span }))),
      make('tr', {}, headings)),
    make('tbody', {}, rows.map(row => {
      const line = make('tr', { class: row.style, 'data-key': row.key }, columns.map(column => makeCell(column, row)));
      line.addEventListener('click', event => event.target.closest('.copy, code') || selection.set(row.key));
      return line;
    })),
    make('tfoot', {}, make('tr', {}, footer)));
  selection.listen(key => [...table.tBodies[0].rows].forEach(row => {
    row.classList.toggle('selected', row.dataset.key === key);
    row.querySelector('.name')?.setAttribute('aria-pressed', row.dataset.key === key);
  }));
  return make('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': label }, table);
}

// A page opened from a folder may have no clipboard; then the text is selected and copied the old way.
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = document.body.appendChild(make('textarea'));
    area.value = text;
    area.select();
    const done = document.execCommand('copy');
    area.remove();
    return done;
  }
}

function makeCopyButton(text, label) {
  const button = make('button', { type: 'button', class: 'copy', 'aria-label': label }, 'copy');
  button.addEventListener('click', async () => {
    button.textContent = await copyText(text) ? 'copied' : 'failed';
    setTimeout(() => { button.textContent = 'copy'; }, 1200);
  });
  return button;
}
