// The flow of all cases in their long-axis planes.
import { DrawnWall } from "./curved.ts";
import type { Case } from "./data.ts";
import { el, fileName, folded, missing, overlaidPng, savePng, section } from "./dom.ts";
import { fastestFrame, type FlowFrame, flowScale, type FlowQuantity, flowTitle, FlowView, readFlow } from "./flow_view.ts";
import { axisName, heartOf } from "./orientation.ts";

interface Shown { c: Case; wall: DrawnWall; frame: number; data: FlowFrame; view: FlowView }

const none = "There are no frames of the blood in the work folder (output.blood = false, or an engine without blood).";
const noWall = "There are frames of the blood, but none of the wall, without which its borders are not known.";

/** Why a case's flow is not shown; nothing where it is. */
const absent = (c: Case) => (c.flow ? undefined : c.json.has_blood ? noWall : none);

/** "four-chamber long axis", or where the plane lies. */
const planeName = (c: Case) => axisName((c.flow?.plane_deg ?? 0) - heartOf(c).septum);

export function flowSection(cases: Case[]): HTMLElement {
  const missed = cases.map(absent);
  if (missed.every((why) => why !== undefined)) return folded("flow", "Flow in a long-axis plane", [...new Set(missed)].join(" "));
  const place = el("div");
  const whole = section("flow", "Flow in a long-axis plane",
    `Blood in the plane of the ${[...new Set(cases.filter((c) => absent(c) === undefined).map(planeName))].join(" and of the ")}, within the wall and, above ` +
    "the base, in line with its inner rim; letters name the walls on both sides. Colours: speed with all three components, or pressure. Arrows: velocity in the plane, to the scale of the arrow at the lower " +
    "right, which is set by the fastest blood of the moment. It opens at the moment after end-diastole with the fastest blood among those the " +
    "run wrote. There are no valves and no atrium: blood passes freely through the open base, so the pattern there is not physiological.", place);
  // drawn when it comes near the screen, or soon, so that it can be printed: the first view does not wait for it
  let isBegun = false;
  const begin = () => {
    if (isBegun) return;
    isBegun = true;
    observer.disconnect();
    void fill(cases, place);
  };
  const observer = new IntersectionObserver((entries) => { if (entries.some((entry) => entry.isIntersecting)) begin(); }, { rootMargin: "600px" });
  observer.observe(whole);
  setTimeout(begin, 3000);
  return whole;
}

async function fill(cases: Case[], place: HTMLElement): Promise<void> {
  const found: Shown[] = [];
  for (const c of cases) {
    if (!c.flow || !c.wall) continue;
    const frame = await fastestFrame(c.flow, c.timeOf("end_diastole"));
    const view = new FlowView(c.flow, heartOf(c));
    view.canvas.className = "flow";
    view.canvas.setAttribute("role", "img");
    const wall = new DrawnWall(c.wall);
    found.push({ c, wall, frame, data: await readFlow(c.flow, frame, wall), view });
  }
  let what: FlowQuantity = "speed";
  const draw = () => {
    const scale = flowScale(found.map(({ c, data }) => ({ flow: c.flow!, frame: data })), what);
    for (const { c, frame, data, view } of found) {
      const t = c.flow!.times[frame];
      const captions = [`${c.name}, ${c.words(t)}, ${c.clock(t)}`, `${planeName(c)}${heartOf(c).assumed ? " (* the septum is assumed)" : ""}`];
      view.show(data, what, scale, captions);
      view.canvas.setAttribute("aria-label", `${what} and velocity: ${captions.join("; ")}`);
    }
  };
  const choice = el("select", { change: () => { what = choice.value as FlowQuantity; draw(); } },
    ...(["speed", "pressure"] as const).map((name) => el("option", { value: name }, flowTitle[name])));
  const panel = (one: Shown) => el("div", { class: "panel" }, el("div", { class: "view flowing" }, one.view.canvas, one.view.overlay),
    el("label", { class: "wide" }, "time", el("input", { type: "range", min: 0, max: one.c.flow!.times.length - 1, step: 1, value: one.frame,
      "aria-label": `time of the flow of ${one.c.name}`, input: async (event: Event) => {
        one.frame = (event.target as HTMLInputElement).valueAsNumber;
        one.data = await readFlow(one.c.flow!, one.frame, one.wall);
        draw();
      } })), savePng(fileName(one.c.name, "flow"), () => overlaidPng(one.view.canvas, one.view.overlay)));
  place.replaceChildren(el("div", { class: "controls" }, el("label", {}, "colours", choice)),
    el("div", { class: "cases" }, ...found.map(panel), ...cases.filter(absent).map((c) => missing(`${c.name}: ${absent(c)}`))));
  draw();
}
