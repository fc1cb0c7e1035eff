// The colour maps of the program's pictures (src/lv/report/colour_map.cpp): even in lightness, distinct for colour-blind
// eyes; interpolated in Oklab (B. Ottosson, 2020).

export type Rgb = [number, number, number];

const sequentialAnchors = [0x441a68, 0x462f83, 0x41449b, 0x2c5da4, 0x1874a2, 0x028aa0,
  0x059f9b, 0x1eb490, 0x4ec77e, 0x87d763, 0xbee451, 0xf3ee44];
const divergingAnchors = [0x02468b, 0x2668aa, 0x4c8ac6, 0x7fadd6, 0xb6cfe4, 0xf1f1f1,
  0xe3c7b5, 0xd49c80, 0xc27152, 0xa8482e, 0x8b1a0f];

export const missingColour = "#d9d9d9";
/** Colours of lines that colour-blind readers tell apart (Okabe and Ito, 2008). */
export const lineColours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#4d4d4d"];

const toLinear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const toSrgb = (c: number) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);

function toOklab(hex: number): Rgb {
  const [r, g, b] = [hex >> 16, (hex >> 8) & 255, hex & 255].map((c) => toLinear(c / 255));
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s];
}

function fromOklab([L, a, b]: Rgb): Rgb {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const part = (c: number) => Math.round(255 * toSrgb(Math.min(1, Math.max(0, c))));
  return [part(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    part(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    part(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s)];
}

function table(anchors: number[]): Rgb[] {
  const lab = anchors.map(toOklab);
  return Array.from({ length: 256 }, (_, i) => {
    const at = (i * (lab.length - 1)) / 255;
    const k = Math.min(Math.floor(at), lab.length - 2);
    return fromOklab(lab[k].map((from, c) => from + (at - k) * (lab[k + 1][c] - from)) as Rgb);
  });
}

const tables = { sequential: table(sequentialAnchors), diverging: table(divergingAnchors) };

/** Values nearer than `floor` to `middle` are as good as none and have no colour; where colours begin at the middle neither have those below
 * it: between nodes, quadratic elements fall below what they have there. */
export interface Scale { min: number; max: number; diverging: boolean; middle: number; floor: number }

export const uncoloured: Rgb = [236, 234, 231];
/** From where to where a scale has no colour. */
export const uncolouredRange = ({ min, middle, floor }: Scale): [number, number] => [min < middle || floor === 0 ? middle - floor : -1e30, middle + floor];
const isColoured = (scale: Scale, x: number) => {
  const [from, to] = uncolouredRange(scale);
  return x <= from || x >= to;
};

export const cssOf = (rgb: Rgb) => `rgb(${rgb.join(",")})`;

export const colourTable = (scale: Scale) => (scale.diverging ? tables.diverging : tables.sequential);

export function rgbOf(scale: Scale, x: number): Rgb {
  if (!isColoured(scale, x)) return uncoloured;
  const t = scale.max > scale.min ? (x - scale.min) / (scale.max - scale.min) : 0.5;
  return colourTable(scale)[Math.round(255 * Math.min(1, Math.max(0, t)))];
}

export function colourOf(scale: Scale, x: number): string {
  return Number.isNaN(x) ? missingColour : cssOf(rgbOf(scale, x));
}

/** Black or white letters on a colour. */
export function inkOn(scale: Scale, x: number): string {
  if (Number.isNaN(x)) return "#222";
  const [r, g, b] = rgbOf(scale, x).map((c) => toLinear(c / 255));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.22 ? "#111" : "#fff";
}
