// How fast a page is, on a machine that does nothing else: the time to its first view and how it follows the time slider; medians.
// node tests/web/speed.mjs PAGE.html [TIMES]   exit code 1: slower than asked (first view within 1 s, 25 moments a second)
import { lacking, launch, openPage, processorTime, scrub } from "./browser.mjs";

const [file, times = "5"] = process.argv.slice(2);
if (lacking) throw new Error(lacking);
const asked = { wall: 1000, fps: 25 };  // at most [ms], at least [1/s]
const all = [];
for (let i = 0; i < Number(times); ++i) {
  const browser = await launch();
  const before = await processorTime(browser);
  const page = await openPage(browser, file, { viewport: { width: 1280, height: 720 } });
  const opened = await page.evaluate(() => Object.fromEntries(["first", "wall", "ready"].map((name) => [name, Number(document.body.dataset[name])])));
  const opening = (await processorTime(browser)) - before;
  all.push({ ...opened, opening, ...(await scrub(browser, page)) });
  await browser.close();
}
const median = (name) => all.map((one) => one[name]).sort((a, b) => a - b)[all.length >> 1];
const verdict = (good) => (good ? "as asked" : "SLOWER than asked");
const quick = median("wall") <= asked.wall;
const smooth = median("fps") >= asked.fps;
console.log(`first view: numbers after ${median("first")} ms, with the wall after ${median("wall")} ms (asked: ${asked.wall}): ${verdict(quick)}`);
console.log(`whole page: after ${median("ready")} ms and ${median("opening").toFixed(0)} ms of processor time`);
console.log(`scrubbing: ${median("fps").toFixed(1)} moments a second (asked: ${asked.fps}): ${verdict(smooth)}; ` +
  `${median("script").toFixed(1)} ms of script and ${median("processor").toFixed(1)} ms of processor time each`);
console.log(`(${all[0].count} moments; medians of ${all.length})`);
process.exit(quick && smooth ? 0 : 1);
