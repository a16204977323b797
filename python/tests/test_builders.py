"""Studies that are built step by step are those that TOML says."""

from __future__ import annotations

import pickle

import numpy
import pandas
import pytest

import gearsweep
from gearsweep import InputError, Study

TEXT = """
[model]
name = "gear5"
preset = "coarse"
stiffness = "rectangular"
[parameters]
mu = 0.05
[[axes]]
name = "omega"
from = 0.4
to = 2.0
count = 6
[[axes]]
name = "b"
values = [0.3, 0.9, 1.5]
[initial]
policy = "fixed"
state = { x1 = 0.2 }
[integrate]
settle = 20
record = 10
stop = "never"
[observe]
quantities = ["x1_rms", "dmf_max"]
"""


def built() -> Study:
    return (
        Study.gear5(preset="coarse", mu=0.05, stiffness="rectangular")
        .sweep(omega=(0.4, 2.0, 6), b=numpy.array([0.3, 0.9, 1.5]))
        .initial(policy="fixed", state={"x1": 0.2})
        .integrate(settle=20, record=10, stop="never")
        .observe("x1_rms", "dmf_max")
    )


def refusal(call) -> str:
    with pytest.raises(InputError) as refused:
        call()
    return str(refused.value)


def test_steps_give_the_study_that_a_text_gives():
    assert built() == Study(TEXT)
    assert built().run().equals(gearsweep.run(TEXT))


def test_the_order_of_steps_does_not_matter():
    other = (
        Study.of("gear5", "coarse")
        .observe("x1_rms", "dmf_max")
        .integrate(record=10, stop="never")
        .integrate(settle=20)
        .initial(policy="fixed", state={"x1": 0.2})
        .sweep(omega=(0.4, 2.0, 6), b=[0.3, 0.9, 1.5])
        .parameters(stiffness="rectangular", mu=0.05)
    )
    assert other == built()


def test_the_first_keyword_is_x():
    study = Study.gear5().sweep(b=[0.5, 1.0], omega=(0.4, 2.0, 3))
    assert list(study.axes) == ["b", "omega"]
    made = study.integrate(settle=5, record=5, stop="never").run()
    assert made.x1_rms.dims == ("omega", "b")


@pytest.mark.parametrize(
    "values",
    [
        [0.5, 0.75, 1.0],
        numpy.array([0.5, 0.75, 1.0]),
        numpy.array([0.5, 0.75, 1.0], dtype=numpy.float32),
        pandas.Series([0.5, 0.75, 1.0]),
        range(1, 4),
        (0.5, 0.75, 1.0, 1.25, 1.5),
        numpy.float64(0.5),
    ],
)
def test_an_axis_takes_what_is_like_an_array(values):
    made = Study.gear5().sweep(omega=values).integrate(settle=2, record=2, stop="never").run()
    numpy.testing.assert_array_equal(made.omega, numpy.atleast_1d(numpy.asarray(values, float)))


def test_an_axis_takes_a_range_and_its_scale():
    study = Study.gear5().integrate(settle=2, record=2, stop="never")
    linear = study.sweep(omega=(numpy.float64(0.5), 2, numpy.int64(4))).run()
    numpy.testing.assert_allclose(linear.omega, [0.5, 1.0, 1.5, 2.0], rtol=1e-15)
    even_ratios = study.sweep(omega=(0.5, 4.0, 4, "log")).run()
    numpy.testing.assert_allclose(even_ratios.omega, [0.5, 1.0, 2.0, 4.0], rtol=1e-15)
    assert even_ratios.omega.attrs["scale"] == "log"


def test_sweep_replaces_the_axes_that_were_there():
    other = Study.read("coarse-map").sweep(mu=(0.0, 0.1, 3))
    assert other.axes == {"mu": 3}


def test_samples_need_not_be_named_twice():
    sampled = Study.gear5().observe("x1_rms", poincare=["x1", "v1"])
    assert sampled == Study.gear5().observe("x1_rms", "poincare", poincare=["x1", "v1"])
    assert "quantities = [ 'x1_rms', 'poincare' ]" in sampled.toml
    alone = Study.gear5().observe("poincare", poincare=["x1"])
    assert Study.gear5().observe(poincare="x1") == alone


def test_a_list_fills_numbered_parameters():
    study = Study.gear5(stiffness="fourier", kappa=[0.1, 0.02]).sweep(omega=[1.0, 1.1])
    settings = study.integrate(settle=2, record=2, stop="never").run().attrs["settings"]
    assert "kappa = 0.1\n" in settings
    assert "kappa_2 = 0.02\n" in settings


def test_each_step_is_another_study():
    base = Study.gear5()
    before = base.toml
    base.sweep(omega=[1.0]).observe("x1_rms").parameters(mu=0.1).integrate(record=3)
    assert base.toml == before


def test_a_study_without_axes_is_a_value():
    draft = Study.gear5(preset="coarse")
    assert draft.axes == {}
    assert Study(str(draft)) == draft
    assert pickle.loads(pickle.dumps(draft)) == draft
    assert draft != draft.parameters(mu=0.1)
    assert "without axes" in repr(draft)
    assert "without axes" in draft._repr_html_()


def test_a_study_without_axes_is_not_run():
    for call in (Study.gear5().run, lambda: gearsweep.run(Study.gear5(), set={"title": "x"})):
        assert "study.sweep(omega=(0.4, 2.0, 100))" in refusal(call)


def test_a_chain_may_be_named_before_its_axis():
    chain = Study.gear5().initial(policy="forward", along="omega")
    assert chain.sweep(omega=[0.5, 0.6]).axes == {"omega": 2}
    assert "'omega'" in refusal(lambda: chain.sweep(b=[0.5, 0.6]))


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: Study.of("geer5"), "did you mean 'gear5'?"),
        (lambda: Study.gear5("corse"), "did you mean 'coarse'?"),
        (lambda: Study.gear5(zita=0.1), "did you mean 'zeta'?"),
        (lambda: Study.gear5(stifness="fourier"), "did you mean 'stiffness'?"),
        (lambda: Study.gear5(stiffness="furier"), "did you mean 'fourier'?"),
        (lambda: Study.gear5(mu="high"), "unknown name 'high'"),
        (lambda: Study.gear5(backlash=3), "backlash must be a string"),
        (lambda: Study.gear5().sweep(omga=[1.0]), "did you mean 'omega'?"),
        (lambda: Study.gear5().sweep(), "give one or two axes"),
        (lambda: Study.gear5().sweep(omega=[1], b=[1], mu=[0]), "a map has one or two"),
        (lambda: Study.gear5().sweep(omega=(0.4, 1.0, 2.0)), "count must be a whole number"),
        (lambda: Study.gear5().sweep(omega=(1, 2, 3, "cubic")), "expected (from, to, count)"),
        (lambda: Study.gear5().sweep(omega="all"), "expected (from, to, count)"),
        (lambda: Study.gear5().sweep(omega=None), "expected (from, to, count)"),
        (lambda: Study.gear5().sweep(omega=[[1.0, 2.0]]), "not of shape (1, 2)"),
        (lambda: Study.gear5().sweep(omega=[]), "has no values"),
        (lambda: Study.gear5().sweep(omega=[1.0, numpy.nan]), "must be finite"),
        (lambda: Study.gear5().sweep(omega=[2.0, 1.0]), "must increase"),
        (lambda: Study.gear5().observe("x1_rm"), "did you mean 'x1_rms'?"),
        (lambda: Study.gear5().observe(), "observe.quantities is empty"),
        (lambda: Study.gear5().observe(poincare=3), "must be a list of strings"),
        (lambda: Study.gear5().observe(poincare={"x1"}), "no values of the type set"),
        (lambda: Study.gear5().initial(polcy="fixed"), "did you mean 'policy'?"),
        (lambda: Study.gear5().integrate(setle=3), "did you mean 'settle'?"),
        (lambda: Study(None), "not one of the type NoneType"),
        (lambda: Study(""), "the file is empty"),
    ],
)
def test_a_wrong_step_is_refused_at_once(call, said):
    assert said in refusal(call)


def test_a_million_values_make_a_short_message():
    values = numpy.linspace(0.1, 1.0, 1_000_000)
    values[500_000] = 0.0
    said = refusal(lambda: Study.gear5().sweep(omega=values))
    assert len(said) < 400
    assert "omega" in said


def test_a_million_values_are_an_axis():
    values = numpy.linspace(0.1, 1.0, 1_000_000)
    assert Study.gear5().sweep(omega=values).axes == {"omega": 1_000_000}


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: Study.gear5().sweep(omega=(0.2, 2)), "has no count"),
        (lambda: Study.gear5().sweep(omega=(2, 1, 5)), "sweep(omega): axis 'omega' goes from"),
        (lambda: Study("coarse-map"), "Study.read('coarse-map')"),
        (lambda: gearsweep.run(gearsweep.model("duffing")), "gearsweep.Study(model)"),
    ],
)
def test_what_users_try_first_is_answered(call, said):
    assert said in refusal(call)


def test_quantities_may_be_a_list():
    asked = Study.gear5().observe(["x1_rms", "dmf_max"])
    assert asked == Study.gear5().observe("x1_rms", "dmf_max")


def test_who_drops_axes_is_told():
    swept = Study.gear5().sweep(omega=(0.5, 1.0, 3))
    with pytest.warns(RuntimeWarning, match="take the place of the axes omega"):
        assert swept.points({"mu": [0.0, 0.1]}).axes == {"point": 2}


def test_distributions_are_the_keys_of_a_study():
    built = Study.gear5("coarse").uncertain(
        samples=20,
        mu=gearsweep.normal(0.005, mean=0.1),
        omega=gearsweep.normal(0.01, relative=True),
        e0=gearsweep.uniform(0.55, 0.65),
        F1=gearsweep.triangular(0.08, 0.1, 0.12),
        b=gearsweep.values(numpy.array([0.9, 1.1]), relative=True),
    )
    read = Study("""
[model]
name = "gear5"
preset = "coarse"
[uncertain]
samples = 20
mu = {distribution = "normal", std = 0.005, mean = 0.1}
omega = {distribution = "normal", std = 0.01, relative = true}
e0 = {distribution = "uniform", from = 0.55, to = 0.65}
F1 = {distribution = "triangular", from = 0.08, mode = 0.1, to = 0.12}
b = {distribution = "values", values = [0.9, 1.1], relative = true}
""")
    assert built == read


@pytest.mark.parametrize("numbers", ["0.1 0.2", [[0.1], [0.2]], 0.1, ["a"]])
def test_values_are_numbers_in_one_row(numbers):
    with pytest.raises(InputError, match="values: expected numbers"):
        gearsweep.values(numbers)


def test_a_distribution_that_cannot_be_is_refused():
    with pytest.raises(InputError, match=r"uncertain\(mu\)"):
        Study.gear5("coarse").uncertain(mu=gearsweep.uniform(0.2, 0.1))
