#!/usr/bin/env python3
"""Made-up people through the whole program (labels, mesh, unloading, fit to Klotz's curve and the end-systolic volume, beat,
results) on coarse elements: how many come to the end, and what stops the others.
Usage: people.py VENTRICLE [FIRST LAST]; the environment variable VENTRICLE_PERSON_SECONDS says how much processor time one
may take (default: 600), VENTRICLE_PEOPLE_FOLDER keeps the runs."""
import csv
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

program = pathlib.Path(sys.argv[1]).resolve()
first, last = (int(n) for n in (sys.argv[2:4] if len(sys.argv) > 3 else ("1", "100")))
patience = int(os.environ.get("VENTRICLE_PERSON_SECONDS", "600"))
wanted = 0.98  # part of the people that must come to the end

# Coarse, for tests only: one layer of quadratic elements.
coarse = """
[quasi_static]
edge_length = "13 mm"
layers = 1
"""


def prepare(number, folder):
    """The case of a person, on coarse elements, and what is true."""
    study = folder / f"person_{number}"
    subprocess.run([program, "phantom", study, "--person", str(number)], check=True, stdout=subprocess.DEVNULL)
    case = study / "coarse.toml"
    text = (study / "case.toml").read_text().replace('passive = "klotz"\n', 'passive = "klotz"\npressure_error = "0 mmHg"\n')
    case.write_text(text + coarse)
    return case, json.loads((study / "truth.json").read_text())


def last_words(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines or [""])[-1]


def stage_of(work):
    """The last stage that began."""
    log = work / "log.txt"
    begun = re.findall(r"\b(\w+) \.\.\.$", log.read_text(), re.MULTILINE) if log.exists() else []
    return begun[-1] if begun else ""


def run(case):
    """Outcome, processor seconds, and the program's last words where it did not come to the end."""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (patience, patience + 5))

    began = used()
    work = case.parent / "work"
    done = subprocess.run([program, "run", case, "--work", work, "--ranks", "1"], capture_output=True, text=True, preexec_fn=limit)
    seconds = used() - began
    if done.returncode == 0:
        return "done", seconds, ""
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        log = work / "log.txt"
        return "too long", seconds, last_words(log.read_text() if log.exists() else "")
    return "stopped", seconds, last_words(done.stderr or done.stdout)


def numbers(work):
    """What was fitted, as far as the run came."""
    file = work / "02b_calibrate" / "calibration.json"
    if not file.exists():
        return [""] * 7
    fit = json.loads(file.read_text())
    klotz, p = fit["klotz"], fit["parameters"]
    ejection = ""
    summary = list(work.glob("0*_results/summary.json"))
    if summary:
        ejection = f'{json.loads(summary[0].read_text())["ejection_fraction_percent"]:.0f}'
    return [f'{klotz["seen_volume_ml"]:.0f}', f'{klotz["V0_ml"]:.0f}', f'{klotz["model_V0_ml"]:.0f}', f'{p["scale"]:.3g}',
            f'{p["exponent"]:.3g}', f'{p["T_scale"]:.3g}', ejection]


def main(folder):
    columns = ["person", "kind", "EDV", "ESV", "mmHg", "mesh EDV", "Klotz V0", "V0", "scale", "exponent", "T_scale", "EF%", "s", "outcome",
               "stage", "last words"]
    widths = [6, 13, 5, 5, 5, 8, 8, 5, 7, 8, 7, 5, 5, 9, 9, 0]
    table = []

    def show(row):
        print("  ".join(str(cell).ljust(width) for cell, width in zip(row, widths)), flush=True)

    show(columns)
    for number in range(first, last + 1):
        case, truth = prepare(number, folder)
        outcome, seconds, words = run(case)
        row = [number, truth["kind"], f'{truth["edv_ml"]:.0f}', f'{truth["esv_ml"]:.0f}', f'{truth["ed_pressure_mmHg"]:.1f}',
               *numbers(case.parent / "work"), f"{seconds:.0f}", outcome,
               "" if outcome == "done" else stage_of(case.parent / "work"), words]
        show(row)
        table.append(row)
    with (folder / "people.csv").open("w", newline="") as file:
        csv.writer(file).writerows([columns, *table])
    done = sum(row[-3] == "done" for row in table)
    print(f"{done} of {len(table)} came to the end")
    return 0 if done >= wanted * len(table) else 1


kept = os.environ.get("VENTRICLE_PEOPLE_FOLDER")
if kept:
    pathlib.Path(kept).mkdir(parents=True, exist_ok=True)
    sys.exit(main(pathlib.Path(kept)))
with tempfile.TemporaryDirectory(prefix="ventricle_people_") as temporary:
    sys.exit(main(pathlib.Path(temporary)))
