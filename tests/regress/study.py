#!/usr/bin/env python3
"""A study of few, large elements: a table with a row per case, a work folder each; another factor runs the new case alone.
Usage: study.py VENTRICLE"""
import csv
import pathlib
import subprocess
import sys
import tempfile

program = pathlib.Path(sys.argv[1]).resolve()
failures = []
case = """name = "study"
engine = "quasi_static"
quasi_static.edge_length = "20 mm"
quasi_static.layers = 1
protocol.kind = "cycle"
cycle.beats = 1
cycle.step = "20 ms"
circulation.kind = "windkessel"
active.law = "land2017"
calcium.shape = "double_exponential"
calcium.Ca_max = "0.7 uM"
calcium.t_1 = "0.04 s"
calcium.t_2 = "0.22 s"
[study]
"""


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail and not holds else ''}", flush=True)
    if not holds:
        failures.append(claim)


def study(folder, factors):
    (folder / "study.toml").write_text(case + factors)
    run = subprocess.run([program, "study", "study.toml", "--ranks", "1"], cwd=folder, capture_output=True, text=True, check=False)
    check(f"a study with {factors.strip()!r} runs", run.returncode == 0, run.stderr)
    with open(folder / "study.work/study/study.csv", encoding="utf8") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def made(folder):
    """When each case's beat was made."""
    return {beat.parts[-3]: beat.stat().st_mtime_ns for beat in folder.glob("study.work/**/03_beat/beat.bin")}


with tempfile.TemporaryDirectory() as temporary:
    work = pathlib.Path(temporary)
    rows = study(work, "preload = [0.7]\n")
    first = made(work)
    check("it has the case and one other", list(rows) == ["case", "preload_0.7"], list(rows))
    less, more = rows["preload_0.7"], rows["case"]
    check("less preload fills and ejects less", all(float(less[name]) < float(more[name]) for name in ("edv_ml", "stroke_volume_ml", "stroke_work_mmHg_ml")))
    on_line = [abs(float(r["E_es_mmHg_per_ml"]) * (float(r["greatest_elastance_volume_ml"]) - float(r["V_0_ml"])) - float(r["greatest_elastance_pressure_mmHg"]))
               for r in rows.values()]
    check("the line goes through two points", max(on_line) < 1e-3, on_line)
    rows = study(work, "preload = [0.7]\ncontractility = [1.3]\n")
    check("a contractility comes under every load", list(rows) == ["case", "preload_0.7", "contractility_1.3", "contractility_1.3_preload_0.7"], list(rows))
    check("what was there is not run again", all(made(work)[name] == at for name, at in first.items()))
    check("more contractility is a greater elastance", float(rows["contractility_1.3"]["E_es_mmHg_per_ml"]) > float(rows["case"]["E_es_mmHg_per_ml"]))
    for name in ("study.svg", "study.txt", "preload_0.7/05_report/report.html"):
        check(f"{name} is there", (work / "study.work/study" / name).stat().st_size > 0)
    check("nothing was missing", not any(r["no_beat_because"] for r in rows.values()))

    # a closed loop whose other chambers fit into shorter beats
    loop = case.replace('"windkessel"', '"closed_loop"').replace("cycle.beats = 1", "cycle.beats = 8")
    loop = loop.replace("[study]", """[circulation.closed_loop]
right_ventricle.T_R = "0.3 s"
[study]""")
    (work / "loop.toml").write_text(loop + "preload = [0.9]\nheart_rate = [1.2]\n")
    run = subprocess.run([program, "study", "loop.toml", "--ranks", "1"], cwd=work, capture_output=True, text=True, check=False)
    check("a study of a closed loop runs", run.returncode == 0, run.stderr[-600:])
    with open(work / "loop.work/study/study.csv", encoding="utf8") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    check("all come to their limit cycle", all(r["is_limit_cycle"] == "yes" for r in rows.values()), {n: (r["beats"], r["is_limit_cycle"]) for n, r in rows.items()})
    check("less blood fills and ejects less", all(float(rows["preload_0.9"][name]) < float(rows["case"][name]) for name in ("edv_ml", "stroke_work_mmHg_ml")))
    check("a faster heart fills less", float(rows["heart_rate_1.2"]["edv_ml"]) < float(rows["case"]["edv_ml"]))
    print({n: (r["beats"], r["edv_ml"], r["esv_ml"]) for n, r in rows.items()}, flush=True)
sys.exit(1 if failures else 0)
