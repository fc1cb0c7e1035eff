#!/usr/bin/env python3
"""The processor time of clean builds of the program at two commits, in turn, without a compiler cache.

    tools/build_time.py OLD NEW [OBJECT...]     e.g. main HEAD, or main HEAD lv/mesh/plane.cpp

Prints user and system time of every process of each build [s] and their ratio; with names of sources, of these objects alone
(a precompiled header counts with the first). Processor time, for it hardly depends on what else the machine does; the two
builds take turns object by object when sources are named, else one follows the other.
"""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
environment = {**os.environ, "CCACHE_DISABLE": "1"}


def processor_time(*command, cwd):
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    before = spent()
    subprocess.run(command, cwd=cwd, env=environment, check=True, stdout=subprocess.DEVNULL)
    return spent() - before


def configured(commit, folder):
    subprocess.run(["git", "clone", "-q", root, folder], check=True)
    subprocess.run(["git", "checkout", "-q", "--detach", commit], cwd=folder, check=True)
    subprocess.run(["cmake", "--preset", "release", "-DBUILD_TESTING=OFF"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return folder / "build/release"


with tempfile.TemporaryDirectory() as scratch:
    commits = [subprocess.run(["git", "rev-parse", c], cwd=root, check=True, capture_output=True, text=True).stdout.strip()
               for c in sys.argv[1:3]]
    builds = [configured(commit, pathlib.Path(scratch) / str(i)) for i, commit in enumerate(commits)]
    total = [0.0, 0.0]
    for target in [f"src/CMakeFiles/lv.dir/{source}.o" for source in sys.argv[3:]] or ["ventricle"]:
        times = [processor_time("ninja", target, cwd=build) for build in builds]
        total = [a + b for a, b in zip(total, times)]
        print(f"{target}: {times[0]:.1f} s, {times[1]:.1f} s, {times[1] / times[0]:.2f}", flush=True)
    print(f"{sys.argv[1]} {total[0]:.1f} s, {sys.argv[2]} {total[1]:.1f} s: {total[1] / total[0]:.2f}")
