// Whether web/dist/page.html is what web/src makes.   exit code 77: skipped
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
const made = join(mkdtempSync(join(tmpdir(), "ventricle_bundle_")), "page.html");
execFileSync(process.execPath, [join(web, "node_modules/typescript/bin/tsc"), "--noEmit", "-p", web], { stdio: "inherit" });
execFileSync(process.execPath, [join(web, "build.mjs"), made], { stdio: "inherit" });
const same = readFileSync(made).equals(readFileSync(join(web, "dist/page.html")));
console.log(same ? "the committed page is what its sources make" : "web/dist/page.html is stale: cd web && npm run build");
process.exit(same ? 0 : 1);
