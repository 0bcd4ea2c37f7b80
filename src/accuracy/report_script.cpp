#include "accuracy/report_assets.hpp"

namespace speculum {

std::string_view reportScript() {
  return R"js(
(() => {
  'use strict';
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const table = document.getElementById('points');
  const choice = document.getElementById('choice');
  document.documentElement.classList.add('js');

  // One point is selected everywhere: in the plots, the table and the viewer.
  const select = point => {
    all('.plot .mark[data-point]').forEach(m => m.classList.toggle('selected', m.dataset.point === point));
    all('tbody tr', table).forEach(row => {
      const on = row.dataset.point === point;
      row.classList.toggle('selected', on);
      row.querySelector('.name').setAttribute('aria-pressed', on);
    });
    all('[data-shown]').forEach(e => { e.hidden = e.dataset.shown !== point; });
    if (choice) {
      choice.value = point;
      if (choice.selectedIndex < 0) {
        choice.value = '';
      }
    }
  };
  if (choice) {
    choice.addEventListener('change', () => select(choice.value));
  }
  all('tbody tr', table).forEach(row => row.addEventListener('click', event => {
    if (!event.target.closest('.copy, code')) {
      select(row.dataset.point);
    }
  }));

  const tip = document.body.appendChild(document.createElement('div'));
  tip.className = 'tip';
  tip.hidden = true;
  const showTip = (mark, text) => {
    tip.textContent = text;
    tip.hidden = false;
    const box = mark.querySelector('.hit').getBoundingClientRect();
    const room = document.documentElement.clientWidth - tip.offsetWidth - 8;
    const above = box.top > tip.offsetHeight + 12;
    tip.style.left = scrollX + Math.max(8, Math.min(box.left + box.width / 2 - tip.offsetWidth / 2, room)) + 'px';
    tip.style.top = scrollY + (above ? box.top - tip.offsetHeight - 6 : box.bottom + 6) + 'px';
  };
  const hideTip = () => { tip.hidden = true; };

  // One tab stop a plot; arrow keys go from mark to mark along the horizontal axis.
  all('svg.plot').forEach(plot => {
    const x = mark => mark.querySelector('.hit').cx.baseVal.value;
    const marks = all('.mark', plot).filter(m => m.querySelector('.hit')).sort((a, b) => x(a) - x(b));
    plot.setAttribute('role', 'group');
    marks.forEach((mark, i) => {
      const title = mark.querySelector('title');
      const text = title.textContent;
      title.remove();
      mark.setAttribute('role', mark.dataset.point === undefined ? 'img' : 'button');
      mark.setAttribute('aria-label', text.replaceAll('\n', ', '));
      mark.setAttribute('tabindex', i === 0 ? '0' : '-1');
      mark.addEventListener('pointerenter', () => showTip(mark, text));
      mark.addEventListener('pointerleave', hideTip);
      mark.addEventListener('focus', () => showTip(mark, text));
      mark.addEventListener('blur', hideTip);
      mark.addEventListener('click', () => mark.dataset.point !== undefined && select(mark.dataset.point));
      mark.addEventListener('keydown', event => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        const next = step && marks[i + step];
        if (next) {
          mark.setAttribute('tabindex', '-1');
          next.setAttribute('tabindex', '0');
          next.focus();
        } else if ((event.key === 'Enter' || event.key === ' ') && mark.dataset.point !== undefined) {
          select(mark.dataset.point);
        } else {
          return;
        }
        event.preventDefault();
      });
    });
  });
  document.addEventListener('keydown', event => event.key === 'Escape' && hideTip());

  // What is missing comes last in either direction; equals keep their order.
  const sortBy = (column, descending) => {
    const key = row => {
      const text = row.cells[column].dataset.key;
      return text === '' && column > 2 ? null : column === 1 || column === 2 ? text : Number(text);
    };
    const compare = (a, b) => typeof a === 'string' ? a.localeCompare(b, 'en', { numeric: true }) : a < b ? -1 : a > b;
    const rows = all('tbody tr', table).map(row => [key(row), row]);
    rows.sort(([a], [b]) => a === null || b === null ? (a === null) - (b === null)
                                                     : descending ? compare(b, a) : compare(a, b));
    table.tBodies[0].append(...rows.map(([, row]) => row));
  };
  all('thead button', table).forEach(button => button.addEventListener('click', () => {
    const heading = button.closest('th');
    const before = heading.getAttribute('aria-sort');
    const descending = before ? before === 'ascending' : button.dataset.first === 'descending';
    all('thead th', table).forEach(th => th.removeAttribute('aria-sort'));
    heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
    sortBy(Number(button.dataset.column), descending);
  }));

  // Files opened from a folder may have no clipboard; then the text is selected and copied the old way.
  const copy = async text => {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch {
      const area = document.body.appendChild(document.createElement('textarea'));
      area.value = text;
      area.select();
      const done = document.execCommand('copy');
      area.remove();
      return done;
    }
  };
  all('.copy').forEach(button => button.addEventListener('click', async () => {
    button.textContent = await copy(button.dataset.copy) ? 'copied' : 'failed';
    setTimeout(() => { button.textContent = 'copy'; }, 1200);
  }));

  const divider = document.getElementById('divider');
  const panes = document.querySelector('.panes');
  const map = document.querySelector('.frame.map');
  if (divider) {
    const show = () => {
      const percent = divider.value / 10;
      divider.parentElement.style.setProperty('--split', percent + '%');
      divider.setAttribute('aria-valuetext', Math.round(percent) + ' % rendered, the rest ray traced');
    };
    divider.addEventListener('input', show);
    divider.addEventListener('keydown', event => {
      const step = { ArrowLeft: -20, ArrowDown: -20, ArrowRight: 20, ArrowUp: 20 }[event.key];
      if (step) {
        divider.value = Number(divider.value) + step * (event.shiftKey ? 5 : 1);
        show();
        event.preventDefault();
      }
    });
    show();
  }
  if (panes && map) {
    const at = [50, 50];
    const move = (x, y) => {
      at[0] = Math.max(0, Math.min(100, x));
      at[1] = Math.max(0, Math.min(100, y));
      panes.style.setProperty('--at-x', at[0] + '%');
      panes.style.setProperty('--at-y', at[1] + '%');
    };
    const follow = event => {
      const box = map.getBoundingClientRect();
      move(100 * (event.clientX - box.left) / box.width, 100 * (event.clientY - box.top) / box.height);
    };
    map.tabIndex = 0;
    map.setAttribute('role', 'group');
    map.setAttribute('aria-label', 'Error map; arrow keys move a zoomed view');
    map.addEventListener('pointermove', follow);
    map.addEventListener('pointerdown', follow);
    map.addEventListener('keydown', event => {
      const step = { ArrowLeft: [-4, 0], ArrowRight: [4, 0], ArrowUp: [0, -4], ArrowDown: [0, 4] }[event.key];
      if (step) {
        move(at[0] + step[0], at[1] + step[1]);
        event.preventDefault();
      }
    });
    all('.zoom button').forEach(button => button.addEventListener('click', () => {
      all('.zoom button').forEach(b => b.setAttribute('aria-pressed', b === button));
      panes.style.setProperty('--zoom', button.dataset.zoom);
      panes.classList.toggle('zoomed', button.dataset.zoom !== '1');
    }));
  }

  const base = document.querySelector('tbody tr.base') || document.querySelector('tbody tr');
  const first = choice ? choice.value : base && base.dataset.point;
  if (first) {
    select(first);
  }
})();
)js";
}

}  // namespace speculum
