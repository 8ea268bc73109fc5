#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What Python costs: python_overhead.py [RUNS]. Solvers and distances at 100,000 faces by the package,
against the same by the program, which is C++ throughout, in turn, on one thread, the least of all
runs; and two threads with a solver each against one. GEOTHERM_PROGRAM and GEOTHERM_LIBRARY name those
of one build. To be run on an idle machine."""

import json
import os
import subprocess
import sys
import tempfile
import threading
import time

import geotherm


def seconds(work) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def by_program(path: str) -> tuple[float, float]:
    """Set-up and one query, in ms."""
    run = subprocess.run(
        [os.environ["GEOTHERM_PROGRAM"], "solve", path, "-s", "17", "--no-check", "--threads", "1",
         "--json", "-"], check=True, capture_output=True, text=True)
    times = json.loads(run.stdout)["timing_ms"]
    return times["setup"], times["query"]


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "bunny.ply")
        subprocess.run([os.environ["GEOTHERM_PROGRAM"], "generate", "bunny", "--faces", "100000",
                        "-o", path, "--quiet"], check=True)
        mesh = geotherm.read(path)
        setups, queries, programs = [], [], []
        for _ in range(runs):
            programs.append(by_program(path))
            setups.append(1000 * seconds(lambda: geotherm.Solver(mesh, threads=1)))
            solver = geotherm.Solver(mesh, threads=1)
            queries += [1000 * seconds(lambda: solver.distance(17)) for _ in range(3)]
    for what, mine, other in (("Solver()", min(setups), min(one[0] for one in programs)),
                              ("distance()", min(queries), min(one[1] for one in programs))):
        print(f"{what:<12} {mine:8.2f} ms, the program {other:8.2f} ms, {mine / other - 1:+.1%}")
    pair = [geotherm.Solver(mesh, threads=1) for _ in range(2)]
    ids = list(range(0, 48000, 1000))

    def both() -> None:
        threads = [threading.Thread(target=one.distances, args=(ids,)) for one in pair]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    one = min(seconds(lambda: pair[0].distances(ids)) for _ in range(runs))
    two = min(seconds(both) for _ in range(runs))
    print(f"two threads  {2 * one / two:8.2f} times the work of one in the same time")


main()
