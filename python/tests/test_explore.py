"""A page that Python serves."""

from __future__ import annotations

import json
import urllib.error
import urllib.request

import pytest
import xarray
from conftest import MAP
from test_curves import PENDULUM
from test_errors import refusal

import gearsweep


@pytest.fixture(scope="module")
def maps() -> xarray.Dataset:
    return gearsweep.run(PENDULUM)


@pytest.fixture(scope="module")
def found(maps) -> xarray.Dataset:
    return gearsweep.curves(maps, min_pairs=5)


def served_curves(page: gearsweep.Exploration) -> dict:
    try:
        with urllib.request.urlopen(page.url + "curves") as answer:
            return json.load(answer)
    finally:
        page.stop()


def test_a_page_is_served_until_it_is_stopped() -> None:
    page = gearsweep.explore("coarse-map", set=MAP, memory=64)
    with urllib.request.urlopen(page.url + "scene") as answer:
        assert json.load(answer)["axes"][0]["name"] == "omega"
    assert page.url in page._repr_html_()
    page.stop()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(page.url + "scene", timeout=5)
    assert repr(page) == "Exploration(stopped)"


def test_what_is_no_study_is_refused() -> None:
    with pytest.raises(gearsweep.InputError, match="no-such-study"):
        gearsweep.explore("no-such-study")


def test_curves_of_a_dataset_are_those_of_its_file(maps, found, tmp_path):
    path = tmp_path / "curves.nc"
    found.to_netcdf(path)
    told = served_curves(gearsweep.explore(maps, curves=found, memory=64))
    assert told == served_curves(gearsweep.explore(maps, curves=path, memory=64))
    assert told == served_curves(gearsweep.explore(PENDULUM, curves=xarray.load_dataset(path)))
    assert [curve["kind"] for curve in told["curves"]] == found.curve_kind.values.tolist()
    flip = [curve["kind"] for curve in told["curves"]].index("flip")
    end = int(found.curve_points.values[: flip + 1].sum())
    own = slice(end - int(found.curve_points[flip]), end)
    assert told["curves"][flip]["x"] == found.damping.values[own].tolist()
    assert told["curves"][flip]["y"] == found.drive.values[own].tolist()


@pytest.mark.parametrize("is_file", [False, True])
def test_curves_of_another_plane_are_refused(maps, found, tmp_path, is_file):
    found.to_netcdf(tmp_path / "curves.nc")
    given = tmp_path / "curves.nc" if is_file else found
    with pytest.raises(gearsweep.InputError, match="^curves.*: its curves are of omega = 0.66"):
        gearsweep.explore(maps, curves=given, set={"parameters.omega": 0.7})
    with pytest.raises(gearsweep.InputError, match="^curves.*: its curves are of the model"):
        gearsweep.explore("coarse-map", set=MAP, curves=given)


def test_what_is_no_file_of_curves_is_refused(maps, found, tmp_path):
    maps.to_netcdf(tmp_path / "map.nc")
    (tmp_path / "text.nc").write_text("curves")
    for curves, said in (
        (tmp_path / "map.nc", "map.nc' holds no curves"),
        (tmp_path / "text.nc", "is no file of gearsweep curves"),
        (tmp_path / "none.nc", "is no file of gearsweep curves"),
        (maps, "curves: the Dataset is not one that gearsweep.curves() returned"),
        (found.drop_vars("section"), "'curves' holds no curves"),
        (found.isel(point=slice(0, -1)), "'curves' holds no curves"),
        (found.drop_vars("curve_kind"), "'curves' holds no curves"),
        (found.assign_attrs(x="drive", y="damping"), "'curves' has curves that are not of its own"),
        (found.assign_attrs(study=PENDULUM.replace("pendulum", "duffing")), "axis 'drive' is neither"),
        (3, "curves: expected a Dataset or a file, not a int"),
    ):
        assert said in refusal(lambda curves=curves: gearsweep.explore(maps, curves=curves)), said
