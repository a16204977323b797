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


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("global 1 x-1 {x=0}", "resets"),
        ("w'=delay(x,2)", "delays"),
        ("wiener n", "noise"),
        ("y'=if(t<1)then(1)else(0)", "the time outside of a sine"),
        ("y'=sin(t)+sin(1.5*t)", "more than one product"),
        ("0=x-y", "algebraic"),
        ("nonsense", "no known kind"),
    ],
)
def test_what_a_study_has_no_place_for_is_named(tmp_path, line, what):
    assert what in imported(tmp_path, f"x'=-x\n{line}\ndone\n", status=2)
