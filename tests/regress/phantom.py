#!/usr/bin/env python3
"""A synthetic study through the program to the mesh or to strain, compared with what is true of it.
Usage: phantom.py VENTRICLE [all | strain | blind] [OPTION OF `ventricle phantom` ...]; without options, the studies of the lists
below, of which the everyday ones without `all`. `blind`: strain also without the long axes, which must be worse."""
import base64
import csv
import json
import pathlib
import re
import statistics
import struct
import subprocess
import sys
import tempfile
import zlib

program = pathlib.Path(sys.argv[1]).resolve()
small = ["--phases", "10", "--field-of-view", "150"]
noisy = ["--snr", "20", "--shift", "3"]
everyday = [
    [*small, "--dicom", "false", *noisy, "--seed", "2"],
    [*small, "--nifti", "false", *noisy, "--seed", "3", "--thickness", "10"],
]
others = [
    [*small, "--nifti", "false", "--snr", "20", "--seed", "2"],
    [*small, "--dicom", "false"],
    [*small, "--dicom", "false", *noisy, "--seed", "3", "--thickness", "10"],
    [*small, "--nifti", "false"],
    [*small, "--nifti", "false", *noisy, "--seed", "3"],
]
# Physiological shortening, noise and breath-holds; 14 phases, of which the sixth is end-systole.
moving = ["--phases", "14", "--field-of-view", "150", "--nifti", "false", "--shortening", "0.12", "--snr", "20", "--shift", "3"]
what = sys.argv[2] if sys.argv[2:3] and not sys.argv[2].startswith("--") else ""
of_strain = what in ("strain", "blind")
options = sys.argv[3 if what else 2:]
studies = [options] if options else [[*moving, "--seed", "3"]] if of_strain else everyday + others if what == "all" else everyday
rows, columns = 61, 90  # of points on each surface in surfaces.vtu
failures = []


def check(claim, value, asked):
    good = abs(value) <= asked
    print(f"{'pass' if good else 'FAIL'}  {claim}: {value:.3g}, asked at most {asked:g}", flush=True)
    if not good:
        failures.append(claim)


def read_points(file):
    """The points of a VTK XML file whose appended data are zlib blocks, raw or in base64."""
    content = file.read_bytes()
    offset = int(re.search(rb'Name="Points".*?offset="(\d+)"', content, re.S)[1])
    encoded = b'encoding="base64"' in content
    start = content.index(b"_", content.index(b"<AppendedData")) + 1 + offset

    def part(at, size):
        if not encoded:
            return content[at:at + size], at + size
        length = 4 * ((size + 2) // 3)
        return base64.b64decode(content[at:at + length])[:size], at + length

    blocks = struct.unpack("<I", part(start, 4)[0] if not encoded else base64.b64decode(content[start:start + 8])[:4])[0]
    head, at = part(start, 4 * (3 + blocks))
    sizes = struct.unpack(f"<{3 + blocks}I", head)[3:]
    packed, _ = part(at, sum(sizes))
    values = b""
    for size in sizes:
        values += zlib.decompress(packed[:size])
        packed = packed[size:]
    flat = struct.unpack(f"<{len(values) // 4}f", values)
    return [flat[i:i + 3] for i in range(0, len(flat), 3)]


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def distance(x, surface):
    """From a point to the plane that touches the surface at its nearest point [mm]."""
    nearest = min(range(len(surface)), key=lambda k: (surface[k][0] - x[0]) ** 2 + (surface[k][1] - x[1]) ** 2
                  + (surface[k][2] - x[2]) ** 2)
    i, j = divmod(nearest, columns)
    around = minus(surface[i * columns + (j + 1) % columns], surface[i * columns + (j - 1) % columns])
    along = minus(surface[min(i + 1, rows - 1) * columns + j], surface[max(i - 1, 0) * columns + j])
    normal = cross(around, along)
    length = dot(normal, normal) ** 0.5
    d = minus(x, surface[nearest])
    return abs(dot(d, normal)) / length if length > 1e-6 else dot(d, d) ** 0.5


def distances(study, work, truth):
    """From the true short-axis borders at early diastole, put back by the breath-holds' shifts, to the wall."""
    points = read_points(work / "01_anatomy" / "surfaces.vtu")
    surfaces = {"endo": points[:rows * columns], "epi": points[rows * columns:]}
    frame = json.loads((work / "01_anatomy" / "frame.json").read_text())
    axes = [frame[f"{axis}_axis_in_image_space"] for axis in "xyz"]
    shift = {s["slice"]: s["shift_mm"] for s in truth["short_axis"]}
    found = []
    for row in csv.DictReader((study / "contours" / "early_short_axis.csv").open()):
        if int(row["point"]) % 3:
            continue
        x = minus([float(row[f"{c}_mm"]) for c in "xyz"], shift[int(row["slice"])])
        x = minus(x, frame["origin_in_image_space_mm"])
        found.append(distance([dot(x, axis) for axis in axes], surfaces[row["contour"]]))
    return found


def make_study(options, folder):
    """Its name, its folder, a folder for what is made of it, and its truth."""
    study = folder / "study"
    subprocess.run([program, "phantom", study, *options], check=True, stdout=subprocess.DEVNULL)
    return " ".join(options), study, folder / "work", json.loads((study / "truth.json").read_text())


def compare(options, folder):
    name, study, work, truth = make_study(options, folder)
    # Strain has its own tests and takes longer than all the rest.
    case = study / "mesh.toml"
    case.write_text((study / "case.toml").read_text().split("\n[strain]")[0] + '\n[mesh]\nedge_length = "1.4 mm"\n')
    subprocess.run([program, "run", case, "--until", "mesh", "--work", work, "--ranks", "1"], check=True, stdout=subprocess.DEVNULL)
    sheet = {r["quantity"]: float(r["value"]) for r in csv.DictReader((work / "01_anatomy" / "quality.csv").open())}
    cavity, wall = truth["early_diastole"]["cavity_volume_ml"], truth["wall_volume_ml"]
    check(f"{name}: cavity volume (%)", 100 * (sheet["cavity_fitted"] / cavity - 1), 2)
    check(f"{name}: wall volume (%)", 100 * (sheet["wall_fitted"] / wall - 1), 3)
    check(f"{name}: median distance (mm)", statistics.median(distances(study, work, truth)), 0.7)
    scar = sum(float(r["infarct_ml"]) for r in csv.DictReader((work / "02_mesh" / "infarct.csv").open()))
    check(f"{name}: scar volume (%)", 100 * (scar / truth["scar_volume_ml"] - 1), 5)


def rms(differences):
    return (sum(d * d for d in differences) / len(differences)) ** 0.5


def at_end_systole(file, phase, key, value):
    """A column of a table at end-systole, by the key that a row has."""
    return {key(r): float(r[value]) for r in csv.DictReader(file.open()) if int(r["phase"]) == phase}


def strain_errors(study, case, work, phase):
    """Model minus truth at end-systole: circumferential strain per AHA segment, and rotation per slice (degrees)."""
    subprocess.run([program, "strain", case, "--work", work], check=True, stdout=subprocess.DEVNULL)
    found = []
    for name, value in [("segments", "circumferential_strain"), ("rotation", "rotation_deg")]:
        def key(row):
            return (row.get("scheme", ""), row["slice"], row.get("segment", ""))
        truth = at_end_systole(study / f"truth_{name}.csv", phase, key, value)
        measured = at_end_systole(work / "00_strain" / f"{name}.csv", phase, key, value)
        found.append([measured[k] - true for k, true in truth.items() if k[0] in ("", "aha17")])
    return found


def compare_base(name, study, work, truth):
    """How the base moves: along the axis as the evenly shortening phantom does at height 0, with the rotation of the slice below it,
    and without tilts."""
    phase = truth["end_systole"]["phase"]
    rows = list(csv.DictReader((work / "00_strain" / "base_motion.csv").open()))
    base = {column: float(value) for column, value in rows[(phase - truth["end_diastole"]["phase"]) % len(rows)].items()}
    (high, u), (low, v) = [(s["height_mm"], s["through_plane_motion_at_end_systole_mm"]) for s in truth["short_axis"][:2]]
    turned = at_end_systole(study / "truth_rotation.csv", phase, lambda r: int(r["slice"]), "rotation_deg")
    check(f"{name}: axial motion of the base (mm)", abs(base["axial_mm"] + u - high * (u - v) / (high - low)), 1.5)
    check(f"{name}: tilt of the base (degrees)", max(abs(base["septal_tilt_deg"]), abs(base["anterior_tilt_deg"])), 3)
    check(f"{name}: rotation of the base (degrees)", abs(base["rotation_deg"] - turned[min(turned)]), 1.5)


def compare_strain(options, folder):
    name, study, work, truth = make_study(options, folder)
    phase = truth["end_systole"]["phase"]
    segments, rotation = strain_errors(study, study / "case.toml", work, phase)
    check(f"{name}: AHA segments that are missing", 16 - len(segments), 0)
    check(f"{name}: circumferential strain of AHA segments, rms", rms(segments), 0.02)
    check(f"{name}: rotation of slices, rms (degrees)", rms(rotation), 1)
    moved = at_end_systole(work / "00_strain" / "axial_motion.csv", phase, lambda r: int(r["slice"]), "axial_displacement_mm")
    true = {s["slice"]: s["through_plane_motion_at_end_systole_mm"] for s in truth["short_axis"]}
    check(f"{name}: motion through the planes, rms (mm)", rms([u - true[k] for k, u in moved.items()]), 1)
    compare_base(name, study, work, truth)
    if what != "blind":
        return
    # What the long axes are for: these checks must be able to fail.
    blind = study / "blind.toml"
    blind.write_text(re.sub(r"(?m)^long_axis_cine.*\n", "", (study / "case.toml").read_text()))
    segments, rotation = strain_errors(study, blind, folder / "blind", phase)
    print(f"      without long axes: {rms(segments):.3g} and {rms(rotation):.3g} degrees", flush=True)
    check(f"{name}: without long axes, strain not off by 0.025", max(0, 0.025 - rms(segments)), 0)


for options in studies:
    with tempfile.TemporaryDirectory(prefix="ventricle_phantom_") as temporary:
        (compare_strain if of_strain else compare)(options, pathlib.Path(temporary))
print(f"{len(failures)} failed")
sys.exit(1 if failures else 0)
