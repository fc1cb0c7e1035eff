// Where planes and lines of one orientation pass through those of another.
import { dot, inSpace, placeOn, type Place, type Plane, type Point } from "./study.ts";

const normal = ({ along_row: a, along_column: b }: Plane): Point => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Where a closed line in space passes through a plane, as places on it. */
export function passages(points: Point[], plane: Plane): Place[] {
  const n = normal(plane);
  const away = points.map((x) => dot(n, [x[0] - plane.origin[0], x[1] - plane.origin[1], x[2] - plane.origin[2]]));
  return points.flatMap((a, i) => {
    const j = (i + 1) % points.length;
    if (away[i] < 0 === away[j] < 0) return [];
    const t = away[i] / (away[i] - away[j]);
    return [placeOn(plane, [0, 1, 2].map((d) => a[d] + t * (points[j][d] - a[d])) as Point)];
  });
}

/** The line along which another plane's picture cuts a picture, from edge to edge of the other; undefined where it does not. */
export function cutOf(picture: Plane, other: Plane): [Place, Place] | undefined {
  const [w, h] = [(other.columns - 1) * other.spacing[0], (other.rows - 1) * other.spacing[1]];
  const corners: Place[] = [[0, 0], [w, 0], [w, h], [0, h]];
  const ends = passages(corners.map((at) => inSpace(other, at)), picture);
  return ends.length === 2 ? [ends[0], ends[1]] : undefined;
}
