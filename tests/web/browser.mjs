// Headless Chromium for the tests of the page and for the pictures of it in docs.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = fileURLToPath(new URL("../..", import.meta.url));
const chromium = process.env.CHROMIUM ?? "/usr/bin/chromium";
const patience = 120_000;  // [ms]: on a busy machine all takes its time

/** What is missing to start a browser; undefined if nothing is. */
export const lacking = !existsSync(chromium) ? `${chromium} is not there (apt-get install chromium, or set CHROMIUM)`
  : !existsSync(join(root, "web/node_modules/playwright-core")) ? "playwright-core is not there (cd web && npm ci)" : undefined;

/** Drawn without a graphics processor, and no network. Chromium takes a process of graphics that is slow for one that hangs, unless told not to. */
export const launch = () => createRequire(join(root, "web/"))("playwright-core").chromium.launch({ executablePath: chromium, timeout: patience,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-watchdog", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-quic", "--no-first-run"] });

/** Waits for all that a page opens with. Throws with what the page says when it cannot be drawn, or is not in time. */
export async function drawn(page) {
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.stack));
  await page.waitForFunction(() => document.body?.dataset.ready ?? document.body?.dataset.failed, null, { timeout: patience }).catch(async () => {
    throw new Error(`${page.url()} was not drawn in ${patience / 1000} s: ${await page.evaluate(() => JSON.stringify({ ...document.body?.dataset, state: document.readyState }))} ${errors.join("\n")}`);
  });
  const failed = await page.evaluate(() => document.body.dataset.failed);
  if (failed) throw new Error(`${page.url()} cannot be drawn: ${failed}`);
  return page;
}

/** A page in a context of its own; `settings` are those of the context. */
export async function newPage(browser, settings = {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 900 }, acceptDownloads: true, offline: true, ...settings });
  context.setDefaultTimeout(patience);
  return context.newPage();
}

/** Opens a page's file and waits for all of it. */
export async function openPage(browser, file, settings = {}, watch = () => {}) {
  const page = await newPage(browser, settings);
  watch(page);
  await page.goto(pathToFileURL(resolve(file)).href, { waitUntil: "commit" });
  return drawn(page);
}

/** Waits until the 3-D views show what they were asked for, as finely as they do. */
export const settled = (page) => page.evaluate(() => new Promise((done) => {
  const look = (frames) => {
    const moves = document.querySelector("[aria-busy=true], canvas.wall[data-at=motion]");
    if (frames < 2 || moves) requestAnimationFrame(() => look(frames + 1));
    else done();
  };
  look(0);
}));

/** What is drawn only when it comes into sight, by the section's id. */
export const late = { flow: "canvas, .missing", outlines: "svg.outlined, .missing" };

/** Brings a section into sight and waits until it is drawn. */
export async function inSight(page, id) {
  await page.locator(`#${id}`).scrollIntoViewIfNeeded();
  if (late[id]) await page.waitForSelector(late[id].split(", ").map((part) => `#${id} ${part}`).join(", "), { state: "attached" });
  await settled(page);
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
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  return 1000 * processInfo.reduce((sum, p) => sum + p.cpuTime, 0);
}

/** Drags the time slider through `moments` moments: frames a second, milliseconds of script and of processor time (of all the browser's
 * processes) a frame, and how many moments the page has. */
export async function scrub(browser, page, moments = 60) {
  await page.locator("canvas.wall").first().scrollIntoViewIfNeeded();
  await settled(page);
  const before = await processorTime(browser);
  const result = await page.evaluate(async (moments) => {
    const slider = document.getElementById("time");
    const count = Number(slider.max) + 1;
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    let script = 0;
    const start = performance.now();
    for (let i = 0; i < moments; ++i) {
      const t = performance.now();
      slider.value = i % count;
      slider.dispatchEvent(new Event("input"));
      for (let k = 0; k < 20; ++k) await undefined;  // with what waits for promises that are kept already: the drawing
      script += performance.now() - t;
      await frame();
    }
    return { fps: (1000 * moments) / (performance.now() - start), script: script / moments, count };
  }, moments);
  return { ...result, processor: ((await processorTime(browser)) - before) / moments };
}
