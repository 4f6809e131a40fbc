#!/usr/bin/env python3
"""Runs Weft on plates, mattes, textures and projects that other programs made, or broke, and judges every run by one oracle:
the exit code, the inputs, the outputs, what was written elsewhere, memory, time, and the words.

usage: adversary.py WEFT [--plain] [--only PATTERN]… [--every N] [--seed N] [--jobs N] [--keep FOLDER] [--list]"""
import argparse
import collections
import concurrent.futures
import fnmatch
import os
import random
import shlex
import shutil
import sys
import tempfile
import threading
import time
import traceback

import oracle
from cases import EVERY, PLAIN
from shot import Shot
import cases_commands  # noqa: F401  the modules add their cases when they are read
import cases_damage  # noqa: F401
import cases_exr  # noqa: F401
import cases_mattes  # noqa: F401
import cases_movies  # noqa: F401
import cases_names  # noqa: F401
import cases_numbers  # noqa: F401
import cases_outputs  # noqa: F401
import cases_overwriting  # noqa: F401
import cases_pictures  # noqa: F401
import cases_projects  # noqa: F401
import cases_special_files  # noqa: F401
import cases_usage  # noqa: F401

SKIP = 77


def perform(case, folder, weft, seed):
    """All faults of one case, as (command line, fault), and the number of runs."""
    root = os.path.join(folder, case.name.replace("/", "_"))
    shot = Shot(root, os.path.abspath(weft), random.Random(f"{seed}/{case.name}"))
    found, runs = [], 0
    try:
        for step in case.build(shot):
            before = shot.tree()
            step.outcome = shot.run(step.words, step.seconds, step.stdin, step.environment)
            after = shot.tree()
            runs += 1
            command = "cd " + shlex.quote(shot.shot) + " && weft " + shlex.join(step.words)
            faults = oracle.judge(step, step.outcome, shot.shot, before, after)
            found += [(command, fault, step.outcome.err.strip()) for fault in faults]
            if faults:
                break
    except Exception:
        found.append(("", "the case itself failed: " + traceback.format_exc(), ""))
    return found, runs, root


def chosen(options):
    found = [c for c in EVERY if any(fnmatch.fnmatchcase(c.name, pattern) for pattern in options.only or ["*"])]
    return [c for c in found if c.name in PLAIN or not options.plain][::options.every]


def run_all(cases, options, folder):
    """Prints each failing case as it is found. Class -> [cases, runs, failures]."""
    table = collections.defaultdict(lambda: [0, 0, 0])
    failing, lock = [], threading.Lock()

    def one(case):
        begun = time.monotonic()
        found, runs, root = perform(case, folder, options.weft, options.seed)
        with lock:
            row = table[case.name.split("/")[0]]
            row[0], row[1], row[2] = row[0] + 1, row[1] + runs, row[2] + bool(found)
            if time.monotonic() - begun > 30:
                print(f"slow: {case.name} took {time.monotonic() - begun:.0f} s", flush=True)
            if found:
                failing.append(case.name)
                print(f"FAULT {case.name}")
                for command, fault, err in found:
                    print("   ", fault)
                print("    command:", found[0][0])
                print("    stderr: ", found[0][2][:600].replace("\n", "\n             "), flush=True)
        if not (found and options.keep):
            shutil.rmtree(root, ignore_errors=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, cases))
    return table, failing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("weft")
    parser.add_argument("--plain", action="store_true", help="the few cases of the plain suite")
    parser.add_argument("--only", action="append", help="cases by name, with wildcards; repeatable")
    parser.add_argument("--seed", type=int, default=16)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", help="folder that keeps what failing cases left")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only each Nth of the cases")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    sys.stdout.reconfigure(errors="backslashreplace")  # names that are no UTF-8
    for tool in ("oiiotool", "ffmpeg", "ffprobe", "prlimit"):
        if not shutil.which(tool):
            print(f"SKIPPED: there is no {tool}")
            return SKIP
    cases = chosen(options)
    if options.list:
        print("\n".join(c.name for c in cases))
        return 0
    if not cases:
        sys.exit(f"no case is named so: see --list")
    if options.keep:
        os.makedirs(options.keep, exist_ok=True)
    folder = tempfile.mkdtemp(prefix="weft_adversary_", dir=options.keep)
    begun = time.monotonic()
    try:
        table, failing = run_all(cases, options, folder)
    finally:
        if not options.keep:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"\n{'class':<16}{'cases':>7}{'runs':>7}{'failing':>9}")
    for name, row in [*sorted(table.items()), ("all", [sum(r[i] for r in table.values()) for i in range(3)])]:
        print(f"{name:<16}{row[0]:>7}{row[1]:>7}{row[2]:>9}")
    print(f"{time.monotonic() - begun:.0f} s, seed {options.seed}")
    for name in sorted(failing):
        print(f"again: {sys.argv[0]} {options.weft} --seed {options.seed} --keep FOLDER --only {shlex.quote(name)}")
    return 1 if failing else 0


if __name__ == "__main__":
    sys.exit(main())
