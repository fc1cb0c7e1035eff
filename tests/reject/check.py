#!/usr/bin/env python3
"""Wrong inputs: `ventricle validate` must refuse each case file here with exit code 1 and with the
message of the file's first line. Usage: check.py VENTRICLE"""
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).parent
program = pathlib.Path(sys.argv[1]).resolve()
wrong = 0
for case in sorted(here.glob("*.toml")):
    expected = case.read_text(errors="replace").splitlines()[0].removeprefix("# expect: ")
    run = subprocess.run([program, "validate", case.name], cwd=here, capture_output=True, text=True)
    if not expected or run.returncode != 1 or expected not in run.stderr:
        wrong += 1
        print(f"{case.name}: exit code {run.returncode}\n  expected: {expected}\n  got:      {run.stderr}")
print(f"{wrong} of {len(list(here.glob('*.toml')))} cases failed")
sys.exit(1 if wrong else 0)
