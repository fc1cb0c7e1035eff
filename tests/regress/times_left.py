#!/usr/bin/env python3
"""What the log says of the time left, over what it then took, at 25, 50 and 75% of beats, fits and unloadings.

The program's clock is made to show its own processor time (a library that is loaded before it), so that other programs do not disturb either side of
the ratio. For each mark the nearest line that says a time left is compared with what remained at that very line; where it lies farther than a tenth of the
stage from the mark, its place is printed. What is printed in whole seconds may be off by half of one besides.
Usage: times_left.py VENTRICLE [WORDS...]: the cases whose names have one of these words; VENTRICLE_TIMES_FOLDER keeps the logs, VENTRICLE_DATA names the
folder of real hearts (otherwise ../shared/data; without it they are left out)."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

program = pathlib.Path(sys.argv[1]).resolve()
words = sys.argv[2:]
data = pathlib.Path(os.environ.get("VENTRICLE_DATA", pathlib.Path(__file__).parents[2] / "../shared/data")).resolve()
kept = os.environ.get("VENTRICLE_TIMES_FOLDER")
marks = (0.25, 0.5, 0.75)
margin, rounding = 0.3, 0.5  # as a fraction; [s]
shortest = 10.0  # stages that are judged [s]

clock = """
#define _GNU_SOURCE
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
int clock_gettime(clockid_t which, struct timespec* time) {
  return (int)syscall(SYS_clock_gettime, which == CLOCK_MONOTONIC ? CLOCK_PROCESS_CPUTIME_ID : which, time);
}
"""

quasi_static = 'engine = "quasi_static"\n'


def elements(edge):
    return f'quasi_static.edge_length = "{edge} mm"\n' + ("quasi_static.layers = 1\n" if edge >= 11 else "")


def wall(endo, epi):
    return f'anatomy.ellipsoid.endo_radius = "{endo} mm"\nanatomy.ellipsoid.epi_radius = "{epi} mm"\n'


infarct = """
[infarct]
source = "described"
[infarct.described]
angle = "30 deg"
width = "150 deg"
top = 1.0
apex = 0.425
[passive]
C_a = 2.51
[active]
T_scale = 10.4
[protocol]
ed_pressure = "16 mmHg"
es_pressure = "110 mmHg"
"""

smaller_infarct = """
[infarct]
source = "described"
[infarct.described]
angle = "-60 deg"
width = "90 deg"
top = 0.6
apex = 0.3
[active]
T_scale = 5.0
[protocol]
ed_pressure = "12 mmHg"
es_pressure = "120 mmHg"
"""

glasgow = data / "glasgow_HV01/text_export"
hv01 = f"""
[anatomy]
source = "contours"
[anatomy.contours]
short_axis = "{glasgow}/contours_sa_aligned_long_axis.csv"
long_axis = "{glasgow}/contours_la.csv"
apex_endo = "{glasgow}/apex_endo.csv"
apex_epi = "{glasgow}/apex_epi.csv"
septum_point = ["37.1 mm", "0.8 mm", "-4.5 mm"]
"""
sunnybrook = data / "sunnybrook_SC-HF-I-1"
patient = f"""
[anatomy]
source = "sunnybrook"
[anatomy.sunnybrook]
contours = "{sunnybrook}/contours"
dicom = "{sunnybrook}/dicom"
phase = 3
[anatomy.contours]
align_slices = true
[unloaded]
pressure = "16 mmHg"
[passive]
C_a = 5.0
[infarct]
source = "described"
[infarct.described]
angle = "30 deg"
width = "120 deg"
top = 0.7
apex = 0.4
[protocol]
ed_pressure = "16 mmHg"
es_pressure = "110 mmHg"
"""
small = (pathlib.Path(__file__).parent / "small.toml").read_text().replace('name = "small"\n', "")


def fit(passive, edv="", esv=""):
    lines = [f'calibrate.passive = "{passive}"'] if passive else []
    if edv:
        lines.append(f'calibrate.edv = "{edv} ml"')
    if esv:
        lines += ["calibrate.active = true", f'calibrate.esv = "{esv} ml"']
    return "\n".join(lines) + "\n"


seen = 'unloaded.pressure = "{} mmHg"\n'.format

def klotz(ed, esv):
    return seen(ed) + f'protocol.ed_pressure = "{ed} mmHg"\n' + fit("klotz", "", esv)


# Lines of each case, the last stage, and whether rules were chosen on it.
cases = {
    "beat, 14 mm": (quasi_static + elements(14), "beat", True),
    "beat, thick, 12 mm": (quasi_static + elements(12) + wall(16, 32), "beat", True),
    "beat, infarct, 12 mm": (quasi_static + elements(12) + wall(21.94, 31.49) + infarct, "beat", True),
    "beat, weak, 10 mm": (quasi_static + elements(10) + "active.T_scale = 1.5\n", "beat", False),
    "beat, thin, 12 mm": (quasi_static + elements(12) + wall(24, 30), "beat", False),
    "beat, default mesh": (quasi_static, "beat", False),
    "beat, HV01, 12 mm": (quasi_static + elements(12) + hv01, "beat", True),
    "unloaded, 14 mm": (quasi_static + elements(14) + seen(8), "unload", True),
    "unloaded, thin, 11 mm": (quasi_static + elements(11) + wall(24, 30) + seen(10), "unload", False),
    "unloaded, default mesh": (quasi_static + seen(8), "unload", False),
    "fit of scale and T_scale, 14 mm": (quasi_static + elements(14) + fit("scale", 110, 55), "calibrate", True),
    "fit of scale and T_scale, default mesh": (quasi_static + fit("scale", 143, 61), "calibrate", True),
    "fit of C_a and T_scale, thick, 9 mm": (quasi_static + elements(9) + wall(20, 32) + fit("C_a", 130, 60), "calibrate", False),
    "fit of T_scale, 9 mm": (quasi_static + elements(9) + fit("", "", 66), "calibrate", False),
    "fit to Klotz, 14 mm": (quasi_static + elements(14) + klotz(8, 35), "calibrate", True),
    "fit to Klotz, default mesh": (quasi_static + klotz(8, 35), "calibrate", False),
    "fit to Klotz, thick, 14 mm": (quasi_static + elements(14) + wall(18, 32) + klotz(12, 26), "calibrate", True),
    "fit to Klotz, thin, 13 mm": (quasi_static + elements(13) + wall(24, 31) + klotz(10, 62), "calibrate", False),
    "fit of scale and exponent, 12 mm": (quasi_static + elements(12) + fit("scale_and_exponent", 144, 61), "calibrate", True),
    "fit of T_scale, unloaded, 14 mm": (quasi_static + elements(14) + seen(4) + 'protocol.ed_pressure = "4 mmHg"\n' + fit("", "", 40), "calibrate", True),
    "fit of T_scale, unloaded, 9 mm": (quasi_static + elements(9) + seen(6) + 'protocol.ed_pressure = "6 mmHg"\n' + fit("", "", 38), "calibrate", False),
    "immersed beat": (small, "beat", True),
    "immersed beat, infarct": (small.replace("[protocol]\n", infarct.strip() + "\n"), "beat", True),
    "immersed beat, smaller infarct": (small.replace("[protocol]\n", smaller_infarct.strip() + "\n"), "beat", False),
    "immersed beat, stiff": (small.replace("[protocol]\n", "[passive]\nC_a = 2.5\n[protocol]\n"), "beat", False),
}
if glasgow.exists():
    cases["fit of scale and beat, HV01, default mesh"] = (quasi_static + fit("scale", 142.6) + hv01, "beat", False)
if sunnybrook.exists():
    cases["fit of T_scale, unloading and beat, SC-HF-I-1, 12 mm"] = (quasi_static + elements(12) + fit("", "", 141.3) + patient, "beat", False)


def left_in(line):
    """Seconds that a line says are left, if any."""
    found = re.search(r", about ([^,]*) left\b", line)
    if not found:
        return None
    parts = re.fullmatch(r"(?:(\d+) h ?)?(?:(\d+) min ?)?(?:(\d+) s)?", found[1])
    return sum(int(n or 0) * s for n, s in zip(parts.groups(), (3600, 60, 1))) if parts else None


def used(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def log_of(name, text, until, folder, library):
    """Lines of a run, each with the processor time at which it came, and one at the end."""
    case = folder / "case.toml"
    case.write_text(f'name = "{name}"\n{text}')
    environment = dict(os.environ, LD_PRELOAD=str(library), OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    child = subprocess.Popen([program, "run", case, "--work", folder / "work", "--until", until, "--ranks", "1"], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, env=environment)
    lines = []
    for line in child.stdout:
        lines.append((used(child.pid), line.rstrip()))
    _, status, usage = os.wait4(child.pid, 0)
    lines.append((usage.ru_utime + usage.ru_stime, f"ended with code {os.waitstatus_to_exitcode(status)}"))
    if status:
        print(f"{name}: {lines[-2][1]}", flush=True)
    return lines


def stages(lines):
    """Lines of each stage that tells a time left."""
    begun = [(i, m[1]) for i, (_, line) in enumerate(lines) if (m := re.search(r"info (\w+) \.\.\.$", line))]
    ends = [i for i, _ in begun[1:]] + [len(lines) - 1]
    return [(name, lines[first:end + 1]) for (first, name), end in zip(begun, ends) if name in ("calibrate", "unload", "beat")]


def judge(name, lines):
    """Of one stage, whose parts tell their own time (the unloadings of a fit): processor seconds, and for each mark what is said, what remained, where, and whether it holds."""
    first, last = lines[0][0], lines[-1][0]
    told = [(at, said) for at, line in lines[1:-1]
            if (said := left_in(line)) is not None and (name == "unload" or not line.endswith("of unloading"))]
    found = []
    for mark in marks:
        at, said = min(told, key=lambda entry: abs(entry[0] - first - mark * (last - first)), default=(last, None))
        place = (at - first) / (last - first)
        found.append((said, last - at, place if abs(place - mark) > 0.1 else None, said is not None and abs(said - last + at) <= margin * (last - at) + rounding))
    return last - first, found


def in_words(said, rest, place):
    if said is None or rest <= 0.0:
        return "nothing"
    return f"{said / rest:.2f}" + (f" at {100 * place:.0f}%" if place else "")


def main():
    failures = 0
    with tempfile.TemporaryDirectory(prefix="ventricle_times_") as temporary:
        folder = pathlib.Path(temporary)
        (folder / "clock.c").write_text(clock)
        library = folder / "clock.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, folder / "clock.c"], check=True)
        for name, (text, until, is_chosen_on) in cases.items():
            if words and not any(word in name for word in words):
                continue
            own = folder / re.sub(r"\W+", "_", name)
            own.mkdir()
            lines = log_of(name, text, until, own, library)
            if kept:
                pathlib.Path(kept).mkdir(exist_ok=True)
                (pathlib.Path(kept) / f"{own.name}.json").write_text(json.dumps(lines))
            for stage, part in stages(lines):
                seconds, found = judge(stage, part)
                holds = all(h for *_, h in found) or seconds < shortest
                failures += not holds
                print(f"{'pass' if holds else 'FAIL'}  {name}{' (chosen on)' if is_chosen_on else ''} | {stage} | {seconds:.1f} s | "
                      + " | ".join(in_words(*what[:3]) for what in found), flush=True)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
