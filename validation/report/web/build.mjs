// Bundles src/ with the libraries of package-lock.json into C++ source: node build.mjs OUTPUT.cc NODE_MODULES
// The same sources and lock give the same bytes.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [output, modules] = process.argv.slice(2);
if (!output || !modules) {
  console.error('usage: node build.mjs OUTPUT.cc NODE_MODULES');
  process.exit(2);
}
const root = dirname(fileURLToPath(import.meta.url));
const esbuild = await import(pathToFileURL(join(resolve(modules), 'esbuild/lib/main.js')));

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [join(root, 'src', entry)],
    nodePaths: [resolve(modules)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2020',
    charset: 'utf8',
    legalComments: 'none', // the page's licence list holds them whole
  });
  return result.outputFiles[0].text.trim();
}

// What a <script> must not hold; esbuild writes "<\/script" in strings itself.
function checked(script) {
  if (/<\/script|<!--/i.test(script)) throw new Error('the bundle holds </script or <!--, which would end its element');
  return script;
}

function licence(name) {
  const folder = join(modules, name);
  const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  return `${name} ${version} (${license})\n\n${readFileSync(join(folder, 'LICENSE'), 'utf8').trim()}\n`;
}

// A compiler need not take literals of any length: pieces of 8000 characters that it joins itself.
function literal(text) {
  const bytes = Buffer.from(text);
  const pieces = [];
  for (let i = 0; i < bytes.length; i += 8000) pieces.push(escaped(bytes.subarray(i, i + 8000)));
  return pieces.map((piece) => `    "${piece}"`).join('\n');
}

function escaped(bytes) {
  let text = '';
  for (const byte of bytes) {
    const character = String.fromCharCode(byte);
    if (character === '"' || character === '\\') text += '\\' + character;
    else if (character === '\n') text += '\\n';
    else if (character === '?') text += '\\?';
    else if (byte < 32 || byte > 126) text += '\\' + byte.toString(8).padStart(3, '0');
    else text += character;
  }
  return text;
}

const script = checked(await bundle('main.js'));
const style = await bundle('page.css');
const { dependencies } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
const licences = Object.keys(dependencies).sort().map(licence).join('\n');
const digest = createHash('sha256').update(script).digest('base64');

const entries = { page_script: script, page_style: style, page_licences: licences, page_script_digest: digest };
writeFileSync(output, `// Made by web/build.mjs.
#include "validation/report/web_bundle.h"

namespace pelvireg::report
{
${Object.entries(entries).map(([name, text]) => `std::string_view ${name}()
{
  static constexpr char text[] =
${literal(text)};
  return {text, sizeof(text) - 1};
}`).join('\n\n')}
} // namespace pelvireg::report
`);
