#!/usr/bin/env python3
"""Twin experiments: what a fit recovers of hearts whose stress-free shape, stiffness and contractility are known.

A made-up person (ventricle phantom --person) is fitted and contracted: this model is the heart whose truth is known. Its end-diastolic and
end-systolic walls are seen as label maps: pixels on the person's slices, borders drawn unsteadily, slices moved by breath-holds, the
end-systolic volume counted from the pixels. A fit of these maps, with the pressures and nothing else, is compared with the truth, on a mesh like
the truth's and on another. A truth 5:1.5 is person 5 with muscle 1.5 times as stiff as Klotz's curve asks for, so that her heart without load is
larger than a fit to the curve can know.
Usage: twins.py VENTRICLE [PERSON[:TIMES]...]; VENTRICLE_TWINS_FOLDER keeps the runs. Needs NumPy, SciPy, meshio and NiBabel (exit code 77 without)."""
import csv
import json
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

try:
    import meshio
    import nibabel
    import numpy as np
    from scipy.spatial import cKDTree
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-meshio, python3-nibabel, python3-scipy)")
    sys.exit(77)

program = pathlib.Path(sys.argv[1]).resolve()
persons = sys.argv[2:] or ["7", "5", "2", "3", "4", "5:1.5"]

# Meshes: of the truth, and other ones of the fit. Coarse, for tests only: one layer of quadratic elements.
meshes = {"same": "13 mm", "other": "11 mm"}
border_noise = 0.5  # of a drawn border, root mean square [mm]
breath_hold = 1.5  # of a slice in its plane, root mean square [mm]
# What a fit must recover; borders are drawn to half a millimetre, slices lie 6 to 10 mm apart.
most_off = {"V0": 0.10, "T_scale": 0.25}  # as fractions
most_distant = 2.0  # mean distance of the stress-free surfaces [mm]
fineness = 6  # parts of a quadratic side, along each edge


def run(case, work):
    """Processor seconds; ends the program with the run's last words where it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "run", case, "--work", work, "--until", "results", "--ranks", "1"], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(f"{case}: {done.stderr.strip() or done.stdout[-500:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def frame_of(work):
    """Origin and axes (columns) of the model frame in the scanner's (LPS, mm)."""
    frame = json.loads((work / "01_anatomy/frame.json").read_text())
    return (np.array(frame["origin_in_image_space_mm"]),
            np.column_stack([frame[f"{axis}_axis_in_image_space"] for axis in "xyz"]))


class Side:
    """Endocardium or epicardium of a wall's quadratic elements: nine nodes to each side of an element, in a square."""

    def __init__(self, mesh, transmural):
        on_side = np.abs(mesh.point_data["transmural"] - transmural) < 1e-6
        faces = np.array([(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])
        squares = []
        for parts in mesh.cells_dict["hexahedron"].reshape(-1, 8, 8):  # eight cells are the parts of one element
            quads = [list(quad) for cell in parts for quad in cell[faces] if on_side[quad].all()]
            if len(quads) == 4:
                squares.append(self.square(quads))
        self.squares = np.array(squares)
        edges = {}
        for square in squares:
            for line in (square[0], square[2], square[:, 0], square[:, 2]):
                edges.setdefault(frozenset(line), []).append(line)
        self.base = np.unique([line for lines in edges.values() if len(lines) == 1 for line in lines])

    @staticmethod
    def square(quads):
        """Of four quadrangles around a node: the nodes around it in their order, laid on a square's edge."""
        centre = set.intersection(*map(set, quads)).pop()
        parts = []
        for quad in quads:
            at = quad.index(centre)
            parts.append([quad[(at + k) % 4] for k in (1, 2, 3)])  # middle of an edge, corner, middle of an edge
        ring = parts.pop(0)
        while parts:
            following = next(part for part in parts if ring[-1] in (part[0], part[-1]))
            parts.remove(following)
            ring += (following if following[0] == ring[-1] else following[::-1])[1:]
        square = np.empty((3, 3), dtype=int)
        square[1, 1] = centre
        for node, place in zip(ring, [(0, 1), (0, 2), (1, 2), (2, 2), (2, 1), (2, 0), (1, 0), (0, 0)]):
            square[place] = node
        return square

    def triangles(self, points):
        """Of the curved sides, parts small enough to be straight: (n, 3, 3)."""
        s = np.linspace(-1.0, 1.0, fineness + 1)
        shape = np.stack([0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)])
        grid = np.einsum("ia,jb,eijx->eabx", shape, shape, points[self.squares])
        a, b, c, d = grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]
        return np.concatenate([np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)]).reshape(-1, 3, 3)


def wall_of(work, file):
    """Triangles of both sides, and the nodes at the base, in the scanner's frame."""
    mesh = meshio.read(work / file)
    origin, axes = frame_of(work)
    points = origin + mesh.points.astype(float) @ axes.T
    sides = {name: Side(mesh, t) for name, t in (("endo", 0.0), ("epi", 1.0))}
    base = np.concatenate([points[side.base] for side in sides.values()])
    return {name: side.triangles(points) for name, side in sides.items()}, base


def section(triangles, origin, along_row, along_column, normal):
    """Segments (n, 2, 2) in which a plane cuts triangles, in its own coordinates."""
    height = (triangles - origin) @ normal
    height = np.where(height == 0.0, 1e-9, height)
    cut = np.ptp(np.sign(height), axis=1) > 0
    corners, h = triangles[cut], height[cut]
    h_next, next_corners = np.roll(h, -1, axis=1), np.roll(corners, -1, axis=1)
    crosses = h * h_next < 0.0  # two of three edges
    share = np.where(crosses, h, 0.0) / np.where(crosses, h - h_next, 1.0)
    ends = (corners + share[..., None] * (next_corners - corners))[crosses].reshape(-1, 2, 3) - origin
    return np.stack([ends @ along_row, ends @ along_column], axis=-1)


def unsteady(random):
    """A border's distance from where it should be, by angle: waves of the second to the sixth order."""
    waves = [(n, random.normal(), random.normal()) for n in range(2, 7)]
    size = border_noise / math.sqrt(len(waves))
    return lambda angle: size * sum(a * np.cos(n * angle) + b * np.sin(n * angle) for n, a, b in waves)


def inside(segments, columns, rows, pixel_i, pixel_j):
    """Which pixels' centres lie inside: an odd number of crossings on the row before them."""
    found = np.zeros((columns, rows), dtype=bool)
    x = np.arange(columns) * pixel_i
    for j in range(rows):
        y = j * pixel_j + 1e-7
        (a, b) = segments[:, 0], segments[:, 1]
        cut = (a[:, 1] > y) != (b[:, 1] > y)
        if cut.any():
            a, b = a[cut], b[cut]
            at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
            found[:, j] = (at[None, :] < x[:, None]).sum(axis=1) % 2 == 1
    return found


def see(work, study, file, seed):
    """Writes the label map of a model's end-diastole and end-systole; volumes of the cavity's pixels [ml]."""
    image = nibabel.load(study / "labels.nii.gz")
    seen = np.asarray(image.dataobj)
    affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ image.affine  # LPS
    columns, rows, slices = seen.shape[:3]
    steps = [np.linalg.norm(affine[:3, k]) for k in range(3)]
    along_row, along_column = affine[:3, 0] / steps[0], affine[:3, 1] / steps[1]
    normal = np.cross(along_row, along_column)
    random = np.random.default_rng(seed)
    shifts = breath_hold * math.sqrt(0.5) * random.normal(size=(slices, 2))
    labels = np.where(seen == 1, 1, 0).astype(seen.dtype)  # the right ventricle, where no wall will be
    for t, moment in enumerate(("end_diastole", "end_systole")):
        wall, base = wall_of(work, f"04_results/{moment}.vtu")
        towards_base = np.sign(frame_of(work)[1][:, 2] @ normal)
        for k in range(slices):
            origin = affine[:3, 3] + k * affine[:3, 2]
            pixels = {}
            is_below_base = (towards_base * ((base - origin) @ normal) > 0.0).all()
            for side in ("epi", "endo") if is_below_base else ():
                segments = section(wall[side], origin, along_row, along_column, normal)
                if len(segments) == 0:
                    continue
                centre = segments.reshape(-1, 2).mean(axis=0)
                arm = segments - centre
                angle = np.arctan2(arm[..., 1], arm[..., 0])
                length = np.hypot(arm[..., 0], arm[..., 1])
                stretched = arm * np.maximum(0.0, 1.0 + unsteady(random)(angle) / np.maximum(length, 1.0))[..., None]
                pixels[side] = inside(stretched + centre + shifts[k], columns, rows, steps[0], steps[1])
            if "epi" not in pixels:
                labels[:, :, k, t] = 0
                continue
            labels[:, :, k, t][pixels["epi"]] = 2
            if "endo" in pixels:
                labels[:, :, k, t][pixels["endo"] & pixels["epi"]] = 3
    nibabel.save(nibabel.Nifti1Image(labels, image.affine, image.header), file)
    volume = steps[0] * steps[1] * steps[2] / 1000.0
    return [volume * int((labels[..., t] == 3).sum()) for t in range(2)]


def whole_wall(work, state, quantity):
    with open(work / "04_results/regions.csv", encoding="utf8") as file:
        for row in csv.DictReader(file):
            if (row["state"], row["scheme"], row["quantity"]) == (state, "whole", quantity):
                return float(row["mean"])
    raise KeyError(quantity)


def muscle_of(work):
    fit = json.loads((work / "02b_calibrate/calibration.json").read_text())
    return {name: fit["parameters"][name] for name in ("scale", "exponent", "T_scale")}


def model_of(work, muscle):
    summary = json.loads((work / "04_results/summary.json").read_text())
    return {**muscle,
            "V0": json.loads((work / "02c_unload/unloaded.json").read_text())["unloaded_volume_ml"],
            "EDV": summary["edv_ml"], "ESV": summary["esv_ml"],
            "stress": whole_wall(work, "end_systole", "fibre_stress"), "tension": whole_wall(work, "end_systole", "active_tension")}


def distance(truth, found):
    """Of the found stress-free sides' points from the true ones: mean and 95th percentile [mm]."""
    d = []
    for side in ("endo", "epi"):
        tree = cKDTree(truth[side].reshape(-1, 3))
        d.append(tree.query(found[side].reshape(-1, 3))[0])
    d = np.concatenate(d)
    return float(d.mean()), float(np.percentile(d, 95))


def with_mesh(text, edge):
    return (text.replace('passive = "klotz"\n', 'passive = "klotz"\npressure_error = "0 mmHg"\n')
            + f'\n[quasi_static]\nedge_length = "{edge}"\nlayers = 1\n')


columns = ["person", "mesh", "labels EDV", "labels ESV", "scale", "exponent", "T_scale", "V0", "EDV", "ESV", "ES stress", "ES tension",
           "stress-free mm", "p95 mm", "s"]
widths = [7, 6, 11, 11, 15, 15, 15, 15, 15, 15, 15, 15, 15, 7, 5]


def show(row):
    print("  ".join(str(cell).ljust(width) for cell, width in zip(row, widths)), flush=True)


def off_the_curve(case, fragment, times):
    """A case with the muscle of a fit to Klotz's curve, but so many times as stiff, and nothing to be fitted."""
    muscle = re.sub(r'^(a\w* = ")([^ ]+)', lambda line: f"{line[1]}{times * float(line[2]):.10g}", fragment, flags=re.MULTILINE)
    kept = re.sub(r"\[calibrate\][^[]*", "", case)
    assert muscle != fragment and kept != case
    return kept + "\n" + muscle


def make_truth(study, text, times):
    """The muscle, and the seconds of the run that is the truth."""
    case = study / "truth.toml"
    case.write_text(with_mesh(text, meshes["same"]))
    seconds = run(case, study / "truth")
    muscle = muscle_of(study / "truth")
    if times != 1.0:
        fragment = (study / "truth/02b_calibrate/calibrated.toml").read_text()
        case.write_text(off_the_curve(case.read_text(), fragment, times))
        seconds = run(case, study / "truth")
        muscle["scale"] *= times
    return muscle, seconds


def too_far(errors, mean, times):
    """What of a fit is off by too much, in words. Off the curve the fit can only keep what it was given: end-systole's volume."""
    if times != 1.0:
        return [f"{n} is off by {100 * errors[n]:+.1f}%" for n in ("EDV", "ESV") if abs(errors[n]) > 0.03]
    off = [f"{n} is off by {100 * errors[n]:+.0f}%" for n, most in most_off.items() if abs(errors[n]) > most]
    return off + ([f"the stress-free wall is off by {mean:.1f} mm"] if mean > most_distant else [])


def experiment(person, folder):
    """Shows the truth of a person, then every fit with its errors; what is off by too much, in words."""
    number, _, times = person.partition(":")
    number, times = int(number), float(times or 1.0)
    study = folder / f"twin_{person.replace(':', '_')}"
    subprocess.run([program, "phantom", study, "--person", str(number)], check=True, stdout=subprocess.DEVNULL)
    text = (study / "case.toml").read_text()
    muscle, seconds = make_truth(study, text, times)
    truth = model_of(study / "truth", muscle)
    wall, _ = wall_of(study / "truth", "02c_unload/mesh.vtu")
    names = list(truth)
    show([person, "truth", "", "", *(f"{truth[n]:.4g}" for n in names), "", "", f"{seconds:.0f}"])
    seen = see(study / "truth", study, study / "seen.nii.gz", number)
    failures = []
    for mesh, edge in meshes.items():
        esv = [line for line in text.splitlines() if line.startswith("esv = ")][0]
        case = study / f"fit_{mesh}.toml"
        case.write_text(with_mesh(text, edge).replace("labels.nii.gz", "seen.nii.gz").replace(esv, f'esv = "{seen[1]:.2f} ml"'))
        seconds = run(case, study / f"fit_{mesh}")
        fit = model_of(study / f"fit_{mesh}", muscle_of(study / f"fit_{mesh}"))
        mean, p95 = distance(wall, wall_of(study / f"fit_{mesh}", "02c_unload/mesh.vtu")[0])
        errors = {n: fit[n] / truth[n] - 1.0 for n in names}
        show([person, mesh, f"{seen[0]:.1f}", f"{seen[1]:.1f}", *(f"{fit[n]:.4g} ({100 * errors[n]:+.1f}%)" for n in names), f"{mean:.2f}", f"{p95:.2f}",
              f"{seconds:.0f}"])
        failures += [f"person {person}, {mesh} mesh: {what}" for what in too_far(errors, mean, times)]
    return failures


def main(folder):
    show(columns)
    failures = []
    for number in persons:
        try:
            failures += experiment(number, folder)
        except RuntimeError as failure:
            failures.append(str(failure))
    for failure in failures:
        print(f"FAIL  {failure}", flush=True)
    return 1 if failures else 0


kept = os.environ.get("VENTRICLE_TWINS_FOLDER")
if kept:
    pathlib.Path(kept).mkdir(parents=True, exist_ok=True)
    sys.exit(main(pathlib.Path(kept)))
with tempfile.TemporaryDirectory(prefix="ventricle_twins_") as temporary:
    sys.exit(main(pathlib.Path(temporary)))
