// Whether web/dist is what web/src makes.   exit code 77: skipped
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const web = fileURLToPath(new URL("../../web", import.meta.url));
if (!existsSync(join(web, "node_modules/esbuild"))) {
  console.log("skipped: the tools are not there (cd web && npm ci)");
  process.exit(77);
}
const made = mkdtempSync(join(tmpdir(), "ventricle_bundle_"));
execFileSync(process.execPath, [join(web, "node_modules/typescript/bin/tsc"), "--noEmit", "-p", web], { stdio: "inherit" });
execFileSync(process.execPath, [join(web, "build.mjs"), made], { stdio: "inherit" });
const stale = ["page.html", "draw.html"].filter((page) => !readFileSync(join(made, page)).equals(readFileSync(join(web, "dist", page))));
console.log(stale.length === 0 ? "the committed pages are what their sources make" : `web/dist is stale (${stale.join(", ")}): cd web && npm run build`);
process.exit(stale.length === 0 ? 0 : 1);
