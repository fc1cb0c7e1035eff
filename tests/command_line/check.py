#!/usr/bin/env python3
"""The command line as a new user meets it: help, exit codes, and the way from a label map to a case that validates.
Usage: check.py VENTRICLE"""
import pathlib
import subprocess
import sys
import tempfile

program = pathlib.Path(sys.argv[1]).resolve()
failures = []
commands = ["new", "validate", "run", "study", "calibrate", "circulation", "segment", "draw", "strain", "phantom", "verify", "images", "report", "compare",
            "parameters", "bench"]


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail and not holds else ''}", flush=True)
    if not holds:
        failures.append(claim)


def ventricle(*arguments, cwd=None):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=cwd)


def check_help():
    bare = ventricle()
    check("without a command it prints its help", bare.returncode == 0 and "Exit codes" in bare.stdout)
    check("help names every command", all(f"  {name}" in bare.stdout for name in commands))
    for name in commands:
        text = ventricle(name, "--help").stdout
        check(f"{name} --help says more than its options", len(text.strip().splitlines()[-1]) > 10 and
              not text.strip().splitlines()[-1].lstrip().startswith("--"), text)
    check("an unknown command is wrong input", ventricle("rum").returncode == 1)


def check_parameters():
    found = ventricle("parameters", "calcium")
    check("parameters are filtered", "Ca_max" in found.stdout and "edge_length" not in found.stdout)
    check("a filter that fits nothing is wrong input", ventricle("parameters", "edge_lenth").returncode == 1)


def check_way(folder):
    """From the label map of a phantom to a case that validates, with nothing typed but the commands."""
    made = ventricle("phantom", folder / "study", "--phases", 8, "--pixel", 2.5, "--dicom", "false")
    check("the phantom is made", made.returncode == 0, made.stderr)
    labels = folder / "study" / "nifti" / "cine_short_axis_labels.nii.gz"
    case = folder / "mine.toml"
    new = ventricle("new", case, "--from", labels)
    check("a case is made from its label map", new.returncode == 0, new.stderr)
    check("the engine stands on its first lines", "engine = " in "".join(case.read_text().splitlines(True)[:12]))
    valid = ventricle("validate", case)
    last = valid.stdout.splitlines()[-1] if valid.stdout else ""
    check("it validates", valid.returncode == 0, valid.stderr)
    check("the last line says costs, warnings and the next command",
          "immersed about" in last and "quasi_static about" in last and "septum assumed" in last
          and last.endswith(f"next: ventricle run {case}"), last)
    check("and before it which part it was at", all(part in valid.stdout for part in (
        "anatomy ...", "mesh ...", "trying steps of the immersed engine ...", "trying a load step of the quasi-static engine ...")), valid.stdout[:400])
    check("nothing is coloured in a pipe", "\033" not in valid.stdout + valid.stderr)
    dry = ventricle("run", case, "--dry-run")
    check("a dry run says what would run, and runs nothing",
          dry.returncode == 0 and "would run, because" in dry.stdout and not (folder / "mine.work").exists(), dry.stdout)
    listed = ventricle("images", labels)
    check("images end with the lines of a case", "[anatomy.labels]" in listed.stdout, listed.stdout)
    again = ventricle("new", case, "--from", labels)
    check("a case that exists is not overwritten", again.returncode == 1 and "exists already" in again.stderr)
    check_outputs(case)


# One heartbeat of some 40 steps on the coarsest wall, against an aortic pressure that its muscle does not reach.
too_weak = """name = "too weak"
engine = "quasi_static"
quasi_static = {edge_length = "20 mm", layers = 1}
protocol.kind = "cycle"
active.law = "land2017"
calcium = {Ca_0 = "0.1 uM", Ca_max = "0.7 uM", shape = "double_exponential", t_1 = "0.02 s", t_2 = "0.08 s"}
circulation = {kind = "windkessel", period = "0.4 s", start.p_ar_sys = "400 mmHg"}
cycle = {beats = 1, step = "0.01 s"}
"""


def check_refused_beat(folder):
    case = folder / "weak.toml"
    case.write_text(too_weak.replace("0.7 uM", "700 uM"))
    dry = ventricle("run", case, "--dry-run")
    check("a dry run warns of units as validate does", dry.returncode == 0 and "calcium.Ca_max is 700 uM" in dry.stdout + dry.stderr, dry.stdout)
    case.write_text(too_weak)
    run = ventricle("run", case, "--ranks", 1)
    page = folder / "weak.work" / "report.html"
    check("times of chambers that follow the heart rate are told", "are those of 150 beats a minute, 0.595 of the usual" in run.stdout, run.stdout)
    check("calcium that is not of the heart rate is warned of", "healthy systole lasts 0.59 times as long as at 75" in run.stdout + run.stderr, run.stdout)
    check("heartbeats without an end-systole are refused with a page of what was reached",
          run.returncode == 2 and "the aortic valve stays closed" in run.stderr and page.exists(), run.stderr)
    html = page.read_text() if page.exists() else ""
    check("which says that it is unfinished, and why", "03_beat is unfinished." in html and "the run ended early: the last beat has no end-diastole" in html)


# A volume that no contractility reaches against this pressure.
def check_refused_fit(folder):
    case = folder / "fit.toml"
    case.write_text("""name = "out of reach"
engine = "quasi_static"
quasi_static = {edge_length = "20 mm", layers = 1}
calibrate = {active = true, esv = "20 ml"}
protocol.es_pressure = "300 mmHg"
""")
    run = ventricle("run", case, "--ranks", 1)
    page = folder / "fit.work" / "report.html"
    check("a refused fit leaves a page of what was reached", run.returncode == 1 and page.exists(), run.stdout + run.stderr)
    html = page.read_text() if page.exists() else ""
    check("which says that it is unfinished, and why", "02b_calibrate is unfinished." in html and "the run ended early:" in html and "20.00 ml cannot be reached" in html)


def check_outputs(case):
    before = case.read_bytes()
    for ask in (["draw", case, "--export", case], ["report", case.parent, "--output", case], ["compare", case.parent, case.parent, "--output", case]):
        asked = ventricle(*ask)
        check(f"{ask[0]} replaces no file that is not its own",
              asked.returncode == 1 and "no page that this program wrote" in asked.stderr and case.read_bytes() == before, asked.stderr)
        asked = ventricle(*ask[:-1], case.parent / "absent" / "page.html")
        check(f"{ask[0]} says which folder is missing", asked.returncode == 1 and "there is no folder" in asked.stderr, asked.stderr)
    for more in ([], ["--export", case.parent / "page.html"], ["--import", case]):
        asked = ventricle("draw", case, "--no-browser", "--to", case, *more)
        check("draw keeps no drawing in a file", asked.returncode == 1 and "is no folder" in asked.stderr, asked.stderr)


with tempfile.TemporaryDirectory() as temporary:
    check_help()
    check_parameters()
    check_way(pathlib.Path(temporary))
    check_refused_beat(pathlib.Path(temporary))
    check_refused_fit(pathlib.Path(temporary))
sys.exit(1 if failures else 0)
