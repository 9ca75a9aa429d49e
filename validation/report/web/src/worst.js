// "Show" beside each of the worst places: the 3-D view goes there.
import { element } from './dom.js';

export function linkWorstPlaces(data, viewer) {
  for (const box of document.querySelectorAll('.worst')) {
    const places = data.model.worst.filter((place) => place.condition === box.dataset.condition);
    box.querySelectorAll('tbody tr').forEach((row, i) => {
      const button = element('button', { type: 'button', textContent: 'Show' });
      button.setAttribute('aria-label', `Show the place ${i + 1} of ${box.dataset.condition} in the 3-D view`);
      button.addEventListener('click', () => viewer.showPlace(places[i]));
      row.insertCell().append(button);
    });
    box.querySelector('thead tr').append(element('th'));
  }
}
