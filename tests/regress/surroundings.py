#!/usr/bin/env python3
"""The program where something is missing, strange or at its limit: no network, no PATH, pipes in place of files, little
memory, launchers of ranks. It works, or says why not in words. Usage: surroundings.py VENTRICLE"""
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time

here = pathlib.Path(__file__).parent
program = pathlib.Path(sys.argv[1]).resolve()
coarse = here / "unloaded.toml"
mpirun = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n"]
failures = []


def check(claim, holds, detail=""):
    print(f"{'pass' if holds else 'FAIL'}  {claim}{f': {detail}' if detail and not holds else ''}", flush=True)
    if not holds:
        failures.append(claim)


def run(*command, seconds=300, **options):
    try:
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=seconds, **options)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, "hangs", "", "")


def says(claim, done, code, *words):
    text = done.stdout + done.stderr
    check(f"{claim}: exit code {code}" + "".join(f", \"{w}\"" for w in words),
          done.returncode == code and all(w in text for w in words), f"{done.returncode} {text[-1500:]}")


def with_variables(**variables):
    return {"env": {**os.environ, **variables}}


def limited(limit, size):
    return {"preexec_fn": lambda: resource.setrlimit(limit, (size, size))}


def check_one_rank():
    says("a shell of Slurm", run(program, "validate", coarse, **with_variables(PMI_RANK="0", PMI_SIZE="1", PMIX_RANK="0")), 0)
    says("an empty environment", run(program, "validate", coarse, env={}), 0)
    says("no folder for temporary files", run(program, "validate", coarse, **with_variables(TMPDIR="/etc/passwd")), 0)
    if run("unshare", "-n", "true").returncode == 0:
        says("no network", run("unshare", "-n", program, "validate", coarse), 0)


def check_several_ranks(folder):
    many = folder / "many"
    says("more ranks than the grid takes", run(program, "run", here / "small.toml", "--ranks", 19, "--work", many), 1, "at most 18")
    check("nothing was begun", not many.exists())
    until_mesh = ["run", coarse, "--until", "mesh", "--work"]
    done = run(program, *until_mesh, folder / "slurm", "--ranks", 2, **with_variables(PMI_RANK="0", PMI_SIZE="1"))
    says("two ranks in a shell of Slurm", done, 0, "on 2 ranks")
    if run("unshare", "-n", "true").returncode == 0:
        done = run("unshare", "-n", program, *until_mesh, folder / "alone", "--ranks", 2)
        says("two ranks without a network", done, 2, "network", "--ranks 1")
        check("mpirun is not heard", "PMI" not in done.stderr and "orte" not in done.stderr, done.stderr)
        says("without a network, as many as there can be", run("unshare", "-n", program, *until_mesh, folder / "usual"), 0, "on 1 rank")
    done = run("taskset", "-c", 0, program, *until_mesh, folder / "one_processor")
    says("one processor", done, 0, "on 1 rank")
    says("two ranks where mpirun has one", run(*mpirun, 1, program, *until_mesh, folder / "inner", "--ranks", 2), 0, "on 2 ranks")
    says("other ranks than mpirun's", run(*mpirun, 2, program, *until_mesh, folder / "other", "--ranks", 3), 1, "mpirun has started 2")
    done = run(*mpirun, 2, program, "validate", coarse)
    check("a command of one rank under mpirun is refused once", done.stderr.count("runs on one rank") == 1, done.stderr)
    says("verify under mpirun", run(*mpirun, 1, program, "verify", "force_and_torque_conserved"), 0)
    done = run(program, "verify", "force_and_torque_conserved", "--ranks", 1)
    check("verify on one rank alone", done.returncode == 0 and "2 ranks" not in done.stderr, done.stderr)


def check_files(folder):
    os.mkfifo(folder / "pipe.toml")
    (folder / "device.toml").symlink_to("/dev/zero")
    (folder / "round.toml").symlink_to("round.toml")
    (folder / "folder.toml").mkdir()
    for name in ("pipe", "device", "round", "folder", "absent"):
        says(f"a {name} as a case", run(program, "validate", folder / f"{name}.toml", seconds=20), 1, "cannot be read")
    (folder / "work" / "log.txt").mkdir(parents=True)
    until_mesh = ["run", coarse, "--ranks", 1, "--until", "mesh", "--work"]
    says("a folder as the log", run(program, *until_mesh, folder / "work", seconds=60), 2, "log.txt")
    (folder / "piped" / "03_beat.part").mkdir(parents=True)
    os.mkfifo(folder / "piped" / "03_beat.part" / "checkpoint.bin")
    says("a pipe as a checkpoint", run(program, *until_mesh, folder / "piped", seconds=60), 2, "checkpoint.bin")


def check_limits(folder):
    until_mesh = ["run", coarse, "--ranks", 1, "--until", "mesh", "--work"]
    says("files that may not grow", run(program, *until_mesh, folder / "short", **limited(resource.RLIMIT_FSIZE, 4096)), 2, "cannot be written")
    large = folder / "large.toml"
    large.write_text((here / "small.toml").read_text().replace("[30, 30, 37]", "[1000, 1000, 1200]")
                     .replace('"4 mm"', '"4 mm"\n[coupling]\nkind = "quadrature"'))
    says("more than the memory", run(program, "validate", large, **limited(resource.RLIMIT_AS, 3 << 30)), 2, "memory")
    with open("/dev/full", "w", encoding="utf8") as full:
        done = subprocess.run([program, "parameters"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        check("a full disk for what is printed", done.returncode == 2, done.stderr)


def check_stops(folder):
    """Requests to stop are heard wherever they come."""
    for seconds in (0.3, 1, 2, 3, 4, 6):
        process = subprocess.Popen([program, "run", coarse, "--ranks", "1", "--work", folder / f"stopped_{seconds}"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(seconds)
        process.send_signal(signal.SIGTERM)
        asked = time.time()
        code = process.wait()
        check(f"stopped after {seconds} s: within 25 s", time.time() - asked < 25 and code in (0, 130, -signal.SIGTERM), code)


with tempfile.TemporaryDirectory(prefix="ventricle_surroundings_") as temporary:
    place = pathlib.Path(temporary)
    check_one_rank()
    check_several_ranks(place)
    check_files(place)
    check_limits(place)
    check_stops(place)
print(f"{len(failures)} failed")
sys.exit(1 if failures else 0)
