// Pictures of parts of a report page. node docs/page_shots.mjs PAGE.html FOLDER ID=NAME ...
// ID is that of a section; "phone" is the wall on a screen of 390 x 800, "top" what the page opens with.
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const require = createRequire(fileURLToPath(new URL("../web/", import.meta.url)));
const playwright = require("playwright-core");
const [file, folder, ...wanted] = process.argv.slice(2);
const browser = await playwright.chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader"] });

async function shoot(id, name) {
  const viewport = id === "phone" ? { width: 390, height: 800 } : { width: 1200, height: 900 };
  const page = await (await browser.newContext({ viewport, offline: true })).newPage();
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 120_000 });
  const path = join(folder, `${name}.png`);
  const part = id === "phone" ? "canvas.wall" : id === "top" ? "body" : `#${id}`;
  await page.locator(part).first().scrollIntoViewIfNeeded();
  await page.waitForTimeout(1500); // what is drawn when it comes into sight
  if (id === "phone" || id === "top") await page.screenshot({ path });
  else await page.locator(part).screenshot({ path });
  await page.context().close();
}

for (const pair of wanted) {
  const [id, name] = pair.split("=");
  await shoot(id, name);
  console.log(`${name}.png`);
}
await browser.close();
