// summary.pdf: one page of paper. PELVIREG_PROGRAM, PELVIREG_RESULT: a result directory, of which a copy is used.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

const folder = mkdtempSync(join(tmpdir(), 'pelvireg-summary-'));
const result = join(folder, 'result'), pdf = join(result, 'summary.pdf');
cpSync(process.env.PELVIREG_RESULT, result, { recursive: true });
rmSync(pdf, { force: true });
after(() => rmSync(folder, { recursive: true, force: true }));

const print = (environment = {}) =>
  spawnSync(process.env.PELVIREG_PROGRAM, ['report', result, '--pdf'], { encoding: 'utf8', env: { ...process.env, ...environment } });

test('without Chromium one sentence says what to install, and nothing half-written stays', () => {
  const { status, stderr } = print({ PATH: '/nowhere' });
  assert.equal(status, 2, stderr);
  assert.match(stderr, /no program 'chromium' in PATH; install the package chromium/);
  assert.ok(!existsSync(pdf));
});

test('it is one page, without a date, and the same bytes again', () => {
  assert.equal(print().status, 0);
  const first = readFileSync(pdf);
  const text = first.toString('latin1');
  assert.equal(text.match(/\/Type \/Page\b/g).length, 1);
  assert.deepEqual(text.match(/\/MediaBox \[[^\]]*\]/)[0].match(/[\d.]+/g).slice(2).map((points) => Math.round((Number(points) / 72) * 25.4)), [210, 297]);
  assert.doesNotMatch(text, /Date \(D:(?!19700101000000)/);
  rmSync(pdf);
  assert.equal(print().status, 0);
  assert.ok(readFileSync(pdf).equals(first));
});

test('the figures are files that stand alone', () => {
  for (const name of ['error_by_step-full.svg', 'error_by_slice-unregistered.svg', 'image_plane-no_boundary_conditions.svg']) {
    const svg = readFileSync(join(result, 'figures', name), 'utf8');
    assert.match(svg, /^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg"/, name);
    assert.equal(svg.match(/<svg /g).length, svg.match(/<\/svg>/g).length, name);
  }
});
