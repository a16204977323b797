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


# The second pinion has 18 teeth on the shaft of a gear of 41.
def test_a_second_mesh_has_orders_of_its_own():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    few = {"axes.0.count": 2, "integrate.settle": 1}
    stages = gearsweep.orders("two-stage-gear", record=41, orders=2, set=few)
    own = [line for line in stages.gear.plot().lines if line.get_color() == "#d070ff"]
    assert len(own) == 4
    expected = 18.0 / 41.0 * stages.forcing_frequency.values
    numpy.testing.assert_allclose(own[0].get_ydata(), expected, rtol=1e-9)
    motion = gearsweep.trace(
        "two-stage-gear",
        pinion_speed_rpm_first=6000,
        settle=41,
        record=41,
        samples_per_period=32,
    )
    ax = motion.gear.plot("spectrum:dmf1")
    marks = [line for line in ax.lines if line.get_color() == "#d070ff"]
    assert marks[0].get_xdata()[0] == pytest.approx(18.0 / 41.0)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["orders of second"]
    assert "mesh frequency of first" in ax.get_xlabel()
    pyplot.close("all")


def test_mistakes_are_told(lines):
    assert "did you mean 'omega'" in refusal(lambda: gearsweep.orders("coarse-map", over="omga"))
    assert "did you mean 'dmf'" in refusal(lambda: gearsweep.orders("coarse-map", channel="dmg"))
    assert "hann" in refusal(lambda: gearsweep.orders("coarse-map", window="kaiser"))
    assert "orders" in refusal(lambda: gearsweep.orders("coarse-map", orders=-1))
    assert "'frequency'" in refusal(lambda: lines.gear.plot("dmf_max"))


@pytest.mark.parametrize("name", ["run", "submit", "trace", "orders", "floquet", "tolerance", "explore"])
def test_an_option_without_a_name_is_asked_for_it(name):
    said = refusal(lambda: getattr(gearsweep, name)("coarse-map", "x1"))
    assert said.startswith(f"{name}: 'x1' has no name")
    assert "device" in said
