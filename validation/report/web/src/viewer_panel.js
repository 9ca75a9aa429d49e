// The controls of the 3-D view, and what they say.
import { gradient } from './colour_map.js';
import { element } from './dom.js';

const viewNames = { oblique: 'Oblique', left: 'From the left', front: 'From the front', above: 'From above' };

export class ViewerPanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.selects = {};
    this.legend = this.makeLegend();
    this.element = element('div', { className: 'panel' }, this.stepControl(), ...this.choices(), this.organBoxes(), this.thingBoxes(), this.viewButtons());
  }

  makeLegend() {
    this.ticks = element('div', { className: 'ticks' });
    this.legendTitle = element('div', { className: 'legend-title' });
    const bar = element('div', { className: 'colour-bar' });
    bar.style.background = gradient;
    return element('div', { className: 'colour-legend' }, this.legendTitle, bar, this.ticks);
  }

  stepControl() {
    const { steps } = this.viewer.data.model;
    this.slider = element('input', { type: 'range', min: 0, max: steps, value: this.viewer.state.step, id: 'step-slider' });
    this.slider.setAttribute('aria-label', 'registration step');
    this.stepText = element('output');
    this.slider.addEventListener('input', () => this.viewer.set({ step: Number(this.slider.value) }));
    this.play = element('button', { type: 'button', textContent: '▶ Play' });
    this.play.addEventListener('click', () => this.viewer.togglePlay());
    return element('div', { className: 'step-control' }, element('label', {}, 'Step ', this.slider), this.stepText, this.play);
  }

  choice(label, options, key, change = (value) => value) {
    const select = element('select', {}, ...options.map(([value, text]) => element('option', { value, textContent: text })));
    select.value = String(this.viewer.state[key]);
    select.addEventListener('change', () => this.viewer.set({ [key]: change(select.value) }));
    this.selects[key] = select;
    return element('label', {}, `${label} `, select);
  }

  choices() {
    return [
      this.choice('Show', [['truth', 'truth'], ['estimate', 'estimate'], ['both', 'truth and estimate']], 'shown'),
      this.choice('Condition', this.viewer.conditions.map(({ name }) => [name, name]), 'condition'),
      this.choice('Colour', [['false', 'error'], ['true', 'organ']], 'byOrgan', (value) => value === 'true'),
      this.choice('Scale', [['1', '0 to 1 mm'], ['2', '0 to 2 mm'], ['4', '0 to 4 mm (paper)'], ['10', '0 to 10 mm']], 'scale', Number),
    ];
  }

  boxes(title, entries) {
    const box = element('fieldset', {}, element('legend', { textContent: title }));
    for (const [text, checked, change] of entries) {
      const input = element('input', { type: 'checkbox', checked });
      input.addEventListener('change', () => change(input.checked));
      box.append(element('label', {}, input, ` ${text}`));
    }
    return box;
  }

  organBoxes() {
    const { organs } = this.viewer.data.model;
    const box = this.boxes('Organs', organs.map((organ) => [organ, true, (on) => {
      if (on) this.viewer.state.hidden.delete(organ);
      else this.viewer.state.hidden.add(organ);
      this.viewer.update();
    }]));
    this.organInputs = Object.fromEntries([...box.querySelectorAll('input')].map((input, o) => [organs[o], input]));
    return box;
  }

  thingBoxes() {
    const things = [['plane', 'image plane'], ['controlPoints', 'outline points (control points)'],
      ['attachments', "the condition's attachments"], ['bars', "the truth's ligaments and fasciae"]];
    return this.boxes('Around them', [
      ...things.filter(([key]) => this.viewer.surroundings.has(key)).map(([key, text]) => [text, this.viewer.state[key], (on) => this.viewer.set({ [key]: on })]),
      ['cut open at the image plane', this.viewer.state.cut, (on) => this.viewer.set({ cut: on })],
    ]);
  }

  viewButtons() {
    const bar = element('div', { className: 'buttons' });
    for (const [name, textContent] of Object.entries(viewNames)) {
      const button = element('button', { type: 'button', textContent });
      button.addEventListener('click', () => this.viewer.look(name));
      bar.append(button);
    }
    return bar;
  }

  write(increment) {
    const { step, scale, shown, byOrgan } = this.viewer.state;
    const { steps } = this.viewer.data.model;
    this.slider.value = step;
    this.stepText.textContent = step === 0 ? 'at rest' : `${step} of ${steps}, position ${increment}`;
    this.slider.setAttribute('aria-valuetext', this.stepText.textContent);
    this.legend.hidden = byOrgan || step === 0;
    this.legendTitle.textContent = shown === 'estimate' ? 'distance to the truth (mm)' : 'distance to the estimate (mm)';
    this.ticks.replaceChildren(...[0, 0.25, 0.5, 0.75, 1].map((share) => element('span', { textContent: `${share === 1 ? '≥ ' : ''}${share * scale}` })));
  }

  writePlaying(plays) {
    this.play.textContent = plays ? '❚❚ Pause' : '▶ Play';
  }

  /** Sets the controls to what a worst place needs. */
  choose(condition, organ) {
    this.selects.condition.value = condition;
    if (!this.organInputs[organ].checked) this.organInputs[organ].click();
  }
}
