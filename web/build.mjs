// Bundles src/ into dist/page.html and dist/draw.html: one file each, with script and style inside and lines where `ventricle report` and
// `ventricle draw` put data.   node build.mjs [FOLDER]
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = fileURLToPath(new URL(".", import.meta.url));
const folder = process.argv[2] ?? join(here, "dist");

async function bundle(script, template, name) {
  const { outputFiles } = await build({
    absWorkingDir: here,
    entryPoints: [script],
    bundle: true,
    minify: true,
    write: false,
    outdir: "dist",
    target: "es2022",
    format: "iife",
    charset: "utf8",
    legalComments: "inline",
  });
  const part = (suffix) => outputFiles.find((file) => file.path.endsWith(suffix)).text.trim();
  const page = readFileSync(join(here, template), "utf8")
    .replace("/* licence */", () => readFileSync(join(here, "node_modules/three/LICENSE"), "utf8"))
    .replace("/* style */", () => part(".css"))
    .replace("/* script */", () => part(".js").replaceAll("</script", "<\\/script"));
  writeFileSync(join(folder, name), page);
}

await bundle("src/main.ts", "src/page.html", "page.html");
await bundle("src/draw/main.ts", "src/draw/draw.html", "draw.html");
