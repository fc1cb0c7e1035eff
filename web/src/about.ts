// What the program tells the page besides its cases: see src/lv/page/page.cpp.
import type { Quantity } from "./quantities.ts";
import type { Cut } from "./shared.ts";

/** A view of the wall. */
export interface Look {
  name: string;
  azimuth: number;    // of the camera from the septum [degrees]
  elevation: number;  // [degrees]; from the apex, nearly -90, the azimuth's wall is up
  cut: Partial<Cut>;  // angle from the septum
}

interface About {
  version: string;
  cases: number;
  unlike_moments: string;
  quantities: Quantity[];
  infarct: Quantity;
  moments: { name: string; title: string; mark: string; volume: string }[];
  beat_measures: { name: string; title: string; unit: string; help: string }[];
  territories: { name: string; segments: number[]; angle: number }[];  // segments from 0; anticlockwise from the right [degrees]
  views: Look[];
  opening_view: number;
}

export const about: About = JSON.parse(document.getElementById("about")!.textContent!);
