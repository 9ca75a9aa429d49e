// What report.html must do in a browser. PELVIREG_RESULT: a result directory; PELVIREG_HOSTILE: the page of a case with a
// hostile name; PELVIREG_WEB_MODULES: node_modules; PELVIREG_CHROMIUM: the browser.
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pictureOf, withPage } from './browser.mjs';
import { csvOf, dataOf } from './page_data.mjs';

const result = process.env.PELVIREG_RESULT, hostile = process.env.PELVIREG_HOSTILE;
const report = join(result, 'report.html');
const summary = JSON.parse(readFileSync(join(result, 'summary.json'), 'utf8'));
const byStep = csvOf(join(result, 'curves_by_step.csv')), bySlice = csvOf(join(result, 'curves_by_slice.csv'));
const organs = ['bladder', 'vagina', 'uterus', 'rectum'];

/** What a chart's first panel says at its cursor: the abscissa, and a mean and a deviation an organ. */
const readOut = (page, chart) => page.evaluate((name) => {
  const table = document.querySelector(`[data-chart=${name}] table.values`);
  return {
    at: Number(table.caption.textContent.match(/-?\d+/)[0]),
    rows: [...table.tBodies[0].rows].map((row) => [...row.cells].map((cell) => cell.textContent.replace('± ', ''))),
  };
}, chart);

const valuesIn = (rows, condition, key, at) => organs.map((organ) => {
  const row = rows.find((other) => other.condition === condition && other.organ === organ && Number(other[key]) === at);
  return row ? [organ, Number(row.mean_mm).toFixed(3), Number(row.sd_mm).toFixed(3)] : [organ, '–', ''];
});

test('the numbers inside are byte by byte those of the result files', () => {
  const data = dataOf(report);
  for (const name of ['summary.json', 'curves_by_step.csv', 'curves_by_slice.csv'])
    assert.deepEqual(data.part(name), readFileSync(join(result, name)), name);
});

test('further metrics and worst places are those of summary.json and errors_by_step.csv', () => {
  const { metrics, worst } = dataOf(report).model;
  for (const [condition, perOrgan] of Object.entries(summary.metrics_at_last_step))
    for (const organ of organs)
      for (const [name, { mean, sd }] of Object.entries(perOrgan[organ])) {
        assert.equal(metrics[condition][organ][name].mean.at(-1), mean, `${condition} ${organ} ${name}`);
        assert.equal(metrics[condition][organ][name].sd.at(-1), sd, `${condition} ${organ} ${name}`);
      }
  const nominal = csvOf(join(result, 'errors_by_step.csv')).filter((row) => row.sample === '0' && Number(row.step) === summary.n_steps);
  for (const condition of Object.keys(summary.errors)) {
    const largest = Math.max(...nominal.filter((row) => row.condition === condition).map((row) => Number(row.max_mm)));
    const first = worst.find((place) => place.condition === condition);
    assert.ok(Math.abs(first.error_mm - largest) < 1e-8 * largest, `${condition}: ${first.error_mm} against ${largest}`); // nine digits
  }
});

test('it is smaller than 8 MB', (t) => {
  const size = statSync(report).size;
  t.diagnostic(`${(size / 1e6).toFixed(2)} MB`);
  assert.ok(size < 8e6);
});

test('it opens from disk without a request or an error, and everything comes to life', async (t) => {
  await withPage(report, {}, async ({ page, said, requests, milliseconds }) => {
    t.diagnostic(`ready after ${milliseconds} ms`);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.ready), 'all');
    for (const box of await page.locator('details > summary').all()) await box.evaluate((summary) => { summary.parentElement.open = true; });
    await page.waitForTimeout(300);
    assert.deepEqual(said, []);
    assert.deepEqual(requests, [new URL(`file://${report}`).href]);
  });
});

test('the verdicts and the error table say what summary.json says', async () => {
  await withPage(report, {}, async ({ page }) => {
    const verdicts = await page.$$eval('#claims tbody tr', (rows) => rows.map((row) => row.cells[0].textContent.slice(2)));
    assert.deepEqual(verdicts, summary.claims.map((claim) => claim.verdict));
    const rows = await page.$$eval('.first table tbody tr', (all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    for (const [condition, errors] of Object.entries(summary.errors)) {
      const shown = rows.find((row) => row[0] === `${condition}, last step`);
      if (!shown) continue; // ablations are closed
      assert.deepEqual(shown.slice(1).map((cell) => cell.split(' ')[0]), organs.map((organ) => errors[organ].last_step.mean_mm.toFixed(2)));
    }
  });
});

test('the phases of a step are those of summary.json', async () => {
  await withPage(report, {}, async ({ page }) => {
    const tables = await page.$$eval('#time .panels table', (all) => all.map((table) => [...table.rows].map((row) => [...row.cells].slice(0, 3).map((cell) => cell.textContent))));
    assert.deepEqual(tables.map((rows) => rows[0][0]), summary.timing.map((timing) => timing.condition));
    for (const [k, { phases, mean_ms }] of summary.timing.entries()) {
      assert.ok(phases.length > 0 && phases.reduce((sum, phase) => sum + phase.mean_ms, 0) <= mean_ms);
      const shown = [...phases.map((phase) => phase.mean_ms), mean_ms].map((mean) => [mean.toFixed(2), (100 * (mean / mean_ms)).toFixed(1)]);
      assert.deepEqual(tables[k].slice(1).map((row) => row.slice(1)), shown);
    }
  });
});

test('the mouse reads values off the charts that equal the CSV', async () => {
  await withPage(report, {}, async ({ page }) => {
    for (const [chart, rows, key] of [['step', byStep, 'step'], ['slice', bySlice, 'slice_index']])
      for (const share of [0.15, 0.5, 0.8]) {
        const over = page.locator(`[data-chart=${chart}] .plot .u-over`).first();
        await over.scrollIntoViewIfNeeded();
        const box = await over.boundingBox();
        await page.mouse.move(box.x + share * box.width, box.y + box.height / 2);
        const { at, rows: shown } = await readOut(page, chart);
        assert.deepEqual(shown, valuesIn(rows, 'full', key, at), `${chart} ${at}`);
      }
    const before = await readOut(page, 'step');
    assert.notEqual(before.at, summary.n_steps);
  });
});

test('the arrow keys read the same values, and the focus is seen', async () => {
  await withPage(report, {}, async ({ page }) => {
    const plot = page.locator('[data-chart=step] .plot').first();
    await page.locator('[data-chart=step] select').first().focus();
    for (let i = 0; i < 30 && !(await plot.evaluate((node) => node === document.activeElement)); ++i) await page.keyboard.press('Tab');
    assert.ok(await plot.evaluate((node) => node === document.activeElement), 'Tab reaches the chart');
    assert.notEqual(await plot.evaluate((node) => getComputedStyle(node).outlineStyle), 'none');
    await page.keyboard.press('End');
    await page.keyboard.press('ArrowLeft');
    const { at, rows } = await readOut(page, 'step');
    assert.equal(at, summary.n_steps - 1);
    assert.deepEqual(rows, valuesIn(byStep, 'full', 'step', at));
  });
});

test('the step slider moves with the arrow keys and changes what is drawn', async () => {
  await withPage(report, {}, async ({ page, said }) => {
    const canvas = page.locator('.stage canvas'), slider = page.locator('#step-slider');
    const choose = (label, value) => page.locator('.panel label', { hasText: label }).locator('select').selectOption(value);
    const tick = (text) => page.locator('.panel fieldset label', { hasText: text }).first().locator('input').click();
    let before;
    const changes = async (what, act) => {
      await act();
      const now = await pictureOf(canvas);
      assert.ok(!now.equals(before), what);
      before = now;
    };
    await tick('image plane'); // and the points move too: only the organs shall tell
    await tick('outline points');
    await slider.focus();
    const last = before = await pictureOf(canvas);
    await changes('another step', async () => {
      for (let i = 0; i < 12; ++i) await page.keyboard.press('ArrowLeft');
    });
    assert.match(await page.locator('.step-control output').textContent(), new RegExp(`^${summary.n_steps - 12} of ${summary.n_steps}`));
    await page.keyboard.press('End');
    assert.ok(last.equals(await pictureOf(canvas)), 'back at the last step it looks as before');
    before = last;
    for (const [label, value] of [['Condition', 'no_boundary_conditions'], ['Scale', '1'], ['Show', 'estimate'], ['Condition', 'full'],
      ['Colour', 'true'], ['Show', 'both'], ['Colour', 'false']])
      await changes(`${label}: ${value}`, () => choose(label, value));
    for (const text of ['image plane', 'outline points', 'bladder', "the truth's ligaments", "the condition's attachments", 'cut open'])
      await changes(text, () => tick(text));
    await changes('arrow keys turn the view', async () => {
      await canvas.focus();
      await page.keyboard.press('ArrowRight');
    });
    assert.deepEqual(said, []);
  });
});

test('the mouse reads organ, error and side off the 3-D view', async () => {
  await withPage(report, {}, async ({ page }) => {
    const canvas = page.locator('.stage canvas');
    await canvas.scrollIntoViewIfNeeded();
    const box = await canvas.boundingBox();
    const seen = new Set();
    for (let share = 0.2; share < 0.8; share += 0.05) {
      await page.mouse.move(box.x + share * box.width, box.y + 0.5 * box.height);
      const text = await page.locator('.read-out').textContent();
      if (text) seen.add(text.match(/^(\w+): \d+\.\d\d mm, \d+ mm (left|right) of the image plane$/)[1]);
    }
    assert.ok(seen.size >= 2 && [...seen].every((organ) => organs.includes(organ)), [...seen].join());
  });
});

test('the slice slider shows the slice and the values of the CSV', async () => {
  await withPage(report, {}, async ({ page }) => {
    const slider = page.locator('#slice-view input[type=range]');
    const drawn = () => page.locator('.slice-large .truth').getAttribute('d');
    const middle = await drawn();
    await slider.focus();
    await page.keyboard.press('ArrowRight');
    assert.notEqual(await drawn(), middle);
    const rows = await page.$$eval('#slice-view table.values tbody tr', (all) => all.map((row) => [...row.cells].map((cell) => cell.textContent.replace('± ', ''))));
    assert.deepEqual(rows, valuesIn(bySlice, 'full', 'slice_index', 1));
    const full = await page.locator('.slice-large .estimate').getAttribute('d');
    await page.locator('#slice-view select').selectOption('no_boundary_conditions');
    assert.notEqual(await page.locator('.slice-large .estimate').getAttribute('d'), full);
  });
});

test('a worst place is found in the 3-D view', async () => {
  await withPage(report, {}, async ({ page }) => {
    const place = dataOf(report).model.worst.find(({ condition }) => condition === 'full');
    await page.locator('.worst[data-condition=full] button').first().click();
    assert.equal(await page.locator('.read-out').textContent(), `${place.organ}: ${place.error_mm.toFixed(2)} mm, the pink mark`);
  });
});

test('the CSV buttons save the files', async () => {
  await withPage(report, {}, async ({ page }) => {
    for (const name of ['curves_by_step.csv', 'curves_by_slice.csv']) {
      const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: `Download ${name}` }).click()]);
      assert.equal(download.suggestedFilename(), name);
      assert.deepEqual(readFileSync(await download.path()), readFileSync(join(result, name)));
    }
  });
});

test('the figure of a metric is saved with the numbers of summary.json', async () => {
  await withPage(report, {}, async ({ page }) => {
    await page.locator('[data-chart=metric] select').first().selectOption('Dice');
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Download metric.csv' }).click()]);
    const rows = csvOf(await download.path()).filter((row) => Number(row.step) === summary.n_steps);
    for (const [condition, perOrgan] of Object.entries(summary.metrics_at_last_step))
      for (const organ of organs) {
        const row = rows.find((other) => other.condition === condition && other.organ === organ);
        assert.deepEqual([Number(row.mean), Number(row.sd), Number(row.n_runs)], [perOrgan[organ].dice.mean, perOrgan[organ].dice.sd, perOrgan[organ].dice.n_runs]);
      }
  });
});

for (const width of [1280, 390])
  for (const javaScript of [true, false])
    test(`nothing is wider than the window at ${width} pixels, ${javaScript ? 'with' : 'without'} script`, async () => {
      await withPage(report, { width, javaScript }, async ({ page }) => {
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
      });
    });

test('it can be read without its script', async () => {
  await withPage(report, { javaScript: false }, async ({ page }) => {
    for (const id of ['claims', 'by-step', 'by-slice', 'slices', 'worst', 'metrics', 'truth', 'time', 'definitions', 'provenance'])
      assert.ok(await page.locator(`#${id}`).isVisible(), id);
    assert.ok(await page.locator('[data-chart=step] svg[role=img]').first().isVisible());
    assert.ok(await page.locator('[data-chart=slice] svg[role=img]').first().isVisible());
    assert.equal(await page.locator('figure.slice svg').count(), 2 * dataOf(report).model.slices_each_side + 1);
    assert.ok((await page.locator('#pictures img').count()) === 0 || (await page.locator('#pictures img').first().isVisible()));
  });
});

test('without WebGL it says so and shows the still pictures', async () => {
  await withPage(report, { webGL: false }, async ({ page, said }) => {
    assert.equal(await page.evaluate(() => document.documentElement.dataset.ready), 'no-webgl');
    assert.match(await page.locator('#viewer').textContent(), /no WebGL/);
    assert.ok(await page.locator('#pictures').isVisible());
    assert.ok(await page.locator('[data-chart=step] .plot').first().isVisible());
    assert.deepEqual(said, []);
  });
});

for (const colorScheme of ['light', 'dark'])
  test(`text stands out from its background in ${colorScheme} (WCAG 2.1, 1.4.3: 4.5 to 1)`, async () => {
    await withPage(report, { colorScheme }, async ({ page }) => {
      const faint = await page.evaluate(() => {
        const channels = (colour) => colour.match(/[\d.]+/g).map(Number);
        const linear = (value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4);
        const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        const backgroundOf = (node) => {
          for (; node; node = node.parentElement) {
            const [r, g, b, alpha = 1] = channels(getComputedStyle(node).backgroundColor);
            if (alpha > 0.5) return [r, g, b];
          }
          return [255, 255, 255];
        };
        const found = [];
        for (const node of document.querySelectorAll('main *')) {
          if (node.closest('svg') || !node.checkVisibility() || ![...node.childNodes].some((child) => child.nodeType === 3 && child.data.trim())) continue;
          const [a, b] = [luminance(channels(getComputedStyle(node).color)), luminance(backgroundOf(node))].sort((x, y) => y - x);
          const ratio = (a + 0.05) / (b + 0.05);
          if (!(ratio >= 4.5)) found.push(`${node.className || node.tagName}: ${ratio.toFixed(2)}`);
        }
        return found;
      });
      assert.deepEqual([...new Set(faint)], []);
    });
  });

test('a hostile case name is text and nothing else', async () => {
  await withPage(hostile, {}, async ({ page, said, requests, dialogs }) => {
    const name = '</script><script>window.caught = 1</script><img src=x onerror="window.caught = 2">\'"&';
    assert.ok((await page.title()).endsWith(name));
    assert.ok((await page.locator('h1').textContent()).endsWith(name));
    assert.equal(dataOf(hostile).model.case, name);
    assert.equal(await page.evaluate(() => window.caught), undefined);
    assert.equal(await page.locator('img[src=x]').count(), 0);
    assert.deepEqual(dialogs, []);
    assert.deepEqual(said, []);
    assert.equal(requests.length, 1);
  });
});
