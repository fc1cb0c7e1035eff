// Where the walls of the heart are, and the views that have names. Model frame: z along the long axis towards the base; the
// middle of the septum lies at an angle about z from x, the anterior wall a quarter turn further, anticlockwise seen from the base.
import type { Case } from "./data.ts";
import { shown } from "./quantities.ts";
import type { Cut } from "./shared.ts";

export interface Heart {
  septum: number;    // [degrees]
  assumed: boolean;  // nothing shows where the septum is
  ends: string[];    // of "apex" and "base", those that were not drawn but assumed
}

export function heartOf(c: Case): Heart {
  return { septum: c.json.septum_deg ?? 0, assumed: c.assumes("septum"), ends: ["apex", "base"].filter((part) => c.assumes(part)) };
}

/** "* assumed: septum, apex": what the stars of a picture of the wall mean; empty without any. */
export function starNote(heart: Heart): string {
  const parts = [...(heart.assumed ? ["septum"] : []), ...heart.ends];
  return parts.length ? `* assumed: ${parts.join(", ")}` : "";
}

/** A column's title, with what was assumed of the anatomy that its regions hang on. */
export function starredTitle(title: string, heart: Heart): string {
  const note = starNote(heart);
  return note ? `${title}* (${note})` : title;
}

/** Letters of the walls and their angles from the septum [degrees]. */
export const walls: [string, number][] = [["S", 0], ["A", 90], ["L", 180], ["I", 270]];

export const marked = (name: string, assumed: boolean) => (assumed ? `${name}*` : name);

export interface Look {
  name: string;
  azimuth: number;    // of the camera from the septum [degrees]
  elevation: number;  // [degrees]; from the apex, nearly -90, the azimuth's wall is up
  cut?: Partial<Cut>; // angle from the septum
}

const below = -89.9;
const level = 8;

/** The clinical views: long axes through the middle of the septum (four chambers), the anteroseptal wall (three) and the
 * anterior wall (two), with the septum, or the inferior wall, on the left; the short axis from the apex. */
export const looks: Look[] = [
  { name: "4-chamber", azimuth: 90, elevation: level, cut: { kind: "long", angle: 0 } },
  { name: "3-chamber", azimuth: 120, elevation: level, cut: { kind: "long", angle: 30 } },
  { name: "2-chamber", azimuth: 0, elevation: level, cut: { kind: "long", angle: 90 } },
  { name: "short axis", azimuth: 90, elevation: below, cut: { kind: "short" } },
  { name: "anterior", azimuth: 90, elevation: level, cut: { kind: "none" } },
  { name: "septal", azimuth: 0, elevation: level, cut: { kind: "none" } },
  { name: "inferior", azimuth: 270, elevation: level, cut: { kind: "none" } },
  { name: "lateral", azimuth: 180, elevation: level, cut: { kind: "none" } },
  { name: "apex", azimuth: 90, elevation: below, cut: { kind: "none" } },
];

/** A plane through the long axis at an angle from the septum [degrees]: its clinical name, or where it is. */
export function axisName(angle: number): string {
  const named = looks.find((look) => look.cut?.kind === "long" && Math.abs(Math.sin(((look.cut.angle! - angle) * Math.PI) / 180)) < 1e-4);
  return named ? `${named.name} long axis` : `long axis, ${shown(angle)}° from the septum`;
}

/** What a cut is called. */
export function cutName(cut: Cut): string {
  if (cut.kind === "none") return "whole wall";
  return cut.kind === "short" ? `short axis, ${shown(-cut.height)} mm below the base` : axisName(cut.angle);
}

export const unit = (degrees: number): [number, number] =>
  [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];

/** The letter of the wall that is nearest to a direction about the long axis [degrees from x]. */
export function letterAt(heart: Heart, degrees: number): string {
  const away = (angle: number) => Math.cos(((degrees - heart.septum - angle) * Math.PI) / 180);
  return marked(walls.reduce((best, wall) => (away(wall[1]) > away(best[1]) ? wall : best))[0], heart.assumed);
}
