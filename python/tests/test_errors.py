"""What is wrong is told with the text of the command, and does no harm to what comes after."""

from __future__ import annotations

import pickle

import numpy
import pytest
import xarray
from conftest import MAP, command, options_of

import gearsweep
from gearsweep import InputError, RunError, Study


def refusal(call) -> str:
    with pytest.raises(InputError) as refused:
        call()
    return str(refused.value)


@pytest.mark.parametrize(
    ("study", "changes"),
    [
        ("coarse-mop", {}),
        ("./nowhere.toml", {}),
        ("coarse-map", {"parameters.nu": 1}),
        ("coarse-map", {"omega.count": 4}),
        ("coarse-map", {"axes.omego.count": 4}),
        ("coarse-map", {"axes.omega.count": "many"}),
        ("coarse-map", {"axes.omega.count": 1.5}),
        ("coarse-map", {"axes.omega.count": -1}),
        ("coarse-map", {"parameters.mu": float("nan")}),
        ("coarse-map", {"parameters.mu": float("inf")}),
        ("coarse-map", {"model.name": "gear6"}),
        ("coarse-map", {"model.backlash": "dynamik"}),
        ("coarse-map", {"integrate.tolerance": 1e-30}),
        ("coarse-map", {"axes.omega.count": 400_000_000, "axes.e0.count": 400_000_000}),
    ],
)
def test_bad_studies_are_refused_as_by_the_command(study, changes, tmp_path):
    out = ("-o", str(tmp_path / "out.nc"), "--quiet")
    said = command("run", study, *out, *options_of(changes), status=2)
    own = refusal(lambda: gearsweep.run(study, set=changes))
    assert f"gearsweep: {own}\n" == said


def test_text_of_another_kind_is_refused_as_a_file_is(tmp_path):
    text = "[model]\nname = 'gear5'\n[[axes]]\nname = \n"
    path = tmp_path / "study.toml"
    path.write_text(text)
    said = command("run", str(path), "-o", str(tmp_path / "out.nc"), status=2)
    assert said == f"gearsweep: {refusal(lambda: gearsweep.run(path))}\n"
    assert refusal(lambda: Study(text)) == refusal(lambda: gearsweep.run(text))


def test_devices_that_are_not_there(tmp_path):
    out = ("-o", str(tmp_path / "out.nc"))
    for device in ("99", "one"):
        said = command("run", "coarse-map", *out, "--device", device, status=2)
        assert refusal(lambda d=device: gearsweep.run("coarse-map", device=d)) in said
    assert "99" in refusal(lambda: gearsweep.run("coarse-map", device=99))


@pytest.mark.parametrize(
    "call",
    [
        lambda: gearsweep.run(3),
        lambda: Study(None),
        lambda: gearsweep.run("coarse-map", set=["parameters.mu"]),
        lambda: gearsweep.run("coarse-map", set={"parameters.mu": object()}),
        lambda: gearsweep.run("coarse-map", set={3: 1}),
        lambda: gearsweep.run("coarse-map", set={"a=b": 1}),
        lambda: gearsweep.run("coarse-map", set=MAP, progress=3),
        lambda: gearsweep.run("coarse-map", set=MAP, device=1.5),
        lambda: gearsweep.run(xarray.Dataset()),
        lambda: gearsweep.run(xarray.Dataset(attrs={"study": "["})),
        lambda: gearsweep.run(xarray.Dataset(attrs={"study": 5})),
        lambda: gearsweep.trace(xarray.Dataset(attrs={"study": numpy.array([1, 2])})),
        lambda: gearsweep.model("gear"),
    ],
)
def test_wrong_arguments_are_refused(call):
    assert refusal(call)


# The study of a result is its maker's, and the files that it names would be the reader's.
@pytest.mark.parametrize(
    "study",
    [
        "[model]\nfile = 'SECRET'\n[[axes]]\nname = 'x'\nvalues = [1]\n",
        "[points]\nfile = 'SECRET'\n",
        "[[axes]]\nname = 'omega'\nvalues = [1]\n[gear]\nstiffness_file = 'SECRET'\n",
        "[[axes]]\nname = 'omega'\nvalues = [1]\n[uncertain]\nmu = {file = 'SECRET'}\n",
    ],
)
def test_a_result_opens_no_file_of_its_reader(study, tmp_path):
    secret = tmp_path / "secret"
    secret.write_text("mu\n0.0123\n")
    maps = gearsweep.run("coarse-map", set=MAP)
    maps.attrs["study"] = study.replace("SECRET", str(secret))
    path = tmp_path / "map.nc"
    maps.to_netcdf(path)
    for result in (maps, path):
        for call in (gearsweep.run, gearsweep.trace, gearsweep.floquet, gearsweep.orders):
            said = refusal(lambda call=call, result=result: call(result))
            assert "the study of a result may name none" in said
            assert "0.0123" not in said
    for words in (
        ("run", str(path), "-o", str(tmp_path / "again.nc")),
        ("trace", str(path), "-o", str(tmp_path / "trace.nc")),
        ("floquet", str(path)),
        ("report", str(path), "-o", str(tmp_path / "page.html")),
    ):
        assert "the study of a result may name none" in command(*words, status=2)


def test_a_journal_that_cannot_be_made_is_told_of(tmp_path):
    with pytest.raises((InputError, RunError), match="nowhere"):
        gearsweep.run("coarse-map", set=MAP, journal=tmp_path / "nowhere" / "journal")


@pytest.mark.binding
def test_the_next_call_works():
    before = gearsweep.run("coarse-map", set=MAP)
    refusal(lambda: gearsweep.run("coarse-map", set={**MAP, "parameters.nu": 1}))
    refusal(lambda: gearsweep.run("coarse-map", set=MAP, device=99))
    assert gearsweep.run("coarse-map", set=MAP).equals(before)


@pytest.mark.binding
def test_errors_are_of_python():
    assert issubclass(InputError, ValueError)
    assert issubclass(RunError, RuntimeError)
    for error in (InputError("what"), RunError("why")):
        same = pickle.loads(pickle.dumps(error))
        assert type(same) is type(error)
        assert type(error).__module__ == "gearsweep"
        assert str(same) == str(error)
