"""Maps in Zarr, which clusters and clouds read by chunks: xarray writes them, and nothing is lost."""

import pytest
import xarray

import gearsweep as gs

STUDIES = {
    "map": ("coarse-map", {"axes.omega.count": 6, "axes.e0.count": 5}),
    "names of states": ("coarse-bifurcation", {"axes.omega.count": 8}),
}


@pytest.mark.parametrize("study", STUDIES)
def test_maps_come_back_from_zarr_and_are_computed_again_from_it(study, tmp_path):
    name, changes = STUDIES[study]
    short = {"integrate.settle": 20, "integrate.record": 10}
    maps = gs.run(name, set={**changes, **short}, progress=None)
    maps.to_zarr(tmp_path / "map.zarr")
    back = xarray.open_zarr(tmp_path / "map.zarr").load()
    xarray.testing.assert_identical(back, maps)
    assert back.gear.classes("status").equals(maps.gear.classes("status"))
    again = gs.run(back, progress=None)
    for quantity in maps.data_vars:
        assert again[quantity].values.tobytes() == maps[quantity].values.tobytes()
