// The page of a run in a real browser, opened from a file without a network.
// node check.mjs VENTRICLE [--work WORK] [--images WORK]   exit code 77: skipped
// WORK: folders of runs that are there, of a case with flow and of one with a cine; without, small ones are run.
import { execFile } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { lacking, launch, openPage, root, scrub } from "./browser.mjs";
import { thickSeptum } from "./thick_septum.mjs";

const program = resolve(process.argv[2]);
const option = (name) => (process.argv.includes(name) ? resolve(process.argv[process.argv.indexOf(name) + 1]) : undefined);

if (lacking) { console.log(`skipped: ${lacking}`); process.exit(77); }

let failed = 0;
function check(claim, holds, detail = "") {
  console.log(`${holds ? "pass" : "FAIL"}  ${claim}${!holds && detail !== "" ? `: ${detail}` : ""}`);
  if (!holds) ++failed;
}
const close = (a, b, tolerance) => (Number.isNaN(a) && Number.isNaN(b)) || Math.abs(a - b) <= tolerance * Math.max(Math.abs(b), 1e-12);
const number = (text) => (text.trim() === "–" ? NaN : parseFloat(text.replace("−", "-")));

function csv(file) {
  const [head, ...rows] = readFileSync(file, "utf8").trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(head.map((name, i) => [name, row[i] === "" ? NaN : row[i]])));
}

const folder = mkdtempSync(join(tmpdir(), "ventricle_page_"));
const work = option("--work") ?? join(folder, "small.work");
const images = option("--images") ?? join(folder, "images.work");
const execute = promisify(execFile);
const ventricle = (...args) => execute(program, args, { cwd: folder, maxBuffer: 1 << 28 });

/** A phantom of few images and large elements through the quasi-static engine. */
async function runImages() {
  await ventricle("phantom", "study", "--phases", "6", "--field-of-view", "150", "--shortening", "0.12", "--nifti", "true");
  const file = join(folder, "study/coarse.toml");
  writeFileSync(file, `engine = "quasi_static"\n${readFileSync(join(folder, "study/case.toml"), "utf8")}`);
  await ventricle("run", file, "--work", images, "--ranks", "1");
}

/** A mesh with an infarct of its anterior wall, a little towards the septum, in a heart that is turned about its long axis. */
async function meshInfarct() {
  writeFileSync(join(folder, "turned.toml"), ["name = 'turned'", "engine = 'quasi_static'", "[regions]", "septum_angle = '70 deg'", "[infarct]",
    "source = 'described'", "[infarct.described]", "angle = '60 deg'", "width = '70 deg'", "top = 1.0", "apex = 0.0"].join("\n"));
  await ventricle("run", "turned.toml", "--until", "mesh", "--ranks", "1");
  await ventricle("report", "turned.work", "--output", "turned.html");
}

const fit = { measured: [131.5, 61.25], C_a: 1.234, below: 1.111, above: 1.358 };

/** The run as if its parameters had been fitted, its septum assumed, and more left in the cavity than was in it. */
async function pretendFit() {
  const to = join(folder, "fitted.work");
  cpSync(work, to, { recursive: true });
  const file = join(to, "04_results/summary.json");
  const summary = JSON.parse(readFileSync(file, "utf8"));
  summary.calibration = ["EDV", "ESV"].map((volume, i) => ({ volume, measured_ml: fit.measured[i], quasi_static_ml: 130, beat_ml: 129, within_tolerance: false }));
  summary.assumptions = [{ part: "septum", text: "the septum is assumed on the x axis" }, { part: "apex", text: "the apex is continued below the last contour" }];
  summary.marks = { edv_ml: "fitted", end_diastole: "computed", "end_diastole.pressure_mmHg": "assumed" };
  const judged = { unit: "%", low: 48, high: 77, source: "a study" };
  summary.plausibility = [
    { quantity: "ejection_fraction_percent", label: "ejection fraction", value: -26, answer: "outside", reason: "it holds more", impossible: true, ...judged },
    { quantity: "apex_rotation_deg", label: "rotation of the apex", value: 30, answer: "outside", reason: "", impossible: false, ...judged },
    { quantity: "circumferential_strain", label: "circumferential strain", value: -0.1, answer: "not applicable", reason: "an infarct", impossible: false, ...judged },
    { quantity: "edv_ml", label: "end-diastolic volume", value: 131, answer: "within", reason: "", impossible: false, ...judged }];
  writeFileSync(file, JSON.stringify(summary));
  mkdirSync(join(to, "02b_calibrate"), { recursive: true });
  writeFileSync(join(to, "02b_calibrate/calibration.json"), JSON.stringify({ uncertainty: [{ parameter: "C_a", value: fit.C_a,
    when_off: [{ measurement: "EDV", by: "5%", below: fit.below, above: fit.above }] }], ambiguities: ["One volume determines one parameter."] }));
  await ventricle("report", to, "--output", "fitted.html");
}

const ofBeats = (name) => csv(join(folder, name, "03_beat/beats.csv"));

/** The run as if its wall had beaten: with the beats of a circulation alone, for two resistances. */
async function pretendBeats() {
  for (const [name, R_p] of [["beats", 1.05], ["stiff", 1.6]]) {
    writeFileSync(join(folder, `${name}.toml`), ["[circulation]", "kind = 'windkessel'", "step = '2 ms'", "beats = 2", `windkessel.R_p = '${R_p} mmHg s/ml'`].join("\n"));
    await ventricle("circulation", `${name}.toml`, "--work", `${name}.circuit`);
    const to = join(folder, `${name}.work`);
    cpSync(work, to, { recursive: true });
    rmSync(join(to, "03_beat/curves.csv"));
    for (const table of ["cycle.csv", "beats.csv"]) cpSync(join(folder, `${name}.circuit/00_circulation`, table), join(to, "03_beat", table));
    const file = join(to, "04_results/summary.json");
    const last = ofBeats(`${name}.work`).at(-1);
    const summary = { ...JSON.parse(readFileSync(file, "utf8")), case: name, cycle: { last_beat: { peak_pressure_mmHg: Number(last.peak_pressure_mmHg) } } };
    if (name === "beats") summary.heartbeats_fitted = [{ datum: "EDV", unit: "ml", measured: 141.25, fit: 141.1, beat: 140.9, within_tolerance: true }];
    writeFileSync(file, JSON.stringify(summary));
  }
  mkdirSync(join(folder, "beats.work/02b_calibrate"), { recursive: true });
  writeFileSync(join(folder, "beats.work/02b_calibrate/heartbeats.json"), JSON.stringify({ left_alone: ["The contractility keeps the case's value"],
    parameters: [{ parameter: "circulation.windkessel.p_ven", words: "filling pressure", unit: "mmHg", fitted_to: "EDV", before: 8, value: 9.876,
      when_off: [{ measurement: "EDV", by: "5%", below: 8.765, above: 11.25 }] }],
    data: [{ name: "EDV", d_ln_datum_by_d_ln: { "circulation.windkessel.p_ven": 0.4321 } }] }));
  await ventricle("report", "beats.work", "--output", "beats.html");
  await ventricle("compare", "beats.work", "stiff.work", "--output", "loops.html");
}

async function makeHalf() {
  const half = join(folder, "half.work");
  cpSync(work, half, { recursive: true });
  for (const stage of ["04_results", "05_report"]) rmSync(join(half, stage), { recursive: true, force: true });
  if (existsSync(join(half, "03_beat"))) renameSync(join(half, "03_beat"), join(half, "03_beat.part"));
  await ventricle("report", half, "--output", "half.html");
  rmSync(join(half, "03_beat.part"), { recursive: true, force: true });
  await ventricle("report", half, "--output", "mesh.html");
}

/** On two processors at most: the phantom beside all that follows from the small run. */
async function makePages() {
  const ofPhantom = existsSync(images) ? undefined : runImages();
  if (!existsSync(work)) await ventricle("run", join(root, "tests/regress/small.toml"), "--work", work, "--ranks", "1");
  await ventricle("report", work, "--output", "page.html");
  await ventricle("compare", work, work, "--output", "compare.html");
  await pretendFit();
  await pretendBeats();
  await makeHalf();
  await meshInfarct();
  thickSeptum(join(folder, "thick.work"), 70);
  await ventricle("report", "thick.work", "--output", "thick.html");
  rmSync(join(folder, "thick.work/03_beat/wall.pvd"));
  await ventricle("report", "thick.work", "--output", "blood.html");
  await ofPhantom;
  await ventricle("report", images, "--output", "images.html");
  await ventricle("compare", images, work, "--output", "mixed.html");
}

const browser = await launch();

/** Opens a page and watches what it says and asks for. */
async function open(file, viewport = { width: 1200, height: 900 }) {
  const said = [];
  const asked = [];
  const page = await openPage(browser, resolve(folder, file), { viewport }, (one) => {
    one.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|swiftshader/i.test(message.text()) && said.push(message.text()));
    one.on("pageerror", (error) => said.push(error.stack));
    one.on("request", (request) => asked.push(request.url()));
  });
  await page.evaluate(() => document.getElementById("flow").scrollIntoView());
  await page.waitForFunction(() => document.querySelector("#flow canvas, #flow .missing"), null, { timeout: 60_000 });
  return { page, said, asked, close: () => page.context().close() };
}

const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 350)  /* longer than the view takes to come to rest */))));

/** A short text that stands for a canvas's pixels, with the share of them that are not white and the number of colours. */
async function pixels(page, selector, nth = 0) {
  await settled(page);
  return page.locator(selector).nth(nth).evaluate((canvas) => {
    const small = document.createElement("canvas");
    [small.width, small.height] = [160, 110];
    const context = small.getContext("2d", { willReadFrequently: true });
    context.fillStyle = "#fff";
    context.fillRect(0, 0, 160, 110);
    context.drawImage(canvas, 0, 0, 160, 110);
    const { data } = context.getImageData(0, 0, 160, 110);
    let drawn = 0;
    let sum = 0;
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] + data[i + 1] + data[i + 2] < 750) ++drawn;
      colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      for (let d = 0; d < 3; ++d) sum = (sum * 31 + data[i + d]) % 4294967291;
    }
    return { print: sum, drawn: drawn / 17600, colours: colours.size };
  });
}

async function setSlider(page, selector, value) {
  await page.locator(selector).evaluate((input, to) => { input.value = to; input.dispatchEvent(new Event("input")); }, value);
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
  check("all charts have their lines", charts.length === 7 && charts.every((length) => length > 40), charts);
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

async function checkPicking(page) {
  await page.locator("canvas.wall").scrollIntoViewIfNeeded();
  const box = await page.locator("canvas.wall").boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height * 0.55];
  await page.mouse.move(middle[0] + 3, middle[1]);
  await page.mouse.move(...middle);
  await page.waitForTimeout(300);
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

async function checkNumbers(page) {
  const summary = JSON.parse(readFileSync(join(work, "04_results/summary.json"), "utf8"));
  const read = Object.fromEntries(await page.locator("#summary tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent).slice(0, 2))));
  const expected = { "end-diastolic volume (ml)": summary.edv_ml, "end-systolic volume (ml)": summary.esv_ml, "ejection fraction (%)": summary.ejection_fraction_percent,
    "circumferential strain (%)": 100 * summary.whole_wall.end_systole.circumferential_strain.mean };
  for (const [name, value] of Object.entries(expected))
    check(`${name} is summary.json's`, close(number(read[name] ?? "–"), value, 0.005), `${read[name]} ${value}`);
  const rows = csv(join(work, "04_results/regions.csv"));
  const regional = (state, scheme, quantity) => rows.filter((r) => r.state === state && r.scheme === scheme && r.quantity === quantity);
  let wrong = [];
  for (const quantity of ["active_tension", "fibre_stress", "radial_strain", "J"]) {
    await page.selectOption("#wall select >> nth=0", quantity);
    await settled(page);
    const shown = await page.locator("svg.bullseye").evaluateAll((all) => all.map((one) =>
      [...one.querySelectorAll("[data-index]")].sort((a, b) => a.dataset.index - b.dataset.index).map((path) => path.getAttribute("aria-label"))));
    const plots = ["end_diastole", "end_systole"].flatMap((state) => ["aha17", "sector"].map((scheme) => regional(state, scheme, quantity)));
    plots.forEach((plot, p) => plot.forEach((row, i) => {
      const [name, numbers] = shown[p][i].split(": ");
      const [mean, sd] = numbers.split(" ± ").map(number);
      if (name !== row.region || !close(mean, Number(row.mean), 0.006) || !close(sd, Number(row.sd), 0.006))
        wrong.push(`${shown[p][i]} instead of ${row.region} ${row.mean} ${row.sd}`);
    }));
    check(`bull's-eyes of ${quantity} are regions.csv's`, plots.flat().length === 110 && wrong.length === 0, wrong.slice(0, 3).join("; "));
    wrong = [];
  }
  const thirds = await page.locator("#normal tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  const fibre = ["basal", "middle", "apical"].map((third) => Number(rows.find((r) => r.state === "end_systole" && r.region === third && r.quantity === "fibre_strain").mean));
  check("fibre strain per third is regions.csv's", fibre.every((mean, i) => close(number(thirds[0][i + 1].split(" ± ")[0]), mean, 0.006)), thirds[0]);
  const mesh = csv(join(work, "02_mesh/quality.csv"));
  const meshRows = await page.locator("#input table").last().locator("tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  check("the mesh's figures are quality.csv's", mesh.length === meshRows.length && mesh.every((r, i) => r.quantity === meshRows[i][0] && close(number(meshRows[i][1]), Number(r.value), 1e-6)), JSON.stringify(meshRows.slice(2, 4)));
  const turned = csv(join(work, "04_results/rotation.csv")).map((r) => Number(r.end_diastole_to_end_systole_deg));
  const shownTurn = await page.locator("#rotation tbody tr td:nth-child(2)").allInnerTexts();
  check("rotation is rotation.csv's", turned.length === 7 && turned.every((deg, i) => close(number(shownTurn[i]), deg, 0.006)), shownTurn);
}

async function checkDownloads(page, work) {
  const buttons = page.locator("button.save");
  const kinds = {};
  const wrong = [];
  for (let i = 0; i < (await buttons.count()); ++i) {
    await page.waitForTimeout(150);  // Chromium drops downloads beyond ten a second
    const [download] = await Promise.all([page.waitForEvent("download"), buttons.nth(i).evaluate((button) => button.click())]);
    const name = download.suggestedFilename();
    const contents = readFileSync(await download.path());
    const kind = name.slice(name.lastIndexOf(".") + 1);
    kinds[kind] = (kinds[kind] ?? 0) + 1;
    const good = kind === "png" ? contents.subarray(1, 4).toString() === "PNG" && contents.length > 3000
      : kind === "svg" ? /^<svg[^>]*xmlns/.test(contents) && contents.length > 1000
      : kind === "csv" ? contents.toString().split("\n").length > 2 : Object.keys(JSON.parse(contents)).length > 1;
    if (!good) wrong.push(name);
    const original = { "regions.csv": "04_results", "curves.csv": "03_beat", "summary.json": "04_results", "strain_agreement.json": "04_results" };
    for (const [file, stage] of Object.entries(original))
      if (name.endsWith(`-${file}`) && !name.includes("-whole") && !contents.equals(readFileSync(join(work, stage, file)))) wrong.push(`${name} differs`);
  }
  check("every save button saves what it says", wrong.length === 0 && kinds.png > 10 && kinds.svg > 9 && kinds.csv > 8, JSON.stringify({ kinds, wrong }));
}

async function checkSpeed(page) {
  const { fps, script, processor, count } = await scrub(browser, page);
  console.log(`info  scrubbing 60 moments (of ${count}): ${fps.toFixed(1)} frames per second, software rendering; ` +
    `${script.toFixed(1)} ms of script and ${processor.toFixed(1)} ms of processor time a frame`);
  check("a moment takes less than 200 ms of processor time, software rendering", processor < 200, processor);
}

const dot = (a, b) => a.reduce((sum, v, d) => sum + v * b[d], 0);
const vector = (row, name, end) => ["x", "y", "z"].map((axis) => Number(row[`${name}_${axis}${end}`]));

/** Where outlines.csv puts the first point of each line over an image, in mm from its upper left corner. */
function firstPoints(state, slice) {
  const place = csv(join(images, "04_results/pictures/pictures.csv")).find((r) => r.state === state && r.slice === String(slice));
  const spacing = [Number(place.spacing_i_mm), Number(place.spacing_j_mm)];
  return csv(join(images, "04_results/outlines.csv")).filter((r) => r.state === state && r.slice === String(slice) && r.point === "1").map((r) => {
    const from = ["x_mm", "y_mm", "z_mm"].map((name, d) => Number(r[name]) - vector(place, "origin", "_mm")[d]);
    return { source: r.source, at: [dot(from, vector(place, "along_row", "")) + spacing[0] / 2, dot(from, vector(place, "along_column", "")) + spacing[1] / 2] };
  });
}

/** Where septum and anterior wall lie in a short-axis image, to its right and down, from the model's frame and the recorded angle. */
function wallDirections(slice) {
  const frame = JSON.parse(readFileSync(join(images, "01_anatomy/frame.json"), "utf8"));
  const place = csv(join(images, "04_results/pictures/pictures.csv")).find((r) => r.slice === String(slice));
  const septum = parseFloat(JSON.parse(readFileSync(join(images, "02_mesh/stage.json"), "utf8")).ingredients["regions.septum_angle"].replaceAll('"', "")) * Math.PI / 180;
  const at = (angle) => {
    const inSpace = frame.x_axis_in_image_space.map((x, d) => x * Math.cos(angle) + frame.y_axis_in_image_space[d] * Math.sin(angle));
    return ["along_row", "along_column"].map((name) => dot(inSpace, vector(place, name, "")));
  };
  return { septal: at(septum), anterior: at(septum + Math.PI / 2) };
}

async function checkOutlines(page) {
  await page.waitForSelector("#outlines svg.outlined");
  const listed = csv(join(images, "04_results/pictures/pictures.csv"));
  const look = () => page.locator("#outlines figure svg.outlined").evaluate(async (root) => {
    const picture = new Image();
    picture.src = root.querySelector("image").getAttribute("href");
    await picture.decode();
    const toPage = root.querySelector("path").getCTM();
    const box = root.getCTM();
    return { slice: root.dataset.slice, width: picture.naturalWidth, png: picture.src.length, label: root.getAttribute("aria-label"),
      starts: [...root.querySelectorAll("path")].map((path) => {
        const at = new DOMPoint(...path.getAttribute("d").match(/^M([-\d.]+) ([-\d.]+)/).slice(1).map(Number)).matrixTransform(box.inverse().multiply(toPage));
        return { source: path.dataset.source, at: [at.x, at.y] };
      }) };
  });
  const seen = [];
  const longAxes = await page.locator('#outlines .sheet svg[data-slice^="long axis"]').evaluateAll((all) => all.map((root) =>
    ["model", "contours"].map((source) => root.querySelectorAll(`path[data-source=${source}]`).length).join()));
  check("long axes have images too, with both outlines of the model and the curves drawn", longAxes.length === 3 && longAxes.every((counts) => counts === "2,2"), longAxes);
  for (const state of ["end_diastole", "end_systole"]) {
    await page.locator(`#outlines [data-state=${state}]`).click();
    check(`all slices have an image at ${state}`, (await page.locator("#outlines .sheet svg").count()) === listed.filter((r) => r.state === state).length);
    const now = await look();
    seen.push(now);
    const expected = firstPoints(state, now.slice);
    check(`${state}: an image of the size in pictures.csv`, now.width === Number(listed.find((r) => r.state === state && r.slice === now.slice).columns), now.width);
    check(`${state}: model and contours lie over it where outlines.csv has them`, expected.length === now.starts.length && expected.length >= 4 &&
      ["model", "contours"].every((source) => expected.some((e) => e.source === source)) &&
      expected.every((e, i) => e.source === now.starts[i].source && e.at.every((x, d) => Math.abs(x - now.starts[i].at[d]) < 0.03)),
      JSON.stringify({ expected, starts: now.starts }));
  }
  const placed = await page.locator("#outlines figure text.letter").evaluateAll((all) => Object.fromEntries(all.map((one) => [one.textContent[0], [Number(one.getAttribute("x")), Number(one.getAttribute("y"))]])));
  const expected = wallDirections(seen[1].slice);
  const away = (a, b) => placed[a].map((x, d) => x - placed[b][d]);
  const along = (v, w) => dot(v, w) / Math.hypot(...v) / Math.hypot(...w);
  check("letters over an image lie where the frame has the walls", Object.keys(placed).sort().join() === "A,I,L,S" && along(away("A", "I"), expected.anterior) > 0.95 &&
    along(away("S", "L"), expected.septal) > 0.95, JSON.stringify({ placed, expected }));
  check("the two moments have different images", seen[0].png !== seen[1].png || JSON.stringify(seen[0].starts) !== JSON.stringify(seen[1].starts));
  await setSlider(page, "#outlines input[type=range]", 1);
  check("the slider goes to another slice", (await look()).slice !== seen[1].slice);
  await page.locator("#outlines .thumb").last().click();
  const last = listed.filter((r) => r.state === "end_systole").at(-1).slice;
  check("a small image becomes the large one", (await look()).slice === last);
  const distances = csv(join(images, "04_results/outline_distances.csv"));
  const shownRows = await page.locator("#outlines tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  check("distances are outline_distances.csv's, missing ones a dash", shownRows.length === distances.length &&
    distances.every((r, i) => close(number(shownRows[i][2]), Number(r.mean_mm), 0.006) && close(number(shownRows[i][4]), Number(r.largest_mm), 0.006)), shownRows[0]);
}

async function checkStrain(page) {
  const all = JSON.parse(readFileSync(join(images, "04_results/strain_agreement.json"), "utf8"));
  const tables = await page.locator("#strain table").evaluateAll((some) => some.map((one) =>
    [...one.querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent))));
  const a = all.circumferential.sector;
  const row = tables[0].find((r) => r[0] === "circumferential, sectors of slices");
  check("agreement is strain_agreement.json's", row && number(row[1]) === a.count && close(number(row[2]), a.bias, 0.006) && close(number(row[3]), a.standard_deviation, 0.006) &&
    close(number(row[4].split(" to ")[0]), a.lower_limit, 0.006), row);
  const pairs = csv(join(images, "04_results/strain_comparison_circumferential.csv")).filter((r) => r.scheme === "sector");
  const differences = pairs.map((r) => Number(r.model) - Number(r.measured));
  const mean = differences.reduce((sum, d) => sum + d, 0) / pairs.length;
  const sd = Math.sqrt(differences.reduce((sum, d) => sum + (d - mean) ** 2, 0) / (pairs.length - 1));
  check("which is the table's", close(a.bias, mean, 1e-3) && close(a.upper_limit - a.lower_limit, 3.92 * sd, 1e-3), `${a.bias} ${mean}`);
  const aha = csv(join(images, "04_results/strain_comparison_radial.csv")).filter((r) => r.scheme === "aha17");
  check("strain per segment is strain_comparison_*.csv's", aha.length > 10 && aha.every((r) => {
    const shownRow = tables[2].find((cells) => cells[0] === r.segment);
    return shownRow && close(number(shownRow[4]), Number(r.measured), 0.006) && close(number(shownRow[5]), Number(r.model), 0.006);
  }), JSON.stringify(tables[2]?.[0]));
  const dots = await page.locator("#strain svg.chart").evaluateAll((charts) => charts.map((chart) => chart.querySelectorAll("circle:not(.live, .key)").length));
  check("four charts have a dot a region", dots.length === 4 && dots[0] === pairs.length && dots[1] === pairs.length, dots);
}

async function checkImages() {
  const { page, said, asked, close: done } = await open("images.html");
  await checkOutlines(page);
  await checkStrain(page);
  await checkGaps(page);
  await checkDownloads(page, images);
  check("a page with images: no error, no network", said.length === 0 && asked.every((url) => /^(file|blob|data):/.test(url)), said.join("\n"));
  await done();
  const mixed = await open("mixed.html");
  await mixed.page.waitForSelector("#outlines svg.outlined");
  check("beside a case without images one with them shows them, the other says so",
    (await mixed.page.locator("#outlines .missing").count()) === 1 && (await mixed.page.locator("#strain .missing").count()) === 1 && mixed.said.length === 0, mixed.said.join("\n"));
  await mixed.close();
}

async function checkFitted() {
  const { page, said, close: done } = await open("fitted.html");
  const text = (await page.locator("#summary").innerText()) + (await page.locator("#details").innerText());
  check("measured volumes and fitted parameters with their sensitivity are shown",
    ["131.5", "61.25", "1.234", "1.11 / 1.36", "One volume determines"].every((part) => text.includes(part)) && !text.includes("No measured volumes"), text.match(/fitted[^]{0,300}/)?.[0]);
  const letters = await page.locator("#wall text.letter").allTextContents();
  const words = await page.locator("svg.bullseye").first().textContent();
  check("an assumed septum and apex are starred in the 3-D view and in bull's-eyes, and said first", letters.join() === "S*,A*,L*,I*,apex*" && /septal\*/.test(words) &&
    /assumed, septum/.test(text), `${letters} ${words}`);
  const starred = {
    "the 3-D view": await page.locator("#wall svg.overlay").textContent(), "bull's-eyes": await page.locator("#regions figcaption").first().textContent(),
    "rotation": await page.locator("#rotation svg.chart").textContent(), "flow": await page.locator("#flow svg.overlay").textContent() };
  const marks = { "the 3-D view": "* assumed: septum, apex", "bull's-eyes": "* assumed: septum, apex", "rotation": "to the apex*", "flow": "S*" };
  for (const [name, mark] of Object.entries(marks)) check(`what was assumed is marked in ${name}`, starred[name].includes(mark), starred[name]);
  const saved = await savedSvg(page, "#regions");
  check("and in a saved bull's-eye, with its case, quantity and colour bar", /assumed: septum,/.test(saved.text) && /circumferential strain/.test(saved.text) &&
    saved.text.includes("mean of the region") && saved.gradients === 1 && saved.anchors === 0, JSON.stringify(saved));
  const cells = (name) => text.split("\n").find((line) => line.startsWith(name)) ?? "";
  check("figures bear their origin", /fitted/.test(cells("end-diastolic volume (ml)")) && /assumed/.test(cells("endocardial pressure")), cells("end-diastolic volume (ml)"));
  check("a figure is within, outside, or the range does not apply", /within/.test(cells("end-diastolic volume\t")) && /outside/.test(cells("rotation of the apex")) &&
    /not applicable.*an infarct/.test(cells("circumferential strain\t")), cells("circumferential strain\t"));
  const sentence = await page.locator(".sentence").innerText();
  check("an impossible figure is flagged, in the first sentence too", /IMPOSSIBLE/.test(cells("ejection fraction\t")) && /IMPOSSIBLE: ejection fraction; outside.*rotation/.test(sentence), sentence);
  check("and no error is reported", said.length === 0, said.join("\n"));
  await done();
}

/** Where the infarct is drawn, from the middle of the picture, in parts of its height; to the right and down. */
async function infarctPlace(page) {
  await settled(page);
  return page.locator("canvas.wall").evaluate((canvas) => {
    const small = document.createElement("canvas");
    [small.width, small.height] = [Math.round((200 * canvas.width) / canvas.height), 200];
    const context = small.getContext("2d", { willReadFrequently: true });
    context.drawImage(canvas, 0, 0, small.width, small.height);
    const { data } = context.getImageData(0, 0, small.width, small.height);
    const found = [];
    let [wallX, wallY, wall] = [0, 0, 0];
    for (let i = 0; i < data.length; i += 4) {
      const [x, y] = [(i / 4) % small.width, Math.floor(i / 4 / small.width)];
      if (data[i] + data[i + 1] + data[i + 2] < 740) { wallX += x; wallY += y; ++wall; }
      if (data[i] > 1.6 * data[i + 2] && data[i + 1] > 1.6 * data[i + 2]) found.push([x, y]);  // yellow
    }
    const mean = (d) => found.reduce((sum, p) => sum + p[d], 0) / found.length / 200;
    const at = (x, y) => context.getImageData(x, y, 1, 1).data[0];
    return { right: mean(0) - wallX / wall / 200, down: mean(1) - wallY / wall / 200, count: found.length,
      middle: at(Math.round(wallX / wall), Math.round(wallY / wall)) };
  });
}

const letterPlaces = (page) => page.locator("#wall text.letter").evaluateAll((all) => Object.fromEntries(all.filter((one) =>
  one.getAttribute("visibility") === "visible").map((one) => [one.textContent, [Number(one.getAttribute("x")), Number(one.getAttribute("y"))]])));

async function checkOrientation() {
  const { page, said, close: done } = await open("turned.html");
  const look = async (name) => {
    await page.getByRole("button", { name, exact: true }).first().click();
    return [await infarctPlace(page), await letterPlaces(page)];
  };
  const [short, four] = await look("short axis");
  check("short axis from the apex: an infarct that is anterior and a little septal is up and a little to the left", short.count > 50 && short.down < -0.08 &&
    short.right < -0.02 && short.right > short.down, JSON.stringify(short));
  check("and letters stand anterior up, septum left", four.A[1] < four.S[1] && four.S[1] < four.I[1] && four.S[0] < four.A[0] && four.A[0] < four.L[0], JSON.stringify(four));
  check("and the section is open: the base is seen through the cavity, no closed cap", short.middle === 255, short.middle);
  const [two, sides] = await look("2-chamber");
  check("two chambers: the infarct is in the anterior wall, on the right, and letters say so", two.right > 0.05 && sides.I[0] < sides.A[0] && !sides.S, JSON.stringify({ two, sides }));
  const [, walls] = await look("4-chamber");
  check("four chambers: septum left, lateral wall right", walls.S[0] < walls.L[0] && !walls.A, JSON.stringify(walls));
  await page.focus("canvas.wall");
  for (let i = 0; i < 18; ++i) await page.keyboard.press("ArrowRight");
  const behind = [await infarctPlace(page), await letterPlaces(page)];
  check("the cut follows the camera: from the other side the near half is gone, and letters changed sides", behind[1].L[0] < behind[1].S[0] && behind[0].count > 50, JSON.stringify(behind));
  check("an infarct's page: no error", said.length === 0, said.join("\n"));
  await done();
}

/** What axe-core finds that keeps people out. */
async function checkAccessible(file, colorScheme) {
  const { page, close: done } = await open(file, { width: 1280, height: 720 });
  await page.emulateMedia({ colorScheme });
  await page.addScriptTag({ path: join(root, "web/node_modules/axe-core/axe.min.js") });
  const found = await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ["violations"] })).violations
    .filter((one) => ["serious", "critical"].includes(one.impact)).map((one) => `${one.id}: ${one.nodes.slice(0, 3).map((node) => node.target.join(" ")).join(", ")}`));
  check(`axe finds nothing serious in ${file}, ${colorScheme}`, found.length === 0, found.join("\n"));
  await done();
}

/** The PNG of the wall as the page saves it: colours in its lower left corner, where the legend is, and dark letters above. */
async function checkSavedWall(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#wall button.save").first().click()]);
  const png = readFileSync(await download.path()).toString("base64");
  const seen = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const scale = image.width / document.querySelector("canvas.wall").clientWidth;
    const colours = (x, y, width, height) => {
      const part = context.getImageData(x * scale, y * scale, width * scale, height * scale).data;
      const all = new Set();
      for (let i = 0; i < part.length; i += 4) all.add((part[i] << 16) | (part[i + 1] << 8) | part[i + 2]);
      return all.size;
    };
    const letter = document.querySelector("#wall text.letter[visibility=visible]");
    return { legend: colours(10, image.height / scale - 34, 190, 10), caption: colours(10, 8, 120, 16), bar: colours(image.width / scale - 40, image.height / scale - 30, 36, 16),
      letter: colours(Number(letter.getAttribute("x")) - 8, Number(letter.getAttribute("y")) - 8, 16, 16) };
  }, png);
  check("a saved picture of the wall has legend, caption, letters and scale bar", seen.legend > 60 && seen.caption > 5 && seen.letter > 5 && seen.bar > 1, JSON.stringify(seen));
}

/** The first SVG that a section saves: its words, its colour bars, and ids that another page's drawings have too. */
async function savedSvg(page, section) {
  const button = page.locator(`${section} button.save[aria-label$=".svg"]`).first();
  const texts = [];
  for (let i = 0; i < 2; ++i) {
    const [download] = await Promise.all([page.waitForEvent("download"), button.evaluate((one) => one.click())]);
    texts.push(readFileSync(await download.path(), "utf8"));
  }
  const words = [...texts[0].matchAll(/<text[^>]*>([^<]*)</g)].map((match) => match[1]).join(" ");
  return { text: words, gradients: texts[0].split("<linearGradient").length - 1, anchors: texts[0].split("var(--").length - 1 };
}

/** Flow in a wall whose septum, at 70 degrees, is twice as thick as its lateral wall. */
async function checkFlowPlane() {
  const { page, said, close: done } = await open("thick.html");
  const texts = await page.locator("#flow svg.overlay text").allTextContents();
  check("the flow's plane is the four-chamber view's, by name", texts.includes("4-chamber long axis") && /4-chamber long axis/.test(await page.locator("#flow .help").textContent()), texts);
  const letters = await page.locator("#flow text.letter").evaluateAll((all) => Object.fromEntries(all.map((one) => [one.textContent, one.getBoundingClientRect().x])));
  check("its letters are S on the left and L on the right", Object.keys(letters).sort().join() === "L,S" && letters.S < letters.L, JSON.stringify(letters));
  const seen = await page.locator("canvas.flow").evaluate((canvas) => {
    const { width, height } = canvas;
    const row = canvas.getContext("2d").getImageData(0, Math.round(0.5 * height), width, 1).data;
    const kinds = Array.from({ length: width }, (_, x) => {
      const [r, g, b, a] = row.subarray(4 * x, 4 * x + 4);
      return a === 0 ? " " : Math.abs(r - 222) + Math.abs(g - 205) + Math.abs(b - 200) < 12 ? "w" : "b";
    }).join("");
    const walls = [...kinds.matchAll(/w{4,}/g)].map((match) => match[0].length);
    return { walls, kinds: kinds.replace(/(.)\1*/g, "$1") };
  });
  check("the thick septum is on the left", seen.walls.length === 2 && seen.walls[0] > 1.6 * seen.walls[1], JSON.stringify(seen));
  check("no error is reported", said.length === 0, said.join("\n"));
  const { caption, legend } = await savedFlow(page);
  check("a saved picture of the flow has its caption and its legend", caption > 5 && legend > 60, `${caption} ${legend}`);
  await done();
  const without = await open("blood.html");
  check("blood without a wall is said to be there", /frames of the blood, but none of the wall/.test(await without.page.locator("#flow").textContent()), await without.page.locator("#flow").textContent());
  await without.close();
}

/** Colours of a saved flow where its caption and its legend are. */
async function savedFlow(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#flow button.save").first().click()]);
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const colours = (x, y, width, height) => {
      const part = context.getImageData(x, y, width, height).data;
      const all = new Set();
      for (let i = 0; i < part.length; i += 4) all.add((part[i] << 16) | (part[i + 1] << 8) | part[i + 2]);
      return all.size;
    };
    return { caption: colours(20, 10, 300, 26), legend: colours(22, image.height - 66, 0.38 * image.width, 20) };
  }, readFileSync(await download.path()).toString("base64"));
}

async function checkFirstScreen() {
  const { page, close: done } = await open("page.html", { width: 1280, height: 720 });
  await page.evaluate(() => scrollTo(0, 0));
  const inSight = await page.evaluate(() => ["#wall select", "#wall .legend", "#time", "#wall .ticks", "#summary tbody"].map((selector) => {
    const box = document.querySelector(selector).getBoundingClientRect();
    return box.top >= 0 && box.bottom <= innerHeight && box.left >= 0 && box.right <= innerWidth;
  }));
  check("quantity, legend, moment and the first numbers are in sight at 1280 x 720", inSight.every(Boolean), inSight);
  check("the first picture is circumferential strain", (await page.locator("#wall select").first().inputValue()) === "circumferential_strain");
  check("end-diastole and end-systole are marked at the slider", (await page.locator("#wall .tick").allTextContents()).join() === "ED,ES");
  const bars = await page.locator("#regions svg.bar").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
  check("both states have one scale", bars.length === 2 && bars[0] === bars[1], bars);
  await page.selectOption("#wall select >> nth=0", "active_tension");
  const fills = await page.locator("svg.bullseye").first().locator("[data-index]").evaluateAll((all) => [...new Set(all.map((one) => one.getAttribute("fill")))]);
  check("a tension of nearly nothing has no colour", fills.join() === "rgb(236,234,231)", fills);
  const hidden = await page.locator(".of-paper").evaluateAll((all) => all.filter((one) => getComputedStyle(one).display !== "none").length);
  await page.locator(".paper-switch input").first().check();
  const after = await page.locator(".of-paper").evaluateAll((all) => all.filter((one) => getComputedStyle(one).display !== "none").length);
  check("the paper's subjects stand beside on request", hidden === 0 && after > 5, `${hidden} ${after}`);
  await done();
}

/** Calcium of the quasi-static engine is blank in contraction. */
async function checkGaps(page) {
  const rows = csv(join(images, "03_beat/curves.csv"));
  const known = rows.map((r) => Number.isFinite(Number(r.calcium_uM)));
  const runs = known.filter((is, i) => is && !known[i - 1]).length;
  const chart = await page.locator("#curves svg.chart").evaluateAll((all) => all.filter((one) => /calcium/.test(one.getAttribute("aria-label"))).map((one) => ({
    d: one.querySelector("path").getAttribute("d"), label: one.getAttribute("aria-label") }))[0]);
  check("a gap in a file is a gap in its curve", runs > 1 && chart.d.split("M").length - 1 === runs && chart.d.split(/[ML]/).length - 1 === known.filter(Boolean).length, `${runs} ${chart.d}`);
  check("an axis that is a load is called one", /load/.test(chart.label), chart.label);
  const path = page.locator("#curves figure").first();
  check("the pressure-volume path has its name, end-diastole and end-systole", /pressure-volume path \(no valves\)/.test(await path.innerText()) &&
    (await path.locator("text").allTextContents()).filter((word) => ["ED", "ES"].includes(word)).length === 2);
}

/** A real ventricle, where its data are: fitted to its measured volume, its strains from a table. */
async function checkRealVentricle() {
  const data = join(process.env.VENTRICLE_DATA ?? join(root, "../shared/data"), "glasgow_HV01/text_export");
  if (!existsSync(data)) { console.log(`info  no page of HV01: ${data} is not there (set VENTRICLE_DATA)`); return; }
  const file = (name) => JSON.stringify(join(data, name));
  writeFileSync(join(folder, "hv01.toml"), ["name = 'HV01'", "engine = 'quasi_static'", "[anatomy]", "source = 'contours'", "[anatomy.contours]",
    `short_axis = ${file("contours_sa_aligned_long_axis.csv")}`, `long_axis = ${file("contours_la.csv")}`, `apex_endo = ${file("apex_endo.csv")}`,
    `apex_epi = ${file("apex_epi.csv")}`, "septum_point = ['37.1 mm', '0.8 mm', '-4.5 mm']", "[calibrate]", "passive = 'scale'",
    "edv = '142.6 ml'", "[active]", "T_scale = 3.0", "[strain]", `measured = ${file("segmental_strain_from_cine.csv")}`, "measured_column = 'frame10'"].join("\n"));
  await ventricle("run", "hv01.toml", "--ranks", "1");
  const { page, said, close: done } = await open(join("hv01.work", "05_report/report.html"));
  const fitted = JSON.parse(readFileSync(join(folder, "hv01.work/02b_calibrate/calibration.json"), "utf8"));
  const summary = await page.locator("#details").innerText();
  const scale = fitted.uncertainty[0];
  check("HV01: its measured volume and its fitted parameter are shown", summary.includes("142.6") && close(number(summary.match(/\nscale\t([\d.]+)/)?.[1] ?? "–"), scale.value, 0.006), summary.match(/scale.*/)?.[0]);
  const pairs = csv(join(folder, "hv01.work/04_results/strain_comparison_circumferential.csv"));
  const dots = await page.locator("#strain svg.chart").first().locator("circle:not(.live, .key)").count();
  check("HV01: strains of 30 sectors stand beside the measured ones", pairs.length === 30 && dots === 30, dots);
  check("HV01: its quality sheet is shown, images are said to be missing, no error", /cavity_fitted/.test(await page.locator("#input").innerText()) &&
    (await page.locator("#outlines .missing").count()) === 1 && said.length === 0, said.join("\n"));
  await done();
}

/** Figures that the run itself wrote, without a browser. */
function checkFigures() {
  const figures = (run) => readdirSync(join(run, "05_report/figures")).filter((name) => name.endsWith(".svg"));
  const wrong = figures(images).filter((name) => !/<svg[^>]*>[^]*<path/.test(readFileSync(join(images, "05_report/figures", name), "utf8")));
  const muscle = readFileSync(join(work, "05_report/figures/stress_stretch.svg"), "utf8");
  check("the paper's subjects are in no figure that was not asked for", /Holzapfel/.test(muscle) && !/Gao/.test(muscle));
  check("a run writes its charts and bull's-eyes as SVG", figures(work).length === 20 && figures(images).length === 24 && wrong.length === 0,
    `${figures(work).length} ${figures(images).length} ${wrong}`);
}

async function checkPhone() {
  const { page, close: done } = await open("page.html", { width: 390, height: 800 });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  check("a phone's width is enough", width <= 391, width);
  await done();
}

async function checkHalf() {
  const { page, said, close: done } = await open("half.html");
  const state = await page.locator(".state").innerText();
  check("an unfinished run says so", /not complete/.test(state) && /03_beat is unfinished/.test(state) && /04_results has not been made/.test(state), state);
  check("and shows the frames that there are", (await pixels(page, "canvas.wall")).drawn > 0.08);
  check("and says what is missing", (await page.locator(".missing").count()) >= 5);
  const text = await page.locator("body").innerText();
  check("and makes up nothing", !/NaN|undefined/.test(text), text.match(/.{30}(NaN|undefined).{20}/)?.[0]);
  check("and no error is reported", said.length === 0, said.join("\n"));
  await done();
  const mesh = await open("mesh.html");
  check("a run with a mesh alone shows it", (await pixels(mesh.page, "canvas.wall")).drawn > 0.08 && mesh.said.length === 0, mesh.said.join("\n"));
  await mesh.close();
}

async function checkCompare() {
  const { page, said, asked, close: done } = await open("compare.html", { width: 1400, height: 900 });
  check("two cases: both walls are drawn", (await pixels(page, "canvas.wall", 0)).drawn > 0.05 && (await pixels(page, "canvas.wall", 1)).drawn > 0.05);
  const before = [await pixels(page, "canvas.wall", 0), await pixels(page, "canvas.wall", 1)];
  await setSlider(page, "#time", 40);
  const later = [await pixels(page, "canvas.wall", 0), await pixels(page, "canvas.wall", 1)];
  check("one slider moves both", later.every((now, i) => now.print !== before[i].print));
  await page.focus("canvas.wall >> nth=0");
  await page.keyboard.press("ArrowLeft");
  const turned = await pixels(page, "canvas.wall", 1);
  check("turning one turns the other", turned.print !== later[1].print);
  check("no error, no network", said.length === 0 && asked.every((url) => /^(file|blob|data):/.test(url)), said.join("\n"));
  await done();
}

/** Rows of the table of the last beat: measure, then its cells. */
const measured = (page) => page.locator("#heartbeats table").first().locator("tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
const ofMeasure = (rows, words) => rows.find(([name]) => name.startsWith(words)) ?? [];

async function checkBeats() {
  const { page, said, close: done } = await open("beats.html");
  const last = ofBeats("beats.work").at(-1);
  const [loop, wiggers] = await page.locator("#heartbeats svg.chart").evaluateAll((all) => all.map((one) => ({ lines: [...one.querySelectorAll("path")].map((path) => path.getAttribute("d")),
    words: [...one.querySelectorAll("text")].map((text) => text.textContent), panels: one.querySelectorAll("svg").length, live: one.querySelectorAll("line.live").length })));
  check("heartbeats: both loops, and the valve events of the last", loop.lines.length === 2 && ["MC", "AO", "AC", "MO"].every((name) => loop.words.includes(name)), loop.words);
  check("the Wiggers diagram has pressures, volume and flows, and a line in each for the time", wiggers.panels === 3 && wiggers.lines.length === 6 && wiggers.live === 3, JSON.stringify(wiggers.words));
  const rows = await measured(page);
  check("all measures of a beat stand there with a definition", rows.length === Object.keys(last).length - 1 && rows.every((row) => row.at(-1).length > 3), rows.length);
  check("they are beats.csv's", close(number(ofMeasure(rows, "stroke work")[1]), Number(last.stroke_work_mmHg_ml), 1e-3) &&
    close(number(ofMeasure(rows, "relaxation constant")[1]), Number(last.tau_ms), 1e-3), rows.join("; "));
  check("the first screen tells the peak pressure", /peak pressure \(mmHg\)/.test(await page.locator("#summary").innerText()));
  const details = await page.locator("#details").innerText();
  check("what heartbeats were fitted to, by which parameter, how the datum follows it, and what was left alone", ["141.3", "9.876", "8.77 / 11.3", "0.432",
    "The contractility keeps the case's value."].every((part) => details.includes(part)), details.match(/Heartbeats fitted[^]{0,600}/)?.[0]);
  check("no error is reported on heartbeats", said.length === 0, said.join("\n"));
  await done();
  const two = await open("loops.html", { width: 1400, height: 900 });
  const lines = await two.page.locator("#heartbeats svg.chart").first().locator("path").count();
  const both = ofMeasure(await measured(two.page), "end-systolic volume").slice(1, 4).map(number);
  const expected = ["beats.work", "stiff.work"].map((name) => Number(ofBeats(name).at(-1).esv_ml));
  check("two cases: one loop each over the other, and the difference of each measure", lines === 2 && close(both[2], expected[1] - expected[0], 0.01) && close(both[1], expected[1], 1e-3),
    `${lines} ${both} ${expected}`);
  await two.close();
}

await makePages();
const opened = await open("page.html");
const megabytes = statSync(join(folder, "page.html")).size / 1e6;
console.log(`info  the page has ${megabytes.toFixed(2)} MB; its first view is there ${await opened.page.evaluate(() => document.body.dataset.first)} ms and the wall ` +
  `${await opened.page.evaluate(() => document.body.dataset.ready)} ms after its start`);
check("the page is smaller than 15 MB", megabytes < 15, megabytes);
await checkDrawn(opened.page);
await checkControls(opened.page);
await checkPicking(opened.page);
await checkNumbers(opened.page);
await checkSavedWall(opened.page);
await checkDownloads(opened.page, work);
await checkSpeed(opened.page);
check("it prints", (await opened.page.pdf()).length > 30_000);
check("no error is reported", opened.said.length === 0, opened.said.join("\n"));
check("nothing is asked from a network", opened.asked.every((url) => /^(file|blob|data):/.test(url)), opened.asked.join(" "));
await opened.close();
await checkFirstScreen();
await checkOrientation();
await checkFlowPlane();
await checkAccessible("page.html", "light");
await checkAccessible("images.html", "dark");
await checkPhone();
await checkHalf();
await checkCompare();
await checkBeats();
await checkImages();
await checkFitted();
await checkRealVentricle();
checkFigures();
await browser.close();
rmSync(folder, { recursive: true, force: true });
console.log(`${failed} failed`);
process.exit(failed ? 1 : 0);
