# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads, processes, signals, copies."""

import copy
import gc
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import pytest

import regulus as rg

from conftest import searched_for_long


def test_several_threads_make_and_drop_robots():
    verdicts, errors = [], []

    def work(size):
        try:
            prepared = rg.load("planar_3rpr").prepare("regular")
            for i in range(20):
                verdicts.append(prepared.check(range={"x": (0, f"{size}/{i + 1}")}).verdict)
            del prepared
            gc.collect()
        except BaseException as error:  # noqa: B902
            errors.append(error)

    threads = [threading.Thread(target=work, args=(i + 1,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert errors == [] and verdicts == ["no-singularity"] * 120


def test_another_thread_runs_during_a_search(robot_1):
    ticks = []
    search = threading.Thread(target=searched_for_long, args=(robot_1,), kwargs={"time_limit": 0.6})
    search.start()
    while search.is_alive():
        ticks.append(time.monotonic())
        time.sleep(0.01)
    assert len(ticks) > 10


def test_dropping_a_prepared_question_does_not_wait_for_a_search(robot_1, circle):
    prepared = circle.prepare("outside")
    search = threading.Thread(target=searched_for_long, args=(robot_1,), kwargs={"time_limit": 1})
    search.start()
    time.sleep(0.2)
    del prepared
    gc.collect()
    assert search.is_alive()
    search.join()


def interrupt_after(seconds):
    # A shell starts what it puts into the background with SIGINT ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)

    def send():
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=send).start()


def test_ctrl_c_gives_the_result_until_then(robot_1):
    interrupt_after(0.5)
    with pytest.raises(KeyboardInterrupt) as stop:
        searched_for_long(robot_1, time_limit=60)
    assert stop.value.result.verdict == "possible-problem"
    assert stop.value.result.reason == "the search was interrupted"
    assert stop.value.result.boxes > 0
    assert robot_1.check("wide_15"), "the next question has its answer"


def test_ctrl_c_gives_the_boxes_of_a_paving_until_then(robot_1):
    interrupt_after(0.7)
    with pytest.raises(KeyboardInterrupt) as stop:
        robot_1.locate("wide_15", resolution="1/512", method="reg")
    assert (stop.value.result.claims == "undecided").any()


def test_a_waiting_call_is_withdrawn_at_once(robot_1):
    search = threading.Thread(target=searched_for_long, args=(robot_1,), kwargs={"time_limit": 1.5})
    search.start()
    time.sleep(0.2)
    interrupt_after(0.2)
    with pytest.raises(KeyboardInterrupt) as stop:
        robot_1.check("wide_15")
    assert search.is_alive() and stop.value.result is None
    search.join()


def test_results_are_copied_and_pickled(robot_1, planar):
    prepared = robot_1.prepare("wide_15", range={"x": (-1, 1)})
    results = [robot_1.check("wide_15"), prepared.check(), planar.check("crossing")]
    for result in results:
        for twin in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
            assert (twin.verdict, twin.report, twin.json) == (
                result.verdict,
                result.report,
                result.json,
            )
    assert pickle.loads(pickle.dumps(robot_1)) == robot_1 == copy.deepcopy(robot_1)
    again = pickle.loads(pickle.dumps(prepared)).check()
    assert again.verdict == results[1].verdict and again.boxes == results[1].boxes
    paving = planar.locate("crossing", resolution="1/8")
    assert (pickle.loads(pickle.dumps(paving)).boxes == paving.boxes).all()
    bound = planar.bound("regular", "x")
    assert pickle.loads(pickle.dumps(bound)).result == bound.result


def check_in_another_process(size):
    return rg.load("robot_1").check("wide_15", range={"x": (-size, size)}).verdict


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes_answer_too(robot_1, method):
    assert robot_1.check("wide_15")
    with multiprocessing.get_context(method).Pool(2) as pool:
        found = pool.map_async(check_in_another_process, [1, 2, 3]).get(timeout=100)
    assert found == ["no-singularity"] * 3


def refusal_in_another_process(_):
    try:
        rg.load("robot_1")
    except RuntimeError as error:
        return str(error)
    return ""


def test_a_process_forked_during_a_search_refuses(robot_1):
    search = threading.Thread(target=searched_for_long, args=(robot_1,), kwargs={"time_limit": 1})
    search.start()
    time.sleep(0.2)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        found = pool.map_async(refusal_in_another_process, [0]).get(timeout=100)
    search.join()
    assert "spawn" in found[0]


def test_a_forked_process_ends_as_it_should():
    program = (
        "import os, regulus, sys\n"
        "q = regulus.load('planar_3rpr').prepare('regular')\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    del q\n"
        "    sys.exit(0)\n"
        "sys.exit(os.waitpid(child, 0)[1])\n"
    )
    # Python warns of each fork where there are threads.
    command = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", program]
    finished = subprocess.run(command, capture_output=True, timeout=60)
    assert finished.returncode == 0 and finished.stderr == b""


def test_calls_at_the_end_of_the_process_do_not_hang():
    program = (
        "import atexit\n"
        "def late():\n"
        "    try: regulus.load('robot_1')\n"
        "    except RuntimeError as error: print(error)\n"
        "atexit.register(late)\n"
        "import regulus\n"
        "regulus.load('robot_1')\n"
    )
    finished = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False
    )
    assert finished.stdout == "Python is ending\n" and finished.returncode == 0


def test_the_process_ends_while_another_thread_searches():
    program = (
        "import regulus, threading, time\n"
        "def work(): regulus.load('robot_1').check('wide_15', method='reg')\n"
        "threading.Thread(target=work, daemon=True).start()\n"
        "time.sleep(0.5)\n"
    )
    finished = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=60)
    assert finished.returncode == 0, finished.stderr
