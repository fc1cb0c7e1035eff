#!/usr/bin/env python3
"""Segments whose contractility is known are seen as noisy strains, and a fit finds their factors again, as far as it says. Few, large
elements. Usage: contractility_twin.py VENTRICLE [SEED ...]"""
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

program = pathlib.Path(sys.argv[1]).resolve()
seeds = [int(s) for s in sys.argv[2:]] or [1, 2, 3]
failures = []
NOISE = 0.025
WEAK = (7, 8, 13, 14)  # anterior and antero-septal, from the middle to the apex
common = """engine = "quasi_static"
quasi_static.edge_length = "14 mm"
quasi_static.layers = 1
"""


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail else ''}", flush=True)
    if not holds:
        failures.append(claim)


def run(folder, name, until):
    done = subprocess.run([program, "run", f"{name}.toml", "--until", until, "--ranks", "1"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{name}: {done.stderr[-800:]}")


def rows(file):
    with open(file, encoding="utf8") as table:
        return list(csv.DictReader(table))


def truth(folder):
    """Volumes, and strains of segments."""
    (folder / "factors.csv").write_text("segment,factor\n" + "".join(f"{s},0.3\n" for s in WEAK))
    (folder / "truth.toml").write_text(common + 'muscle.contractility = "factors.csv"\n')
    run(folder, "truth", "results")
    summary = json.loads((folder / "truth.work/04_results/summary.json").read_text())
    strains = [float(r["mean"]) for r in rows(folder / "truth.work/04_results/regions.csv")
               if r["scheme"] == "aha17" and r["quantity"] == "circumferential_strain" and r["state"] == "end_systole"]
    assert len(strains) == 17
    return summary["edv_ml"], summary["esv_ml"], strains


def fitted(folder, seed, edv, esv, strains):
    noise = random.Random(seed)
    (folder / "strains.csv").write_text("slice,segment,strain\n" + "".join(
        f"aha,{k + 1},{strain + noise.gauss(0, NOISE):.5f}\n" for k, strain in enumerate(strains[:16])))
    (folder / f"fit{seed}.toml").write_text(common + f"""[calibrate]
passive = "scale"
active = true
edv = "{edv * (1 + noise.gauss(0, 0.01)):.2f} ml"
esv = "{esv * (1 + noise.gauss(0, 0.01)):.2f} ml"
strains = "strains.csv"
strain_error = {NOISE}
volume_error = 0.01
contractility = "segments"
""")
    run(folder, f"fit{seed}", "results" if seed == seeds[0] else "calibrate")
    return json.loads((folder / f"fit{seed}.work/02b_calibrate/calibration.json").read_text())


def judge(seed, fit):
    """Returns the squares of ln(factor/truth)/error; T_scale and factors are told apart by the penalty alone, so by their product."""
    strength = fit["parameters"]["T_scale"] / 3.0
    off, weak, others = [], [], []
    for s in fit["contractility"]:
        known = 0.3 if s["segment"] in WEAK else 1.0
        off.append((math.log(strength * s["factor"] / known) / s["standard_error_of_logarithm"]) ** 2)
        (weak if known < 1 else others).append(math.log(s["factor"]))
        print(f"  {s['segment']:2} {s['name']:20} known {known:.1f}, found {strength * s['factor']:.2f}, error of ln "
              f"{s['standard_error_of_logarithm']:.2f}, resolution {s['resolution']:.2f}")
    check(f"seed {seed}: chi^2 is about the number of data", fit["least_squares"]["chi_squared"] < 2 * len(off),
          f"{fit['least_squares']['chi_squared']:.1f} of {len(off) + 2} data, {fit['least_squares']['degrees_of_freedom']:.1f} degrees of freedom")
    mean = [math.exp(sum(group) / len(group)) for group in (weak, others)]
    check(f"seed {seed}: the weak group is weaker than the rest", mean[0] < 0.75 * mean[1], f"factors {mean[0]:.2f} and {mean[1]:.2f} in the mean")
    return off


with tempfile.TemporaryDirectory() as temporary:
    work = pathlib.Path(temporary)
    known = truth(work)
    squares = []
    for seed in seeds:
        squares += judge(seed, fitted(work, seed, *known))
    rms = math.sqrt(sum(squares) / len(squares))
    check("factors are off by about what the fit says", 0.4 < rms < 1.4, f"rms {rms:.2f} of the stated errors, largest {math.sqrt(max(squares)):.2f}")
    results = work / f"fit{seeds[0]}.work/04_results"
    summary = json.loads((results / "summary.json").read_text())
    check("the results name the factors as fitted", summary["marks"]["contractility"] == "fitted"
          and summary["marks"]["parameters.muscle.contractility"] == "fitted" and len(summary["contractility"]) == 16)
    check("and have their table and bull's-eye", all((results / f"contractility.{end}").exists() for end in ("csv", "png")))
sys.exit(1 if failures else 0)
