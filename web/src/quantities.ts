// The quantities that are shown, and their words.

export interface Quantity {
  name: string;     // as in regions.csv
  title: string;
  unit: string;     // "1" of numbers without one
  signed: boolean;  // a diverging colour map, symmetric about `middle`
  middle: number;
  floor: number;    // nearer to `middle` is as good as none, and not coloured
  help: string;
}

const strainHelp = "Green-Lagrange strain; up to end-diastole from early diastole, after it from end-diastole. " +
  "Negative: shorter.";

export const quantities: Quantity[] = [
  { name: "circumferential_strain", title: "circumferential strain", unit: "1", signed: true, middle: 0, floor: 0.005, help: strainHelp },
  { name: "fibre_stress", title: "fibre stress", unit: "kPa", signed: false, middle: 0, floor: 0.1,
    help: "Total Cauchy stress along the deformed fibre: passive, active and pressure." },
  { name: "fibre_strain", title: "fibre strain", unit: "1", signed: true, middle: 0, floor: 0.005, help: strainHelp },
  { name: "longitudinal_strain", title: "longitudinal strain", unit: "1", signed: true, middle: 0, floor: 0.005, help: strainHelp },
  { name: "radial_strain", title: "radial strain", unit: "1", signed: true, middle: 0, floor: 0.005,
    help: strainHelp + " Positive across the wall: thicker." },
  { name: "active_tension", title: "active tension", unit: "kPa", signed: false, middle: 0, floor: 0.1,
    help: "Tension T along the fibre that the muscle makes (Niederer-Hunter-Smith law)." },
  { name: "fibre_stress_passive", title: "passive fibre stress", unit: "kPa", signed: false, middle: 0, floor: 0.1,
    help: "The passive law's share of the Cauchy stress along the fibre, without the pressure." },
  { name: "J", title: "volume ratio J", unit: "1", signed: true, middle: 1, floor: 0.0005,
    help: "Deformed over undeformed volume; muscle is nearly incompressible, so anything but 1 is the model's error." },
];

export const infarct: Quantity = {
  name: "infarct", title: "infarct M", unit: "1", signed: false, middle: 0, floor: 0.005,
  help: "Extent of the infarct: 1 in it, falling to 0 across the border zone; it does not change with time.",
};

export function quantity(name: string): Quantity {
  return [...quantities, infarct].find((q) => q.name === name)!;
}

export const label = (q: Quantity) => (q.unit === "1" ? q.title : `${q.title} (${q.unit})`);

/** A moment's name for readers: "end-diastole". */
export const stateTitle = (name: string) => name.replaceAll("_", " ").replace(/^end /, "end-");

/** A moment's short name for axes and sliders, "ED" for end_diastole, and its name. */
export const stateMark = (name: string) => ({ title: stateTitle(name),
  label: name.startsWith("end_") ? name.split("_").map((word) => word[0].toUpperCase()).join("") : stateTitle(name) });

/** Below this a number is the rounding of zero, in any unit of the page. */
const rounding = 1e-9;

/** A number for reading, with a true minus sign; a dash where it is missing. */
export function shown(x: number | null | undefined, digits = 3): string {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (Math.abs(x) < rounding) return "0";
  const text = Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? x.toPrecision(digits)
    : x.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(x) || 1))));
  return text.replaceAll("-", "−");
}
