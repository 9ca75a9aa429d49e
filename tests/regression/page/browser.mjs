// Chromium without a window, for tests of report.html.
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const { chromium } = await import(pathToFileURL(join(process.env.PELVIREG_WEB_MODULES, 'playwright-core/index.mjs')));

const softwareGL = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const noGL = ['--disable-gpu', '--disable-3d-apis'];

/** The page of `file` with everything it says and asks for; `use` gets it, and it is closed afterwards. */
export async function withPage(file, { width = 1280, javaScript = true, webGL = true, colorScheme = 'light' } = {}, use) {
  const browser = await chromium.launch({
    executablePath: process.env.PELVIREG_CHROMIUM,
    args: ['--no-sandbox', ...(webGL ? softwareGL : noGL)], // tests may run as root, where there is no sandbox
  });
  try {
    const context = await browser.newContext({ viewport: { width, height: 900 }, javaScriptEnabled: javaScript, acceptDownloads: true, reducedMotion: 'reduce',
      colorScheme });
    const page = await context.newPage();
    const said = [], requests = [], dialogs = [];
    page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !fromDriver(message)) said.push(message.text()); });
    page.on('pageerror', (error) => said.push(error.message));
    page.on('request', (request) => { if (!/^(data|blob):/.test(request.url())) requests.push(request.url()); });
    page.on('dialog', (dialog) => { dialogs.push(dialog.message()); dialog.dismiss(); });
    const begin = Date.now();
    await page.goto(pathToFileURL(file).href);
    if (javaScript) await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 60000 });
    await use({ page, said, requests, dialogs, milliseconds: Date.now() - begin });
  } finally {
    await browser.close();
  }
}

/** A screenshot of the element when two in a row are the same. */
export async function pictureOf(locator) {
  await locator.scrollIntoViewIfNeeded();
  for (let before = await locator.screenshot(), i = 0; i < 20; ++i) {
    const now = await locator.screenshot();
    if (now.equals(before)) return now;
    before = now;
  }
  throw new Error('the element does not come to rest');
}

/** What software OpenGL says of its own speed when a picture is read back. */
function fromDriver(message) {
  return /GL Driver Message .*GPU stall due to ReadPixels/.test(message.text());
}
