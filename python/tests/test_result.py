"""A Dataset is what xarray makes of the command's file, bit for bit."""

from __future__ import annotations

import ast

import numpy
import pytest
import xarray
from conftest import MAP, SMALL

import gearsweep

# What tells of the one run, and not of the result.
OF_THE_RUN = {"command_line", "created", "compute_seconds", "kernel_seconds"}

STUDIES = {
    "map": ("coarse-map", MAP),
    "stopped": ("coarse-map", {**MAP, "integrate.stop": "orbit"}),
    "single precision": ("coarse-map", {**MAP, "integrate.precision": "fp32"}),
    "pilot": ("coarse-map", {**MAP, "integrate.tolerance": 0.05, "axes.omega.count": 40}),
    "chaos": ("coarse-chaos", {**MAP, "axes.e0.count": 3}),
    "bifurcation": ("coarse-bifurcation", {"axes.omega.count": 30, **SMALL}),
    "basins": ("coarse-basins", {"axes.x1.count": 6, "axes.v1.count": 5, **SMALL}),
    "spectrum": (
        "table1-gear",
        {
            "observe.quantities": '["lyapunov_spectrum", "section_min", "poincare"]',
            "axes.omega.count": 4,
            **SMALL,
        },
    ),
    "chain": ("hysteresis", MAP),
    "reference": ("coarse-map", {**MAP, "integrate.engine": "reference", "axes.e0.count": 2}),
}


def as_python(value: object) -> object:
    """A list of the command's is one of Python's."""
    return ast.literal_eval(value) if str(value).startswith("[") else value


def assert_same_attributes(own: dict, other: dict, left_out: frozenset = frozenset()) -> None:
    assert list(own) == list(other)
    for name in own.keys() - left_out:
        assert own[name].__class__ is other[name].__class__, name
        numpy.testing.assert_array_equal(own[name], other[name], err_msg=name)
        assert numpy.asarray(own[name]).dtype == numpy.asarray(other[name]).dtype, name


def assert_same_bits(own: xarray.DataArray, other: xarray.DataArray) -> None:
    assert own.dims == other.dims
    assert own.dtype == other.dtype
    if own.dtype == object:
        assert own.values.tolist() == other.values.tolist()
    else:
        assert own.values.tobytes() == other.values.tobytes()
    assert_same_attributes(own.attrs, other.attrs)
    assert own.encoding.get("dtype") == other.encoding.get("dtype")
    fills = [variable.encoding.get("_FillValue") for variable in (own, other)]
    numpy.testing.assert_array_equal(*fills)


@pytest.mark.parametrize("name", STUDIES)
def test_is_that_of_the_file(name, by_command):
    study, changes = STUDIES[name]
    other = by_command(study, changes)
    own = gearsweep.run(study, set={path: as_python(value) for path, value in changes.items()})
    assert ("pilot_max_step" in own.attrs) == (name == "pilot")
    assert list(own.variables) == list(other.variables)
    assert list(own.coords) == list(other.coords)
    assert dict(own.sizes) == dict(other.sizes)
    assert_same_attributes(own.attrs, other.attrs, OF_THE_RUN)
    for variable in own.variables:
        assert_same_bits(own[variable], other[variable])


def test_says_what_made_it():
    made = gearsweep.run("coarse-map", set=MAP)
    assert made.attrs["gearsweep_version"] == gearsweep.__version__
    assert made.attrs["command_line"] == f"gearsweep.run('coarse-map', set={MAP!r})"


def test_makes_itself_again():
    first = gearsweep.run("coarse-map", set=MAP)
    again = gearsweep.run(first)
    xarray.testing.assert_equal(first, again)
    other = gearsweep.run(first, set={"parameters.mu": 0.3})
    assert not first.dmf_max.equals(other.dmf_max)


@pytest.mark.binding
def test_can_be_written_and_read(tmp_path):
    made = gearsweep.run("coarse-bifurcation", set={"axes.omega.count": 6, **SMALL})
    made.to_netcdf(tmp_path / "again.nc")
    with xarray.open_dataset(tmp_path / "again.nc") as opened:
        xarray.testing.assert_equal(made, opened.load())


def test_bad_points_have_a_status_and_no_values():
    # The stiffer bearing is too much for the step.
    study = gearsweep.Study(
        "[model]\npreset = 'coarse'\n[[axes]]\nname = 'k1'\nvalues = [1.0, 1e6]\n"
        "[integrate]\nsettle = 20\nrecord = 10\nstates = 'all'\nstop = 'never'\n"
        "[observe]\nquantities = ['x1_rms', 'contact_class']\n"
    )
    with pytest.warns(RuntimeWarning, match="diverged"):
        made = study.run()
    assert made.status.values.tolist() == [0, 1]
    assert made.x1_rms.isnull().values.tolist() == [False, True]
