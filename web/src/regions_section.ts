// Bull's-eyes of the quantity that the 3-D view shows, which point at the same regions; those of the infarct.
import { drawBullsEye, type DrawnBullsEye } from "./bullseye.ts";
import { barParts, colourBar } from "./bar.ts";
import type { Scale } from "./colours.ts";
import { Case, type Scheme, value } from "./data.ts";
import { el, figure, fileName, folded, missing, section } from "./dom.ts";
import { heartOf, marked, starNote } from "./orientation.ts";
import { label, type Quantity, quantity, shown, stateTitle } from "./quantities.ts";
import { Shared, statesOf } from "./shared.ts";
import { regionName } from "./wall_section.ts";

const schemeTitle: Record<Scheme, string> = { aha17: "17 segments (AHA)", sector: "seven slices" };

/** Bull's-eyes and the region that is marked in all of them. */
class Marked {
  private plots: { drawn: DrawnBullsEye; scheme: Scheme }[] = [];
  constructor(private shared: Shared) {}

  clear(): void { this.plots = []; }

  draw(c: Case, scheme: Scheme, values: number[], details: string[], scale: Scale, title: string, file: string,
    barTitle: string, { outlined, assumed = [] }: { outlined?: boolean[]; assumed?: string[] } = {}): HTMLElement {
    const heart = heartOf(c);
    const names = c.regionNames(scheme);
    const drawn = drawBullsEye({ scheme, names, values, details, scale, title, assumed: heart.assumed, outlined,
      pick: (index, fixed) => this.shared.pick(index === undefined ? undefined : { scheme, index }, fixed) });
    this.plots.push({ drawn, scheme });
    return figure([title, starNote(heart, assumed)].filter(Boolean).join("; "), file, drawn.figure, (width) => barParts(scale, barTitle, width));
  }

  mark(): void {
    const { selection } = this.shared.state;
    for (const { drawn, scheme } of this.plots) drawn.highlight(selection?.scheme === scheme ? selection.index : undefined);
  }
}

function means(c: Case, q: Quantity, state: string, scheme: Scheme) {
  const rows = c.regionNames(scheme).map((name) => c.row(state, scheme, name, q.name));
  return { values: rows.map((row) => value(row?.mean)), details: rows.map((row) => `${shown(value(row?.mean))} ± ${shown(value(row?.sd))}`) };
}

/** The second case less the first, per AHA segment. */
function difference(cases: Case[], q: Quantity, marks: Marked): HTMLElement | undefined {
  if (cases.length < 2 || cases.some((c) => !c.regions.length)) return undefined;
  const states = statesOf(cases).filter((state) => cases.every((c) => c.states.includes(state)));
  const all = states.map((state) => {
    const [a, b] = cases.map((c) => means(c, q, state, "aha17").values);
    return b.map((x, i) => x - a[i]);
  });
  const most = all.flat().filter(Number.isFinite).reduce((best, x) => Math.max(best, Math.abs(x)), 0) || 1;
  const scale: Scale = { min: -most, max: most, diverging: true, middle: 0, floor: q.floor };
  const [a, b] = cases.map((c) => c.name);
  return el("div", { class: "differences" }, el("h3", {}, `Difference, ${b} − ${a}`), colourBar(scale, `${label(q)}, ${b} − ${a}`),
    el("div", { class: "pair" }, ...states.map((state, s) => marks.draw(cases[1], "aha17", all[s], all[s].map((x) => shown(x)), scale,
      `${q.title} at ${stateTitle(state)}, ${b} − ${a}`, fileName(b, "minus", a, q.name, state), `${label(q)}, ${b} − ${a}`))));
}

/** The state that a strain at a moment is from. */
const since = (c: Case, q: Quantity, state: string) => c.since(q.name, c.timeOf(state) ?? NaN);

/** "circumferential strain at end-systole, from end-diastole". */
const heading = (cases: Case[], q: Quantity, state: string) =>
  [`${label(q)} at ${stateTitle(state)}`, [...new Set(cases.map((c) => since(c, q, state)).filter(Boolean))].join(" or ")].filter(Boolean).join(", ");

/** What goes around regions of a bull's-eye; before the word "infarct". */
const outlineWords = (outlined: boolean[]) => outlined.some(Boolean) ? "white line: around regions more than half of which is" : "no region is more than half";

function readOut(cases: Case[], shared: Shared): string {
  const { selection } = shared.state;
  if (!selection) return "";
  const q = quantity(shared.state.quantity);
  return cases.map((c) => {
    const name = regionName(c, selection.scheme, selection.index);
    return `${c.name}, ${name}: ` + c.states.map((state) => {
      const row = c.row(state, selection.scheme, name, q.name);
      return `${stateTitle(state)} ${shown(value(row?.mean))} ± ${shown(value(row?.sd))} ` +
        `(1% ${shown(value(row?.p1))}, median ${shown(value(row?.p50))}, 99% ${shown(value(row?.p99))})`;
    }).join("; ");
  }).join(" | ");
}

const help = "The wall seen from the apex and laid flat: the base outside, the apex in the middle, anterior up, septum left. Left of each pair the 17 " +
  "segments of the American Heart Association with their numbers, parted by dark lines into what the left anterior descending (LAD), right (RCA) " +
  "and circumflex (LCX) artery usually feed; right the scheme of seven short-axis slices, the basal five with six sectors, the other two with " +
  "four. Means over the undeformed volume, from regions.csv; stripes where a region has no value. Quantity and colours are those of the 3-D " +
  "view. Point at a region to outline it there, click to keep it; with the keyboard, arrow keys go around and to the next ring.";

export function bullsEyeSection(cases: Case[], shared: Shared, scaleNow: () => Scale): HTMLElement {
  if (cases.every((c) => !c.regions.length))
    return folded("regions", "Bull's-eyes", "regions.csv is missing, so there are no regional means.");
  const marks = new Marked(shared);
  const place = el("div");
  const read = el("p", { class: "read", "aria-live": "polite" });
  const pair = (c: Case, q: Quantity, state: string, scale: Scale) => c.regions.length
    ? el("div", { class: "pair" }, ...(["aha17", "sector"] as const).map((scheme) => {
      const { values, details } = means(c, q, state, scheme);
      const outlined = c.wall?.infarctedRegions(scheme);
      const title = [`${c.name}: ${q.title} at ${stateTitle(state)}`, since(c, q, state), schemeTitle[scheme]].filter(Boolean).join(", ");
      return marks.draw(c, scheme, values, details, scale, title + (outlined ? `; ${outlineWords(outlined)} ${marked("infarct", c.assumesInfarct)}` : ""),
        fileName(c.name, q.name, state, scheme), `${label(q)}, mean of the region`, { outlined, assumed: outlined && c.assumesInfarct ? ["infarct"] : [] });
    }))
    : missing(`${c.name}: regions.csv is missing, so there are no regional means.`);
  const refresh = () => {
    marks.clear();
    const q = quantity(shared.state.quantity);
    if (q.name === "infarct") {
      place.replaceChildren(missing("The infarct does not change with time: its transmurality stands at the zones below."));
      return;
    }
    const scale = scaleNow();
    place.replaceChildren(...statesOf(cases).map((state) => el("div", { class: "state-of" }, el("h3", {}, heading(cases, q, state)),
      colourBar(scale, `${label(q)}, mean of the region`), el("div", { class: "cases" }, ...cases.map((c) => pair(c, q, state, scale))))),
      ...[difference(cases, q, marks)].filter((part) => part !== undefined));
    mark();
  };
  const mark = () => {
    marks.mark();
    read.textContent = readOut(cases, shared);
  };
  shared.onChange((_, changed) => {
    if (changed.has("quantity") || changed.has("range")) refresh();
    if (changed.has("selection")) mark();
  });
  refresh();
  return section("regions", "Bull's-eyes", help, read, place);
}

/** How much of each AHA segment is infarcted, and of the wall's thickness there; nothing for a case without infarct. */
export function transmurality(c: Case, shared: Shared): HTMLElement | undefined {
  const rows: any[] = c.summary?.infarct_segments ?? [];
  if (!rows.length) return undefined;
  const of = c.regionNames("aha17").map((name) => rows.find((row) => row.segment === name.replace(/^\d+ /, "")));
  const scale: Scale = { min: 0, max: 100, diverging: false, middle: 0, floor: 0.5 };
  const marks = new Marked(shared);
  const assumed = c.assumesInfarct ? ["infarct"] : [];
  const star = c.assumesInfarct ? "*" : "";
  const details = of.map((row) => row
    ? `infarct in ${shown(row.percent_of_segment)}% of the segment, there through ${shown(row.transmurality_percent)}% of the wall` : "no infarct");
  const one = (key: string, title: string, file: string) =>
    marks.draw(c, "aha17", of.map((row) => row?.[key] ?? 0), details, scale, `${c.name}: ${title} (%)`, fileName(c.name, file), `${title}${star} (%)`,
      { assumed });
  const drawn = [one("percent_of_segment", "part of the segment that is infarcted", "infarcted-part"),
    one("transmurality_percent", "transmurality where it is infarcted", "transmurality")];
  shared.onChange((_, changed) => changed.has("selection") && marks.mark());
  return el("div", {}, colourBar(scale, `infarct${star} (%)`), el("div", { class: "pair" }, ...drawn));
}
