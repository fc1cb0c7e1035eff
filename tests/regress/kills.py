#!/usr/bin/env python3
"""Runs that are killed at random moments and started again, in every stage, against one that was left alone: every table,
field, picture and figure must be the same. Usage: kills.py VENTRICLE [ENGINE ...]; the environment variable
VENTRICLE_KILLS says how many kills per engine (default: 100), VENTRICLE_SEED makes other random moments."""
import collections
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

program = pathlib.Path(sys.argv[1]).resolve()
kills = int(os.environ.get("VENTRICLE_KILLS", "100"))
seed = int(os.environ.get("VENTRICLE_SEED", "1"))
patience = 600  # seconds, that one start may take
slow_to_stop = 25  # seconds
mark = "VENTRICLE_KILL_TEST"
failures = []
stages = ("00_strain", "01_anatomy", "02_mesh", "02b_calibrate", "02c_unload", "03_beat", "04_results", "05_report")

# As small as every stage allows, so that a kill costs seconds: coarse, for tests only, with steps that are too long, so that
# some are taken back.
common = """
[unloaded]
pressure = "2 mmHg"

[calibrate]
passive = "scale"
edv = "98 ml"
tolerance = 0.05

[quasi_static]
edge_length = "18 mm"
layers = 1
first_step = 1

[strain]
cine = "nifti/cine_short_axis.nii.gz"
contours = "contours/ed_short_axis.csv"
end_diastole = 1
"""
frames = 'output.frame_interval = "0.02 s"\n'
engines = {
    "quasi_static": 'engine = "quasi_static"\n' + frames + common,
    "immersed": 'engine = "immersed"\n' + frames + 'output.checkpoint_interval = "0.05 s"\n' + common + """
[mesh]
edge_length = "6 mm"

[box]
cells = [24, 24, 32]

[time]
longest_step = "1e-3 s"

[protocol]
filling_ramp = "0.02 s"
filling_longest = "0.05 s"
filling_window = "0.01 s"
contraction_ramp = "0.02 s"
contraction_longest = "0.05 s"
contraction_window = "0.01 s"
""",
}
phantom = ["--phases", "5", "--field-of-view", "150", "--pixel", "3", "--thickness", "20"]


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail and not holds else ''}", flush=True)
    if not holds:
        failures.append(claim)


def make_case(engine, folder):
    """A study whose strain is measured, and the default ventricle with the engine."""
    subprocess.run([program, "phantom", folder / "study", *phantom], check=True, stdout=subprocess.DEVNULL)
    septum = re.search(r"(?m)^septum_point = .*$", (folder / "study" / "case.toml").read_text())[0]
    case = folder / "study" / f"{engine}.toml"
    case.write_text('name = "killed"\n' + engines[engine].replace("[strain]", f"[strain]\n{septum}"))
    return case


def said_in(work):
    return work.parent / f"{work.name}.txt"


def start(case, work, ranks):
    environment = {**os.environ, mark: str(work)}
    with said_in(work).open("w") as said:
        return subprocess.Popen([program, "run", case, "--work", work, "--ranks", str(ranks)], env=environment,
                                stdout=said, stderr=subprocess.STDOUT)


def processes(work):
    """All that belong to a run, by their number: the names of their programs."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            if f"{mark}={work}".encode() in (entry / "environ").read_bytes().split(b"\0"):
                found[int(entry.name)] = (entry / "comm").read_text().strip()
        except OSError:
            continue  # it has ended
    return found


def stage_at(work):
    parts = sorted(p.name for p in work.glob("*.part")) if work.exists() else []
    return parts[-1][:-5] if parts else "between stages"


def target(process, work, choice):
    """The process to kill, and what it is."""
    others = {n: name for n, name in processes(work).items() if n != process.pid}
    launchers = [n for n, name in others.items() if name in ("mpirun", "orterun")]
    ranks = [n for n, name in others.items() if name == program.name[:15]]  # as the kernel cuts it
    if choice == "mpirun" and launchers:
        return launchers[0], choice
    if choice == "rank" and ranks:
        return ranks[-1], choice
    return process.pid, "parent"


def wait_until_gone(work, seconds):
    begun = time.time()
    while processes(work) and time.time() < begun + seconds:
        time.sleep(0.05)
    return time.time() - begun


def end(process, work):
    """Waits for a run to end; what it said last."""
    try:
        process.wait(timeout=patience)
    except subprocess.TimeoutExpired:
        process.kill()
        check("no start hangs", False)
    return said_in(work).read_text(errors="replace")[-3000:]


def wait_for_moment(process, work, dice, mean_wait):
    """Waits for a random moment of a run, or of one of its stages that are left, for most stages are short."""
    left = [stage for stage in stages if not (work / stage).exists()]
    until = time.time() + dice.expovariate(1 / mean_wait)
    if left and dice.random() < 0.5:
        stage = dice.choice(left)
        while process.poll() is None and not (work / f"{stage}.part").exists() and not (work / stage).exists():
            time.sleep(0.002)
        until = time.time() + dice.uniform(0, 0.1 * mean_wait)
    while process.poll() is None and time.time() < until:
        time.sleep(0.002)


def disturb(process, work, dice, counts):
    """Kills or stops a run at a random moment; whether there was still something to disturb."""
    wait_for_moment(process, work, dice, counts["mean_wait"])
    if process.poll() is not None:
        return False
    how = dice.choice([signal.SIGKILL] * 4 + [signal.SIGTERM, signal.SIGINT])
    who, name = target(process, work, dice.choice(["parent", "rank", "mpirun"]))
    if how != signal.SIGKILL:
        who, name = process.pid, "parent"
    counts["stage"][stage_at(work)] += 1
    counts["who"][f"{how.name} to {name}"] += 1
    try:
        os.kill(who, how)
    except ProcessLookupError:
        return False
    output = end(process, work)
    gone = wait_until_gone(work, 60)
    counts["slowest"] = max(counts["slowest"], gone)
    # by the signal itself before the program listens
    allowed = {0, 130, -how} if how != signal.SIGKILL else {0, 2, 130, -signal.SIGKILL}
    if process.returncode not in allowed:
        check(f"{how.name} to {name}: a code of those that are documented", False, f"{process.returncode}\n{output}")
    if gone > slow_to_stop:
        check(f"{how.name} to {name}: all processes end", False, f"{processes(work)} after {gone:.0f} s")
    return True


def normalised(path):
    """A file's contents, without what tells of the time that a run took."""
    content = path.read_bytes()
    if path.name == "summary.json":
        content = re.sub(rb'"wall_clock[^,}]*', b"", content)
    if path.name == "summary.txt":
        content = re.sub(rb"(?m)^.*\b(s|min|h) (of computation|on \d+ rank).*$", b"", content)
    return content


def contents(work):
    """Of all that a user looks at. The log and the records of the work folder tell how it came about; beat.bin and the
    page hold the time it took."""
    skipped = {"log.txt", "stage.json", ".lock", "beat.bin", "report.html", "confirmation.json", "confirmation.bin"}
    return {str(p.relative_to(work)): normalised(p) for p in sorted(work.rglob("*")) if p.is_file() and p.name not in skipped}


def compare(claim, reference, work):
    here, there = contents(reference), contents(work)
    different = sorted(set(here) ^ set(there)) + [name for name in here if name in there and here[name] != there[name]]
    check(f"{claim}: all {len(here)} files are the same", not different, different)
    kinds = collections.Counter(pathlib.Path(name).suffix for name in here)
    print("      " + ", ".join(f"{n} {kind or 'others'}" for kind, n in sorted(kinds.items())), flush=True)


def undisturbed(case, work, ranks):
    begun = time.time()
    process = start(case, work, ranks)
    output = end(process, work)
    check(f"{case.stem} on {ranks}: a run that is left alone ends well", process.returncode == 0, output)
    return time.time() - begun


def retries(work):
    log = (work / "log.txt").read_text()
    return len(re.findall(r"; back to |a step of .* failed", log))


def killed_runs(case, reference, ranks, wanted, seconds, dice):
    counts = {"stage": collections.Counter(), "who": collections.Counter(), "slowest": 0.0, "mean_wait": max(1.0, seconds / 4)}
    done = round_number = 0
    while done < wanted and not failures:
        round_number += 1
        work = reference.parent / f"killed_{ranks}_{round_number}"
        while True:
            process = start(case, work, ranks)
            if done < wanted and disturb(process, work, dice, counts):
                done += 1
                continue
            break
        output = end(process, work)
        wait_until_gone(work, 60)
        check(f"{case.stem} on {ranks}, run {round_number}: it ends well after all", process.returncode == 0, output)
        compare(f"{case.stem} on {ranks}, run {round_number}", reference, work)
    print(f"      {done} kills in {round_number} runs; slowest end {counts['slowest']:.1f} s", flush=True)
    for kind in ("stage", "who"):
        print("      " + ", ".join(f"{name}: {n}" for name, n in sorted(counts[kind].items())), flush=True)


def try_engine(engine, folder):
    dice = random.Random(seed)
    case = make_case(engine, folder)
    for ranks, wanted in ((1, kills - kills // 2), (2, kills // 2)):
        reference = folder / f"undisturbed_{ranks}"
        seconds = undisturbed(case, reference, ranks)
        if failures:
            return
        check(f"{engine} on {ranks}: steps are taken back", retries(reference) > 0)
        killed_runs(case, reference, ranks, wanted, seconds, dice)


for engine in sys.argv[2:] or engines:
    with tempfile.TemporaryDirectory(prefix="ventricle_kills_") as temporary:
        try_engine(engine, pathlib.Path(temporary))
print(f"{len(failures)} failed")
sys.exit(1 if failures else 0)
