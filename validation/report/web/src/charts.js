// Charts with values at the cursor, in place of the still figures.
import uPlot from 'uplot';
import { csvOf, descriptions } from './chart_data.js';
import { element, written } from './dom.js';
import { downloadButton } from './downloads.js';

const colours = ['#0072B2', '#D55E00', '#009E73', '#CC79A7']; // as the still figures
const mainConditions = ['full', 'no_boundary_conditions', 'unregistered'];
const ink = '#333', grid = '#e4e4e4';

class Chart {
  constructor(host, description, data) {
    this.host = host;
    this.description = description;
    this.data = data;
    this.organs = data.model.organs;
    this.conditions = data.model.conditions.map((condition) => condition.name);
    this.titles = Object.fromEntries(data.model.conditions.map((condition) => [condition.name, condition.title]));
    this.shown = this.conditions.filter((name) => mainConditions.includes(name))
      .sort((a, b) => mainConditions.indexOf(a) - mainConditions.indexOf(b));
    if (this.shown.length === 0) this.shown = [...this.conditions];
    this.choice = Object.keys(description.choices)[0];
    this.scale = 'common';
    this.hidden = new Set();
    this.index = this.startIndex();
    this.plots = [];
    this.panels = element('div', { className: 'panels live' });
    if (!description.keepStill) host.querySelector('.still').hidden = true;
    host.append(this.controls(), this.panels);
    this.draw();
    new ResizeObserver(() => this.resize()).observe(this.panels);
  }

  startIndex() {
    const { x, start } = this.description;
    return start === undefined ? x.length - 1 : Math.max(0, x.indexOf(start));
  }

  controls() {
    const { choices, file } = this.description;
    const bar = element('div', { className: 'controls' });
    if (Object.keys(choices).length > 1) bar.append(this.choiceSelect(Object.keys(choices)));
    bar.append(this.scaleSelect());
    if (this.conditions.length > this.shown.length) bar.append(this.conditionBoxes());
    bar.append(file ? downloadButton(file, 'text/csv', () => this.data.part(file)) : this.figureButton());
    return bar;
  }

  figureButton() {
    const { x, xName, saves, choices } = this.description;
    return downloadButton(`${saves}.csv`, 'text/csv', () => csvOf(choices[this.choice], x, xName));
  }

  choiceSelect(names) {
    const select = element('select', {}, ...names.map((name) => element('option', { textContent: name })));
    select.addEventListener('change', () => { this.choice = select.value; this.draw(); });
    return element('label', {}, 'Figure ', select);
  }

  scaleSelect() {
    const select = element('select', {});
    for (const [value, text] of [['common', 'the same for all panels'], ['own', 'each panel its own']])
      select.append(element('option', { value, textContent: text }));
    select.addEventListener('change', () => { this.scale = select.value; this.draw(); });
    return element('label', {}, 'Scale ', select);
  }

  conditionBoxes() {
    const box = element('fieldset', {}, element('legend', { textContent: 'Conditions' }));
    for (const name of this.conditions) {
      const input = element('input', { type: 'checkbox', checked: this.shown.includes(name) });
      input.addEventListener('change', () => {
        this.shown = input.checked ? [...this.shown, name] : this.shown.filter((other) => other !== name);
        this.draw();
      });
      box.append(element('label', {}, input, ` ${name}`));
    }
    return box;
  }

  curves(condition) {
    return this.description.choices[this.choice][condition] ?? {};
  }

  /** Least and largest of mean ± sd of the conditions; a few outliers must not flatten every curve, as in the stills. */
  yRange(conditions) {
    const upper = [], lower = [];
    for (const condition of conditions)
      for (const organ of this.organs) {
        if (this.hidden.has(organ)) continue;
        const curve = this.curves(condition)[organ];
        curve?.mean.forEach((mean, i) => {
          if (mean === null) return;
          upper.push(mean + curve.sd[i]);
          lower.push(mean - curve.sd[i]);
        });
      }
    if (upper.length === 0) return [0, 1];
    upper.sort((a, b) => a - b);
    let top = upper[upper.length - 1];
    if (this.description.anyRange) {
      const bottom = Math.min(...lower), reach = top - bottom || Math.abs(top) || 1;
      return bottom >= 0 && bottom < 0.5 * top ? [0, top + 0.05 * reach] : [bottom - 0.05 * reach, top + 0.05 * reach];
    }
    const p95 = upper[Math.floor(0.95 * (upper.length - 1))];
    if (top > 3 * p95 && p95 > 0) top = 2 * p95;
    return [0, top * 1.05 || 1];
  }

  draw() {
    for (const panel of this.plots) panel.plot.destroy();
    this.panels.replaceChildren();
    this.plots = [];
    const common = this.yRange(this.shown);
    for (const condition of this.shown)
      this.plots.push(this.panel(condition, this.scale === 'common' ? common : this.yRange([condition])));
    this.readOut();
  }

  panel(condition, range) {
    const title = element('h3', { textContent: this.titles[condition] ?? condition });
    const canvas = element('div', { className: 'plot', tabIndex: 0 });
    canvas.setAttribute('role', 'group');
    canvas.setAttribute('aria-label', `${this.choice} by ${this.description.xLabel}, ${title.textContent}; left and right arrow keys move the cursor`);
    const table = element('table', { className: 'values', ariaLive: 'polite' });
    this.panels.append(element('figure', {}, title, canvas, table));
    const plot = new uPlot(this.options(canvas, range), this.columns(condition), canvas);
    canvas.addEventListener('keydown', (event) => this.key(event));
    return { condition, canvas, plot, table };
  }

  columns(condition) {
    const columns = [this.description.x];
    for (const organ of this.organs) {
      const curve = this.curves(condition)[organ] ?? { mean: [], sd: [], n_runs: [] };
      columns.push(curve.mean, curve.mean.map((mean, i) => (mean === null ? null : mean + curve.sd[i])),
        curve.mean.map((mean, i) => (mean === null ? null : mean - curve.sd[i])));
    }
    return columns;
  }

  options(host, yRange) {
    const series = [{}], bands = [];
    this.organs.forEach((organ, o) => {
      const show = !this.hidden.has(organ), stroke = colours[o % colours.length];
      series.push({ label: organ, stroke, width: 2, show, points: { show: this.description.x.length < 20, size: 5 } },
        { show, width: 0, points: { show: false } }, { show, width: 0, points: { show: false } });
      bands.push({ series: [3 * o + 2, 3 * o + 3], fill: `${stroke}33` });
    });
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 }, font: '12px system-ui, sans-serif',
      labelFont: '12px system-ui, sans-serif', labelSize: 20 };
    return {
      ...this.size(host), series, bands, legend: { show: false },
      scales: { x: { time: false, range: this.xRange() }, y: { range: () => yRange } },
      axes: [{ ...axis, label: this.description.xLabel, size: 34 }, { ...axis, label: this.choice, size: 52 }],
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
      hooks: { draw: [(plot) => this.drawBound(plot)], setCursor: [(plot) => this.moved(plot)] },
    };
  }

  xRange() {
    const { x } = this.description, margin = (x[x.length - 1] - x[0]) * 0.02 || 1;
    return [x[0] - margin, x[x.length - 1] + margin];
  }

  drawBound(plot) {
    const { bound } = this.description;
    const { ctx, bbox } = plot, ratio = devicePixelRatio;
    if (bound === undefined || bound > plot.scales.y.max) return;
    const y = plot.valToPos(bound, 'y', true);
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = ink;
    ctx.lineWidth = ratio;
    ctx.setLineDash([6 * ratio, 4 * ratio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'bottom';
    ctx.fillText(`paper: below ${bound} mm`, bbox.left + 6 * ratio, y - 2 * ratio);
    ctx.restore();
  }

  size(host) {
    return { width: Math.max(200, Math.floor(host.clientWidth)), height: 270 };
  }

  resize() {
    for (const { plot, canvas } of this.plots)
      if (plot.width !== this.size(canvas).width) plot.setSize(this.size(canvas));
  }

  moved(plot) {
    const { idx } = plot.cursor;
    if (idx === null || idx === undefined || plot.cursor.left < 0 || this.quiet) return;
    this.index = idx;
    this.showCursor(plot);
    this.readOut();
  }

  /** The cursor of all panels stands at the same place. */
  showCursor(source) {
    this.quiet = true;
    for (const { plot } of this.plots)
      if (plot !== source) plot.setCursor({ left: plot.valToPos(this.description.x[this.index], 'x'), top: 0 });
    this.quiet = false;
  }

  key(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    this.index = Math.min(Math.max(this.index + step, 0), this.description.x.length - 1);
    this.showCursor(null);
    this.readOut();
  }

  toggle(organ) {
    if (!this.hidden.delete(organ)) this.hidden.add(organ);
    this.draw();
  }

  readOut() {
    for (const { condition, table } of this.plots) {
      const caption = element('caption', { textContent: `${this.description.at(this.description.x[this.index])}, ${this.runs(condition)}` });
      const rows = this.organs.map((organ, o) => this.row(condition, organ, o));
      table.replaceChildren(caption, element('tbody', {}, ...rows));
    }
  }

  runs(condition) {
    const n = Math.max(0, ...this.organs.map((organ) => this.curves(condition)[organ]?.n_runs[this.index] ?? 0));
    return n > 1 ? `mean ± sd of ${n} runs` : n === 1 ? 'one run' : 'no run';
  }

  row(condition, organ, o) {
    const curve = this.curves(condition)[organ];
    const mean = curve?.mean[this.index] ?? null, sd = curve?.sd[this.index] ?? null;
    const nRuns = curve?.n_runs[this.index] ?? 0;
    const swatch = element('span', { className: 'swatch' });
    swatch.style.background = colours[o % colours.length];
    const button = element('button', { type: 'button', className: 'organ' }, swatch, organ);
    button.setAttribute('aria-pressed', String(!this.hidden.has(organ)));
    button.addEventListener('click', () => this.toggle(organ));
    return element('tr', {}, element('th', { scope: 'row' }, button),
      element('td', { textContent: written(mean), title: mean === null ? '' : String(mean) }),
      element('td', { textContent: nRuns > 1 ? `± ${written(sd)}` : '', title: nRuns > 1 ? String(sd) : '' }));
  }
}

export function makeCharts(data) {
  const all = descriptions(data);
  for (const host of document.querySelectorAll('.chart')) {
    const description = all[host.dataset.chart];
    if (description && description.x.length) new Chart(host, description, data);
  }
}
