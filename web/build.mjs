// Bundles src/ into dist/page.html: one file with script and style inside and a line where `ventricle report` puts data.
// node build.mjs [FILE]
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const here = new URL(".", import.meta.url);
const { outputFiles } = await build({
  absWorkingDir: here.pathname,
  entryPoints: ["src/main.ts"],
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
const template = readFileSync(new URL("src/page.html", here), "utf8");
const licence = readFileSync(new URL("node_modules/three/LICENSE", here), "utf8");
const page = template
  .replace("/* licence */", () => licence)
  .replace("/* style */", () => part(".css"))
  .replace("/* script */", () => part(".js").replaceAll("</script", "<\\/script"));
writeFileSync(process.argv[2] ?? new URL("dist/page.html", here), page);
