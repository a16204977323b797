# %% [markdown]
# # A rotor of your own that rubs
#
# You write the equations of an unbalanced rotor in a stator with clearance, check them against a closed form,
# and see where the motion with rubbing is no longer periodic.

# %%
import gearsweep as gs
import matplotlib.pyplot as plt
import numpy as np

rotor = gs.Model(
    states={"x": "v", "y": "w",
            "v": "e*omega^2*cos(phase) - 2*zeta*v - x - grip*(x - rub*y)",
            "w": "e*omega^2*sin(phase) - 2*zeta*w - y - grip*(y + rub*x) - load"},
    parameters={"omega": 0.9, "zeta": 0.05, "k": 30.0, "gap": 1.0, "mu": 0.1, "disc": 5.0, "e": 0.6, "load": 0.0},
    constants={"r": "sqrt(x^2 + y^2 + 1e-20)", "grip": "k*stop(r, gap)/r",
               "slide": "disc*omega + (x*w - y*v)/r", "rub": "mu*tanh(slide/0.2)"},
    signals={"radius": "r", "normal": "k*stop(r, gap)"},
    period="2*pi/omega",
)
print(rotor)

# %% [markdown]
# `stop(r, gap)` is `r - gap` if `r` is larger than the gap, otherwise 0. The program finds this corner, and the
# integration keeps its order there. Friction acts against `slide`, the speed of the disc's surface at the
# contact, and becomes 0 if the disc rolls. If you replace `rub` by the constant `mu`, a rotor that whirls
# backwards gains energy without end: try it.
#
# ## Is it right?
#
# The program finds the integration step by itself. Without rubbing the rotor is linear, and its deflection is
# $e\,\omega^2/\sqrt{(1-\omega^2)^2 + (2\zeta\omega)^2}$.

# %%
free = gs.Study(rotor).parameters(e=0.05).sweep(omega=(0.3, 0.8, 11)).observe("radius_max")
found = free.integrate(settle=300, record=20).run(progress=None)
omega = found.omega.values
closed = 0.05 * omega**2 / np.sqrt((1 - omega**2) ** 2 + (0.1 * omega) ** 2)
error = np.abs(found.radius_max.values / closed - 1).max()
print(f"largest difference from the closed form: {error:.1e}")
assert error < 1e-5

# %% [markdown]
# ## Where does it rub, and how?
#
# A constant load, such as the weight, makes the rotor rub for a part of each turn.

# %%
study = (
    gs.Study(rotor).parameters(load=0.5, mu=0.1)
    .sweep(omega=(0.7, 1.5, 60), e=(0.05, 0.5, 40))
    .observe("period", "normal_max")
    .integrate(settle=200, record=64)
)
maps = study.run(progress=None)
figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
for quantity, ax in zip(("period", "normal_max"), axes):
    maps.gear.plot(quantity, ax=ax)
plt.show()

# %% [markdown]
# ## One of its motions

# %%
trace = gs.trace(maps, omega=1.02, e=0.3, record=8)
trace.gear.plot("phase")
plt.show()
