#!/usr/bin/env python3
"""Every file of a work folder, and every column, key and array in it, stands in docs/outputs.md or a page that it leads to.
Usage: outputs.py WORK ..."""
import json
import pathlib
import re
import sys

docs = pathlib.Path(__file__).parents[2] / "docs"
own = (docs / "outputs.md").read_text()
text = own + "".join((docs / name).read_text() for name in sorted(set(re.findall(r"\]\((?:docs/)?([\w-]+\.md)", own))))
names = set(re.findall(r"[\w.-]+", text)) | set(re.findall(r"[A-Za-z]\w*", text))
families = [re.escape(name).replace(r"\*", r"\w*") for name in set(re.findall(r"[\w.]*\w_\*[\w.]*", text))]  # E_fibre_*, wall_*.vtu
unnamed = {"Points", "connectivity", "offsets", "types", "faces", "faceoffsets"}  # VTK's own


def is_told(name):
    return name in names or any(re.fullmatch(family, name) for family in families)


def parts(file):
    """What a reader meets in a file: columns of a table, arrays of a field, first keys of JSON."""
    if file.suffix == ".csv":
        return file.read_text().splitlines()[0].split(",")
    if file.suffix in (".vtu", ".vtp", ".vti"):
        return set(re.findall(r'<(?:DataArray|Array)[^>]*Name="([^"]+)"', file.read_bytes().decode("latin-1"))) - unnamed
    if file.suffix == ".json" and file.name != "stage.json":
        content = json.loads(file.read_text())
        return list(content) if isinstance(content, dict) else sorted({key for one in content for key in one})
    return []


wrong = set()
for work in map(pathlib.Path, sys.argv[1:]):
    for file in sorted(work.rglob("*")):
        if file.is_dir():
            continue
        place = file.relative_to(work)
        if not is_told(file.name) and place.parts[0] != "05_report":  # figures are named in docs/report.md
            wrong.add(f"{place} is in no document")
        wrong |= {f"{part} of {place} is in no document" for part in parts(file) if not is_told(part)}
print("\n".join(f"FAIL  {claim}" for claim in sorted(wrong)) or "pass  all that a run leaves is documented")
sys.exit(bool(wrong))
