"""The self-test of a device, as a value."""

from __future__ import annotations

import os
import signal
import subprocess

import pytest
from test_errors import refusal

import gearsweep


@pytest.fixture(scope="module")
def seen() -> list[gearsweep.Check]:
    return []


@pytest.fixture(scope="module")
def verification(seen) -> gearsweep.Verification:
    return gearsweep.verify(progress=seen.append)


def test_passes_with_the_checks_of_the_command(verification):
    assert verification.passed
    help_text = subprocess.run(
        [os.environ["GEARSWEEP"], "verify", "--help"], capture_output=True, text=True, check=True
    ).stdout
    for check in verification.checks:
        assert check.what in help_text
        assert check.verdict in ("pass", "skipped")
        assert check.failed == 0
    assert len({check.name for check in verification.checks}) >= 10


def test_tells_each_check_in_its_order(verification, seen):
    assert tuple(seen) == verification.checks


def test_prints_as_a_table(verification):
    lines = repr(verification).splitlines()
    assert lines[0] == verification.device
    assert gearsweep.devices()[0].name in lines[0]
    for line, check in zip(lines[1:], verification.checks, strict=True):
        assert line.startswith(check.verdict)
        assert check.figures in line


def test_a_failed_check_is_a_verdict():
    good = gearsweep.Check("bits", "the same", "pass", 0.1, 3, 0, "3 numbers")
    bad = good._replace(verdict="FAIL", failed=1)
    assert gearsweep.Verification("a device", (good,)).passed
    assert not gearsweep.Verification("a device", (good, bad)).passed


class Enough(Exception):
    """Raised by a progress function that has seen enough."""


@pytest.mark.binding
def test_what_progress_raises_stops_it():
    seen = []

    def stop(check: gearsweep.Check) -> None:
        seen.append(check)
        raise Enough

    with pytest.raises(Enough):
        gearsweep.verify(progress=stop)
    assert len(seen) == 1


def test_ctrl_c_stops():
    with pytest.raises(KeyboardInterrupt):
        gearsweep.verify(progress=lambda _: os.kill(os.getpid(), signal.SIGINT))


def test_wrong_arguments_are_refused():
    assert "99" in refusal(lambda: gearsweep.verify(99))
    assert "progress" in refusal(lambda: gearsweep.verify(progress=3))
