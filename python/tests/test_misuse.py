"""What no caller should do is told of, and the next call works as if it had not been done."""

from __future__ import annotations

import functools
import inspect
import multiprocessing
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy
import pytest
from conftest import MAP, SMALL

import gearsweep
from gearsweep import InputError, RunError, Study

# Each function that users call, with arguments that are right.
GOOD: dict[str, Mapping[str, object]] = {
    "run": {
        "study": "coarse-map",
        "set": MAP,
        "points": None,
        "progress": None,
        "journal": None,
        "device": None,
        "executor": None,
        "shards": None,
    },
    "submit": {"study": "coarse-map", "set": MAP, "points": None, "journal": None, "device": None, "priority": 0},
    "trace": {
        "study": "coarse-map",
        "at": None,
        "settle": 5,
        "record": 1,
        "samples_per_period": None,
        "set": MAP,
        "device": None,
        "omega": 0.7,
        "e0": 0.5,
    },
    "floquet": {
        "study": "coarse-map",
        "at": None,
        "along": None,
        "period": None,
        "steps": 64,
        "equilibrium": False,
        "switch": None,
        "set": MAP,
        "device": None,
        "omega": 0.7,
        "e0": 0.5,
    },
    "orders": {
        "study": "coarse-map",
        "over": None,
        "channel": None,
        "at": None,
        "orders": 2.0,
        "settle": 5,
        "record": 1,
        "samples_per_period": 16,
        "window": None,
        "set": MAP,
        "device": None,
        "e0": 0.5,
    },
    "explore": {
        "study": "coarse-map",
        "curves": None,
        "set": MAP,
        "device": None,
        "height": 400,
        "memory": 64,
        "port": None,
    },
    "tolerance": {
        "study": "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [1.0]\n"
        "[uncertain]\nmu = {distribution = 'normal', std = 0.001}\n",
        "gears": 20,
        "tolerance_class": 7,
        "percentile": 90.0,
        "set": SMALL,
        "progress": None,
        "journal": None,
        "device": None,
    },
    "tolerance_findings": {
        "study": "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [1.0]\n"
        "[uncertain]\nmu = {distribution = 'normal', std = 0.001}\n",
        "gears": 20,
        "tolerance_class": 7,
        "percentile": 90.0,
        "width": None,
        "set": SMALL,
        "journal": None,
        "device": None,
    },
    "curves": {"maps": "map.nc", "steps": None, "min_pairs": None, "device": None},
    "verify": {"device": None, "progress": None},
    "gear_keys": {},
    "model": {"name": "gear5"},
    "models": {},
    "studies": {},
    "devices": {},
    "normal": {"std": 0.1, "mean": None, "relative": False, "folded": False},
    "triangular": {"from_": 0.1, "mode": 0.2, "to": 0.3, "relative": False},
    "uniform": {"from_": 0.1, "to": 0.3, "relative": False},
    "values": {"numbers": [0.1, 0.2], "relative": False},
    "Study": {"source": "[model]\nname = 'gear5'\n"},
    "Study.gear5": {"preset": "coarse"},
    "Study.points": {"self": Study.read("coarse-map"), "points": {"mu": [0.1, 0.2]}},
    "Model.read": {"path": "model.toml"},
    "Study.read": {"path": "coarse-map"},
    "Study.set": {"self": Study.read("coarse-map"), "changes": MAP},
}


def function(name: str) -> Callable[..., object]:
    return functools.reduce(getattr, name.split("."), gearsweep)


def test_each_function_is_misused_below():
    functions = {name for name in gearsweep.__all__ if inspect.isfunction(function(name))}
    assert functions <= GOOD.keys()
    for name in functions:
        parameters = inspect.signature(function(name)).parameters.values()
        named = [one.name for one in parameters if one.kind is not one.VAR_KEYWORD]
        assert list(GOOD[name])[: len(named)] == named, name
        # Beyond them are names of a model.
        assert (len(GOOD[name]) > len(named)) == (len(named) < len(parameters)), name


@pytest.mark.binding
@pytest.mark.parametrize(
    ("name", "parameter"),
    [(name, parameter) for name, good in GOOD.items() for parameter in good if parameter != "self"],
)
@pytest.mark.parametrize("wrong", [object(), b"\xff", 2.5j, ("a", 1)], ids=type)
def test_a_wrong_type_is_refused(name, parameter, wrong):
    with pytest.raises(InputError) as refused:
        function(name)(**{**GOOD[name], parameter: wrong})
    assert str(refused.value)


@pytest.mark.binding
@pytest.mark.parametrize(
    "values",
    [
        numpy.array([]),
        numpy.array([[1.0, 2.0], [3.0, 4.0]]),
        numpy.array([1.0, numpy.nan]),
        numpy.array([1.0, numpy.inf]),
        numpy.array([1.0, 2.0j]),
        numpy.array(["one", "two"]),
        numpy.array([None, 1.0], dtype=object),
        numpy.array([True, False]),
        numpy.array(["2020-01-01"], dtype="datetime64[D]"),
        [1.0, [2.0]],
        {"from": 1.0},
        {1.0, 2.0},
        None,
        "",
    ],
    ids=repr,
)
def test_wrong_values_of_an_axis_are_refused(values):
    study = "[model]\nname = 'gear5'\n[[axes]]\nname = 'omega'\nvalues = [1.0]\n"
    with pytest.raises(InputError, match="axes"):
        gearsweep.run(study, set={"axes.omega.values": values})


# Numbers that NumPy or TOML would make something else of, or nothing.
NO_NUMBERS = [
    numpy.ma.masked_equal([0.5, 9.9, 1.0], 9.9),
    numpy.array([0.5, 1.0 + 2.0j]),
    numpy.array([0.5, numpy.complex64(1.0 + 2.0j)], dtype=object),
    [0.5, 10**400],
    ["0.5", "0.6"],
    numpy.array(["2020-01-01", "2020-01-02"], dtype="datetime64[D]"),
]


@pytest.mark.parametrize("numbers", NO_NUMBERS, ids=lambda numbers: repr(numbers)[:40])
def test_what_is_no_number_is_never_computed_with(numbers):
    study = Study.gear5("coarse")
    states = {"x": "v", "v": "-x"}
    for use in (
        lambda: study.sweep(omega=numbers),
        lambda: study.points({"omega": numbers}),
        lambda: gearsweep.values(numbers),
        lambda: gearsweep.Model(
            states=states, parameters={}, period=1, tables={"t": numpy.ma.array([numbers, numbers]).T}
        ),
        lambda: gearsweep.trace("coarse-map", set=MAP, omega=numbers[1], e0=0.5, record=1),
    ):
        with pytest.raises(InputError) as refused:
            use()
        assert len(str(refused.value)) < 600


def test_a_masked_array_without_masked_values_is_an_array():
    assert Study.gear5().sweep(omega=numpy.ma.array([0.5, 0.6])).axes == {"omega": 2}


@pytest.mark.parametrize("number", [10**400, 10**5000, 2**64], ids=["400", "5000", "2^64"])
def test_a_number_without_end_is_refused(number):
    for use in (
        lambda: Study.gear5(mu=number),
        lambda: Study.gear5().sweep(omega=(0.1, number, 3)),
        lambda: gearsweep.run("coarse-map", set={"axes.omega.count": number}),
        lambda: gearsweep.run("coarse-map", set=MAP, device=number),
        lambda: gearsweep.trace("coarse-map", set=MAP, record=number),
        lambda: gearsweep.trace("coarse-map", set=MAP, omega=number, e0=0.5),
    ):
        with pytest.raises(InputError) as refused:
            use()
        assert len(str(refused.value)) < 600


def test_more_values_than_an_axis_may_have_are_refused_before_they_are_written_out():
    values = numpy.linspace(0.4, 2.0, 4_000_000)
    for use in (
        lambda: Study.gear5().sweep(omega=values),
        lambda: gearsweep.run("coarse-map", set={"axes.omega.values": values}),
    ):
        with pytest.raises(InputError, match="4000000 values; at most 1000000 are possible"):
            use()


@pytest.mark.binding
@pytest.mark.parametrize(
    "changes",
    [
        {"": 1},
        {"axes": 3},
        {"axes.omega.count": 0},
        {"axes.omega.count": True},
        {"axes.omega.count": 10**30},
        {"axes.omega.count": numpy.nan},
        {"observe.quantities": []},
        {"observe.quantities": [3]},
        {"observe.quantities": numpy.zeros((2, 2))},
        {"parameters.mu": numpy.float32("nan")},
        {"parameters.mu": numpy.complex64(0.1 + 0.1j)},
        {"parameters.mu": numpy.ma.masked},
        {"parameters.mu": numpy.array([0.1, 0.2])},
        {"title": "\ud800"},
        {"\ud800": 1},
        {"title\n[axes]": 1},
    ],
    ids=repr,
)
def test_wrong_changes_are_refused(changes):
    with pytest.raises(InputError):
        gearsweep.run("coarse-map", set={**MAP, **changes})


@pytest.mark.binding
@pytest.mark.parametrize("text", ["", "\0", "a\0b", "[", "=", "\ud800", "ü" * 5000, "a = 1\n\0"])
def test_text_that_is_no_study_is_refused(text):
    for read in (Study, Study.read, gearsweep.run):
        with pytest.raises(InputError):
            read(text)


@pytest.mark.binding
@pytest.mark.parametrize("raised", [ValueError, SystemExit, GeneratorExit, KeyboardInterrupt])
def test_what_a_progress_function_raises_ends_the_run_alone(raised):
    def fail(_: object) -> None:
        raise raised("as told")

    before = gearsweep.run("coarse-map", set=MAP)
    with pytest.raises(raised, match="as told"):
        gearsweep.run("coarse-map", set=MAP, progress=fail)
    with pytest.raises(TypeError):
        gearsweep.run("coarse-map", set=MAP, progress=lambda: None)
    assert gearsweep.run("coarse-map", set=MAP).equals(before)


@pytest.mark.binding
def test_a_progress_function_may_run_a_study():
    inner = []
    outer = gearsweep.run(
        "coarse-map",
        set=MAP,
        progress=lambda _: inner or inner.append(gearsweep.run("coarse-map", set=MAP)),
    )
    assert inner[0].equals(outer)


@pytest.mark.binding
def test_threads_may_fail_beside_one_that_runs():
    def attempt(changes: Mapping[str, object]) -> object:
        try:
            return gearsweep.run("coarse-map", set={**MAP, **changes})
        except InputError as error:
            return str(error)

    wrong = [{"parameters.nu": 1}, {"axes.omega.count": 0}, {"integrate.settle": -1}]
    alone = [attempt(changes) for changes in wrong]
    plain = attempt({})
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(attempt, [{}, *wrong, {}]))
    assert together[1:-1] == alone
    assert together[0].equals(plain)
    assert together[-1].equals(plain)


def shape_of_a_run() -> tuple[int, ...]:
    return gearsweep.run("coarse-map", set=MAP).dmf_max.shape


def names_in_a_child() -> tuple[str, ...]:
    return (*gearsweep.models(), Study.read("coarse-map").title)


@pytest.mark.parametrize("call", [shape_of_a_run, gearsweep.devices])
def test_a_pool_of_forked_processes_is_told_what_to_do(call):
    gearsweep.run("coarse-map", set=MAP)
    with (
        ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool,
        pytest.raises(RunError, match="'spawn'"),
    ):
        pool.submit(call).result(timeout=120)


def test_a_forked_process_may_ask_what_needs_no_device():
    gearsweep.run("coarse-map", set=MAP)
    with ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool:
        assert pool.submit(names_in_a_child).result(timeout=120) == names_in_a_child()


def test_a_pool_of_spawned_processes_computes():
    shape = shape_of_a_run()
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(shape_of_a_run).result(timeout=120) == shape


def test_a_repeated_run_makes_no_new_program(tmp_path):
    # A file that a library before OpenCL's adds to, by a line for each program.
    counted = tmp_path / "programs"
    script = (
        "import gearsweep, pathlib\n"
        "def count(**changes):\n"
        f"    gearsweep.run('coarse-map', set={MAP!r} | changes)\n"
        f"    print(pathlib.Path({str(counted)!r}).read_text().count('made'))\n"
        "count()\ncount()\ncount(**{'parameters.mu': 0.2, 'axes.omega.from': 0.7})\n"
        "count(**{'observe.quantities': ['x2_rms']})\n"
    )
    environment = os.environ | {
        "LD_PRELOAD": os.environ["COUNTING_OPENCL"],
        "COUNTED_PROGRAMS": str(counted),
    }
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    first, again, of_other_values, of_other_quantities = map(int, done.stdout.split())
    assert first > 0
    assert again == of_other_values == first
    assert of_other_quantities > first


def test_a_million_points_fit():
    made = gearsweep.run(
        "[model]\nname = 'gear5'\npreset = 'coarse'\n[observe]\nquantities = ['x1_max']\n"
        "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 1000\n"
        "[[axes]]\nname = 'e0'\nfrom = 0.1\nto = 0.5\ncount = 1000\n"
        "[integrate]\nsettle = 1\nrecord = 1\nmax_step = 0.2\nstop = 'never'\n"
    )
    assert made.x1_max.shape == (1000, 1000)
    assert not made.status.any()
    assert made.x1_max.notnull().all()
