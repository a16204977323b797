"""Studies that the workers of an executor compute in shards."""

import os
import signal
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import pytest

import gearsweep as gs

STUDY = (
    gs.Study.of("duffing")
    .sweep(omega=(0.5, 1.5, 12), amplitude=(0.2, 0.4, 4))
    .observe("x_rms", "period")
    .integrate(settle=40, record=10)
)


class Counting(Executor):
    """Threads; the shards of these numbers are lost with their worker."""

    def __init__(self, lost=()):
        self._threads = ThreadPoolExecutor(2)
        self._lost = lost
        self.shards = []

    def submit(self, function, toml, shard, *rest):
        self.shards.append(shard)
        if shard.split("/")[0] in self._lost:
            failed = Future()
            failed.set_exception(OSError("the node is gone"))
            return failed
        return self._threads.submit(function, toml, shard, *rest)


def same_bits(one, other):
    return all(
        one[name].values.tobytes() == other[name].values.tobytes() for name in one.data_vars
    )


@pytest.fixture(scope="module")
def whole():
    return STUDY.run(progress=None)


def test_shards_give_the_maps_of_one_run(whole):
    news = []
    shared = STUDY.run(executor=Counting(), shards=5, progress=news.append)
    assert same_bits(shared, whole)
    assert [round(one.share * 5) for one in news] == [1, 2, 3, 4, 5]
    assert shared.attrs["study"] != ""


def test_more_shards_than_points_are_no_error(whole):
    few = STUDY.sweep(omega=(0.5, 1.5, 3))
    shared = few.run(executor=Counting(), shards=64, progress=None)
    assert same_bits(shared, few.run(progress=None))


def test_a_lost_worker_costs_its_shard_only(whole, tmp_path):
    journal = tmp_path / "map"
    with pytest.raises(gs.RunError, match=r"2 of 4 shards .* the node is gone .OSError."):
        gs.run(STUDY, executor=Counting({"1", "3"}), shards=4, journal=journal, progress=None)
    again = Counting()
    shared = gs.run(STUDY, executor=again, shards=4, journal=journal, progress=None)
    assert again.shards == ["1/4", "3/4"]
    assert same_bits(shared, whole)
    assert list(tmp_path.iterdir()) == []


def test_futures_that_cannot_be_cancelled_are_waited_for(whole):
    class Bound(Future):
        def cancel(self):
            raise NotImplementedError  # as those of Parsl

    class Binding(Counting):
        def submit(self, function, *arguments):
            bound = Bound()
            bound.set_result(super().submit(function, *arguments).result())
            return bound

    shared = gs.run(STUDY, executor=Binding(), shards=3, progress=None)
    assert same_bits(shared, whole)


def test_another_study_takes_no_shard_of_this_one(tmp_path):
    journal = tmp_path / "map"
    with pytest.raises(gs.RunError):
        gs.run(STUDY, executor=Counting({"1"}), shards=2, journal=journal, progress=None)
    other = STUDY.parameters(damping=0.5)
    shared = gs.run(other, executor=Counting(), shards=2, journal=journal, progress=None)
    assert same_bits(shared, other.run(progress=None))


def test_a_killed_process_costs_its_shard_only(whole, tmp_path):
    journal = tmp_path / "map"
    pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))

    def kill_one(news):
        if news.share < 0.1:
            os.kill(next(iter(pool._processes)), signal.SIGKILL)

    with pool, pytest.raises(gs.RunError, match="shards are not there"):
        gs.run(STUDY, executor=pool, shards=24, journal=journal, progress=kill_one)
    again = Counting()
    shared = gs.run(STUDY, executor=again, shards=24, journal=journal, progress=None)
    assert 0 < len(again.shards) < 24
    assert same_bits(shared, whole)


def test_what_is_wrong_is_said_at_once():
    with pytest.raises(gs.InputError, match=r"executor: expected a concurrent.futures.Executor"):
        gs.run(STUDY, executor=3)
    with pytest.raises(gs.InputError, match="shards: expected a whole number from 1"):
        gs.run(STUDY, executor=Counting(), shards=0)
    with pytest.raises(gs.InputError, match="shards: they are for an executor"):
        gs.run(STUDY, shards=4)


def test_a_chain_of_points_has_no_shards():
    chained = STUDY.set({"initial.policy": "forward"})
    with pytest.raises(gs.InputError, match="need each other"):
        gs.run(chained, executor=Counting(), shards=2, progress=None)
