#!/usr/bin/env python3
"""Heartbeats whose parameters are known are measured, and a fit that starts elsewhere finds the parameters again; also when it was
killed in between. Few, large elements. Usage: heartbeat_twin.py VENTRICLE [windkessel or closed_loop]"""
import csv
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

program = pathlib.Path(sys.argv[1]).resolve()
kind = sys.argv[2] if len(sys.argv) > 2 else "windkessel"
failures = []
common = f"""engine = "quasi_static"
quasi_static.edge_length = "18 mm"
quasi_static.layers = 1
protocol.kind = "cycle"
cycle.beats = 30
cycle.step = "10 ms"
circulation.kind = "{kind}"
circulation.period = "0.9 s"
active.law = "land2017"
calcium.shape = "double_exponential"
calcium.Ca_max = "0.7 uM"
calcium.t_1 = "0.04 s"
calcium.t_2 = "0.22 s"
"""
FILLING, RESISTANCE, COMPLIANCE = {
    "windkessel": ("circulation.windkessel.p_ven", "circulation.windkessel.R_p", "circulation.windkessel.C"),
    "closed_loop": ("circulation.closed_loop.blood", "circulation.closed_loop.systemic.R_ar", "circulation.closed_loop.systemic.C_ar"),
}[kind]
truth = {FILLING: (10.0, "mmHg") if kind == "windkessel" else (1350.0, "ml"), "active.land2017.T_ref": (150.0, "kPa"),
         RESISTANCE: (1.3 if kind == "windkessel" else 0.95, "mmHg s/ml"), COMPLIANCE: (1.0 if kind == "windkessel" else 1.1, "ml/mmHg")}


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail else ''}", flush=True)
    if not holds:
        failures.append(claim)


def command(folder, *words):
    return [str(program), *words, "--ranks", "1"], {"cwd": folder, "capture_output": True, "text": True, "check": False}


def measured(folder):
    """The last beat of the known parameters."""
    values = "".join(f'{name} = "{value:g} {unit}"\n' for name, (value, unit) in truth.items())
    (folder / "truth.toml").write_text(common + "cycle.tolerance = 1e-4\n" + values)
    words, options = command(folder, "run", "truth.toml", "--until", "beat")
    run = subprocess.run(words, **options)
    check("heartbeats with known parameters run", run.returncode == 0, run.stderr[-500:])
    with open(folder / "truth.work/03_beat/beats.csv", encoding="utf8") as file:
        return list(csv.DictReader(file))[-1]


def case(name, beat):
    return f"""name = "{name}"
{common}
[calibrate]
cycle = true
edv = "{float(beat['edv_ml']):.3f} ml"
esv = "{float(beat['esv_ml']):.3f} ml"
cuff_systolic = "{float(beat['aortic_systolic_mmHg']):.3f} mmHg"
cuff_diastolic = "{float(beat['aortic_diastolic_mmHg']):.3f} mmHg"
"""


def kill_after(folder, name, evaluations):
    """Starts a fit and kills it when it is past so many evaluations."""
    words, _ = command(folder, "calibrate", f"{name}.toml")
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
        part = folder / f"{name}.work/02b_calibrate.part/evaluation_{evaluations}.bin"
        while run.poll() is None and not part.exists():
            time.sleep(0.05)
        time.sleep(0.7)  # into the next
        run.send_signal(signal.SIGKILL)
    return part.exists()


with tempfile.TemporaryDirectory() as temporary:
    work = pathlib.Path(temporary)
    last = measured(work)
    (work / "fit.toml").write_text(case("fit", last))
    words, options = command(work, "run", "fit.toml")
    run = subprocess.run(words, **options)
    check("a fit to these heartbeats runs", run.returncode == 0, run.stderr[-500:])
    fit = json.loads((work / "fit.work/02b_calibrate/heartbeats.json").read_text())
    for p in fit["parameters"]:
        known, _ = truth[p["parameter"]]
        check(f"{p['words']} comes back within 2%", abs(p["value"] / known - 1) < 0.02, f"{p['before']:g} -> {p['value']:.4g}, known {known:g}")
    for d in fit["data"]:
        check(f"{d['name']} is met within 0.5%", abs(d["off"]) < 0.005, f"{100 * d['off']:.3f}%")
    by = {d["name"]: d["d_ln_datum_by_d_ln"] for d in fit["data"]}
    check("sensitivities have the signs of a heart", by["EDV"][FILLING] > 0 and by["ESV"]["active.land2017.T_ref"] < 0
          and by["diastolic"][RESISTANCE] > 0 and by["systolic"][COMPLIANCE] < 0
          and by["diastolic"][COMPLIANCE] > 0, by)
    print(f"{fit['evaluations']} evaluations, {fit['beats']} heartbeats", flush=True)
    summary = json.loads((work / "fit.work/04_results/summary.json").read_text())
    check("the beat has what it was fitted to", all(v["within_tolerance"] for v in summary["heartbeats_fitted"]), summary["heartbeats_fitted"])
    check("that is marked", summary["marks"]["esv_ml"] == summary["marks"][f"parameters.{RESISTANCE}"] == "fitted")

    (work / "killed.toml").write_text(case("killed", last))
    check("a fit is killed", kill_after(work, "killed", 2))
    words, options = command(work, "calibrate", "killed.toml")
    run = subprocess.run(words, **options)
    check("it goes on", run.returncode == 0, run.stderr[-500:])
    for name in ("heartbeats.json", "heartbeats.csv"):
        check(f"its {name} is that of one left alone", (work / "killed.work/02b_calibrate" / name).read_bytes() == (work / "fit.work/02b_calibrate" / name).read_bytes())

    far = case("far", {**last, "esv_ml": str(0.8 * float(last["esv_ml"]))}) + "factor_max = 1.2\n"
    (work / "far.toml").write_text(far)
    words, options = command(work, "calibrate", "far.toml")
    run = subprocess.run(words, **options)
    check("an end-systolic volume out of reach is refused with what is reached", run.returncode == 1 and "calibrate.esv is" in run.stderr
          and "active.land2017.T_ref at its largest" in run.stderr, run.stderr[-400:])
sys.exit(1 if failures else 0)
