// The page of a run in a real browser, opened from a file without a network.
// node check.mjs VENTRICLE [--work WORK] [--images WORK]   exit code 77: skipped
// WORK: folders of runs that are there, of a case with flow and of one with a cine; without, small ones are run.
import { rmSync } from "node:fs";
import { checkDocumented, checkElsewhere, checkFigures, checkImages, checkMixed, checkReal } from "./image_checks.mjs";
import { checkPage } from "./page_checks.mjs";
import { makeRuns } from "./runs.mjs";
import { browser, failed, folder, secondsTaken, timed } from "./setting.mjs";
import { checkBeats, checkCompare, checkFitted, checkFlowPlane, checkHalf, checkOpeningView, checkOrientation } from "./view_checks.mjs";

const made = makeRuns();

/** Checks what a run was made for, as soon as it is. */
async function of(run, ...checks) {
  await made[run];
  for (const one of checks) await timed(one.name, one);
}

try {
  await of("page", checkPage);
  await of("turned", checkOrientation, checkOpeningView);
  await of("thick", checkFlowPlane);
  await of("compare", checkCompare);
  await of("fitted", checkFitted);
  await of("half", checkHalf);
  await of("beats", checkBeats);
  await of("images", checkImages, checkFigures);
  await of("elsewhere", checkElsewhere);
  await of("mixed", checkMixed);
  await of("real", checkReal, checkDocumented);
} finally {
  await browser.close();
  await Promise.allSettled(Object.values(made));
  rmSync(folder, { recursive: true, force: true });
}
console.log(`info  seconds: ${secondsTaken()}`);
console.log(`${failed} failed`);
process.exit(failed ? 1 : 0);
