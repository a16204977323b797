"""Points that lie on no grid: one result each, as the command gives them."""

from __future__ import annotations

import pickle

import numpy
import pandas
import pytest
import xarray
from conftest import SMALL, command, options_of

import gearsweep
from gearsweep import InputError, Study

POINTS = {"omega": [0.62, 0.71, 1.3], "mu": [0.05, 0.08, 0.02], "x1": [1.0, 0.2, 0.5]}
STUDY = Study.gear5("coarse").integrate(settle=20, record=12, stop="never").observe("x1_rms", "dmf_max")


def test_are_those_of_the_command(tmp_path):
    lines = [",".join(POINTS), *(",".join(map(repr, row)) for row in zip(*POINTS.values()))]
    (tmp_path / "points.csv").write_text("\n".join(lines))
    study = tmp_path / "study.toml"
    study.write_text("[model]\npreset = 'coarse'\n[points]\nfile = 'points.csv'\n")
    quantities = {"observe.quantities": ["x1_rms", "dmf_max"]}
    result = tmp_path / "result.nc"
    command("run", str(study), "-o", str(result), "--quiet", *options_of({**SMALL, **quantities}))
    with xarray.open_dataset(result) as opened:
        by_command = opened.load()
    made = gearsweep.run(STUDY, points=POINTS)
    xarray.testing.assert_equal(made, by_command)
    assert made.mu.attrs == by_command.mu.attrs
    assert gearsweep.run(str(result)).equals(made)
    assert list(made.x1_rms.coords) == ["point", "omega", "mu", "x1"]


@pytest.mark.binding
def test_come_as_a_frame_or_as_arrays():
    asked = STUDY.points(POINTS)
    assert asked.axes == {"point": 3}
    assert STUDY.points(pandas.DataFrame(POINTS)) == asked
    assert STUDY.points({name: numpy.array(value) for name, value in POINTS.items()}) == asked
    assert STUDY.points({name: xarray.DataArray(value) for name, value in POINTS.items()}) == asked
    assert pickle.loads(pickle.dumps(asked)) == Study(asked.toml) == asked


@pytest.mark.binding
def test_a_single_number_stands_for_all():
    assert STUDY.points({"omega": [0.6, 0.7], "mu": 0.1}) == STUDY.points(
        {"omega": [0.6, 0.7], "mu": [0.1, 0.1]}
    )


def test_take_the_place_of_axes():
    made = gearsweep.run("coarse-map", set=SMALL, points={"omega": [0.6, 0.7]})
    assert dict(made.sizes) == {"point": 2}
    assert "points='columns omega'" in made.attrs["command_line"]


def test_replace_other_points_without_a_warning(recwarn):
    assert STUDY.points(POINTS).points({"mu": [0.0, 0.1]}).axes == {"point": 2}
    assert not recwarn


def test_each_may_have_all_values_of_an_axis():
    made = STUDY.points({"mu": [0.0, 0.1]}).sweep(omega=(0.5, 1.5, 4)).run()
    assert made.dmf_max.dims == ("point", "omega")
    alone = STUDY.parameters(mu=0.1).sweep(omega=(0.5, 1.5, 4)).run()
    # What is tabulated depends on the columns.
    numpy.testing.assert_allclose(made.dmf_max[1], alone.dmf_max, rtol=1e-12)


def test_their_result_runs_again_whole_and_in_part():
    made = gearsweep.run(STUDY, points=POINTS)
    assert "0.62" not in made.attrs["study"]
    assert gearsweep.run(made).equals(made)
    last = gearsweep.run(made.isel(point=[2]))
    assert last.dmf_max.item() == made.dmf_max[2].item()
    assert last.omega.item() == 1.3


def test_have_traces_by_their_number():
    made = gearsweep.run(STUDY, points=POINTS)
    trace = gearsweep.trace(made, point=2)
    direct = gearsweep.trace(STUDY, omega=0.71, mu=0.08, x1=0.2)
    # What is tabulated depends on the axes.
    numpy.testing.assert_allclose(trace.x1, direct.x1, rtol=1e-12)
    with pytest.raises(InputError, match="numbered from 1 to 3"):
        gearsweep.trace(made, point=4)
    assert gearsweep.floquet(made, point=1).omega.item() == 0.62


@pytest.mark.binding
@pytest.mark.parametrize(
    ("points", "said"),
    [
        ({}, "no column"),
        ({"mu": 0.1}, "no column with a value for each point"),
        ({"mu": []}, "there are no points"),
        ({"mu": [0.1, float("nan")]}, "'mu' is nan at point 2"),
        ({"mu": [0.1], "omega": [1, 2]}, "'mu' has 1 values, but another column has 2"),
        ({"mu": [[0.1, 0.2]]}, r"has the shape \(1, 2\)"),
        ({"mu": ["a", "b"]}, "an array of numbers"),
        ({"mu": [None]}, "an array of numbers"),
        ({"mu": [1j]}, "an array of numbers"),
        ({"mu": numpy.array([0.1, 0.2 + 0.3j])}, "an array of numbers"),
        ({"mu": [10**400]}, "an array of numbers"),
        ({"mu": numpy.ma.masked_equal([0.1, 9.9], 9.9)}, "1 of the values are masked"),
        ({"mu": [0.1, 7.0]}, "point 2: mu = 7 is out of range"),
        ({"nu": [0.1]}, "did you mean 'mu'"),
        ({3: [0.1]}, "names of parameters"),
        ([0.1, 0.2], "expected a DataFrame, or a dict of arrays"),
    ],
)
def test_what_is_no_list_of_points_is_told(points, said):
    with pytest.raises(InputError, match=said):
        gearsweep.run(STUDY, points=points)


def test_a_million_fit():
    omega = numpy.linspace(0.5, 1.5, 1_000_000)
    study = Study.gear5("coarse").integrate(settle=1, record=1, max_step=0.2, stop="never")
    made = study.observe("x1_max").points({"omega": omega, "mu": 0.05}).run()
    assert made.sizes["point"] == omega.size
    numpy.testing.assert_array_equal(made.omega, omega)
    assert made.x1_max.notnull().all()
