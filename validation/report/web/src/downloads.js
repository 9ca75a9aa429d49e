// Files that the page carries, to be saved.

function save(name, type, content) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export function downloadButton(name, type, content) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = `Download ${name}`;
  button.addEventListener('click', () => save(name, type, content()));
  return button;
}
