// Where the walls of the heart are, and the views that have names. Model frame: z along the long axis towards the base; the
// middle of the septum lies at an angle about z from x, the anterior wall a quarter turn further, anticlockwise seen from the base.
import { about, type Look } from "./about.ts";
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

/** "* assumed: septum, apex": what the stars of a picture of the wall mean, and of more that was assumed; empty without any. */
export function starNote(heart: Heart, more: string[] = []): string {
  const parts = [...(heart.assumed ? ["septum"] : []), ...heart.ends, ...more];
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

/** The views that have names, and the one in which the page opens: see src/lv/page/views.hpp. */
export const looks = about.views;
export const openingLook = looks[about.opening_view];

/** Where a camera stands [degrees]: from the septum about the long axis, and above the plane of the base. */
export interface Direction { azimuth: number; elevation: number }

/** A plane through the long axis at an angle from the septum [degrees]: its clinical name, or where it is. */
export function axisName(angle: number): string {
  const named = looks.find((look) => look.cut.kind === "long" && Math.abs(Math.sin(((look.cut.angle! - angle) * Math.PI) / 180)) < 1e-4);
  return named ? `${named.name} long axis` : `long axis, ${shown(angle)}° from the septum`;
}

/** What a cut is called. */
export function cutName(cut: Cut): string {
  if (cut.kind === "none") return "whole wall";
  return cut.kind === "short" ? `short axis, ${shown(-cut.height)} mm below the base` : axisName(cut.angle);
}

export const unit = (degrees: number): [number, number] =>
  [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];

/** The letter of the wall that is nearest to a direction about the long axis [degrees from the septum]. */
function nearestWall(azimuth: number): string {
  const near = (angle: number) => Math.cos(((azimuth - angle) * Math.PI) / 180);
  return walls.reduce((best, wall) => (near(wall[1]) > near(best[1]) ? wall : best))[0];
}

/** The same of a direction from x, as it is marked. */
export const letterAt = (heart: Heart, degrees: number) => marked(nearestWall(degrees - heart.septum), heart.assumed);

/** Where a camera stands: "from the anterior side". */
export function sideName(heart: Heart, { azimuth, elevation }: Direction): string {
  if (Math.abs(elevation) > 60) return elevation < 0 ? "from the apex" : "from the base";
  const words: Record<string, string> = { S: "septal", A: "anterior", L: "lateral", I: "inferior" };
  return `from the ${marked(words[nearestWall(azimuth)], heart.assumed)} side`;
}

/** Whether a camera and a cut are those of a view. */
export function isAt(look: Look, { azimuth, elevation }: Direction, cut: Cut): boolean {
  const near = 0.5;  // [degrees]
  const turned = Math.abs(((((azimuth - look.azimuth + 180) % 360) + 360) % 360) - 180);
  return turned < near && Math.abs(elevation - look.elevation) < near && cut.kind === look.cut.kind && (cut.kind !== "long" || cut.angle === look.cut.angle);
}

/** Why the page opens in the view it does, where there is an infarct. */
export const openingReason = (look: Look) => look.cut.kind === "long"
  ? `The page opens in the ${look.name} view: of the long axes it shows the most of the infarct.`
  : `The page opens on the ${look.name} side: no long axis shows half as much of the infarct.`;
