"""Runs in the background."""

from __future__ import annotations

import asyncio
import concurrent.futures
import threading

import pytest
from conftest import LONG, MAP

import gearsweep


def threads() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name == "gearsweep.submit"]


def test_the_maps_are_those_of_run():
    coming = gearsweep.submit("coarse-map", set=MAP)
    made = coming.result()
    assert coming.done() and not coming.running()
    assert made.equals(gearsweep.run("coarse-map", set=MAP))
    assert made.attrs["command_line"].startswith("gearsweep.submit('coarse-map'")
    assert coming.progress is not None and coming.progress.share == 1.0


def test_cancelled_it_stops_computing():
    coming = gearsweep.submit("coarse-map", set=LONG)
    assert coming.running()
    assert coming.cancel()
    with pytest.raises(concurrent.futures.CancelledError):
        coming.result()
    for thread in threads():  # a run for hours that is not stopped never ends here
        thread.join()


def test_one_of_a_low_priority_waits():
    gearsweep.run("coarse-map", set=MAP)  # its kernels are there: it would take a moment
    first = gearsweep.submit("coarse-map", set=LONG)
    while first.progress is None:
        assert first.running()
    begun = first.progress.seconds
    waiting = gearsweep.submit("coarse-map", set=MAP, priority=-1)
    while first.progress.seconds < begun + 3:
        assert waiting.running()
    first.cancel()
    assert waiting.result().status.size == 35


def test_several_are_waited_for_by_the_standard_library():
    coming = [gearsweep.submit("coarse-map", set={**MAP, "parameters.mu": mu}) for mu in (0, 0.1)]
    made = {one.result().attrs["study"] for one in concurrent.futures.as_completed(coming)}
    assert len(made) == 2

    async def wait() -> object:
        return await asyncio.wrap_future(gearsweep.submit("coarse-map", set=MAP))

    assert coming[0].result().dmf_max.shape == asyncio.run(wait()).dmf_max.shape


def test_what_is_wrong_is_said_at_once_or_by_the_result(tmp_path):
    with pytest.raises(gearsweep.InputError, match="priority"):
        gearsweep.submit("coarse-map", priority=1.5)
    with pytest.raises(gearsweep.InputError, match="coarse-maps"):
        gearsweep.submit("coarse-maps")
    coming = gearsweep.submit("coarse-map", set=MAP, journal=tmp_path / "missing" / "journal")
    assert isinstance(coming.exception(), gearsweep.InputError | gearsweep.RunError)
