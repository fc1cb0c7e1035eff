// Pages of other runs: where the walls are seen, what was assumed, unfinished runs, two cases, heartbeats, flow.
import { join } from "node:path";
import { settled } from "./browser.mjs";
import { checkOpening } from "./page_checks.mjs";
import { ofBeats } from "./runs.mjs";
import { check, close, coloursIn, csv, folder, nothingAsked, number, open, pixels, saved, setSlider } from "./setting.mjs";

/** The first SVG that a section saves: its words, its colour bars, and whether a colour of the page is left open. */
async function savedSvg(page, section) {
  const text = (await saved(page, page.locator(`${section} button.save[aria-label$=".svg"]`).first())).bytes.toString();
  const words = [...text.matchAll(/<text[^>]*>([^<]*)</g)].map((match) => match[1]).join(" ");
  return { text: words, gradients: text.split("<linearGradient").length - 1, anchors: text.split("var(--").length - 1 };
}

/** Pressure and volume that the picture's caption tells of the second frame, and those on the straight line between two rows of the curves. */
async function captionBetweenRows(page) {
  await setSlider(page, "#time", 1);
  await settled(page);
  const caption = (await page.locator("#wall svg.overlay text").allTextContents())[1];
  const [t, ...told] = ["s", "mmHg", "ml"].map((unit) => Number(new RegExp(`([\\d.]+) ${unit}\\b`).exec(caption)?.[1]));
  const rows = csv(join(folder, "fitted.work/03_beat/curves.csv")).map((r) => [r.time_s, r.pressure_mmHg, r.cavity_volume_ml].map(Number));
  const after = rows.findIndex((r) => r[0] > t);
  const [a, b] = [rows[after - 1], rows[after]];
  const share = (t - a[0]) / (b[0] - a[0]);
  return { told, expected: [1, 2].map((k) => a[k] + share * (b[k] - a[k])) };
}

export async function checkFitted() {
  const { page, said, close: done } = await open("fitted.html");
  const text = (await page.locator("#summary").innerText()) + (await page.locator(".remarks").innerText()) + (await page.locator("#details").innerText());
  check("measured volumes and fitted parameters with their sensitivity are shown",
    ["131.5", "61.25", "1.234", "1.11 / 1.36", "One volume determines"].every((part) => text.includes(part)) && !text.includes("No measured volumes"), text.match(/fitted[^]{0,300}/)?.[0]);
  const letters = await page.locator("#wall text.letter").allTextContents();
  const words = await page.locator("svg.bullseye").first().textContent();
  check("an assumed septum and apex are starred in the 3-D view and in bull's-eyes, and said first", letters.join() === "S*,A*,L*,I*,apex*" && /septal\*/.test(words) && /LAD\*/.test(words) &&
    /assumed, septum/.test(text), `${letters} ${words}`);
  check("and named in the first sentence", / Assumed: septum, apex\.$/.test(await page.locator(".sentence").innerText()), await page.locator(".sentence").innerText());
  await page.setViewportSize({ width: 390, height: 844 });
  const tops = await page.evaluate(() => ["#summary table", "#wall canvas.wall", ".remarks"].map((part) => document.querySelector(part).getBoundingClientRect().top));
  check("on a phone numbers and picture stand before what was assumed", tops[0] < tops[1] && tops[1] < tops[2], tops);
  await page.setViewportSize({ width: 1000, height: 760 });
  const starred = {
    "the 3-D view": await page.locator("#wall svg.overlay").textContent(), "bull's-eyes": await page.locator("#regions figcaption").first().textContent(),
    "rotation": await page.locator("#rotation svg.chart").textContent(), "flow": await page.locator("#flow svg.overlay").textContent() };
  const marks = { "the 3-D view": "* assumed: septum, apex", "bull's-eyes": "* assumed: septum, apex", "rotation": "to the apex*", "flow": "S*" };
  for (const [name, mark] of Object.entries(marks)) check(`what was assumed is marked in ${name}`, starred[name].includes(mark), starred[name]);
  const captions = await page.locator("#regions figcaption").allTextContents();
  check("once in each caption", captions.every((words) => words.split("assumed").length === 2 && !/\*\s*\(/.test(words)), captions);
  const drawing = await savedSvg(page, "#regions");
  check("and in a saved bull's-eye, with its case, quantity and colour bar", /assumed: septum,/.test(drawing.text) && /circumferential strain/.test(drawing.text) &&
    drawing.text.includes("mean of the region") && drawing.gradients === 1 && drawing.anchors === 0, JSON.stringify(drawing));
  const cells = (name) => text.split("\n").find((line) => line.startsWith(name)) ?? "";
  check("figures bear their origin", /fitted/.test(cells("end-diastolic volume (ml)")) && /assumed/.test(cells("endocardial pressure")), cells("end-diastolic volume (ml)"));
  check("a figure is within, outside, or the range does not apply", /within/.test(cells("end-diastolic volume\t")) && /outside/.test(cells("rotation of the apex")) &&
    /not applicable.*an infarct/.test(cells("circumferential strain\t")), cells("circumferential strain\t"));
  const sentence = await page.locator(".sentence").innerText();
  check("an infarct and its size are named in the first sentence", /, with an infarct of 12% of the wall, /.test(sentence), sentence);
  check("and what is doubtful of the computation apart from the heart's", /rotation of the apex; the computation is less exact than it should be: change of an element's volume\./.test(sentence), sentence);
  const heads = await page.locator("#details thead th").allTextContents();
  check("a wall that was unloaded is not called early diastole", heads.includes("without load") && !heads.includes("early diastole"), heads);
  const { told, expected } = await captionBetweenRows(page);
  check("what stands over the picture is read between the rows of curves.csv", told.length === 2 && told.every((x, i) => Math.abs(x - expected[i]) < 6e-3 * Math.abs(expected[i])), `${told} ${expected}`);
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

export async function checkOrientation() {
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

/** How much infarct the named views of a page show, and in which of them it opens. */
async function infarctsShown(page) {
  const opened = { look: await page.locator(".look[aria-pressed=true]").allInnerTexts(), count: (await infarctPlace(page)).count,
    caption: await page.locator("#wall svg.overlay text").allTextContents(), words: await page.locator("#wall .opened").innerText() };
  const counts = {};
  for (const look of ["4-chamber", "3-chamber", "2-chamber", "anterior", "septal", "inferior", "lateral"]) {
    await page.getByRole("button", { name: look, exact: true }).first().click();
    counts[look] = (await infarctPlace(page)).count;
  }
  return { opened, counts };
}

/** Pages of an anterior and of an inferior infarct open where it is seen. */
export async function checkOpeningView() {
  const expected = { "turned.html": ["anterior", "whole wall, from the anterior side", /on the anterior side: no long axis shows half as much/],
    "inferior.html": ["4-chamber", "4-chamber long axis", /in the 4-chamber view: of the long axes it shows the most/] };
  for (const [file, [look, caption, words]] of Object.entries(expected)) {
    const { page, said, close: done } = await open(file);
    const { opened, counts } = await infarctsShown(page);
    const most = Math.max(...Object.values(counts));
    check(`${file} opens where its infarct is seen`, opened.look.join() === look && Math.abs(opened.count - counts[look]) < 0.03 * opened.count && opened.count >= 0.5 * most && opened.count > 500, JSON.stringify({ opened, counts }));
    check("and says so, and what is seen", words.test(opened.words) && opened.caption.includes(caption), JSON.stringify(opened));
    if (look === "anterior") check("where the four-chamber view hides it", counts["4-chamber"] < 0.1 * opened.count, JSON.stringify(counts));
    check(`${file}: no error`, said.length === 0, said.join("\n"));
    await done();
  }
}

/** Flow in a wall whose septum, at 70 degrees, is twice as thick as its lateral wall. */
export async function checkFlowPlane() {
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
  const { bytes } = await saved(page, page.locator("#flow button.save").first());
  const { caption, legend } = await coloursIn(page, bytes, { caption: [20, 10, 300, 26], legend: [22, -66, 170, 20] });
  check("a saved picture of the flow has its caption and its legend", caption > 5 && legend > 60, `${caption} ${legend}`);
  await done();
  const without = await open("blood.html");
  check("blood without a wall is said to be there", /frames of the blood, but none of the wall/.test(await without.page.locator("#flow").textContent()), await without.page.locator("#flow").textContent());
  await without.close();
}

export async function checkHalf() {
  const { page, said, close: done } = await open("half.html");
  const state = await page.locator(".state").innerText();
  check("an unfinished run says so", /not complete/.test(state) && /03_beat is unfinished/.test(state) && /04_results has not been made/.test(state), state);
  check("and bears the name of its case", (await page.locator("h1").innerText()) === "small", await page.locator("h1").innerText());
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

export async function checkCompare() {
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
  check("no error, no network", said.length === 0 && nothingAsked(asked), said.join("\n"));
  await done();
  await checkOpening("compare.html", 2);
}

/** Rows of the table of the last beat: measure, then its cells. */
const measured = (page) => page.locator("#heartbeats table").first().locator("tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
const ofMeasure = (rows, words) => rows.find(([name]) => name.startsWith(words)) ?? [];

export async function checkBeats() {
  const { page, said, close: done } = await open("beats.html");
  const last = ofBeats("beats.work").at(-1);
  const [loop, wiggers] = await page.locator("#heartbeats svg.chart").evaluateAll((all) => all.map((one) => ({ lines: [...one.querySelectorAll("path")].map((path) => path.getAttribute("d")),
    words: [...one.querySelectorAll("text")].map((text) => text.textContent), panels: one.querySelectorAll("svg").length, live: one.querySelectorAll("line.live").length })));
  check("heartbeats: both loops, and the valve events of the last", loop.lines.length === 2 && ["MC", "AO", "AC", "MO"].every((name) => loop.words.includes(name)), loop.words);
  check("the Wiggers diagram has pressures, volume and flows, and a line in each for the time", wiggers.panels === 3 && wiggers.lines.length === 6 && wiggers.live === 3, JSON.stringify(wiggers.words));
  const begins = csv(join(folder, "beats.work/03_beat/cycle.csv")).findLast((row) => row.beat === "1").time_s;
  const caption = await page.locator("#wall svg.overlay text").nth(1).textContent();
  const [, shownTime] = caption.match(/, (-?[0-9.]+) s of beat 2/) ?? [];
  const ejectionEnds = csv(join(folder, "beats.work/03_beat/moments.csv")).at(-1).time_s;
  check("times of heartbeats are from their beat's beginning", close(Number(shownTime), ejectionEnds - begins, 1e-2), `${caption} ${ejectionEnds} ${begins}`);
  const rows = await measured(page);
  check("all measures of a beat stand there with a definition", rows.length === Object.keys(last).length - 1 && rows.every((row) => row.at(-1).length > 3), rows.length);
  check("they are beats.csv's", close(number(ofMeasure(rows, "stroke work")[1]), Number(last.stroke_work_mmHg_ml), 1e-3) &&
    close(number(ofMeasure(rows, "relaxation constant")[1]), Number(last.tau_ms), 1e-3), rows.join("; "));
  check("the first screen tells the peak pressure", /peak pressure \(mmHg\)/.test(await page.locator("#summary").innerText()));
  check("and the cuff's beside the aorta's", /aortic pressure, systolic[^]*124[^]*124/.test(await page.locator("#summary").innerText()));
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
  check("two cases of heartbeats: nothing is said of their moments", await two.page.locator("#unlike-moments").count() === 0);
  await two.close();
  const unlike = await open("unlike.html", { width: 1400, height: 900 });
  const sentence = await unlike.page.locator("header #unlike-moments").innerText().catch((e) => String(e));
  check("heartbeats beside the paper's protocol: the page says at its top that moments are not defined alike", sentence.includes("not defined alike"), sentence);
  await unlike.close();
}
