// How fast a page is: when its summary and its wall are there after it is opened, and how it follows the time slider; medians.
// node tests/web/speed.mjs PAGE.html [TIMES]
import { lacking, launch, openPage, processorTime, scrub } from "./browser.mjs";

const [file, times = "5"] = process.argv.slice(2);
if (lacking) throw new Error(lacking);
const all = [];
for (let i = 0; i < Number(times); ++i) {
  const browser = await launch();
  const before = await processorTime(browser);
  const page = await openPage(browser, file, { viewport: { width: 1280, height: 720 } });
  const opened = await page.evaluate(() => ({ first: Number(document.body.dataset.first), ready: Number(document.body.dataset.ready) }));
  const opening = (await processorTime(browser)) - before;
  all.push({ ...opened, opening, ...(await scrub(browser, page)) });
  await browser.close();
}
const median = (name) => all.map((one) => one[name]).sort((a, b) => a - b)[all.length >> 1];
console.log(`summary after ${median("first")} ms, wall after ${median("ready")} ms and ${median("opening").toFixed(0)} ms of processor time; ${median("fps").toFixed(1)} moments a second, ` +
  `${median("script").toFixed(1)} ms of script and ${median("processor").toFixed(1)} ms of processor time each (${all[0].count} moments, ${all.length} times)`);
