#!/usr/bin/env python3
"""Circumferential strain of each AHA segment at end-systole, from the table and from the field. Usage: read_results.py CASE.work

Needs pandas and meshio (Debian: python3-pandas, python3-meshio)."""
import json
import pathlib
import sys

import meshio
import numpy
import pandas

results = pathlib.Path(sys.argv[1]) / "04_results"

summary = json.loads((results / "summary.json").read_text())
print(f"{summary['case']}: ejection fraction {summary['ejection_fraction_percent']:.1f}% "
      f"({summary['marks']['ejection_fraction_percent']})")

regions = pandas.read_csv(results / "regions.csv")
rows = regions[(regions.state == "end_systole") & (regions.scheme == "aha17") & (regions.quantity == "circumferential_strain")]
table = rows.set_index("segment")[["region", "mean", "sd"]]

wall = meshio.read(results / "end_systole.vtu")  # its points are deformed already
field = {name: numpy.concatenate([numpy.ravel(block) for block in wall.cell_data[name]])
         for name in ("aha17", "reference_volume", "E_circumferential_end_diastole")}
cells = pandas.DataFrame(field)
weighted = (cells.E_circumferential_end_diastole * cells.reference_volume).groupby(cells.aha17).sum()
table["from the field"] = weighted / cells.groupby("aha17").reference_volume.sum()  # elements are of unequal size

print(table.to_string(float_format="%.4f"))
print(f"largest difference {(table['mean'] - table['from the field']).abs().max():.1e}")
