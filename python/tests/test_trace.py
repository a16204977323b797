"""Traces of points are those of the command's file, bit for bit."""

from __future__ import annotations

import os
import signal
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy
import pytest
import xarray
from conftest import MAP, SMALL, command, options_of
from test_errors import refusal
from test_result import OF_THE_RUN, assert_same_attributes, assert_same_bits

import gearsweep

POINTS = [{"omega": 0.71, "e0": 0.5}, {"omega": 1.0, "e0": 0.6, "zeta": 0.05}]


def at(point: dict[str, float]) -> tuple[str, str]:
    return "--at", ",".join(f"{name}={value}" for name, value in point.items())


def assert_same_traces(own: xarray.Dataset, other: xarray.Dataset) -> None:
    assert list(own.variables) == list(other.variables)
    assert list(own.coords) == list(other.coords)
    assert dict(own.sizes) == dict(other.sizes)
    assert_same_attributes(own.attrs, other.attrs, OF_THE_RUN)
    for name in own.variables:
        assert_same_bits(own[name], other[name])


def traced_by_command(path, *words: str) -> xarray.Dataset:
    command("trace", *words, "-o", str(path), "--quiet")
    with xarray.open_dataset(path) as opened:
        return opened.load()


@pytest.mark.parametrize(
    ("words", "options"),
    [
        ((), {}),
        (("--settle", "3", "--record", "2"), {"settle": 3, "record": 2}),
        (("--samples-per-period", "16"), {"samples_per_period": 16}),
    ],
)
def test_are_those_of_the_file(words, options, tmp_path):
    places = [word for point in POINTS for word in at(point)]
    path = tmp_path / "t.nc"
    other = traced_by_command(path, "coarse-map", *places, *words, *options_of(MAP))
    own = gearsweep.trace("coarse-map", at=POINTS, set=MAP, **options)
    assert_same_traces(own, other)
    assert own.sizes["trace"] == 2


# Each shows something that the others do not have.
STUDIES = {
    "units of SI": ("table1-gear", {}, {"omega": 0.65, "mu": 0.1}),
    "single precision": ("coarse-map", {"integrate.precision": "fp32"}, POINTS[0]),
    "reference": ("coarse-map", {"integrate.engine": "reference"}, POINTS[0]),
    "start": ("coarse-basins", {}, {"x1": 0.1, "v1": -0.2}),
    "chain": ("hysteresis", {"axes.omega.count": 6}, None),
    "no place": ("coarse-map", {"axes.omega.count": 1, "axes.e0.count": 1}, {}),
}


@pytest.mark.parametrize("name", STUDIES)
def test_of_each_kind_of_study_are_those_of_the_file(name, tmp_path):
    study, changes, point = STUDIES[name]
    changes = {**SMALL, **changes}
    if point is None:  # inside the axes
        axes = gearsweep.run(study, set=changes).coords
        point = {axis: float(axes[axis].mean()) for axis in gearsweep.Study.read(study).axes}
    places = at(point) if point else ()
    other = traced_by_command(tmp_path / "t.nc", study, *places, *options_of(changes))
    assert_same_traces(gearsweep.trace(study, at=[point], set=changes), other)
    assert ("scale_to_SI" in other.x1.attrs) == (name == "units of SI")


def test_of_a_map_are_at_the_place_itself_with_its_steps(tmp_path):
    changes = {**MAP, "integrate.tolerance": 0.05, "axes.omega.count": 40}
    result = tmp_path / "map.nc"
    command("run", "coarse-map", "-o", str(result), "--quiet", *options_of(changes))
    maps = gearsweep.run("coarse-map", set=changes)
    assert "pilot_max_step" in maps.attrs
    other = traced_by_command(tmp_path / "t.nc", str(result), *at({"omega": 0.7, "e0": 0.5}))
    for source in (maps, result, str(result)):
        assert_same_traces(gearsweep.trace(source, at=[{"omega": 0.7, "e0": 0.5}]), other)
    assert float(other.omega[0]) == 0.7
    assert 0.7 not in maps.omega.values


@pytest.mark.binding
def test_of_one_point_has_no_dimension_for_it():
    own = gearsweep.trace("coarse-map", set=MAP, record=2, **POINTS[1])
    same = gearsweep.trace("coarse-map", set=MAP, record=2, at=POINTS[1])
    listed = gearsweep.trace("coarse-map", set=MAP, record=2, at=[POINTS[1]])
    assert dict(own.sizes) == {"moment": listed.sizes["moment"]}
    assert list(own.coords) == ["tau"]
    assert own.equals(same)
    assert own.equals(listed.isel(trace=0).set_coords("tau"))
    assert own.omega == 1.0


def test_passes_through_the_samples_of_the_map():
    changes = {**MAP, "observe.quantities": ["poincare"], "observe.poincare": ["x1", "v3"]}
    maps = gearsweep.run("coarse-map", set={**changes, "integrate.states": "all"})
    own = gearsweep.trace(maps, omega=maps.omega[2], e0=maps.e0[1])
    samples = maps.poincare.isel(omega=2, e0=1).sel(state="x1").values
    ends = numpy.arange(1, samples.size + 1) * float(own.period)
    seen = own.x1.values[[numpy.abs(own.tau.values - end).argmin() for end in ends]]
    numpy.testing.assert_array_equal(seen, samples)


def test_common_values_hold_for_each_point():
    own = gearsweep.trace("coarse-map", set=MAP, record=1, e0=0.5, at=[{"omega": 0.7}, {"omega": 1}])
    assert own.omega.values.tolist() == [0.7, 1.0]
    assert own.e0.values.tolist() == [0.5, 0.5]


def test_starts_where_it_is_told():
    own = gearsweep.trace("coarse-map", settle=0, record=1, x1=0.25, **POINTS[0])
    assert own.x1[0] == 0.25
    assert own.settled == 0


@pytest.mark.binding
def test_two_threads_trace_at_once():
    alone = [gearsweep.trace("coarse-map", set=MAP, at=[point]) for point in POINTS]
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(lambda at: gearsweep.trace("coarse-map", set=MAP, at=[at]), POINTS))
    assert all(one.equals(other) for one, other in zip(alone, together, strict=True))


def test_says_what_made_it():
    own = gearsweep.trace("coarse-map", omega=0.7, e0=0.5, record=1, settle=2)
    assert own.attrs["command_line"] == (
        "gearsweep.trace('coarse-map', settle=2, record=1, omega=0.7, e0=0.5)"
    )


@pytest.mark.parametrize(
    ("call", "said"),
    [
        ({"omega": 0.7}, "there is no value for the study's axis 'e0': add e0="),
        ({"omga": 0.7, "e0": 0.5}, "unknown parameter 'omga' of model 'gear5'"),
        ({"omega": "fast", "e0": 0.5}, "omega: expected a number, not 'fast'"),
        ({"omega": [0.7, 0.8], "e0": 0.5}, "omega: expected a number"),
        ({"omega": numpy.ones(2), "e0": 0.5}, "omega: expected a number"),
        ({"omega": float("nan"), "e0": 0.5}, "omega = nan is out of range"),
        ({"omega": 0.7, "e0": 0.5, "x1": float("inf")}, "x1 = inf is not finite"),
        ({"omega": True, "e0": 0.5}, "omega: expected a number, not True"),
        ({"at": []}, "at: expected a point such as"),
        ({"at": "omega=1"}, "at: expected a point such as"),
        ({"at": 3}, "at: expected a point such as"),
        ({"at": [0.7]}, "at: a point is a dict such as"),
        ({"at": {3: 1.0}}, "expected the name of a parameter or a state, not one of the type int"),
        ({"at": {"\udcff": 1.0}}, "expected the name of a parameter or a state, but"),
        ({"at": {"om\0ega": 1.0}}, "unknown parameter"),
        ({**POINTS[0], "settle": -1}, "settle: -1 is not in 0 .. 1000000000"),
        ({**POINTS[0], "record": 0}, "record: 0 is not in 1 .. 1000000000"),
        ({**POINTS[0], "record": 1.5}, "record: expected a whole number, not 1.5"),
        ({**POINTS[0], "samples_per_period": 0}, "samples_per_period: 0 is not in 1 .. 1048576"),
        ({**POINTS[0], "device": 99}, "99"),
        ({**POINTS[0], "set": {"integrate.tolerance": 1e-4}}, "give the finished map"),
    ],
)
def test_wrong_places_are_refused(call, said):
    assert said in refusal(lambda: gearsweep.trace("coarse-map", **call))


def test_a_place_need_not_lie_on_the_axes_of_a_map():
    maps = gearsweep.run("coarse-map", set=MAP)
    beyond = {"omega": float(maps.omega[-1]) + 0.1, "e0": 0.5}
    assert_same_traces(gearsweep.trace(maps, **beyond), gearsweep.trace("coarse-map", set=MAP, **beyond))



def test_a_point_that_diverges_is_told_of():
    stiff = {"integrate.states": "all", "integrate.settle": 5, "integrate.record": 5}
    with pytest.raises(gearsweep.RunError, match="diverges"):
        gearsweep.trace("coarse-map", set=stiff, k1=1e6, **POINTS[0])


def interrupted(call) -> None:
    """Ctrl-C while it computes."""
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
    finally:
        timer.cancel()
        timer.join()


def test_ctrl_c_stops():
    interrupted(lambda: gearsweep.trace("coarse-map", settle=100_000_000, **POINTS[0]))


def test_a_forked_child_is_told_so():
    gearsweep.devices()
    child = os.fork()
    if child == 0:
        signal.alarm(120)  # a hang ends here, and fails
        status = 0
        for call in (
            lambda: gearsweep.trace("coarse-map", **POINTS[0]),
            lambda: gearsweep.floquet("coarse-map", **POINTS[0]),
            gearsweep.verify,
        ):
            try:
                call()
                status = 1
            except gearsweep.RunError as error:
                status = status if "after fork()" in str(error) else 2
        os._exit(status)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
