// Files that the page carries, to be saved.
import { element } from './dom.js';

function save(name, type, content) {
  const link = element('a', { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export function downloadButton(name, type, content) {
  const button = element('button', { type: 'button', textContent: `Download ${name}` });
  button.addEventListener('click', () => save(name, type, content()));
  return button;
}
