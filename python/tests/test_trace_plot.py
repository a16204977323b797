"""`trace.gear.plot`: the pictures of ``gearsweep plot``, by matplotlib."""

from __future__ import annotations

import numpy
import pytest
import xarray
from conftest import MAP
from test_errors import refusal

import gearsweep

pyplot = pytest.importorskip("matplotlib.pyplot")
pyplot.switch_backend("agg")

SINES = """
[model]
name = "sines"
[states]
x = { start = "0.0" }
[parameters]
omega = { value = 1.0, min = 0.1, max = 10.0 }
[equations]
x = "omega*(cos(phase) + 0.5*3*cos(3*phase))"
[forcing]
period = "2*pi/omega"
"""


@pytest.fixture(autouse=True)
def close_figures():
    yield
    pyplot.close("all")


@pytest.fixture(scope="module")
def trace() -> xarray.Dataset:
    return gearsweep.trace("coarse-map", set=MAP, omega=0.7, e0=0.5, samples_per_period=64)


# The motion of these equations is sin(phase) + 0.5 sin(3 phase), or 0 dB and -6.02 dB.
def test_a_spectrum_has_the_amplitudes_of_the_sines():
    text = f"[model]\ntext = '''{SINES}'''\n[[axes]]\nname = 'omega'\nvalues = [1.0]\n"
    sines = gearsweep.Study(text)
    motion = gearsweep.trace(sines, omega=1.0, settle=0, record=16, samples_per_period=64)
    line = motion.gear.plot("spectrum:x").get_lines()[0]
    orders, levels = line.get_data()
    assert levels[numpy.abs(orders - 1.0).argmin()] == pytest.approx(0.0, abs=1e-3)
    assert levels[numpy.abs(orders - 3.0).argmin()] == pytest.approx(-6.0206, abs=1e-3)
    assert levels[numpy.abs(orders - 2.0).argmin()] < -80.0


def test_a_history_shows_the_last_periods_in_periods_or_milliseconds(trace):
    ax = trace.gear.plot("time:dmf")
    assert ax.get_xlabel() == "time (mesh periods)"
    assert ax.get_xlim()[1] == pytest.approx(10.0, abs=1.0 / 32.0)
    gear = gearsweep.trace("table1-gear", omega=0.65, mu=0.1, record=4, samples_per_period=64)
    ax = gear.gear.si().gear.plot("force")
    assert ax.get_xlabel() == "time (ms)"
    # 2 pi/0.65 in units of 1/varpi, varpi = 24896 rad/s.
    period = 2e3 * numpy.pi / 0.65 / 24896.0
    assert ax.get_xlim()[1] == pytest.approx(4.0 * period, rel=0.01)
    assert "(N)" in ax.get_ylabel()
    assert [text.get_text() for text in ax.get_legend().get_texts()][0] == "drive flank"


def test_a_phase_portrait_is_over_the_state_whose_rate_is_drawn(trace):
    curve, section = trace.gear.plot("phase").get_lines()
    numpy.testing.assert_array_equal(curve.get_xdata(), trace.x1)
    numpy.testing.assert_array_equal(curve.get_ydata(), trace.v1)
    numpy.testing.assert_array_equal(section.get_xdata(), trace.x1[::64])
    only = trace.gear.plot("section:x1:dmf").get_lines()[0]
    numpy.testing.assert_array_equal(only.get_ydata(), trace.dmf[::64])


def test_several_traces_lie_over_one_another():
    points = [{"omega": 0.7}, {"omega": 0.9}]
    two = gearsweep.trace("coarse-map", set=MAP, at=points, e0=0.5, samples_per_period=64)
    ax = two.gear.plot("spectrum")
    assert len(ax.get_lines()) == 2
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert len(names) == 2
    assert "0.7" in names[0]
    assert "0.9" in names[1]


def test_what_cannot_be_drawn_says_why(trace):
    assert "'spectrum'" in refusal(lambda: trace.gear.plot("spectre"))
    assert "did you mean 'dmf'" in refusal(lambda: trace.gear.plot("time:dmg"))
    uneven = gearsweep.trace("coarse-map", set=MAP, omega=0.7, e0=0.5, record=4)
    assert "samples_per_period=256" in refusal(lambda: uneven.gear.plot("spectrum"))
