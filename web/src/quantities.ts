// The quantities that are shown, and their words.
import { about } from "./about.ts";

export interface Quantity {
  name: string;     // as in regions.csv
  title: string;
  unit: string;     // "1" of numbers without one
  signed: boolean;  // a diverging colour map, symmetric about `middle`
  middle: number;
  floor: number;    // nearer to `middle` is as good as none, and not coloured
  help: string;
}


/** The program's list: see src/lv/analysis/quantities.cpp. */
export const quantities = about.quantities;

/** What a clinic says of a heartbeat, by columns of beats.csv: see src/lv/report/cycle_tables.cpp. */
export const beatMeasures = about.beat_measures;

/** An infarct's extent, which does not change with time. */
export const infarct = about.infarct;

export function quantity(name: string): Quantity {
  return [...quantities, infarct].find((q) => q.name === name)!;
}

export const label = (q: { title: string; unit: string }) => (q.unit === "1" ? q.title : `${q.title} (${q.unit})`);

/** The program's list of moments: see src/lv/heartbeat/beat.hpp. */
const moment = (name: string) => about.moments.find((m) => m.name === name);

/** A moment's name for readers: "end-diastole". */
export const stateTitle = (name: string) => moment(name)?.title ?? name.replaceAll("_", " ");

/** A moment's short name for axes and sliders, "ED" for end_diastole, and its name. */
export const stateMark = (name: string) => ({ title: stateTitle(name), label: moment(name)?.mark ?? stateTitle(name) });

/** What a clinic calls the volume at a moment: "EDV"; empty where it has no name for it. */
export const volumeAt = (name: string) => moment(name)?.volume ?? "";

/** Below this a number is the rounding of zero, in any unit of the page. */
const rounding = 1e-9;

/** A number for reading, with a true minus sign; a dash where it is missing. */
export function shown(x: number | null | undefined, digits = 3): string {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (Math.abs(x) < rounding) return "0";
  const text = Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? x.toPrecision(digits)
    : x.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(Number(x.toPrecision(digits)))))));
  return text.replaceAll("-", "−");
}

/** What is below any meaning is zero. */
export const nothingBelow = (least: number, x: number | null | undefined) => (typeof x === "number" && Math.abs(x) < least ? 0 : x);

/** A sentence of a file as a printer sets it: "±" for "+-", "²" for "^2", minus signs before numbers. */
export const typeset = (text: string) => text.replaceAll("+-", "±").replaceAll("^2", "²").replace(/(^|[\s(])-(?=\d)/g, "$1−");
