"""Runs that are watched, stopped, beside each other, and after fork()."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy
import pytest
from conftest import LONG, MAP, command, options_of

import gearsweep

# Several tiles, which a run that goes on finds in the journal or computes.
TILES = {**MAP, "axes.omega.count": 40, "integrate.tile": 8, "integrate.max_step": 0.2}


class Done(Exception):
    """Raised by a progress function that has seen enough."""


def test_progress_reaches_the_end():
    seen: list[gearsweep.Progress] = []
    made = gearsweep.run("coarse-map", set=TILES, progress=seen.append)
    assert seen[-1].points_done == seen[-1].points == made.dmf_max.size
    assert seen[-1].share == pytest.approx(1.0)
    assert all(a.share <= b.share for a, b in zip(seen, seen[1:], strict=False))


@pytest.mark.binding
def test_progress_comes_in_the_calling_thread():
    threads = set()
    gearsweep.run("coarse-map", set=MAP, progress=lambda _: threads.add(threading.get_ident()))
    assert threads == {threading.get_ident()}


def test_ctrl_c_stops_and_keeps_the_journal(tmp_path):
    journal = tmp_path / "journal"
    some_done = threading.Event()
    # From outside, as a terminal does: the run itself has to notice.
    killer = threading.Thread(
        target=lambda: some_done.wait() and os.kill(os.getpid(), signal.SIGINT)
    )
    killer.start()

    def watch(news: gearsweep.Progress) -> None:
        if news.points_done > 0:
            some_done.set()

    with pytest.raises(KeyboardInterrupt):
        gearsweep.run("coarse-map", set=LONG, journal=journal, progress=watch)
    killer.join()
    assert journal.exists()


def test_ctrl_c_stops_without_a_journal(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    timer = threading.Thread(target=lambda: os.kill(os.getpid(), signal.SIGINT))
    with pytest.raises(KeyboardInterrupt):
        timer.start()
        gearsweep.run("coarse-map", set=LONG)
    timer.join()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.binding
def test_an_interrupted_run_goes_on(tmp_path):
    journal = tmp_path / "journal"
    plain = gearsweep.run("coarse-map", set=TILES)

    def stop(news: gearsweep.Progress) -> None:
        if news.points_done > 0:
            raise Done

    with pytest.raises(Done):
        gearsweep.run("coarse-map", set=TILES, journal=journal, progress=stop)
    assert journal.exists()
    resumed = gearsweep.run("coarse-map", set=TILES, journal=journal)
    assert resumed.equals(plain)
    assert not journal.exists()


@pytest.mark.binding
def test_two_threads_run_at_once():
    calls = [("coarse-map", MAP), ("coarse-chaos", MAP), ("coarse-map", TILES)]
    alone = [gearsweep.run(study, set=changes) for study, changes in calls]
    with ThreadPoolExecutor(len(calls)) as pool:
        together = list(pool.map(lambda call: gearsweep.run(call[0], set=call[1]), calls))
    assert all(one.equals(other) for one, other in zip(alone, together, strict=True))


def test_the_first_runs_of_a_process_may_coincide():
    # The first one makes the driver prepare its devices.
    script = (
        "import gearsweep, threading\n"
        "start = threading.Barrier(4)\n"
        "def work():\n"
        "    start.wait()\n"
        f"    gearsweep.run('coarse-map', set={MAP!r})\n"
        "    made.append(1)\n"
        "made = []\n"
        "threads = [threading.Thread(target=work) for _ in range(4)]\n"
        "for thread in threads: thread.start()\n"
        "for thread in threads: thread.join()\n"
        "assert len(made) == 4\n"
    )
    for _ in range(3):
        assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


@pytest.mark.parametrize("ends", ["pass", "raise SystemExit(3)"])
def test_python_ends_while_a_thread_computes(ends):
    # Prints nothing: Python itself aborts where a daemon thread holds stdout at the end.
    script = (
        "import atexit, threading\n"
        "begun, stopped = threading.Event(), threading.Event()\n"
        "atexit.register(lambda: print(stopped.wait(60)))  # called after gearsweep's own\n"
        "import gearsweep\n"
        "def work():\n"
        "    while True:\n"
        "        try:\n"
        f"            gearsweep.run('coarse-map', set={LONG!r}, progress=lambda _: begun.set())\n"
        "        finally:\n"
        "            stopped.set()\n"
        "threading.Thread(target=work, daemon=True).start()\n"
        "begun.wait()\n"
        f"{ends}\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == (3 if "3" in ends else 0), done.stderr
    assert (done.stdout, done.stderr) == ("True\n", "")


@pytest.mark.binding
def test_other_threads_go_on_meanwhile():
    ended = threading.Event()
    counted = 0

    def count() -> None:
        nonlocal counted
        while not ended.is_set():
            counted += 1

    counting = threading.Thread(target=count)
    counting.start()
    seen: list[int] = []
    gearsweep.run("coarse-map", set=TILES, progress=lambda _: seen.append(counted))
    ended.set()
    counting.join()
    assert seen[-1] > 0


def test_a_forked_child_is_told_so():
    gearsweep.run("coarse-map", set=MAP)
    child = os.fork()
    if child == 0:
        signal.alarm(120)  # a hang ends here, and fails
        status = 1
        try:
            gearsweep.run("coarse-map", set=MAP)
        except gearsweep.RunError as error:
            status = 0 if "after fork()" in str(error) else 2
        os._exit(status)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_a_child_that_was_forked_before_can_compute():
    script = (
        "import gearsweep, os\n"
        "child = os.fork()\n"
        f"gearsweep.run('coarse-map', set={MAP!r})\n"
        "if child: raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_draws_that_are_kept_make_the_statistics_of_the_run():
    study = gearsweep.Study.gear5("coarse").sweep(omega=(0.6, 0.9, 3))
    study = study.integrate(settle=30, record=8, stop="never")
    study = study.observe("x1_rms", "contact_class", poincare=["x1"])
    tolerances = {"m1": gearsweep.uniform(0.3, 0.4), "omega": gearsweep.normal(0.01, relative=True)}
    maps = study.uncertain(samples=9, keep=True, **tolerances).run()
    draws = maps.x1_rms_draws
    assert draws.dims == ("omega", "draw")
    assert maps.uncertain_value.dims == ("draw", "uncertain")
    numpy.testing.assert_allclose(draws.mean("draw"), maps.x1_rms_sample_mean, rtol=1e-12)
    numpy.testing.assert_allclose(draws.quantile(0.95, "draw"), maps.x1_rms_p95, rtol=1e-12)
    share = (maps.contact_class_draws == 1).mean("draw")
    numpy.testing.assert_allclose(share, maps.contact_class_single_sided_share, rtol=1e-12)
    names = maps.uncertain_parameter.values.tolist()
    # The point of the very parameters of a draw has its value.
    mass, factor = (maps.uncertain_value[4, names.index(name)].item() for name in ("m1", "omega"))
    alone = gearsweep.Study.gear5("coarse", m1=mass).sweep(omega=maps.omega.values * factor)
    alone = alone.integrate(settle=30, record=8, stop="never")
    alone = alone.observe("x1_rms", "contact_class", poincare=["x1"])
    numpy.testing.assert_array_equal(alone.run().x1_rms, draws[:, 4])


def test_gears_as_built_have_bands_around_the_nominal_one(tmp_path):
    command("gear", "new", "19/61", "--module", "2.5", "-o", str(tmp_path / "mine.toml"))
    changes = {"axes.pinion_speed_rpm.count": 3, "model.backlash": "constant"}
    maps = gearsweep.tolerance(tmp_path / "mine.toml", gears=20, percentile=90, set=changes)
    assert maps.dmf_max_draws.sizes == {"pinion_speed_rpm": 3, "draw": 20}
    assert (maps.dmf_max_p10 < maps.dmf_max_p50).all()
    assert (maps.dmf_max_p50 < maps.dmf_max_p90).all()
    names = maps.uncertain_parameter.values.tolist()
    assert {"torque_N_m", "mu", "transmission_error_um"} <= set(names)


def test_findings_of_gears_as_built_are_those_of_the_command(tmp_path):
    command("gear", "new", "19/61", "--module", "2.5", "-o", str(tmp_path / "mine.toml"))
    changes = {"axes.pinion_speed_rpm.count": 2, "model.backlash": "constant"}
    found = gearsweep.tolerance_findings(tmp_path / "mine.toml", gears=24, set=changes)
    written = tmp_path / "findings.json"
    words = ("--gears", "24", *options_of(changes))
    command("tolerance", str(tmp_path / "mine.toml"), *words, "--json", str(written), "--quiet")
    expected = json.loads(written.read_text())
    assert {**expected, "command": found["command"]} == found
    assert found["speeds"][0]["error"] is None  # 24 gears do not know their percentile 99
