"""Periodic orbits, as the command tells them to scripts."""

from __future__ import annotations

import json
import os
import subprocess

import numpy
import pytest
import xarray
from test_errors import refusal
from test_trace import interrupted

import gearsweep

# It doubles its period at damping 0.741173.
PENDULUM = """
[model]
name = "pendulum"
preset = "cascade"
[[axes]]
name = "damping"
from = 0.72
to = 0.75
count = 4
[integrate]
settle = 300
[observe]
quantities = ["x_rms"]
"""
PLACE = {"damping": 0.745}
RANGE = ("damping", 0.735, 0.75)


def by_command(study: str, path, *words: str) -> dict:
    path.write_text(study)
    done = subprocess.run(
        [os.environ["GEARSWEEP"], "floquet", str(path), "--json", *words],
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


def multipliers_in(told: dict) -> list[complex]:
    return [complex(m["re"], m["im"]) for m in told["multipliers"]]


def assert_same_orbit(own: xarray.Dataset, told: dict, prefix: str = "") -> None:
    assert own[f"{prefix}period"] == told["period"]
    assert own[f"{prefix}stable"] == told["stable"]
    assert own[f"{prefix}section"].values.tolist() == told["state"]
    assert own[f"{prefix}multipliers"].values.tolist() == multipliers_in(told)


@pytest.fixture(scope="module")
def branch() -> xarray.Dataset:
    return gearsweep.floquet(PENDULUM, along=RANGE, **PLACE)


def test_one_orbit_is_that_of_the_command(tmp_path):
    told = by_command(PENDULUM, tmp_path / "pendulum.toml", "--at", "damping=0.745")
    own = gearsweep.floquet(PENDULUM, **PLACE)
    assert dict(own.sizes) == {"state": 2, "multiplier": 2}
    assert_same_orbit(own, told)
    assert own.state.values.tolist() == told["states"]
    assert own.section_error.values.tolist() == told["state_error"]
    assert own.multiplier_error.values.tolist() == [m["error"] for m in told["multipliers"]]
    assert own.grazing == told["grazing"]
    assert own.damping == told["parameters"]["damping"]
    assert own.attrs["nearest_bifurcation"] == told["nearest"]["kind"]
    assert own.attrs["nearest_margin"] == told["nearest"]["margin"]


def test_the_branch_is_that_of_the_command(tmp_path, branch):
    words = ("--at", "damping=0.745", "--along", "damping=0.735:0.75")
    told = by_command(PENDULUM, tmp_path / "pendulum.toml", *words)
    down, up = (way["orbits"] for way in told["branches"])
    line = [*reversed(down), *up[1:]]
    assert branch.sizes["orbit"] == len(line)
    for i, orbit in enumerate(line):
        assert_same_orbit(branch.isel(orbit=i), orbit)
    assert branch.damping.values.tolist() == [orbit["value"] for orbit in line]
    assert float(branch.damping.sel(orbit=branch.attrs["start_orbit"])) == pytest.approx(0.745)
    assert branch.attrs["ended"] == "; ".join(way["ended"] for way in told["branches"])
    assert branch.sizes["bifurcation"] == len(told["bifurcations"]) == 1
    for i, found in enumerate(told["bifurcations"]):
        own = branch.isel(bifurcation=i)
        assert_same_orbit(own, found, "bifurcation_")
        assert own.bifurcation_kind == found["kind"]
        assert own.bifurcation_value == found["value"]
        assert own.bifurcation_error == found["value_error"]
        assert own.bifurcation_grazing == found["grazing"]
        assert own.bifurcation_born_of == found["born_of"]


def test_a_flip_makes_the_orbit_unstable(branch):
    value = float(branch.bifurcation_value[0])
    assert value == pytest.approx(0.741173, abs=1e-6)
    assert branch.bifurcation_kind.values.tolist() == ["flip"]
    numpy.testing.assert_array_equal(branch.stable, branch.damping > value)
    largest = abs(branch.multipliers).max("multiplier")
    numpy.testing.assert_array_equal(branch.stable, largest <= 1)


def test_has_types_units_and_origins(branch):
    assert branch.multipliers.dtype == complex
    assert branch.stable.dtype == branch.bifurcation_grazing.dtype == bool
    assert branch.period.dtype.kind == "i"
    assert branch.damping.dims == ("orbit",)
    assert {"state", "orbit", "damping"} <= set(branch.coords)
    assert all("long_name" in branch[name].attrs for name in branch.variables)
    assert branch.attrs["study"] == gearsweep.Study(PENDULUM).toml
    assert branch.attrs["along"] == "damping"
    assert branch.attrs["command_line"].startswith("gearsweep.floquet(<str>, along=('damping'")


@pytest.mark.binding
def test_a_branch_without_bifurcations_has_none():
    own = gearsweep.floquet(PENDULUM, along=("damping", 0.745, 0.75), steps=256)
    assert own.sizes["bifurcation"] == 0
    assert own.bifurcation_kind.shape == (0,)
    assert own.bifurcation_multipliers.shape == (0, 2)
    assert own.attrs["start_orbit"] == 1


def part_of(tree: xarray.Dataset, number: int) -> xarray.Dataset:
    """The orbits and bifurcations of a branch."""
    return tree.isel(orbit=tree.orbit_branch == number).isel(
        bifurcation=tree.bifurcation_branch == number
    )


def test_branches_that_leave_are_those_of_the_command(tmp_path):
    words = ("--along", "damping=0.75:0.725", "--switch", "2", "--steps", "256")
    told = by_command(PENDULUM, tmp_path / "pendulum.toml", *words)
    tree = gearsweep.floquet(PENDULUM, along=("damping", 0.75, 0.725), switch=2, steps=256)
    assert tree.sizes["branch"] == len(told["leaving"]) == 2
    assert tree.branch_period.values.tolist() == [2, 4]
    numbers = tree.orbit_branch.values.tolist()
    assert numbers == sorted(numbers) and set(numbers) == {0, 1, 2}
    for way, number in [(told, 0), *((way, way["number"]) for way in told["leaving"])]:
        own = part_of(tree, number)
        (branch,) = way["branches"]
        assert own.sizes["orbit"] == len(branch["orbits"])
        for i, orbit in enumerate(branch["orbits"]):
            assert_same_orbit(own.isel(orbit=i), orbit)
        assert own.damping.values.tolist() == [orbit["value"] for orbit in branch["orbits"]]
        assert own.bifurcation_value.values.tolist() == [b["value"] for b in way["bifurcations"]]
        for i, found in enumerate(way["bifurcations"]):
            assert_same_orbit(own.isel(bifurcation=i), found, "bifurcation_")
    for way in told["leaving"]:
        own = tree.sel(branch=way["number"])
        assert own.branch_leaves == way["leaves"]
        assert own.branch_orbits == len(way["branches"][0]["orbits"])
        assert own.branch_ended == way["branches"][0]["ended"]
        origin = tree.sel(bifurcation=int(own.branch_origin))
        assert origin.bifurcation_branch == way["leaves"]
        assert origin.bifurcation_kind == way["origin"]["kind"] == "flip"
        assert origin.bifurcation_value == way["origin"]["value"]
    # The first branch stands as it does alone.
    alone = gearsweep.floquet(PENDULUM, along=("damping", 0.75, 0.725), steps=256)
    assert "branch" not in alone.dims
    same = part_of(tree, 0).drop_dims("branch").drop_vars(["orbit_branch", "bifurcation_branch"])
    xarray.testing.assert_equal(same, alone)


def test_goes_the_way_that_is_asked_for(branch):
    name, low, high = RANGE
    back = gearsweep.floquet(PENDULUM, along=(name, high, low), **PLACE)
    numpy.testing.assert_array_equal(back.damping, branch.damping[::-1])


def test_of_a_gear_has_the_units_of_its_states():
    own = gearsweep.floquet("table1-gear", omega=0.65, mu=0.1)
    assert own.section.attrs["units"] == "see state_units"
    assert own.state_units.sel(state="x1") == "b_n"
    assert own.state_SI_units.sel(state="x1") == "m"
    assert own.multiplier_error.max() < 1e-6


def test_an_orbit_inside_chaos_is_found_by_its_period():
    own = gearsweep.floquet("coarse-map", omega=0.55, e0=0.6, period=1)
    assert not own.stable
    first = own.multipliers.values[0]
    assert first == pytest.approx(complex(-0.10191766, 1.07545673), abs=1e-7)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        ({}, "there is no value for the study's axis 'damping': add damping=0.72"),
        ({"dampng": 0.7}, "unknown parameter 'dampng' of model 'pendulum'"),
        ({"damping": 1000}, "damping = 1000 is out of range; -10 .. 100"),
        ({"along": ("dampin", 0.7, 0.8)}, "along: unknown parameter 'dampin'"),
        ({"along": ("damping", 0.7)}, "along: expected a parameter and two values"),
        ({"along": "damping"}, "along: expected a parameter and two values"),
        ({"along": ("damping", 0.7, "much")}, "along: expected a number, not 'much'"),
        ({"along": ("damping", 0.7, 0.7)}, "along: the range is empty"),
        ({"along": RANGE, "damping": 0.5}, "damping = 0.5 is not in the range of along"),
        ({**PLACE, "period": 0}, "period: 0 is not in 1 .. 4096"),
        ({**PLACE, "steps": 3}, "steps: 3 is not in 16 .. 65536"),
        ({**PLACE, "switch": 1}, "switch: branches leave along a parameter: give along, too"),
        ({"along": RANGE, "switch": 13}, "switch: 13 is not in 0 .. 12"),
        ({"along": RANGE, "switch": 0.5}, "switch: expected a whole number"),
        ({"at": [PLACE]}, "at: a point is a dict such as"),
    ],
)
def test_wrong_requests_are_refused(call, said):
    assert said in refusal(lambda: gearsweep.floquet(PENDULUM, **call))


def test_a_model_that_nothing_drives_has_cycles():
    rossler = "[model]\nname = 'rossler'\n[[axes]]\nname = 'c'\nvalues = [2.5]\n"
    cycle = gearsweep.floquet(rossler)
    assert cycle.attrs["kind"] == "cycle" and int(cycle.period) == 1 and bool(cycle.stable)
    # By DOP853 at 1e-13.
    assert float(cycle.cycle_time) == pytest.approx(5.748991183278, abs=1e-9)
    assert cycle.multipliers.values[0] == pytest.approx(-0.769693642, abs=1e-8)
    assert float(cycle.multiplier_along) == pytest.approx(1, abs=1e-8)
    branch = gearsweep.floquet(rossler, along=("c", 2.5, 3.0))
    assert branch.bifurcation_kind.values.tolist() == ["flip"]
    assert float(branch.bifurcation_value[0]) == pytest.approx(2.83244502786, abs=1e-7)
    assert branch.cycle_time.dims == ("orbit",)
    tree = gearsweep.floquet(rossler, along=("c", 2.5, 3.2), switch=1)
    assert tree.branch_period.values.tolist() == [2]
    doubled = tree.isel(orbit=tree.orbit_branch == 1)
    assert (doubled.period == 2).all() and bool(doubled.stable[-1])
    # It leaves with twice the time.
    at_flip = float(tree.bifurcation_cycle_time[0])
    assert float(doubled.cycle_time[0]) == pytest.approx(2 * at_flip, rel=1e-4)


def test_a_model_that_nothing_drives_has_equilibria():
    lorenz = "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [22.0]\n"
    start = {"x": 8.0, "y": 8.0, "z": 20.0}
    branch = gearsweep.floquet(lorenz, equilibrium=True, along=("rho", 22, 28), **start)
    assert branch.attrs["kind"] == "equilibrium" and "period" not in branch
    assert branch.eigenvalues.dims == ("orbit", "eigenvalue")
    assert branch.bifurcation_kind.values.tolist() == ["Hopf"]
    assert float(branch.bifurcation_value[0]) == pytest.approx(470 / 19, abs=1e-7)
    assert "driven" in refusal(lambda: gearsweep.floquet(PENDULUM, equilibrium=True, **PLACE))
    assert "True or False" in refusal(lambda: gearsweep.floquet(lorenz, equilibrium=1))


def test_chaos_is_no_orbit_and_says_what_to_try():
    with pytest.raises(gearsweep.RunError, match="--period"):
        gearsweep.floquet(PENDULUM, damping=0.05, drive=0.6, omega=0.7)


def test_ctrl_c_stops_the_settling_and_the_search():
    interrupted(
        lambda: gearsweep.floquet(
            PENDULUM, set={"integrate.settle": 100_000_000, "integrate.stop": "never"}, **PLACE
        )
    )
    interrupted(lambda: gearsweep.floquet(PENDULUM, along=RANGE, steps=65536, **PLACE))
