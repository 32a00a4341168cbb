'use strict';
// Everything is readable without this: it sorts, filters, hides series, and lays pictures over each other.

const press = (button) => {
  const on = button.getAttribute('aria-pressed') === 'false';
  button.setAttribute('aria-pressed', String(on));
  return on;
};

function sortable(table) {
  const heads = [...table.tHead.rows[0].cells];
  const key = (row, column) => {
    const cell = row.cells[column];
    const text = cell.dataset.v ?? cell.textContent.replaceAll(',', '');
    const value = Number.parseFloat(text);
    return Number.isNaN(value) || (cell.dataset.v === undefined && String(value) !== text) ? text : value;
  };
  const order = (a, b) => {
    if (typeof a === 'number' && typeof b === 'number') return a - b;
    if (typeof a === 'number') return -1;
    if (typeof b === 'number') return 1;
    return a.localeCompare(b);
  };
  const sort = (column) => {
    const up = heads[column].getAttribute('aria-sort') !== 'ascending';
    heads.forEach((head) => head.removeAttribute('aria-sort'));
    heads[column].setAttribute('aria-sort', up ? 'ascending' : 'descending');
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => [key(row, column), row]);
    rows.sort(([a], [b]) => (up ? order(a, b) : order(b, a)));
    body.append(...rows.map(([, row]) => row));
  };
  heads.forEach((head, column) => {
    head.tabIndex = 0;
    head.title = 'Sort by this';
    head.addEventListener('click', () => sort(column));
    head.addEventListener('keydown', (event) => event.key === 'Enter' && sort(column));
  });
}

function filterClaims(button) {
  button.addEventListener('click', () => {
    const on = press(button);
    for (const claim of button.closest('section').querySelectorAll('.claim')) {
      if (claim.dataset.verdict === button.dataset.verdict) claim.hidden = !on;
    }
  });
}

function hideSeries(button) {
  button.addEventListener('click', () => {
    const on = press(button);
    for (const group of button.closest('figure').querySelectorAll(`g[data-series="${button.dataset.series}"]`)) {
      group.classList.toggle('off', !on);
    }
  });
}

// Two pictures of a scene on top of each other, cut where the slider is.
function compare(scene) {
  const pictures = [...scene.querySelectorAll('.gallery img')];
  if (pictures.length < 2) return;
  const make = (name, parent, properties = {}) => {
    const element = Object.assign(document.createElement(name), properties);
    parent.append(element);
    return element;
  };
  const box = document.createElement('div');
  box.className = 'compare';
  const choice = make('div', box, { className: 'choice' });
  const stage = make('div', box, { className: 'stage' });
  const slider = make('input', box, { type: 'range', min: 0, max: 100, step: 0.1, value: 50, ariaLabel: 'Where to cut' });
  // Two recipes at first, where there are two.
  const maps = pictures.flatMap((picture, i) => (picture.dataset.label.startsWith('heatmap') ? [i] : []));
  const shown = maps.length > 1 ? [maps[0], maps.at(-1)] : [0, pictures.length - 1];
  shown.forEach((first, side) => {
    const select = make('select', choice, { ariaLabel: side ? 'Right picture' : 'Left picture' });
    pictures.forEach((picture, i) => make('option', select, { value: i, textContent: picture.dataset.label }));
    const image = make('img', stage);
    const show = () => Object.assign(image, { src: pictures[select.value].src, alt: pictures[select.value].alt });
    select.value = first;
    select.addEventListener('change', show);
    show();
  });
  const cut = (percent) => {
    slider.value = percent;
    stage.style.setProperty('--cut', `${slider.value}%`);
  };
  slider.addEventListener('input', () => cut(slider.value));
  stage.addEventListener('pointermove', (event) => {
    const place = stage.getBoundingClientRect();
    if (event.pointerType === 'mouse' || event.buttons) cut((100 * (event.clientX - place.left)) / place.width);
  });
  scene.querySelector('.gallery').before(box);
}

document.querySelectorAll('table.sortable').forEach(sortable);
document.querySelectorAll('.tally button').forEach(filterClaims);
document.querySelectorAll('.legend button').forEach(hideSeries);
document.querySelectorAll('.pictures').forEach(compare);
addEventListener('beforeprint', () => document.querySelectorAll('details').forEach((details) => { details.open = true; }));
