#!/usr/bin/env python3
"""The manual page and the completion hold every command and option that --help shows. Usage: check.py VENTRICLE"""
import re
import subprocess
import sys

program = sys.argv[1]
wrong = []


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def completed(script, *words):
    """What bash offers for the last of the words."""
    line = f'{script}\nCOMP_WORDS=({" ".join(map(repr, words))}); COMP_CWORD={len(words) - 1}; _ventricle; echo "${{COMPREPLY[@]}}"'
    return output("bash", "-c", line).split()


def check(claim, holds):
    if not holds:
        wrong.append(claim)


page, script = output(program, "man"), output(program, "completion")
readable = page.replace("\\-", "-")
commands = re.findall(r"^  (\w+)\s", output(program, "--help").split("Subcommands:")[1], re.MULTILINE)
check("--help lists commands", "run" in commands)
check("bash completes commands", set(commands) <= set(completed(script, "ventricle", "")))
for command in commands:
    check(f"the page describes {command}", f".SS ventricle {command}\n" in readable)
    options = set(re.findall(r"^\s+(?:-\w,)?(--[\w-]+)", output(program, command, "--help"), re.MULTILINE))
    check(f"bash completes the options of {command}", options == set(completed(script, "ventricle", command, "-")))
    for option in options:
        check(f"the page describes {option} of {command}", option in readable)
check("names of files are left to bash", completed(script, "ventricle", "run", "ca") == [])
for name in re.findall(r"^\| `([\w.]+)` \|", output(program, "parameters", "--markdown"), re.MULTILINE):
    check(f"the page describes the parameter {name}", name in readable)
printed = subprocess.run(["man", "-l", "-"], input=page, capture_output=True, text=True, check=False)
check(f"man prints the page: {printed.stderr[:300]}", printed.returncode == 0 and "SYNOPSIS" in printed.stdout)
print("\n".join(f"FAIL  {claim}" for claim in wrong) or f"{len(commands)} commands")
sys.exit(bool(wrong))
