"""Nothing stays of a call that is over."""

from __future__ import annotations

import contextlib
import gc
import sys

import pytest
from conftest import MAP

import gearsweep


def run_and_drop() -> None:
    gearsweep.run("coarse-map", set=MAP, progress=lambda _: None)


def fail() -> None:
    with contextlib.suppress(gearsweep.InputError):
        gearsweep.run("coarse-map", set={"parameters.nu": 1})


def stop() -> None:
    def raise_error(_: object) -> None:
        raise ZeroDivisionError

    with contextlib.suppress(ZeroDivisionError):
        gearsweep.run("coarse-map", set=MAP, progress=raise_error)


@pytest.mark.binding
@pytest.mark.parametrize("call", [run_and_drop, fail, stop, gearsweep.devices, gearsweep.models])
def test_a_call_leaves_no_object(call):
    def blocks_after_calls(count: int) -> int:
        for _ in range(count):
            call()
        gc.collect()
        sys._clear_type_cache()  # it keeps names that were asked for
        return sys.getallocatedblocks()

    blocks_after_calls(3)
    before = blocks_after_calls(1)
    # What is kept at each call shows as often; caches of others' may differ by a few blocks.
    assert blocks_after_calls(20) < before + 20
