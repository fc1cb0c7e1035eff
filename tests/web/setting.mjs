// What the checks of the page share: the program and its runs, claims, and one browser.
import { mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { inSight, lacking, launch, openPage, settled } from "./browser.mjs";

export const program = resolve(process.argv[2]);
const option = (name) => (process.argv.includes(name) ? resolve(process.argv[process.argv.indexOf(name) + 1]) : undefined);

if (lacking) { console.log(`skipped: ${lacking}`); process.exit(77); }

export const folder = mkdtempSync(join(tmpdir(), "ventricle_page_"));
/** Work folders of a run with flow and of one with images, which may be there already. */
export const work = option("--work") ?? join(folder, "small.work");
export const images = option("--images") ?? join(folder, "images.work");
export const browser = await launch();

// ---- claims ----

export let failed = 0;
export function check(claim, holds, detail = "") {
  console.log(`${holds ? "pass" : "FAIL"}  ${claim}${!holds && detail !== "" ? `: ${detail}` : ""}`);
  if (!holds) ++failed;
}

const seconds = [];
/** Runs a part of the checks and keeps how long it took. */
export async function timed(name, part) {
  const start = performance.now();
  const result = await part();
  seconds.push(`${name} ${((performance.now() - start) / 1000).toFixed(1)}`);
  return result;
}
export const secondsTaken = () => seconds.join(", ");

export const close = (a, b, tolerance) => (Number.isNaN(a) && Number.isNaN(b)) || Math.abs(a - b) <= tolerance * Math.max(Math.abs(b), 1e-12);
export const number = (text) => (text.trim() === "–" ? NaN : parseFloat(text.replace("−", "-")));
export const dot = (a, b) => a.reduce((sum, v, d) => sum + v * b[d], 0);

export function csv(file) {
  const [head, ...rows] = readFileSync(file, "utf8").trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(head.map((name, i) => [name, row[i] === "" ? NaN : row[i]])));
}

// ---- pages ----

/** Opens a page and watches what it says and asks for. */
export async function open(file, viewport = { width: 1000, height: 760 }) {
  const said = [];
  const asked = [];
  const page = await openPage(browser, resolve(folder, file), { viewport }, (one) => {
    one.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|swiftshader/i.test(message.text()) && said.push(message.text()));
    one.on("pageerror", (error) => said.push(error.stack));
    one.on("request", (request) => asked.push(request.url()));
  });
  await inSight(page, "flow");
  return { page, said, asked, close: () => page.context().close() };
}

export const nothingAsked = (asked) => asked.every((url) => /^(file|blob|data):/.test(url));

export async function setSlider(page, selector, value) {
  await page.locator(selector).evaluate((input, to) => { input.value = to; input.dispatchEvent(new Event("input")); }, value);
}

/** A short text that stands for a canvas's pixels, with the share of them that are not white and the number of colours. */
export async function pixels(page, selector, nth = 0) {
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

/** What the browser keeps when a save button is pressed: its name and its bytes. */
export async function saved(page, button) {
  const [download] = await Promise.all([page.waitForEvent("download"), button.evaluate((one) => one.click())]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** How many pixels of a picture have the colour of the rims of an infarct's border. */
export const rimPixels = (page, png) => page.evaluate(async (data) => {
  const image = new Image();
  image.src = `data:image/png;base64,${data}`;
  await image.decode();
  const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
  context.drawImage(image, 0, 0);
  const pixels = context.getImageData(0, 0, image.width, image.height).data;
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) count += pixels[i + 3] === 255 && [0, 1, 2].every((d) => Math.abs(pixels[i + d] - 26) < 2) ? 1 : 0;
  return count;
}, png.toString("base64"));

/** How many colours a saved picture has in some boxes (x, y, width, height in pixels, negative from the right or the bottom). */
export const coloursIn = (page, png, boxes) => page.evaluate(async ({ data, boxes }) => {
  const image = new Image();
  image.src = `data:image/png;base64,${data}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [image.width, image.height];
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return Object.fromEntries(Object.entries(boxes).map(([name, [x, y, width, height]]) => {
    const part = context.getImageData(x < 0 ? image.width + x : x, y < 0 ? image.height + y : y, width, height).data;
    const all = new Set();
    for (let i = 0; i < part.length; i += 4) all.add((part[i] << 16) | (part[i + 1] << 8) | part[i + 2]);
    return [name, all.size];
  }));
}, { data: png.toString("base64"), boxes });
