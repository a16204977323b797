"""The command beside the package: what both must agree on."""

from __future__ import annotations

import ctypes
import gc
import os
import subprocess
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest
import xarray

# Few points and few periods, by study; each shows something that the others do not have.
SMALL = {"integrate.settle": 20, "integrate.record": 12}
MAP = {"axes.omega.count": 7, "axes.e0.count": 5, **SMALL}


def options_of(changes: Mapping[str, object]) -> list[str]:
    """Plain changes as the command takes them."""
    return [word for path, value in changes.items() for word in ("--set", f"{path}={value}")]


def command(*words: str, status: int = 0) -> str:
    """What the command says on stderr; it must end with `status`."""
    done = subprocess.run(
        [os.environ["GEARSWEEP"], *words], capture_output=True, text=True, check=False
    )
    assert done.returncode == status, done.stderr
    return done.stderr


@pytest.fixture
def by_command(tmp_path: Path) -> Callable[..., xarray.Dataset]:
    """The result of the command, as xarray opens its file."""

    def run(study: str, changes: Mapping[str, object]) -> xarray.Dataset:
        path = tmp_path / "result.nc"
        command("run", study, "-o", str(path), "--quiet", *options_of(changes))
        with xarray.open_dataset(path) as opened:
            return opened.load()

    return run


@pytest.fixture(scope="session", autouse=True)
def nothing_is_lost() -> Iterator[None]:
    """Where clang's leak sanitizer is, no memory that nothing points to any more."""
    yield
    find_leaks = getattr(ctypes.CDLL(None), "__lsan_do_recoverable_leak_check", None)
    if find_leaks is not None:
        gc.collect()
        assert find_leaks() == 0, "the leak sanitizer's report is on stderr"
