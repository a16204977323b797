"""Studies, and what is built in."""

from __future__ import annotations

import pickle

import numpy
import pytest
from conftest import MAP, command

import gearsweep
from gearsweep import Study


@pytest.fixture
def study() -> Study:
    return Study.read("coarse-map").set(MAP)


def test_prints_as_toml_that_is_the_same_study(study):
    assert str(study) == study.toml
    assert Study(study.toml) == study
    assert Study(study.toml).toml == study.toml


@pytest.mark.binding
def test_is_a_value(study):
    same = Study(study.toml)
    other = study.set({"parameters.mu": 0.2})
    assert hash(same) == hash(study)
    assert len({study, same, other}) == 2
    assert study != other
    assert study != study.toml
    assert pickle.loads(pickle.dumps(study)) == study


def test_never_changes(study):
    before = study.toml
    study.set({"parameters.mu": 0.2})
    assert study.toml == before
    for change in (lambda: setattr(study, "toml", ""), lambda: delattr(study, "_core")):
        with pytest.raises(AttributeError, match="never changes"):
            change()


def test_tells_what_it_is(study):
    assert study.model == "gear5"
    assert study.axes == {"omega": 7, "e0": 5}
    assert "gear5 over 7 values of omega, 5 values of e0" in repr(study)
    assert "<pre>" in study._repr_html_()
    assert "&lt;b&gt;" in study.set({"title": "<b>"})._repr_html_()


def test_is_read_from_each_place(study, tmp_path):
    text = tmp_path / "b=1.toml"
    text.write_text(study.toml)
    result = tmp_path / "map.nc"
    command("run", str(text), "-o", str(result), "--quiet")
    made = study.run()
    for source in (text, str(text), result, str(result)):
        assert Study.read(source) == study
        assert gearsweep.run(source).equals(made)
    assert gearsweep.run(study.toml).equals(made)
    assert gearsweep.run(study).equals(made)


@pytest.mark.binding
@pytest.mark.parametrize(
    ("path", "value", "line"),
    [
        ("integrate.record", numpy.int64(7), "record = 7"),
        ("parameters.mu", numpy.float64(0.25), "mu = 0.25"),
        ("parameters.mu", 1e-3, "mu = 0.001"),
        ("integrate.events", False, "events = false"),
        ("model.backlash", "dynamic", "backlash = 'dynamic'"),
        ("title", 'a "b" \\ ü', "title = 'a \"b\" \\ ü'"),
        ("title", "1.5", "title = '1.5'"),
        ("observe.quantities", ("dmf_max", "x1_rms"), "quantities = [ 'dmf_max', 'x1_rms' ]"),
        ("initial", {"policy": "fixed", "state": {"x1": 0.5}}, "x1 = 0.5"),
    ],
)
def test_takes_values_of_python(study, path, value, line):
    assert line in study.set({path: value}).toml


@pytest.mark.binding
def test_an_axis_takes_an_array():
    values = numpy.linspace(0.5, 0.6, 3)
    made = gearsweep.run(
        "[model]\nname = 'gear5'\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [1.0]\n",
        set={"axes.omega.values": values, "integrate.settle": 5, "integrate.record": 5},
    )
    numpy.testing.assert_array_equal(made.omega, values)


def test_what_is_given_twice_is_told_where_it_was_asked_for():
    twice = {"parameters.omega": 0.7}
    with pytest.warns(RuntimeWarning, match="omega") as told:
        gearsweep.run("coarse-map", set={**MAP, **twice})
    assert told[0].filename == __file__


def test_studies_are_those_of_the_command():
    assert gearsweep.studies()["coarse-map"] == Study.read("coarse-map").title
    assert all(Study.read(name).title == title for name, title in gearsweep.studies().items())


@pytest.mark.binding
def test_models_tell_what_they_have():
    assert "gear5" in gearsweep.models()
    for name, summary in gearsweep.models().items():
        found = gearsweep.model(name)
        assert (found.name, found.summary) == (name, summary)
        assert found.states
        assert all(p.minimum <= p.default <= p.maximum for p in found.parameters)
    gear = gearsweep.model("gear5")
    assert "coarse" in [preset.name for preset in gear.presets]
    assert "dynamic" in next(o.choices for o in gear.options if o.name == "backlash")


@pytest.mark.binding
def test_devices_have_numbers():
    found = gearsweep.devices()
    assert [device.number for device in found] == list(range(len(found)))
    assert found[0].kind in ("cpu", "gpu")
