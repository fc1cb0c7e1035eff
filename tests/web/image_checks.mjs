// Pages of runs with images: outlines over them, measured strain, and a real ventricle.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { root, settled } from "./browser.mjs";
import { checkAccessible, checkDownloads, checkOpening } from "./page_checks.mjs";
import { check, close, csv, dot, folder, images, nothingAsked, number, open, rimPixels, saved, setSlider, work } from "./setting.mjs";

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

/** The canvas's pixels, kept in the browser. */
async function kept(page) {
  await settled(page);
  return page.locator("canvas.wall").evaluateHandle((canvas) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height);
  });
}

/** The rims of the infarct's border, and how many of their pixels lie within 4 pixels of both yellow and violet in a picture of M. */
const onBorder = (page, strain, M) => page.evaluate(([{ data, width, height }, { data: m }]) => {
  const reach = 4;
  let [rims, right] = [0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (![0, 1, 2].every((d) => Math.abs(data[i + d] - 26) < 2)) continue;
    ++rims;
    const [x0, y0] = [(i / 4) % width, Math.floor(i / 4 / width)];
    let [yellow, violet] = [false, false];
    for (let y = Math.max(0, y0 - reach); y <= Math.min(height - 1, y0 + reach); ++y)
      for (let k = 4 * (y * width + x0 - reach); k <= 4 * (y * width + x0 + reach); k += 4) {
        yellow ||= m[k] > 1.6 * m[k + 2] && m[k + 1] > 1.6 * m[k + 2];
        violet ||= m[k + 2] > 1.2 * m[k] && m[k] > 1.2 * m[k + 1];
      }
    if (yellow && violet) ++right;
  }
  return { rims, right };
}, [strain, M]);

/** The infarct's border on the wall, beside its M coloured by two colours that meet at 0.5. */
async function checkBorderOnWall(page) {
  const strain = await kept(page);
  await page.selectOption("#wall select >> nth=0", "infarct");
  for (const [name, value] of [["lowest colour", 0.4999], ["highest colour", 0.5001]])
    await page.getByLabel(name).evaluate((input, to) => { input.value = to; input.dispatchEvent(new Event("change")); }, value);
  const { rims, right } = await onBorder(page, strain, await kept(page));
  check("the infarct's border is drawn on the wall where M is 0.5", rims > 200 && right > 0.95 * rims, `${right} of ${rims}`);
  const key = await page.locator("#wall .legend").textContent();
  check("and not where M itself is shown", !/border/.test(key), key);
  await page.selectOption("#wall select >> nth=0", "circumferential_strain");
}

/** What goes around the infarct in pictures and bull's-eyes of strain. */
async function checkBorder(page) {
  await checkBorderOnWall(page);
  check("its line has its name in the legend", /border of the infarct/.test(await page.locator("#wall .legend").textContent()));
  const { bytes } = await saved(page, page.locator("#wall button.save").first());
  check("and is in a saved picture", await rimPixels(page, bytes) > 200);
  const eyes = await page.locator("#regions figure").evaluateAll((all) => all.map((one) => ({ caption: one.querySelector("figcaption").textContent, line: one.querySelector("path.infarct")?.getAttribute("d").length ?? 0,
    regions: [...one.querySelectorAll("[data-index]")].map((shape) => shape.getAttribute("aria-label")).filter((name) => name.endsWith(", infarcted")).map((name) => name.split(": ")[0]) })));
  const { infarct_segments: segments } = JSON.parse(readFileSync(join(images, "04_results/summary.json"), "utf8"));
  const wrong = eyes.filter(({ caption }) => caption.includes("AHA")).flatMap(({ regions }) => segments.filter(({ segment, percent_of_segment: percent }) =>
    (percent < 20 || percent > 50) && (percent > 50) !== regions.some((name) => name.replace(/^\d+ /, "") === segment)));
  check("bull's-eyes of strain have a line around the segments more than half of which is infarcted, and their captions say so",
    eyes.length === 4 && eyes.every(({ caption, line, regions }) => line > 100 && regions.length > 0 && /white line: around regions/.test(caption)) && wrong.length === 0, JSON.stringify({ eyes, wrong }));
  const heads = await page.locator("#regions h3").allTextContents();
  check("their headings say which state strain is from", heads.join() === "circumferential strain at end-diastole, from early diastole*, assumed,circumferential strain at end-systole, from end-diastole" ||
    heads.join() === "circumferential strain at end-diastole, from early diastole,circumferential strain at end-systole, from end-diastole", heads.join());
}

/** Figures that the run itself wrote, without a browser. */
export function checkFigures() {
  const figures = (run) => readdirSync(join(run, "05_report/figures")).filter((name) => name.endsWith(".svg"));
  const wrong = figures(images).filter((name) => !/<svg[^>]*>[^]*<path/.test(readFileSync(join(images, "05_report/figures", name), "utf8")));
  const muscle = readFileSync(join(work, "05_report/figures/stress_stretch.svg"), "utf8");
  check("the paper's subjects are in no figure that was not asked for", /Holzapfel/.test(muscle) && !/Gao/.test(muscle));
  check("a run writes its charts and bull's-eyes as SVG", figures(work).length === 20 && figures(images).length === 24 && wrong.length === 0,
    `${figures(work).length} ${figures(images).length} ${wrong}`);
}

export async function checkImages() {
  const { page, said, asked, close: done } = await open("images.html");
  await page.waitForSelector("#outlines svg.outlined");
  await checkAccessible(page, "a page with images", "dark");
  await checkOutlines(page);
  await checkStrain(page);
  await checkGaps(page);
  const details = await page.locator("#details").innerText();
  check("no table has a load for a time, nor numbers below any meaning", !/no time|\b0\.000|\de−/.test(details), details.match(/.*(no time|\b0\.000|\de−).*/)?.[0]);
  await checkBorder(page);
  await page.setViewportSize({ width: 390, height: 844 });
  const wide = await page.locator("#summary .table, #zones .table").evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText.slice(0, 60)));
  check("on a phone the tables of numbers and infarct fit", wide.length === 0, wide.join("; "));
  await page.setViewportSize({ width: 1000, height: 760 });
  await checkDownloads(page, images);
  check("a page with images: no error, no network", said.length === 0 && nothingAsked(asked), said.join("\n"));
  await done();
  await checkOpening("images.html", 1, true);  // in the view that shows the phantom's infarct
}

/** A wall that lies in none of the images beside it. */
export async function checkElsewhere() {
  const { page, said, close: done } = await open("elsewhere.html");
  await page.waitForSelector("#outlines svg.outlined");
  const large = page.locator("#outlines figure").first();
  const drawn = await large.locator("svg.outlined").evaluate((root) => ({ model: root.querySelectorAll("[data-source=model]").length,
    contours: root.querySelectorAll("[data-source=contours]").length, letters: root.querySelectorAll("text.letter").length }));
  check("images that the wall does not lie in have contours, but no outline of it and no letters", drawn.model === 0 && drawn.letters === 0 && drawn.contours === 2, JSON.stringify(drawn));
  const words = await page.locator("#outlines").innerText();
  check("and it is said, with no distances", /does not lie in the space of these images/.test(await large.innerText()) && !/distance of the drawn contours/.test(words), words.slice(0, 900));
  check("nor an error", said.length === 0, said.join("\n"));
  await done();
}

export async function checkMixed() {
  const { page, said, close: done } = await open("mixed.html");
  await page.waitForSelector("#outlines svg.outlined");
  check("beside a case without images one with them shows them, the other says so",
    (await page.locator("#outlines .missing").count()) === 1 && (await page.locator("#strain .missing").count()) === 1 && said.length === 0, said.join("\n"));
  const axes = await page.locator("#curves svg.chart").evaluateAll((all) => all.slice(1).map((one) => one.getAttribute("aria-label").split(" against ")[1]));
  const bars = await page.locator("#wall svg.overlay > path").evaluateAll((all) => all.map((one) => Number(one.getAttribute("d").match(/h([\d.]+)/)[1])));
  check("two walls are seen at one scale", bars.length === 2 && Math.abs(bars[0] - bars[1]) < 0.1, bars);
  check("load and time share no axis", axes.length === 8 && axes.filter((name) => name === "time (s)").length === 4 && axes.filter((name) => /^load/.test(name)).length === 4, axes);
  await done();
}

/** docs/outputs.md against what runs with flow and with images leave, and the real one where it is. */
export function checkDocumented() {
  const runs = [work, images, join(folder, "hv01.work")].filter((run) => existsSync(run));
  const { status, stdout, stderr } = spawnSync("python3", [join(root, "tests/documents/outputs.py"), ...runs], { encoding: "utf8" });
  check("all that these runs leave is documented", status === 0, stdout + stderr);
}

/** A real ventricle, where its data are. */
export async function checkReal() {
  const run = join(folder, "hv01.work");
  if (!existsSync(run)) return;
  const { page, said, close: done } = await open(join("hv01.work", "05_report/report.html"));
  const fitted = JSON.parse(readFileSync(join(run, "02b_calibrate/calibration.json"), "utf8"));
  const summary = await page.locator("#details").innerText();
  const scale = fitted.uncertainty[0];
  check("HV01: its measured volume and its fitted parameter are shown", summary.includes("142.6") && close(number(summary.match(/\nscale\t([\d.]+)/)?.[1] ?? "–"), scale.value, 0.006), summary.match(/scale.*/)?.[0]);
  const pairs = csv(join(run, "04_results/strain_comparison_circumferential.csv"));
  const green = 100 * pairs.reduce((sum, r) => sum + Number(r.measured) + Number(r.measured) ** 2 / 2, 0) / pairs.length;
  const beside = (await page.locator("#summary tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)))).find(([name]) => name.startsWith("circumferential"));
  check("HV01: measured changes of length stand beside the model's strain as strain", close(number(beside[2]), green, 0.006), `${beside} ${green}`);
  const dots = await page.locator("#strain svg.chart").first().locator("circle:not(.live, .key)").count();
  check("HV01: strains of 30 sectors stand beside the measured ones", pairs.length === 30 && dots === 30, dots);
  const heads = await page.locator("#details thead th").allTextContents();
  const captions = await page.locator("#regions figcaption").allTextContents();
  check("HV01: early diastole, which nothing shows, is starred in table, bull's-eyes of strain since then and rotation", heads.includes("early diastole*") &&
    captions.filter((words) => words.includes("from early diastole*, assumed")).length === 2 && /\* assumed: early diastole/.test(await page.locator("#rotation").textContent()), `${heads} ${captions}`);
  check("HV01: its quality sheet is shown, images are said to be missing, no error", /cavity fitted/.test(await page.locator("#input").innerText()) &&
    (await page.locator("#outlines .missing").count()) === 1 && said.length === 0, said.join("\n"));
  await done();
}
