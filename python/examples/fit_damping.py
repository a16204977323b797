"""Fit a damping ratio to a measured curve of the meshing force.

You learn to call a sweep from an optimiser: each trial of `scipy.optimize` is one run of a few
milliseconds. The measurement is made here, so that the right answer is known: scipy's `solve_ivp`
integrates the same gear, written out below in Python, and noise is added. No number of it comes
from gearsweep.
"""

# %%
import argparse
import time

import matplotlib.pyplot as plt
import numpy as np
from scipy import integrate, optimize

import gearsweep as gs

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--out", help="write the picture here, in place of showing it")
parser.add_argument("--small", action="store_true", help="few points, for a look within seconds")
arguments, _ = parser.parse_known_args()
readings = 8 if arguments.small else 32

# %% The gear on the test rig: one degree of freedom, half a backlash of 1, damping ratio 0.05
TRUE_DAMPING = 0.05
LOAD, ERROR, FALL = 0.1, np.array([0.01, 0.004, 0.002]), np.array([0.2, 0.1, 0.05])
ORDERS = np.array([1, 2, 3])


def mesh_force(x, phase):
    stiffness = 1 - FALL @ np.cos(np.multiply.outer(ORDERS, phase))
    return stiffness * (np.maximum(x - 1, 0) + np.minimum(x + 1, 0))


def measure(omega, periods=60, recorded=10):
    """The largest meshing forces of the last periods: one gear for each frequency."""

    def motion(phase, state):
        x, v = state.reshape(2, -1)
        excited = LOAD + omega**2 * (ERROR @ (ORDERS**2 * np.cos(ORDERS * phase)))
        pushed = excited - 2 * TRUE_DAMPING * v - mesh_force(x, phase)
        return np.concatenate([v / omega, pushed / omega])

    start = np.repeat([1 + LOAD, 0], omega.size)
    end = 2 * np.pi * periods
    phases = np.linspace(2 * np.pi * (periods - recorded), end, 200 * recorded)
    found = integrate.solve_ivp(motion, (0, end), start, t_eval=phases, rtol=1e-7, atol=1e-9)
    return mesh_force(found.y[: omega.size], phases).max(axis=1)


random = np.random.default_rng(1)
noise = 0.003
omega = np.linspace(0.3, 1.3, readings)
measured = measure(omega) + noise * random.normal(size=readings)

# %% The same curve by gearsweep, for any damping ratio
study = gs.Study.of("gear1").observe("dmf_max").integrate(settle=100, record=10)
calls = []


def curve(at, damping):
    started = time.perf_counter()
    maps = study.parameters(z=damping).sweep(omega=at).run(progress=None)
    calls.append(time.perf_counter() - started)
    return maps.dmf_max.values


# %% The fit. The curve jumps, so its slope is taken over steps of one per cent
guess = 0.1
(damping,), ((variance,),) = optimize.curve_fit(
    curve, omega, measured, p0=guess, bounds=(0.005, 0.5), diff_step=0.01,
    sigma=np.full(readings, noise), absolute_sigma=True,
)
error = np.sqrt(variance)
print(f"damping {damping:.4f} +- {error:.4f}; it is {TRUE_DAMPING}")
print(f"{len(calls)} runs, each {1e3 * np.median(calls):.1f} ms")
assert abs(damping - TRUE_DAMPING) < 4 * error

# %%
figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
fine = np.linspace(omega[0], omega[-1], 400)
axes.plot(omega, measured, "ko", markersize=4, label="measured")
axes.plot(fine, curve(fine, guess), "--", color="grey", label=f"first guess: damping ratio {guess}")
axes.plot(fine, curve(fine, damping), label=f"fit: damping ratio {damping:.4f} ± {error:.4f}")
axes.set_xlabel(r"mesh frequency $\omega/\varpi$")
axes.set_ylabel(r"largest meshing force ($k_0 b_n$)")
axes.set_title(f"A gear with the damping ratio {TRUE_DAMPING}, found again from noisy readings")
axes.legend()
if arguments.out:
    figure.savefig(arguments.out, dpi=100)
else:
    plt.show()
