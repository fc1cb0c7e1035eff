// Where the walls of the heart are, and the views that have names. Model frame: z along the long axis towards the base; the
// middle of the septum lies at an angle about z from x, the anterior wall a quarter turn further, anticlockwise seen from the base.
import type { Case } from "./data.ts";
import type { Cut } from "./shared.ts";

export interface Heart {
  septum: number;    // [degrees]
  assumed: boolean;  // nothing shows where the septum is
}

export function heartOf(c: Case): Heart {
  return { septum: c.json.septum_deg ?? 0, assumed: c.assumes("septum") };
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

/** What a cut is called: a named long axis, or what it is. */
export function cutName(cut: Cut): string {
  if (cut.kind === "none") return "whole wall";
  if (cut.kind === "short") return `short axis, ${-cut.height} mm below the base`;
  const named = looks.find((look) => look.cut?.kind === "long" && (look.cut.angle! - cut.angle) % 180 === 0);
  return named ? `${named.name} long axis` : `long axis, ${cut.angle}° from the septum`;
}

export const unit = (degrees: number): [number, number] =>
  [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];

/** The letter of the wall that is nearest to a direction about the long axis [degrees from x]. */
export function letterAt(heart: Heart, degrees: number): string {
  const away = (angle: number) => Math.cos(((degrees - heart.septum - angle) * Math.PI) / 180);
  return marked(walls.reduce((best, wall) => (away(wall[1]) > away(best[1]) ? wall : best))[0], heart.assumed);
}
