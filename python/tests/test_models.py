"""Models of one's own: equations in Python are those of a file."""

from __future__ import annotations

import pickle
import tomllib

import numpy
import pytest
import xarray
from conftest import SMALL

import gearsweep
from gearsweep import InputError, Model, Study

STATES = {"x": "v", "v": "-2*zeta*v - backlash(x, b) + F*cos(phase)"}
PARAMETERS = {"omega": 1.0, "zeta": 0.05, "b": 1.0, "F": 0.1}
PERIOD = "2*pi/omega"

SWEEPS_THE_FILE = """
[model]
file = "model.toml"
[[axes]]
name = "omega"
values = [0.5, 0.7]
"""
MESH = "# mesh.csv\nphase, stiffness\n0, 1.2\n2, 0.8\n4, 1.1\n"
READS_A_TABLE = """
[model]
name = "measured"
[states]
x = { start = "b + F" }
v = {}
[parameters]
omega = 1.0
b = 1.0
F = 0.1
[equations]
x = "v"
v = "F - 0.1*v - table('mesh.csv', phase)*backlash(x, b)"
[forcing]
period = "2*pi/omega"
"""


@pytest.fixture
def oscillator() -> Model:
    return Model(STATES, PARAMETERS, start={"x": "b"}, period=PERIOD)


def refusal(call) -> str:
    with pytest.raises(InputError) as refused:
        call()
    return str(refused.value)


def test_is_swept(oscillator):
    made = Study(oscillator).sweep(omega=(0.2, 2, 5)).integrate(**short()).run()
    assert made.x_rms.sizes == {"omega": 5}
    assert made.status.values.tolist() == [0] * 5
    assert gearsweep.run(made).equals(made)


def test_a_parameter_may_follow_others():
    own = Model(
        {"x": "v", "v": "-x*wn^2 - 0.2*v + g*sin(phase)"},
        {"wn": 2.0, "omega": "0.5*wn"},
        constants={"g": 0.5},
        period=PERIOD,
    )
    assert {one.name: one.default for one in own.parameters} == {"wn": 2.0, "omega": 1.0}
    study = Study(own).sweep(wn=[1.0, 2.0]).integrate(**short(), max_step=0.02).observe("x_rms")
    follows = study.run()
    assert follows.omega.values.tolist() == [0.5, 1.0]
    assert follows.omega.attrs["follows"] == "0.5*wn"
    other = study.parameters(omega="wn/4", g="wn/8").run()
    assert other.omega.values.tolist() == [0.25, 0.5]
    assert not numpy.allclose(other.x_rms, follows.x_rms)
    # The same, point by point.
    for wn, rms in zip(other.wn.values, other.x_rms.values, strict=True):
        alone = study.sweep(wn=[wn]).parameters(omega=float(wn) / 4, g=float(wn) / 8).run()
        assert alone.x_rms.values == pytest.approx(rms, rel=1e-9)
    assert "unknown name 'wm'" in refusal(lambda: study.parameters(omega="0.5*wm").run())


def short() -> dict[str, int]:
    return {path.removeprefix("integrate."): value for path, value in SMALL.items()}


def test_its_text_is_a_file_of_the_command(oscillator, tmp_path, by_command):
    (tmp_path / "model.toml").write_text(oscillator.text)
    study = tmp_path / "study.toml"
    study.write_text(SWEEPS_THE_FILE)
    other = by_command(str(study), SMALL)
    own = Study(oscillator).sweep(omega=[0.5, 0.7]).integrate(**short()).run()
    xarray.testing.assert_equal(own, other)
    assert Model.read(tmp_path / "model.toml") == oscillator


def test_is_a_value(oscillator):
    same = Model(STATES, PARAMETERS, start={"x": "b"}, period=PERIOD)
    other = Model(STATES, {**PARAMETERS, "F": 0.2}, start={"x": "b"}, period=PERIOD)
    assert hash(same) == hash(oscillator)
    assert len({oscillator, same, other}) == 2
    assert oscillator != oscillator.text
    assert pickle.loads(pickle.dumps(oscillator)) == oscillator
    for change in (lambda: setattr(same, "name", ""), lambda: delattr(same, "_read")):
        with pytest.raises(AttributeError, match="never changes"):
            change()


def test_tells_what_it_has():
    model = Model(
        STATES,
        {**PARAMETERS, "b": {"value": 1.0, "min": 0.0, "unit": "mm", "meaning": "half backlash"}},
        constants={"f": "backlash(x, b)"},
        signals={"force": {"expression": "F*f", "meaning": "<force>"}, "power": "v*f"},
        presets={"wide": {"b": 3.0}, "strong": {"F": 1.0, "meaning": "more force"}},
        units={"x": "mm", "F": "N", "force": "N"},
        meanings={"x": "position"},
        period=PERIOD,
        name="gap",
        summary="a mass in a gap",
    )
    assert (model.name, model.summary) == ("gap", "a mass in a gap")
    assert model.states[0] == ("x", "mm", "position")
    assert model.parameters[2] == ("b", "mm", "half backlash", 1.0, 0.0, 1e12)
    assert model.parameters[3][:2] == ("F", "N")
    assert {"force", "power"} <= {signal.name for signal in model.signals}
    assert [preset.name for preset in model.presets] == ["default", "wide", "strong"]
    assert str(model) == model.text
    assert repr(model) == "<gearsweep.Model 'gap': states x, v; parameters omega, zeta, b, F>"
    assert "&lt;force&gt;" in model._repr_html_()
    assert "<thead><tr><th>name</th>" in model._repr_html_()
    assert "b = 3" in Study.of(model, "wide").sweep(omega=[1.0]).run().attrs["settings"]


def test_an_option_chooses_between_expressions():
    model = Model(
        {"x": "v", "v": "-0.2*v - if(law.cubic, x^3, x) + cos(phase)"},
        {"omega": 1.3},
        options={"law": ["linear", "cubic"]},
        period=PERIOD,
    )
    study = Study(model).sweep(omega=[1.3]).integrate(settle=300, record=5, stop="never")
    linear = float(study.run().x_rms)
    exact = 1.0 / numpy.hypot(1.0 - 1.3**2, 0.2 * 1.3) / numpy.sqrt(2.0)
    assert linear == pytest.approx(exact, rel=1e-4)
    assert float(study.parameters(law="cubic").run().x_rms) != pytest.approx(linear, rel=0.1)


def test_tables_are_those_of_files(tmp_path):
    (tmp_path / "mesh.csv").write_text(MESH)
    (tmp_path / "model.toml").write_text(READS_A_TABLE)
    (tmp_path / "study.toml").write_text(SWEEPS_THE_FILE)
    read = Model.read(tmp_path / "model.toml")
    own = Model(
        {"x": "v", "v": "F - 0.1*v - table('mesh.csv', phase)*backlash(x, b)"},
        {"omega": 1.0, "b": 1.0, "F": 0.1},
        start={"x": "b + F"},
        period=PERIOD,
        tables={"mesh.csv": numpy.array([[0, 1.2], [2, 0.8], [4, 1.1]])},
    )
    assert read.tables == own.tables
    assert pickle.loads(pickle.dumps(own)) == own
    by_file = gearsweep.run(tmp_path / "study.toml", set=SMALL)
    for model in (read, own):
        made = Study(model).sweep(omega=[0.5, 0.7]).run(set=SMALL)
        xarray.testing.assert_equal(made, by_file)


def test_a_built_in_model_is_one_of_these():
    duffing = gearsweep.model("duffing")
    assert isinstance(duffing, Model)
    assert "[equations]" in duffing.text
    assert pickle.loads(pickle.dumps(duffing)) == duffing
    assert Study(duffing) == Study.of("duffing")
    assert "name = 'duffing'" in Study(duffing).toml
    gear = gearsweep.model("gear5")
    assert "[equations]" in gear.text
    assert gear != duffing
    assert pickle.loads(pickle.dumps(gear)) == gear


def test_a_built_in_model_can_be_changed_as_text():
    text = gearsweep.model("duffing").text.replace('name = "duffing"', 'name = "mine"')
    study = Study.of("duffing").set({"model": {"text": text}})
    assert study.model == "mine"


def test_the_period_is_said():
    assert 'period = "2*pi/omega"' in Model(STATES, PARAMETERS, period=PERIOD).text
    assert "give it, as in period='2*pi/omega'" in refusal(lambda: Model(STATES, PARAMETERS))
    free = {"x": "v", "v": "-w*x"}
    assert 'period = "1/w"' in Model(free, {"w": 1.0}, period="1/w").text
    assert "period = 2" in Model(free, {"w": 1.0}, period=2).text


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (
            lambda: Model({"x": "v", "v": "-zet*v + cos(phase)"}, PARAMETERS, period=PERIOD),
            "'zet'; did you mean",
        ),
        (
            lambda: Model({"x": "v", "v": "-zeta*(v + cos(phase)"}, PARAMETERS, period=PERIOD),
            "')' is missing",
        ),
        (lambda: Model({"x": "v", "v": None}, PARAMETERS, period=1), "'v' has no equation"),
        (lambda: Model({"x": "v", "v": "__import__('os')"}, PARAMETERS, period=1), "__import__"),
        (lambda: Model({}, PARAMETERS, period=1), "no [states]"),
        (lambda: Model(["x"], PARAMETERS, period=PERIOD), "states: expected a dict"),
        (lambda: Model(STATES, {**PARAMETERS, "b": "wide"}, period=PERIOD), "unknown name 'wide'"),
        (lambda: Model(STATES, {**PARAMETERS, "b": numpy.nan}, period=PERIOD), "must be finite"),
        (lambda: Model(STATES, {**PARAMETERS, "b": {"min": 0.0}}, period=PERIOD), "has no value"),
        (lambda: Model(STATES, {**PARAMETERS, "x": 1.0}, period=PERIOD), "'x' is defined twice"),
        (
            lambda: Model({"a b": "1", **STATES}, PARAMETERS, period=PERIOD),
            "'a b' cannot be a name",
        ),
        (
            lambda: Model(STATES, PARAMETERS, start={"y": 1}, period=PERIOD),
            "start: the model has no 'y'",
        ),
        (
            lambda: Model(STATES, PARAMETERS, units={"y": "m"}, period=PERIOD),
            "units: the model has no 'y'",
        ),
        (lambda: Model(STATES, PARAMETERS, name="no name", period=PERIOD), "needs a name"),
        (lambda: Model(STATES, PARAMETERS, jumps=3, period=PERIOD), "jumps must be a list"),
        (lambda: Model(STATES, PARAMETERS, options={"law": ["a"]}, period=PERIOD), "needs from 2"),
        (
            lambda: Model(STATES, PARAMETERS, presets={"p": 3}, period=PERIOD),
            "presets: expected a dict",
        ),
        (lambda: Model(STATES, PARAMETERS, presets={"p": {"k": 3}}, period=PERIOD), "'k'"),
        (
            lambda: Model(STATES, PARAMETERS, tables={"k": [[0, 1], [2, 3]]}, period=PERIOD),
            "is read by no",
        ),
        (
            lambda: Model({"x": "-table('k', phase)"}, PARAMETERS, period=PERIOD),
            "reads the table 'k'",
        ),
        (
            lambda: Model(STATES, PARAMETERS, tables={"k": [1, 2]}, period=PERIOD),
            "expected the shape",
        ),
        (
            lambda: Model(STATES, PARAMETERS, tables={"k": "mesh.csv"}, period=PERIOD),
            "an array of numbers",
        ),
        (
            lambda: Model(
                {"x": "-table('k', phase)"},
                {"omega": 1},
                tables={"k": [[0, 1], [-1, 2]]},
                period=PERIOD,
            ),
            "table 'k':2",
        ),
        (
            lambda: Model({"x": "-x + F*cos(omega*t)"}, {"omega": 1, "F": 1}, period=PERIOD),
            "as in cos(phase)",
        ),
        (lambda: Model({"x": "-bcklash(x, b)"}, {"b": 1}, period=1), "did you mean 'backlash'"),
        (lambda: Model.read("nowhere.toml"), "nowhere.toml"),
        (lambda: gearsweep.model("dufing"), "did you mean 'duffing'?"),
        (lambda: gearsweep.model(3), "expected the name of a model"),
    ],
)
def test_what_is_wrong_is_told(call, said):
    assert said in refusal(call)


def test_an_error_shows_the_place_in_the_expression():
    states = {"x": "v", "v": "-2*zet*v + cos(phase)"}
    said = refusal(lambda: Model(states, PARAMETERS, period=PERIOD))
    expression, caret = said.splitlines()[1:]
    assert expression[caret.index("^") :].startswith("zet*v")


def test_presets_have_their_values():
    presets = {preset.name: preset.values for preset in gearsweep.model("gear5").presets}
    assert presets["consistent"] == {}
    assert presets["coarse"] == {"e0": 0.6}
    assert presets["paper"]["formulation"] == "printed"
    assert presets["paper"]["policy"] == "fixed"
    # What a study of the preset resolves to.
    made = Study.gear5("paper").sweep(b=[1.0]).integrate(settle=2, record=1).run()
    resolved = tomllib.loads(made.attrs["settings"])["parameters"]
    numbers = {name: value for name, value in presets["paper"].items() if not isinstance(value, str)}
    assert {name: resolved[name] for name in numbers} == numbers
    own = Model(
        {"x": "-k*x"}, {"k": 1.0, "m": 2.0}, presets={"half": {"k": "0.5*m", "m": 3}}, period=1
    )
    assert own.presets[-1].values == {"k": "0.5*m", "m": 3}


def test_the_keys_of_a_drawing_are_those_that_a_study_takes():
    keys = gearsweep.gear_keys()
    assert keys["pinion_speed_rpm"].unit == "rpm"
    assert keys["teeth"].default == "required"
    drawing = Study.read("table1-gear").toml.split("[gear]")[1].split("[[")[0]
    given = {line.split("=")[0].strip() for line in drawing.splitlines() if "=" in line}
    assert given <= keys.keys()
    assert len(given) > 5
