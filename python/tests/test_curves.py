"""gearsweep.curves: the bifurcation curves of a map."""

from __future__ import annotations

import numpy
import pytest

import gearsweep
from gearsweep import InputError

# The pendulum doubles its period between dampings 0.73 and 0.755.
PENDULUM = """
[model]
name = "pendulum"
[parameters]
omega = 0.6666666666666666
phase = 1.5707963267948966
[[axes]]
name = "damping"
from = 0.73
to = 0.755
count = 12
[[axes]]
name = "drive"
from = 1.49
to = 1.51
count = 10
[integrate]
max_step = 0.1
settle = 1000
[observe]
quantities = ["period"]
"""


@pytest.fixture(scope="module")
def maps():
    return gearsweep.run(PENDULUM)


def test_a_doubling_stands_between_the_periods_that_it_parts(maps, tmp_path):
    found = gearsweep.curves(maps, min_pairs=5)
    kinds = zip(found.curve_kind.values, found.curve_period.values, strict=True)
    flip = [(str(kind), int(period)) for kind, period in kinds].index(("flip", 1))
    counts = found.curve_points.values.astype(int)
    end = counts.cumsum()[flip]
    points = slice(end - counts[flip], end)
    order = numpy.argsort(found.drive.values[points])
    for drive in maps.drive.values[1:-1]:
        at = numpy.interp(
            drive, found.drive.values[points][order], found.damping.values[points][order]
        )
        row = maps.period.sel(drive=drive)
        assert (row.where(row.damping > at + 1e-3, drop=True) == 1).all()
        assert (row.where(row.damping < at, drop=True) != 1).all()
    # A file holds the same map.
    maps.to_netcdf(tmp_path / "map.nc")
    again = gearsweep.curves(tmp_path / "map.nc", min_pairs=5)
    assert numpy.array_equal(again.damping.values, found.damping.values)


def test_curves_are_drawn_over_their_map(maps, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = maps.gear.plot("period")
    before = len(ax.lines)
    assert gearsweep.curves(maps, min_pairs=5).gear.plot(ax=ax) is ax
    assert len(ax.lines) > before
    assert "flip" in [text.get_text() for text in ax.get_legend().get_texts()]
    ax.figure.savefig(tmp_path / "curves.png")


def test_a_map_without_periods_is_refused(maps):
    with pytest.raises(InputError, match="no 'period'"):
        gearsweep.curves(maps.drop_vars("period"))
    with pytest.raises(InputError, match="other points|not over"):
        gearsweep.curves(maps.isel(drive=[0, 1]))
    with pytest.raises(InputError, match="no result file"):
        gearsweep.curves("pendulum-cascade")
