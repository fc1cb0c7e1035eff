// The page: header, what is unfinished, and one section per subject.
import "./style.css";
import { curvesSection, muscleSection, rotationSection } from "./curves_section.ts";
import { about } from "./about.ts";
import { Case } from "./data.ts";
import { el } from "./dom.ts";
import { flowSection } from "./flow_section.ts";
import { heartbeatSection } from "./heartbeat_section.ts";
import { outlinesSection } from "./outlines_section.ts";
import { Shared, timeline } from "./shared.ts";
import { segmentsSection } from "./segments_section.ts";
import { strainSection } from "./strain_section.ts";
import { assumedSentence, firstSection, remarks, sentence } from "./first_section.ts";
import { openingLook } from "./orientation.ts";
import { bullsEyeSection } from "./regions_section.ts";
import { detailsSection, inputSection, normalSection, parameterSection, zoneSection } from "./tables_section.ts";
import { wallSection } from "./wall_section.ts";

function header(cases: Case[], unlikeMoments: string): HTMLElement {
  const title = cases.map((c) => c.name).join(" beside ");
  document.title = `${title} – ventricle`;
  const unfinished = cases.filter((c) => !c.json.complete);
  return el("header", {}, el("h1", {}, title), ...cases.map((c) => el("p", { class: "sentence" }, sentence(c) + assumedSentence(c))),
    unlikeMoments ? el("p", { class: "warning", id: "unlike-moments" }, unlikeMoments) : undefined,
    ...unfinished.map((c) => el("div", { class: "state", role: "alert" }, el("strong", {}, `The run of ${c.name} is not complete. `),
      "What there is, is shown; what is not there, is said to be missing.", el("ul", {}, ...c.json.state.map((line) => el("li", {}, line))))));
}

/** Where the page is from, and how exactly it repeats the files. */
function footer(cases: Case[], version: string): HTMLElement {
  const fidelity = cases.map((c) => c.json.wall?.displacement.largest_error ?? 0).reduce((a, b) => Math.max(a, b), 0);
  const relative = cases.flatMap((c) => Object.values(c.json.wall?.quantities ?? {}))
    .map((q) => q.largest_error / (q.max! - q.min!)).reduce((a, b) => Math.max(a, b), 0);
  return el("footer", {}, `A left ventricle modelled by ventricle; page written by version ${version} from the files in ` +
    `${cases.map((c) => c.json.folder).join(" and ")}. Research software: nothing here is a diagnosis or a recommendation for treatment. ` +
    "Tables and charts repeat the files exactly. The 3-D view repeats positions within " +
    `${fidelity.toFixed(2)} mm and values within ${(100 * relative).toFixed(1)}% of their range. Drawn with three.js (MIT licence). ` +
    "Colour maps are even in lightness and safe for colour-blind eyes. ventricle is free software under the GPL, version 3 or later.");
}

/** When the first picture is on the screen: what is done after it does not keep it waiting. Where nobody looks there is none. */
const onScreen = () => new Promise<void>((done) => {
  new PerformanceObserver((list) => { if (list.getEntriesByName("first-contentful-paint").length) done(); }).observe({ type: "paint", buffered: true });
  setTimeout(done, document.hidden ? 0 : 2000);
});

/** After the screen's next frame; where nobody looks, and there is none, soon. */
const painted = () => new Promise((done) => {
  requestAnimationFrame(() => setTimeout(done));
  setTimeout(done, 500);
});

async function main(): Promise<void> {
  const { version, cases: count, unlike_moments: unlikeMoments } = about;
  const cases = Array.from({ length: count }, (_, i) => Case.read(i));
  if (new Set(cases.map((c) => c.name)).size < cases.length) for (const c of cases) c.name += ` (${c.json.folder})`;
  const page = document.getElementById("page")!;
  page.className = cases.length > 1 ? "two" : "one";
  const time = timeline(cases);
  const quantity = ["circumferential_strain", "fibre_stress"].find((name) => cases.some((c) => c.wall?.quantities.includes(name))) ?? "infarct";
  const shared = new Shared({ quantity, step: time.start, cut: { kind: "long", angle: 0, height: -40, ...openingLook.cut }, fibres: false, fixed: false });
  const wall = wallSection(cases, shared, time);
  const nav = el("nav", { "aria-label": "sections" });
  page.append(header(cases, unlikeMoments), el("div", { class: "first" }, firstSection(cases), remarks(cases), wall.element), nav);
  await wall.opened;
  await onScreen();
  document.body.dataset.first = performance.now().toFixed(0);

  await wall.draw();
  await painted();
  document.body.dataset.wall = performance.now().toFixed(0);

  const all = [bullsEyeSection(cases, shared, wall.scale), zoneSection(cases, shared), heartbeatSection(cases, shared, time), segmentsSection(cases, shared, time), curvesSection(cases, shared, time), detailsSection(cases),
    rotationSection(cases), flowSection(cases), outlinesSection(cases), strainSection(cases), normalSection(cases), muscleSection(cases),
    inputSection(cases), parameterSection(cases)];
  const isFolded = (part: HTMLElement) => part.classList.contains("folded");
  const sections = [...all.filter((part) => !isFolded(part)), ...all.filter(isFolded)];
  nav.append(...all.filter((part) => !isFolded(part)).map((part) => el("a", { href: `#${part.id}` }, part.querySelector("h2")!.textContent!)));
  page.append(...sections, footer(cases, version));
  await painted();
  document.body.dataset.ready = performance.now().toFixed(0);
}

main().catch((error: unknown) => {
  document.body.dataset.failed = String(error);
  document.getElementById("page")!.append(el("p", { class: "state", role: "alert" }, `This page cannot be drawn: ${error}`));
  throw error;
});
