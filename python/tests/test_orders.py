"""Order maps are those of the command's file, and are drawn with their lines."""

from __future__ import annotations

import numpy
import pytest
import xarray
from conftest import command, options_of
from test_errors import refusal
from test_trace import assert_same_traces

import gearsweep

SMALL = {"axes.omega.count": 5, "integrate.settle": 20, "integrate.stop": "never"}


@pytest.fixture(scope="module")
def lines() -> xarray.Dataset:
    return gearsweep.orders("table1-gear", mu=0.1, record=4, set=SMALL)


def test_are_those_of_the_file(lines, tmp_path):
    path = tmp_path / "orders.nc"
    words = ("--at", "mu=0.1", "--record", "4", *options_of(SMALL))
    command("orders", "table1-gear", *words, "-o", str(path), "--quiet")
    with xarray.open_dataset(path) as opened:
        assert_same_traces(lines, opened.load())


@pytest.mark.parametrize("upright", [None, "order"])
def test_are_drawn_with_natural_frequencies_and_orders(lines, upright):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    ax = lines.gear.plot(upright)
    dashed = [line for line in ax.lines if line.get_linestyle() == "--"]
    assert len(dashed) == 3  # of five modes three are equal
    assert len(ax.lines) - len(dashed) == 4
    assert ("order" if upright else "frequency") in ax.get_ylabel()
    pyplot.close("all")


def test_frequencies_are_in_hertz_with_si_units(lines):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    ax = lines.gear.si().gear.plot()
    assert "Hz" in ax.get_ylabel()
    # Order 1 is the frequency at which teeth mesh: 40 teeth times the pinion's turns in a second.
    first = next(line for line in ax.lines if line.get_linestyle() == ":")
    rpm = lines.gear.si().omega.values
    assert numpy.allclose(first.get_ydata(), 40.0 * rpm / 60.0, rtol=1e-9)
    pyplot.close("all")


def test_mistakes_are_told(lines):
    assert "did you mean 'omega'" in refusal(lambda: gearsweep.orders("coarse-map", over="omga"))
    assert "did you mean 'dmf'" in refusal(lambda: gearsweep.orders("coarse-map", channel="dmg"))
    assert "hann" in refusal(lambda: gearsweep.orders("coarse-map", window="kaiser"))
    assert "orders" in refusal(lambda: gearsweep.orders("coarse-map", orders=-1))
    assert "'frequency'" in refusal(lambda: lines.gear.plot("dmf_max"))
