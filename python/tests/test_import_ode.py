"""The example that opens files of XPPAUT."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy
import pytest
from scipy.integrate import solve_ivp

import gearsweep

IMPORT = Path(__file__).parent.parent / "examples" / "import_ode.py"
# Abbreviated words, capitals, an array, a sum, a branch, numbers without a zero, a line that goes on.
CHAIN = r"""
# three driven oscillators
par W=2, Phase=.5,k=1.,i=0.5
number c=.25
init x1=.2 x2=-.1
x[1..3]'=v[j]
v[1..3]'=-C*v[j] - spring(x[j]) + Phase*sin(w*t + [j]) \
  - k*(x[j] - mid)
mid = sum(1,3)of(2*i*i'*x2)/6
spring(u)=if(u>0)then(u+ .5*u**3)else(2.*u)
aux energy=.5*(v1^2+v2^2)
aux k=2*x1
@ total=40, xp=x1
done
this is not read
"""


def imported(folder: Path, text: str, status: int = 0) -> str:
    (folder / "chain.ode").write_text(text)
    done = subprocess.run(
        [sys.executable, IMPORT, folder / "chain.ode"], capture_output=True, text=True, check=False
    )
    assert done.returncode == status, done.stderr
    return done.stdout if status == 0 else done.stderr


def test_its_motion_is_that_of_the_equations(tmp_path):
    (tmp_path / "chain.toml").write_text(imported(tmp_path, CHAIN))
    model = gearsweep.Model.read(tmp_path / "chain.toml")
    study = gearsweep.Study.of(model).sweep(w=[2.0]).integrate(steps_per_period=400)
    trace = gearsweep.trace(study, w=2.0, settle=0, record=3, samples_per_period=4)

    def slope(t: float, state: numpy.ndarray) -> list[float]:
        x, v = state[:3], state[3:]
        spring = numpy.where(x > 0, x + 0.5 * x**3, 2 * x)
        push = 0.5 * numpy.sin(2 * t + numpy.arange(1, 4))
        return [*v, *(-0.25 * v - spring + push - (x - x[1]))]

    times = trace.tau.values
    exact = solve_ivp(slope, (0, times[-1]), [0.2, -0.1, 0, 0, 0, 0], "DOP853", times, rtol=1e-11, atol=1e-12)
    for i, name in enumerate(("x1", "x2", "x3", "v1", "v2", "v3")):
        numpy.testing.assert_allclose(trace[name], exact.y[i], atol=1e-7)  # steps of a 400th leave 1e-8
    numpy.testing.assert_allclose(trace.k_aux, 2 * trace.x1)
    numpy.testing.assert_allclose(trace.energy, 0.5 * (exact.y[3] ** 2 + exact.y[4] ** 2), atol=1e-7)


# A neuron that falls back and adapts: values of an event are worked out one after the other, and 'last' is
# what it was before. Another event, downwards, lifts the slow state; one does no more than write a line.
NEURON = """
par i=1.5,a=.2
v'=i-v-w+a*cos(s)
w'=-w/5
s'=-.3*s
last=w+.1
global 1 {v-1} {v=-w;w=.3+w-v;w=w+.1*last}
glob -1 s-p {s=s+.9; out_put=1}
global +1 {w-p} {out_put=1;}
init s=3,w=.1
par p=1
done
"""


def test_what_happens_at_an_event_is_a_surface(tmp_path):
    text = imported(tmp_path, NEURON)
    assert 'when = "-(s-p)"\nreset = { s = "s+0.9" }' in text
    assert "forcing" not in text and "event_3" not in text
    (tmp_path / "chain.toml").write_text(text)
    study = gearsweep.Study.of(gearsweep.Model.read(tmp_path / "chain.toml")).sweep(i=[1.5])
    trace = gearsweep.trace(study.integrate(max_step=0.01), i=1.5, settle=0, record=5)

    def slope(t: float, state: numpy.ndarray) -> list[float]:
        v, w, s = state
        return [1.5 - v - w + 0.2 * numpy.cos(s), -w / 5, -0.3 * s]

    def fires(t: float, state: numpy.ndarray) -> float:
        return state[0] - 1

    def is_low(t: float, state: numpy.ndarray) -> float:
        return state[2] - 1

    fires.terminal = is_low.terminal = True
    fires.direction, is_low.direction = 1, -1
    begin, state, counts = 0.0, numpy.array([0, 0.1, 3]), [0, 0]
    times = trace.tau.values[trace.tau.values < 20]
    assert times[-1] > 19
    exact = numpy.empty((3, times.size))
    while True:
        flight = solve_ivp(
            slope,
            (begin, 20),
            state,
            "DOP853",
            dense_output=True,
            events=(fires, is_low),
            rtol=1e-11,
            atol=1e-12,
        )
        later = times >= begin
        exact[:, later] = flight.sol(times[later])
        if flight.status != 1:
            break
        begin, (v, w, s) = flight.t[-1], flight.y[:, -1]
        fired = len(flight.t_events[0])
        counts[0 if fired else 1] += 1
        state = numpy.array([-w, 0.3 + w + w + 0.1 * (w + 0.1), s] if fired else [v, w, s + 0.9])
    assert counts[0] > 4 and counts[1] > 2
    between = trace.at_surface.values[: times.size] == 0  # an event has both sides
    for i, name in enumerate("vws"):
        values = trace[name].values[: times.size]
        numpy.testing.assert_allclose(values[between], exact[i][between], atol=1e-7)


def test_it_warns_of_what_is_left_out(tmp_path):
    events = "global 1 {x-1} {x=0;y=y+.1;no_interp=1}\nglobal 1 {y-1} {y=0}\n"
    (tmp_path / "pair.ode").write_text(f"x'=1\ny'=1\n{events}")
    done = subprocess.run(
        [sys.executable, IMPORT, tmp_path / "pair.ode"], capture_output=True, text=True, check=True
    )
    assert "left out is an event at the end of its step (no_interp): global 1 {x-1}" in done.stderr


def test_a_file_whose_equations_have_no_time_has_no_forcing(tmp_path):
    text = imported(tmp_path, "x'=y\ny'=-k*x\npar k=1\nperiod=2\naux e=x^2+y^2+period\ninit x=1\ndone\n")
    assert "forcing" not in text and "phase" not in text
    (tmp_path / "chain.toml").write_text(text)
    study = gearsweep.Study.of(gearsweep.Model.read(tmp_path / "chain.toml")).sweep(k=[1.0])
    trace = gearsweep.trace(study.integrate(max_step=0.01), k=1.0, settle=0, record=2)
    numpy.testing.assert_allclose(trace.x, numpy.cos(trace.tau), atol=1e-8)
    assert "no_parameters = " in imported(tmp_path, "x'=-x\ndone\n")


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("global 1 x-1 {p=0}\npar p=1", "resets of parameters: global 1 x-1 {p=0}"),
        ("global 1 {x-1} {q=0}\nq=x+1", "resets of 'q', which is no state: global 1"),
        ("global 0 {x-1} {x=0}", "an event of sign 0; write one of sign 1 and one of sign -1: global 0"),
        ("global 1 x-1 {arret=1}", "the end of a motion at an event: global"),
        ("global 1 {sin(t)} {x=0}", "an event that waits for no state: global"),
        ("global 1 {x-t} {x=0}", "the time outside of a sine or cosine: x-t"),
        ("global 2 {x-1} {x=0}", "no known kind: global 2"),
        ("global 1 {x-1} {x=0;y=f(1)}\ny'=1\nf(u)=u*x", "just been reset: global"),
        ("w'=delay(x,2)", "delays"),
        ("wiener n", "noise"),
        ("y'=if(t<1)then(1)else(0)", "the time outside of a sine"),
        ("y'=sin(t)+sin(1.5*t)", "more than one product"),
        ("y'=sin(w^2*t)\npar w=2", "another product than 'w*t': sin(w^2*t)"),
        ("y'=sin(x*w*t)\npar w=2", "another product than 'w*t'"),
        ("0=x-y", "algebraic"),
        ("nonsense", "no known kind"),
    ],
)
def test_what_a_study_has_no_place_for_is_named(tmp_path, line, what):
    assert what in imported(tmp_path, f"x'=-x\n{line}\ndone\n", status=2)
