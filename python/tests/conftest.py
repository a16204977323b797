"""The command beside the package: what both must agree on."""

from __future__ import annotations

import ctypes
import gc
import os
import re
import subprocess
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest
import xarray

# It is for mypy, and need not run.
collect_ignore = ["typed_program.py"]

# Few points and few periods, by study; each shows something that the others do not have. Without the
# search for orbits a device has half as much to compile.
SMALL = {"integrate.settle": 20, "integrate.record": 12, "integrate.stop": "never"}
MAP = {"axes.omega.count": 7, "axes.e0.count": 5, **SMALL}
# Work for hours, in short rounds and small tiles: whatever stops it comes before its end.
LONG = {
    "axes.omega.count": 2000,
    "axes.e0.count": 2000,
    "integrate.tile": 64,
    "integrate.max_step": 0.2,
}


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
def nothing_is_lost(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Where clang's leak sanitizer is, something still points to all memory of the library's."""
    yield
    loaded = ctypes.CDLL(None)
    if not hasattr(loaded, "__lsan_do_recoverable_leak_check"):
        return
    report = tmp_path_factory.mktemp("leaks") / "report"
    gc.collect()
    loaded.__sanitizer_set_report_path(os.fsencode(report))
    loaded.__lsan_do_recoverable_leak_check()
    loaded.__sanitizer_set_report_path(b"stderr")
    found = [leak for file in report.parent.iterdir() for leak in file.read_text().split("\n\n")]
    # The sanitizer does not see what frames of Python hold, so objects that Python has made are
    # none of its: test_memory.py counts these.
    of_python = re.compile(r"#1 \S+ in _?Py")
    leaks = [leak for leak in found if "gearsweep" in leak and not of_python.search(leak)]
    assert not leaks, "\n\n".join(leaks)
