// One slice large, with a slider and a choice of condition.
import { element, written } from './dom.js';
import { readCsv } from './payload.js';

export function makeSlices(data) {
  const host = document.getElementById('slice-view');
  const panels = [...document.querySelectorAll('figure.slice')];
  const conditions = data.model.conditions.filter((condition) => condition.nominal !== null);
  if (!host || panels.length === 0 || conditions.length === 0) return;
  const rows = readCsv(data.text('curves_by_slice.csv'));
  const side = data.model.slices_each_side;

  const name = document.querySelector('.slice-condition');
  const select = element('select', {}, ...conditions.map((condition) => element('option', { textContent: condition.name })));
  select.value = name.textContent;
  const slider = element('input', { type: 'range', min: -side, max: side, value: 0 });
  slider.setAttribute('aria-label', 'slice');
  const place = element('output');
  const drawing = element('div', { className: 'slice-large' });
  const values = element('table', { className: 'values' });
  host.append(
    element('div', { className: 'controls' }, element('label', {}, 'Condition ', select),
      element('label', { className: 'wide' }, 'Slice ', slider, place)),
    element('div', { className: 'slice-pair' }, drawing, values));

  function show() {
    const k = Number(slider.value), condition = select.value;
    const nominal = conditions.find((other) => other.name === condition).nominal;
    panels.forEach((panel, i) => {
      panel.querySelector('.estimate').setAttribute('d', data.model.slices[i].estimates[nominal]);
      panel.classList.toggle('chosen', Number(panel.dataset.index) === k);
    });
    name.textContent = condition;
    const chosen = panels.find((panel) => Number(panel.dataset.index) === k);
    drawing.replaceChildren(chosen.querySelector('svg').cloneNode(true));
    place.textContent = `${k > 0 ? '+' : ''}${k}: ${chosen.querySelector('figcaption').lastChild.textContent.trim()}`;
    slider.setAttribute('aria-valuetext', place.textContent);
    const cells = data.model.organs.map((organ) => {
      const row = rows.find((other) => other.condition === condition && other.organ === organ && Number(other.slice_index) === k);
      return element('tr', {}, element('th', { scope: 'row', textContent: organ }),
        element('td', { textContent: row ? written(Number(row.mean_mm)) : '–' }),
        element('td', { textContent: row && Number(row.n_runs) > 1 ? `± ${written(Number(row.sd_mm))}` : '' }));
    });
    values.replaceChildren(element('caption', { textContent: 'mean contour error over the runs (mm)' }), element('tbody', {}, ...cells));
  }
  slider.addEventListener('input', show);
  select.addEventListener('change', show);
  for (const panel of panels)
    panel.addEventListener('click', () => { slider.value = panel.dataset.index; show(); });
  show();
}
