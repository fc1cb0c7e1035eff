// Headless Chromium for the tests of the page and for the pictures of it in docs.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = fileURLToPath(new URL("../..", import.meta.url));
const chromium = process.env.CHROMIUM ?? "/usr/bin/chromium";

/** What is missing to start a browser; undefined if nothing is. */
export const lacking = !existsSync(chromium) ? `${chromium} is not there (apt-get install chromium, or set CHROMIUM)`
  : !existsSync(join(root, "web/node_modules/playwright-core")) ? "playwright-core is not there (cd web && npm ci)" : undefined;

/** Drawn without a graphics processor, and no network. */
export const launch = () => createRequire(join(root, "web/"))("playwright-core").chromium.launch({ executablePath: chromium,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-quic", "--no-first-run"] });

/** Opens a page's file and waits for its first picture; `settings` are those of a context. */
export async function openPage(browser, file, settings = {}, watch = () => {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 900 }, acceptDownloads: true, offline: true, ...settings });
  const page = await context.newPage();
  watch(page);
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 120_000 });
  return page;
}

/** Screens that people have: settings of a context, and media. */
export const screens = {
  "1440x900": { viewport: { width: 1440, height: 900 } },
  "1280x720": { viewport: { width: 1280, height: 720 } },
  "390x844": { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 },
  "zoom200": { viewport: { width: 720, height: 450 }, deviceScaleFactor: 2 },
  "dark": { viewport: { width: 1440, height: 900 }, colorScheme: "dark" },
  "print": { viewport: { width: 718, height: 1000 }, media: "print" },  // the width of A4 within its margins
};

/** Milliseconds of processor time that all of a browser's processes have taken. */
export async function processorTime(browser) {
  const session = await browser.newBrowserCDPSession();
  return 1000 * (await session.send("SystemInfo.getProcessInfo")).processInfo.reduce((sum, p) => sum + p.cpuTime, 0);
}

/** Drags the time slider through 60 moments: frames a second, milliseconds of script and of processor time (of all the browser's
 * processes) a frame, and how many moments there are. */
export async function scrub(browser, page) {
  await page.locator("canvas.wall").first().scrollIntoViewIfNeeded();
  await page.waitForTimeout(1000);
  const before = await processorTime(browser);
  const result = await page.evaluate(async () => {
    const slider = document.getElementById("time");
    const count = Number(slider.max) + 1;
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    let script = 0;
    const start = performance.now();
    for (let i = 0; i < 60; ++i) {
      const t = performance.now();
      slider.value = i % count;
      slider.dispatchEvent(new Event("input"));
      script += performance.now() - t;
      await frame();
    }
    return { fps: 60e3 / (performance.now() - start), script: script / 60, count };
  });
  return { ...result, processor: ((await processorTime(browser)) - before) / 60 };
}
