# SPDX-License-Identifier: MIT
"""Progress, cancelling, threads, processes."""

import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import geotherm


def test_progress_is_told_and_grows(bunny):
    told = []
    geotherm.Solver(bunny, progress=lambda stage, share: told.append((stage, share)))
    assert told and all(stage and share <= 1 for stage, share in told)


def test_false_cancels(bunny):
    with pytest.raises(geotherm.Error) as caught:
        geotherm.Solver(bunny, progress=lambda stage, share: False)
    assert caught.value.code == "cancelled"


def test_what_a_progress_raises_comes_out(bunny, solver):
    def fail(stage, share):
        raise LookupError(stage)

    with pytest.raises(LookupError):
        geotherm.Solver(bunny, progress=fail)
    with pytest.raises(LookupError):
        solver.distances("random:50", progress=fail)
    assert solver.distance(17)[17] == 0


def test_what_places_cost_is_watched_too(solver):
    told = []
    places = np.random.default_rng(1).random((50, 3))
    rows = solver.distances(places, progress=lambda stage, share: told.append(stage))
    assert told[0] == "sources"
    for row, place in zip(rows, places):
        assert np.allclose(row, solver.distance(place), rtol=0, atol=1e-12)
    with pytest.raises(geotherm.Error) as caught:
        solver.distance(places, progress=lambda stage, share: False)
    assert caught.value.code == "cancelled"


def test_long_lines_and_many_isolines_are_cancelled(bunny, solver):
    geotherm.trace(bunny, 17, 0.0, 1.0)  # what is made once is made
    for ask in (
        lambda progress: geotherm.trace(bunny, 17, 0.0, 3000.0, progress=progress),
        lambda progress: geotherm.isolines(bunny, bunny.vertices[:, 1], count=500, progress=progress),
    ):
        told = []
        ask(lambda stage, share: told.append(share))
        assert len(told) > 3 and told == sorted(told) and 0.9 < told[-1] <= 1
        with pytest.raises(geotherm.Error) as caught:
            ask(lambda stage, share: False)
        assert caught.value.code == "cancelled"


def test_a_signed_distance_of_many_curves_never_goes_back(bunny):
    shares = []
    corners = [[17, 99, 300], [900, 1000, 1100], [1500, 1600, 1700]]
    geotherm.signed_distance(
        bunny, corners, rule="heat", progress=lambda stage, share: shares.append(share)
    )
    shares = [share for share in shares if share >= 0]
    assert shares == sorted(shares)


def test_true_is_a_bar(bunny, capsys):
    geotherm.Solver(bunny, progress=True)
    assert capsys.readouterr().err


LONG = """
import geotherm, numpy, sys
solver = geotherm.Solver(geotherm.read("bunny"), method="exact", threads=1)
print("begun", flush=True)
try:
    solver.distances(numpy.arange(2000))
except KeyboardInterrupt:
    print("interrupted", solver.distance(17)[17], flush=True)
"""


def test_ctrl_c_ends_a_long_call_and_leaves_the_solver():
    with subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "begun\n"
        time.sleep(0.3)
        begin = time.monotonic()
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "interrupted 0.0\n"
        assert time.monotonic() - begin < 5
        assert child.wait() == 0


def test_the_interpreters_lock_is_free_during_a_call(bunny):
    solver = geotherm.Solver(bunny, method="exact", threads=1)
    worker = threading.Thread(target=solver.distances, args=(np.arange(60),))
    worker.start()
    turns = 0
    while worker.is_alive():
        turns += 1
        time.sleep(0.001)
    worker.join()
    assert turns > 20


def test_threads_share_a_solver(solver):
    expected = solver.distances(np.arange(8))
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        rows = list(pool.map(solver.distance, range(8)))
    assert np.allclose(rows, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_processes_share_out_the_work(solver, way):
    """Also of a process that has solved before it is copied."""
    expected = [solver.distance(v) for v in range(4)]
    context = multiprocessing.get_context(way)
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        rows = list(pool.map(solver.distance, range(4)))
    assert np.array_equal(rows, expected)


def test_a_thread_that_is_not_the_main_one_solves(solver):
    rows = []
    thread = threading.Thread(target=lambda: rows.append(solver.distance(17)))
    thread.start()
    thread.join()
    assert np.array_equal(rows[0], solver.distance(17))


def test_importing_loads_nothing_large():
    """The library is loaded when it is first needed."""
    code = "import geotherm; print(geotherm.__name__, geotherm._library.library.cache_info().currsize)"
    said = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert said.stdout.split() == ["geotherm", "0"]


@pytest.mark.parametrize("library", ["/no/such/file.so", "libm.so.6"])
def test_a_library_that_is_missing_or_another_is_said(library):
    code = "import geotherm; geotherm.features()"
    environment = {**os.environ, "GEOTHERM_LIBRARY": library}
    said = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True
    )
    assert said.returncode == 1 and "ImportError: " in said.stderr and library in said.stderr


def test_progress_that_asks_its_own_solver_is_refused_not_waited_for(bunny):
    solver = geotherm.Solver(bunny)
    with pytest.raises(geotherm.InputError, match="whose progress asks it; ask it when"):
        solver.path(17, 99, progress=lambda stage, share: solver.solve(3) and None)
    beside = geotherm.Solver(bunny)
    line = solver.path(17, 99, progress=lambda *_: (beside.solve(3), solver.distance(3), None)[2])
    assert line.length == solver.path(17, 99).length


def test_who_waits_for_a_solver_can_be_cancelled(bunny):
    solver = geotherm.Solver(bunny)
    begun, released = threading.Event(), threading.Event()

    def hold(stage, share):
        begun.set()
        released.wait(10)

    first = threading.Thread(target=lambda: solver.solve(17, progress=hold))
    first.start()
    assert begun.wait(10)
    begin = time.monotonic()
    with pytest.raises(geotherm.Error, match="cancelled"):
        solver.solve(99, progress=lambda stage, share: False)
    assert time.monotonic() - begin < 5
    released.set()
    first.join()
