// How fast a page is, on a machine that does nothing else: the time to its first view and how it follows the time slider; medians.
// Each time in a browser that has just been started, and beside it an empty page: what the browser itself takes without a graphics card.
// node tests/web/speed.mjs PAGE.html [TIMES]   exit code 1: slower than asked (first view within 1 s, 25 moments a second)
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { lacking, launch, newPage, openPage, processorTime, scrub } from "./browser.mjs";

const [file, times = "5"] = process.argv.slice(2);
if (lacking) throw new Error(lacking);
const asked = { first: 1000, fps: 25 };  // at most [ms], at least [1/s]
const screen = { viewport: { width: 1280, height: 720 } };
const folder = mkdtempSync(join(tmpdir(), "ventricle_speed_"));
const empty = join(folder, "empty.html");
writeFileSync(empty, "<!doctype html><p>empty</p>");

/** When a page's first content is on the screen, in milliseconds after its address was given. */
const contentful = (page) => page.evaluate(() => new Promise((done) => {
  new PerformanceObserver((list) => done(list.getEntriesByName("first-contentful-paint")[0].startTime)).observe({ type: "paint", buffered: true });
}));

async function emptyPage() {
  const browser = await launch();
  const page = await newPage(browser, screen);
  await page.goto(pathToFileURL(empty).href, { waitUntil: "commit" });
  const floor = await contentful(page);
  await browser.close();
  return { floor };
}

async function wholePage() {
  const browser = await launch();
  const before = await processorTime(browser);
  const page = await openPage(browser, file, screen);
  const first = await contentful(page);
  const opened = await page.evaluate(() => Object.fromEntries(["wall", "ready"].map((name) => [name, Number(document.body.dataset[name])])));
  const opening = (await processorTime(browser)) - before;
  const moving = await scrub(browser, page);
  await browser.close();
  return { first, ...opened, opening, ...moving };
}

const all = [];
for (let i = 0; i < Number(times); ++i) all.push({ ...(await emptyPage()), ...(await wholePage()) });
rmSync(folder, { recursive: true });
const median = (name) => all.map((one) => one[name]).sort((a, b) => a - b)[all.length >> 1];
const verdict = (good) => (good ? "as asked" : "SLOWER than asked");
const quick = median("first") <= asked.first;
const smooth = median("fps") >= asked.fps;
console.log(`first view, numbers and picture: on the screen after ${median("first").toFixed(0)} ms (asked: ${asked.first}): ${verdict(quick)}; an empty page after ${median("floor").toFixed(0)} ms`);
console.log(`the wall can be turned after ${median("wall")} ms, the whole page is there after ${median("ready")} ms and ${median("opening").toFixed(0)} ms of processor time`);
console.log(`scrubbing: ${median("fps").toFixed(1)} moments a second (asked: ${asked.fps}): ${verdict(smooth)}; ` +
  `${median("script").toFixed(1)} ms of script and ${median("processor").toFixed(1)} ms of processor time each`);
console.log(`(${all[0].count} moments; medians of ${all.length})`);
process.exit(quick && smooth ? 0 : 1);
