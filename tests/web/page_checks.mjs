// The page of one run: what is drawn, what its controls do, its numbers and its files.
import { readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { drawn, newPage, openPage, root, scrub, settled } from "./browser.mjs";
import { browser, check, close, coloursIn, csv, folder, nothingAsked, number, open, pixels, rimPixels, saved, setSlider, work } from "./setting.mjs";

async function checkFirstScreen(page) {
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.evaluate(() => scrollTo(0, 0));
  const inSight = await page.evaluate(() => ["#wall select", "#wall .legend", "#time", "#wall .ticks", "#summary tbody"].map((selector) => {
    const box = document.querySelector(selector).getBoundingClientRect();
    return box.top >= 0 && box.bottom <= innerHeight && box.left >= 0 && box.right <= innerWidth;
  }));
  check("quantity, legend, moment and the first numbers are in sight at 1280 x 720", inSight.every(Boolean), inSight);
  check("the first picture is circumferential strain", (await page.locator("#wall select").first().inputValue()) === "circumferential_strain");
  check("a case without an infarct assumes none", !/infarct/.test(await page.locator(".sentence").innerText()), await page.locator(".sentence").innerText());
  check("end-diastole and end-systole are marked at the slider", (await page.locator("#wall .tick").allTextContents()).join() === "ED,ES");
  const bars = await page.locator("#regions svg.bar").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
  check("both states have one scale", bars.length === 2 && bars[0] === bars[1], bars);
  const shown = () => page.locator(".of-paper").evaluateAll((all) => all.filter((one) => getComputedStyle(one).display !== "none").length);
  const hidden = await shown();
  await page.locator(".paper-switch input").first().check();
  const after = await shown();
  check("the paper's subjects stand beside on request", hidden === 0 && after > 5, `${hidden} ${after}`);
  await page.locator(".paper-switch input").first().uncheck();
}

async function checkPhone(page) {
  await page.setViewportSize({ width: 390, height: 800 });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  check("a phone's width is enough", width <= 391, width);
  await page.setViewportSize({ width: 1000, height: 760 });
}

/** What axe-core finds that keeps people out. */
export async function checkAccessible(page, name, colorScheme) {
  await page.emulateMedia({ colorScheme });
  await page.addScriptTag({ path: join(root, "web/node_modules/axe-core/axe.min.js") });
  const found = await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ["violations"] })).violations
    .filter((one) => ["serious", "critical"].includes(one.impact)).map((one) => `${one.id}: ${one.nodes.slice(0, 3).map((node) => node.target.join(" ")).join(", ")}`));
  check(`axe finds nothing serious in ${name}, ${colorScheme}`, found.length === 0, found.join("\n"));
  await page.emulateMedia({ colorScheme: "light" });
}

async function checkDrawn(page) {
  const wall = await pixels(page, "canvas.wall");
  check("the wall is drawn", wall.drawn > 0.08 && wall.colours > 50, JSON.stringify(wall));
  const flow = await pixels(page, "canvas.flow");
  check("the flow is drawn, and nothing where no blood and no wall is", flow.drawn > 0.15 && flow.drawn < 0.75 && flow.colours > 50, JSON.stringify(flow));
  const charts = await page.locator("svg.chart").evaluateAll((all) => all.map((one) =>
    Math.min(...[...one.querySelectorAll("path")].map((path) => path.getAttribute("d").length))));
  for (const id of ["outlines", "strain"])
    check(`a case without images says so in ${id}`, (await page.locator(`#${id} .missing`).count()) === 1 && (await page.locator(`#${id} svg`).count()) === 0);
  check("a case without measured volumes says so", /No measured volumes/.test(await page.locator("#summary").innerText()));
  check("all charts have their lines", charts.length === 10 && charts.every((length) => length > 40), charts);
  const regions = await page.locator("svg.bullseye").evaluateAll((all) => all.map((one) => one.querySelectorAll("[data-index]").length));
  check("bull's-eyes have 38 and 17 regions at both states", regions.join() === "17,38,17,38", regions);
  const text = await page.locator("body").innerText();
  check("nothing reads NaN or undefined", !/NaN|undefined|\[object/.test(text), text.match(/.{30}(NaN|undefined|\[object).{20}/)?.[0]);
}

async function checkControls(page) {
  await page.locator("#wall details.more").evaluate((one) => { one.open = true; });
  let before = await pixels(page, "canvas.wall");
  const changed = async (claim, act) => {
    await act();
    const after = await pixels(page, "canvas.wall");
    check(claim, after.print !== before.print && after.drawn > 0.03, JSON.stringify(after));
    before = after;
  };
  const caption = () => page.locator("#wall svg.overlay text").nth(1).textContent();
  const last = csv(join(work, "03_beat/moments.csv")).at(-1);
  await changed("the time slider moves the wall", () => setSlider(page, "#time", 0));
  check("the caption names the phase of curves.csv", (await caption()).startsWith(`${csv(join(work, "03_beat/curves.csv"))[0].phase}, `), await caption());
  await changed("and back", () => setSlider(page, "#time", 1000));
  check("and the moment of moments.csv", (await caption()).startsWith(`${last.moment.replace("_", "-")}, ${Number(last.time_s).toFixed(3)} s`), await caption());
  const spoken = await page.locator("#time").getAttribute("aria-valuetext");
  check("the slider's spoken text is the caption", spoken === await caption(), `${spoken} ${await caption()}`);
  await changed("fibres are drawn", () => page.check("#fibres"));
  await changed("another quantity has other colours", () => page.selectOption("#wall select >> nth=0", "fibre_strain"));
  await changed("the plane turns", () => setSlider(page, "#wall .controls input[type=range] >> nth=0", 60));
  await changed("a short-axis cut", () => page.selectOption("#wall select >> nth=1", "short"));
  await changed("no cut", () => page.selectOption("#wall select >> nth=1", "none"));
  await changed("a view by name", () => page.getByRole("button", { name: "apex", exact: true }).click());
  await changed("the keyboard turns the wall", async () => { await page.focus("canvas.wall"); await page.keyboard.press("ArrowUp"); await page.keyboard.press("ArrowLeft"); });
  await changed("the infarct can be shown", () => page.selectOption("#wall select >> nth=0", "infarct"));
  await page.uncheck("#fibres");
  await page.selectOption("#wall select >> nth=0", "circumferential_strain");
  await page.getByRole("button", { name: "4-chamber", exact: true }).click();
  await settled(page);
}

/** What the charts of segments say: their axis, the points of each curve, their names and where the time stands. */
const segmentCharts = (page) => page.locator("#segments svg.chart").evaluateAll((all) => all.map((one) => ({ label: one.getAttribute("aria-label"),
  points: [...one.querySelectorAll("g.line path")].map((path) => path.getAttribute("d").split(/[ML]/).length - 1), names: [...one.querySelectorAll("g.line title")].map((title) => title.textContent),
  time: Number(one.querySelector("line.live").getAttribute("x1")), last: Math.max(...one.querySelector("g.line path").getAttribute("d").split(/[ML]/).map((p) => Number(p.split(" ")[0]))) })));

async function checkSegments(page) {
  const rows = csv(join(work, "04_results/segments_over_time.csv"));
  await page.selectOption("#wall select >> nth=0", "fibre_stress");
  await setSlider(page, "#time", 0);
  const [first] = await segmentCharts(page);
  await setSlider(page, "#time", 1000);
  const charts = await segmentCharts(page);
  const all = charts.flatMap(({ points }) => points);
  check("segments have a curve each, in charts of three rings, with a point for every frame", charts.length === 3 && all.length === 17 && all.every((count) => 17 * count === rows.length), JSON.stringify(charts));
  check("under their names", charts.flatMap(({ names }) => names).every((name, i) => name.replace("*", "") === `${rows[i].segment} ${rows[i].name}`), JSON.stringify(charts));
  check("the time on them moves with the slider, to their end", first.time < charts[0].time && charts.every(({ time, last }) => Math.abs(time - last) < 0.1), JSON.stringify([first, ...charts]));
  await page.locator("#segments g.line > text").nth(7).hover();
  const chosen = await page.locator("#segments g.line").evaluateAll((lines) => lines.findIndex((line) => line.classList.contains("chosen")));
  check("a curve that is pointed at is marked, with its segment in the bull's-eyes", chosen === 7 && (await page.locator("#regions .read").innerText()).includes("8 mid anteroseptal"), chosen);
  await page.mouse.move(5, 5);
  await page.selectOption("#wall select >> nth=0", "infarct");
  check("what has no curves is said to have none", /strains and stresses alone/.test(await page.locator("#segments").innerText()));
  await page.selectOption("#wall select >> nth=0", "circumferential_strain");
  check("and the quantity is that of the 3-D view", (await segmentCharts(page)).every(({ label }) => label.startsWith("circumferential strain against")), JSON.stringify(charts));
}

async function checkPicking(page) {
  await page.locator("canvas.wall").scrollIntoViewIfNeeded();
  const box = await page.locator("canvas.wall").boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height * 0.55];
  await page.mouse.move(middle[0] + 3, middle[1]);
  await page.mouse.move(...middle);
  await settled(page);
  const read = await page.locator("#wall .read").innerText();
  const place = read.match(/here: ([\d.−]+); segment (\d+) (.*), slice and sector (\d) (\w+)/);
  check("pointing at the wall reads a value, a segment, a slice and a sector", place !== null, read);
  const marked = () => page.locator("svg.bullseye").evaluateAll((all) =>
    all.map((one) => [...one.querySelectorAll("path.live")].every((path) => path.getAttribute("d"))));
  check("and marks the segment in the bull's-eyes", (await marked()).join() === "true,false,true,false", await marked());
  check("and its numbers are read out", (await page.locator("#regions .read").innerText()).includes(place?.[3] ?? "?"));
  await page.mouse.move(5, 5);
  await settled(page);
  check("leaving the wall lets go", !(await marked()).some(Boolean), await marked());
  const before = await pixels(page, "canvas.wall");
  await page.locator("svg.bullseye >> nth=3").locator("[data-index='8']").hover({ force: true });
  const after = await pixels(page, "canvas.wall");
  check("pointing at a bull's-eye outlines the region on the wall, and fades nothing", before.print !== after.print && Math.abs(before.drawn - after.drawn) < 0.02,
    JSON.stringify({ before, after }));
  check("and names it in the picture", (await page.locator("#wall text.region").textContent()) === "3 infsept", await page.locator("#wall text.region").textContent());
  const stops = await page.locator("svg.bullseye").evaluateAll((all) => all.map((one) => one.querySelectorAll("[tabindex='0']").length));
  check("a bull's-eye is one tab stop", stops.every((count) => count === 1), stops);
  await page.locator("svg.bullseye >> nth=2").locator("[data-index='0']").focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowDown");
  const focused = await page.evaluate(() => document.activeElement.getAttribute("aria-label"));
  check("arrow keys go around a ring and to the next", focused.startsWith("8 mid anteroseptal"), focused);
  await page.keyboard.press("Enter");
  check("the keyboard keeps a region marked", (await marked()).join() === "true,false,true,false", await marked());
  await page.keyboard.press("Enter");
}

/** Whether the regional means of a quantity are regions.csv's; what differs. */
async function differing(page, rows, quantity) {
  await page.selectOption("#wall select >> nth=0", quantity);
  const shown = await page.locator("svg.bullseye").evaluateAll((all) => all.map((one) =>
    [...one.querySelectorAll("[data-index]")].sort((a, b) => a.dataset.index - b.dataset.index).map((path) => path.getAttribute("aria-label"))));
  const plots = ["end_diastole", "end_systole"].flatMap((state) => ["aha17", "sector"].map((scheme) =>
    rows.filter((r) => r.state === state && r.scheme === scheme && r.quantity === quantity)));
  if (plots.flat().length !== 110) return [`${plots.flat().length} rows`];
  return plots.flatMap((plot, p) => plot.flatMap((row, i) => {
    const [name, numbers] = shown[p][i].split(": ");
    const [mean, sd] = numbers.split(" ± ").map(number);
    return name === row.region && close(mean, Number(row.mean), 0.006) && close(sd, Number(row.sd), 0.006) ? []
      : [`${shown[p][i]} instead of ${row.region} ${row.mean} ${row.sd}`];
  }));
}

const cellsOf = (rows) => rows.evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));

async function checkNumbers(page) {
  const summary = JSON.parse(readFileSync(join(work, "04_results/summary.json"), "utf8"));
  const read = Object.fromEntries((await cellsOf(page.locator("#summary tbody tr"))).map((cells) => cells.slice(0, 2)));
  const expected = { "end-diastolic volume (ml)": summary.edv_ml, "end-systolic volume (ml)": summary.esv_ml, "ejection fraction (%)": summary.ejection_fraction_percent,
    "circumferential strain (%)": 100 * summary.whole_wall.end_systole.circumferential_strain.mean };
  for (const [name, value] of Object.entries(expected))
    check(`${name} is summary.json's`, close(number(read[name] ?? "–"), value, 0.005), `${read[name]} ${value}`);
  const rows = csv(join(work, "04_results/regions.csv"));
  for (const quantity of ["fibre_stress", "radial_strain", "J", "active_tension"]) {
    const wrong = await differing(page, rows, quantity);
    check(`bull's-eyes of ${quantity} are regions.csv's`, wrong.length === 0, wrong.slice(0, 3).join("; "));
  }
  const thirds = await cellsOf(page.locator("#normal tbody tr"));
  const fibre = ["basal", "middle", "apical"].map((third) => Number(rows.find((r) => r.state === "end_systole" && r.region === third && r.quantity === "fibre_strain").mean));
  check("fibre strain per third is regions.csv's", fibre.every((mean, i) => close(number(thirds[0][i + 1].split(" ± ")[0]), mean, 0.006)), thirds[0]);
  const mesh = csv(join(work, "02_mesh/quality.csv"));
  const meshRows = await cellsOf(page.locator("#input table").last().locator("tbody tr"));
  check("the mesh's figures are quality.csv's", mesh.length === meshRows.length && mesh.every((r, i) => r.quantity === meshRows[i][0] && close(number(meshRows[i][1]), Number(r.value), Number.isInteger(Number(r.value)) ? 1e-6 : 5e-4)), JSON.stringify(meshRows.slice(2, 4)));
  const turned = csv(join(work, "04_results/rotation.csv")).map((r) => Number(r.end_diastole_to_end_systole_deg));
  const shownTurn = await page.locator("#rotation tbody tr td:nth-child(2)").allInnerTexts();
  check("rotation is rotation.csv's", turned.length === 7 && turned.every((deg, i) => close(number(shownTurn[i]), deg, 0.006)), shownTurn);
}

/** The colours of a bull's-eye of end-diastolic tension, nearly nothing, on the page and among the run's figures. */
async function checkFloor(page) {
  await page.selectOption("#wall select >> nth=0", "active_tension");
  const fills = await page.locator("svg.bullseye").first().locator("[data-index]").evaluateAll((all) => [...new Set(all.map((one) => one.getAttribute("fill")))]);
  check("a tension of nearly nothing has no colour", fills.join() === "rgb(236,234,231)", fills);
  const figure = readFileSync(join(work, "05_report/figures/bulls_eyes_active_tension_end_diastole.svg"), "utf8");
  const parts = [...figure.matchAll(/fill:rgb\(([\d.]+)%,([\d.]+)%,([\d.]+)%\)/g)].map((match) => match.slice(1).map((part) => Math.round(2.55 * part)).join());
  check("and none in the figure that the run writes", parts.filter((colour) => colour === "236,234,231").length >= 38 + 17, [...new Set(parts)]);
  await page.selectOption("#wall select >> nth=0", "circumferential_strain");
}

/** The PNG of the wall as the page saves it: colours in its lower left corner, where the legend is, and dark letters above. */
async function checkSavedWall(page) {
  const { bytes } = await saved(page, page.locator("#wall button.save").first());
  const { width, x, y } = await page.evaluate(() => {
    const letter = document.querySelector("#wall text.letter[visibility=visible]");
    return { width: document.querySelector("canvas.wall").clientWidth, x: Number(letter.getAttribute("x")), y: Number(letter.getAttribute("y")) };
  });
  const scale = bytes.readUInt32BE(16) / width;  // of the PNG's own width
  const at = (...box) => box.map((part) => Math.round(scale * part));
  const seen = await coloursIn(page, bytes, { legend: at(10, -34, 190, 10), caption: at(10, 8, 120, 16), bar: at(-40, -30, 36, 16), letter: at(x - 8, y - 8, 16, 16) });
  check("a saved picture of the wall has legend, caption, letters and scale bar", seen.legend > 60 && seen.caption > 5 && seen.letter > 5 && seen.bar > 1, JSON.stringify(seen));
}

/** All that the save buttons hand to the browser: names, sizes and how the contents begin; all of the text of tables and JSON. */
const handedOver = (page) => page.evaluate(async () => {
  const [make, click] = [URL.createObjectURL, HTMLAnchorElement.prototype.click];
  const all = [];
  let blob;
  let done;
  URL.createObjectURL = (one) => make.call(URL, (blob = one));
  HTMLAnchorElement.prototype.click = function () { done({ name: this.download, blob }); };
  for (const button of document.querySelectorAll("button.save")) {
    const { name, blob: content } = await new Promise((given) => { done = given; button.click(); });
    const isText = /\.(csv|json)$/.test(name);
    all.push({ name, size: content.size, text: await (isText ? content : content.slice(0, 300)).text() });
  }
  [URL.createObjectURL, HTMLAnchorElement.prototype.click] = [make, click];
  return all;
});

const isGood = (kind, { size, text }) => kind === "png" ? text.slice(1, 4) === "PNG" && size > 3000
  : kind === "svg" ? /^<svg[^>]*xmlns/.test(text) && size > 1000
  : kind === "csv" ? text.split("\n").length > 2 : Object.keys(JSON.parse(text)).length > 1;

export async function checkDownloads(page, run) {
  const kindOf = (name) => name.slice(name.lastIndexOf(".") + 1);
  const all = await handedOver(page);
  const counts = all.reduce((sum, { name }) => ({ ...sum, [kindOf(name)]: (sum[kindOf(name)] ?? 0) + 1 }), {});
  const wrong = all.filter((one) => !isGood(kindOf(one.name), one)).map(({ name }) => name);
  const original = { "regions.csv": "04_results", "curves.csv": "03_beat", "summary.json": "04_results", "strain_agreement.json": "04_results" };
  for (const { name, text } of all)
    for (const [file, stage] of Object.entries(original))
      if (name.endsWith(`-${file}`) && !name.includes("-whole") && text !== readFileSync(join(run, stage, file), "utf8")) wrong.push(`${name} differs`);
  check("every save button saves what it says", wrong.length === 0 && counts.png > 10 && counts.svg > 9 && counts.csv > 8, JSON.stringify({ counts, wrong }));
  // the browser itself, one file of each kind
  const lost = [];
  for (const kind of ["png", "svg", "csv", "json"]) {
    const number = all.findIndex(({ name }) => kindOf(name) === kind);
    const { name, bytes } = await saved(page, page.locator("button.save").nth(number));
    if (name !== all[number].name || !isGood(kind, { size: bytes.length, text: bytes.toString() })) lost.push(`${name} ${bytes.length}`);
  }
  check("and the browser keeps it under its name", lost.length === 0, lost.join("; "));
}

async function checkSpeed(page) {
  const { fps, script, processor, count } = await scrub(browser, page, 30);
  console.log(`info  scrubbing 30 moments (of ${count}): ${fps.toFixed(1)} frames per second, software rendering; ` +
    `${script.toFixed(1)} ms of script and ${processor.toFixed(1)} ms of processor time a frame`);
  check("a moment takes less than 200 ms of processor time, software rendering", processor < 200, processor);
}

/** A page whose bytes stop for a while in the middle of an array, as on a slow line or a busy machine. */
async function checkSlowArrival() {
  const html = readFileSync(join(folder, "page.html"));
  const begin = html.indexOf('id="case0-0">');
  const middle = Math.round((begin + html.indexOf("</script>", begin)) / 2);
  let rest;
  const server = createServer((request, answer) => {
    answer.writeHead(200, { "Content-Type": "text/html" });
    answer.write(html.subarray(0, middle));
    rest = () => answer.end(html.subarray(middle));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const page = await newPage(browser, { offline: false });
  await page.goto(`http://127.0.0.1:${server.address().port}/`, { waitUntil: "commit" });
  await page.waitForFunction(() => document.body?.dataset.first);
  check("the numbers are there before the arrays have come", (await page.locator("#summary tbody tr").count()) > 3 && !(await page.evaluate(() => document.body.dataset.ready)));
  rest();
  const failure = await drawn(page).then(() => "", (error) => error.message);
  check("a page that stops on its way in the middle of an array is drawn when the rest has come", failure === "", failure);
  await page.context().close();
  server.close();
}

/** The pictures that a page opens with, before any array is unpacked, beside the walls that take their place. */
export async function checkOpening(file, count, isInfarcted = false) {
  const settings = { viewport: { width: 1280, height: 720 } };
  const early = await newPage(browser, settings);
  await early.addInitScript(() => { Blob.prototype.stream = () => new ReadableStream(); });
  await early.goto(pathToFileURL(join(folder, file)).href);
  await early.waitForFunction(() => document.body?.dataset.first);
  const late = await openPage(browser, join(folder, file), settings);
  await settled(late);
  const shots = await Promise.all([early, late].map(async (page) => (await page.locator("#wall .cases").screenshot()).toString("base64")));
  const { both, one } = await late.evaluate(async (shots) => {
    const all = await Promise.all(shots.map(async (data) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    const isDrawn = (data, i) => data[i] + data[i + 1] + data[i + 2] < 740;
    let [both, one] = [0, 0];
    for (let i = 0; i < all[0].length; i += 4) {
      const [a, b] = all.map((data) => isDrawn(data, i));
      if (a && b) ++both;
      else if (a || b) ++one;
    }
    return { both, one };
  }, shots);
  const pictures = await early.locator("img.opening").count();
  const rims = (await early.locator("img.opening").evaluateAll((all) => all.map((one) => one.src.split(",")[1]))).map((data) => rimPixels(late, Buffer.from(data, "base64")));
  check(isInfarcted ? "and with the infarct's border" : "and without a border where there is no infarct", (await Promise.all(rims)).every((count) => (isInfarcted ? count > 200 : count === 0)));
  check(`${file} opens with ${count} picture(s) of the wall, with words, letters and legend, where the wall then is`, pictures === count && both > 20_000 && one < 0.03 * both,
    `${pictures} ${both} ${one}`);
  await early.context().close();
  await late.context().close();
}

/** Of the parameters print has those that the case file sets, and says how many have their defaults. */
async function checkPrintedParameters(page) {
  const { parameters, set_in_case_file: set } = JSON.parse(readFileSync(join(work, "04_results/summary.json"), "utf8"));
  const seen = () => page.locator("#parameters details").evaluate((one) => {
    one.open = true;
    return { names: [...one.querySelectorAll("tbody tr")].filter((row) => row.getClientRects().length).map((row) => row.firstChild.textContent),
      words: one.innerText };
  });
  const onScreen = await seen();
  await page.emulateMedia({ media: "print" });
  const printed = await seen();
  await page.emulateMedia({ media: "screen" });
  const [all, few] = [parameters, set].map((one) => Object.keys(one).length);
  check("all parameters stand on the screen, in print those that were set", onScreen.names.length === all && few > 3 && printed.names.sort().join() === Object.keys(set).sort().join(),
    `${onScreen.names.length} ${all} ${printed.names}`);
  check("and print says how many have their defaults", printed.words.includes(`Printed are the ${few} `) && printed.words.includes(`other ${all - few} have`) && !onScreen.words.includes("Printed"),
    printed.words.slice(-200));
}

export async function checkPage() {
  const { page, said, asked, close: done } = await open("page.html");
  const megabytes = statSync(join(folder, "page.html")).size / 1e6;
  const { first, wall, ready } = await page.evaluate(() => ({ ...document.body.dataset }));
  console.log(`info  the page has ${megabytes.toFixed(2)} MB; after its start its numbers are there in ${first} ms, the wall in ${wall} ms, all of it in ${ready} ms`);
  check("the page is smaller than 15 MB", megabytes < 15, megabytes);
  await checkFirstScreen(page);
  await checkAccessible(page, "a page", "light");
  await checkPhone(page);
  await checkDrawn(page);
  await checkControls(page);
  await checkPicking(page);
  await checkSegments(page);
  await checkNumbers(page);
  await checkFloor(page);
  await checkSavedWall(page);
  await checkDownloads(page, work);
  await checkSpeed(page);
  check("it prints", (await page.pdf()).length > 30_000);
  await checkPrintedParameters(page);
  check("no error is reported", said.length === 0, said.join("\n"));
  check("nothing is asked from a network", nothingAsked(asked), asked.join(" "));
  await done();
  await checkSlowArrival();
  await checkOpening("page.html", 1);
}
