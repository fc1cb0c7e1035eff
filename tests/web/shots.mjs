// Pictures of a report page.
// node tests/web/shots.mjs PAGE.html FOLDER [ID=NAME ...]
// ID is that of a section; "phone" is the wall on a screen of 390 x 800, "top" what the page opens with. Without IDs: what the page
// opens with and every section, on screens of 1440 x 900, 1280 x 720 and 390 x 844 pixels, at 200% zoom, dark, and printed, and print.pdf.
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { inSight, lacking, late, launch, openPage, screens, settled } from "./browser.mjs";

const [file, folder, ...wanted] = process.argv.slice(2);
if (lacking) throw new Error(lacking);
mkdirSync(folder, { recursive: true });
const browser = await launch();

async function shootPart(id, name) {
  const page = await openPage(browser, file, { viewport: id === "phone" ? { width: 390, height: 800 } : { width: 1200, height: 900 } });
  const path = join(folder, `${name}.png`);
  const part = page.locator(id === "phone" ? "canvas.wall" : id === "top" ? "body" : `#${id}`).first();
  await part.scrollIntoViewIfNeeded();
  if (id === "phone" || id === "top") await settled(page);
  else await inSight(page, id);
  await (id === "phone" || id === "top" ? page : part).screenshot({ path });
  await page.context().close();
}

async function shootScreen(name, { media = "screen", ...settings }) {
  const page = await openPage(browser, file, settings);
  await page.emulateMedia({ media });
  if (media === "print") await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  await settled(page);
  await page.screenshot({ path: join(folder, `${name}_top.png`) });
  for (const id of await page.locator("section:not(.folded)").evaluateAll((all) => all.map((one) => one.id))) {
    await inSight(page, id);
    await page.locator(`#${id}`).screenshot({ path: join(folder, `${name}_${id}.png`) });
  }
  await page.context().close();
}

for (const pair of wanted) {
  await shootPart(...pair.split("="));
  console.log(`${pair.split("=")[1]}.png`);
}
if (!wanted.length) {
  for (const [name, settings] of Object.entries(screens)) await shootScreen(name, settings);
  const page = await openPage(browser, file);
  for (const id of Object.keys(late)) if (await page.locator(`#${id}`).count()) await inSight(page, id);
  await page.pdf({ path: join(folder, "print.pdf"), format: "A4" });
}
await browser.close();
