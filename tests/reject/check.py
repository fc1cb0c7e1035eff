#!/usr/bin/env python3
"""Wrong inputs: `ventricle validate` must refuse each case file here with exit code 1 and with the
message of the file's first line, and `run --dry-run` those whose files only heartbeats take.
Usage: check.py VENTRICLE"""
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).parent
program = pathlib.Path(sys.argv[1]).resolve()
of_heartbeats = ("activation", "base_motion", "cycle_begin", "muscle_contractility")
wrong = 0
for case in sorted(here.glob("*.toml")):
    expected = case.read_text(errors="replace").splitlines()[0].removeprefix("# expect: ")
    commands = [["validate"], ["run", "--dry-run"]] if case.name.startswith(of_heartbeats) else [["validate"]]
    for command in commands:
        run = subprocess.run([program, *command, case.name], cwd=here, capture_output=True, text=True)
        if not expected or run.returncode != 1 or expected not in run.stderr:
            wrong += 1
            print(f"{' '.join(command)} {case.name}: exit code {run.returncode}\n  expected: {expected}\n  got:      {run.stderr}")
print(f"{wrong} refusals failed")
sys.exit(1 if wrong else 0)
