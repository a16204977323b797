"""Ten uncertain parameters: how large the meshing force gets, and which of them matter.

You learn to compute points that lie on no grid: 20,000 gear pairs, each with parameters of its own,
go through `points` in one run. Rank correlation then tells which parameters the force follows.
"""

# %%
import argparse

import matplotlib.pyplot as plt
import numpy as np
from scipy import stats

import gearsweep as gs

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--out", help="write the picture here, in place of showing it")
parser.add_argument("--small", action="store_true", help="few points, for a look within seconds")
arguments, _ = parser.parse_known_args()
count = 200 if arguments.small else 20_000

# %% What is known of each parameter: its median, and how far it scatters (a standard deviation)
known = {
    "b": (1.0, 0.15, "half backlash"),
    "F1": (0.1, 0.2, "load"),
    "e0": (0.4, 0.2, "transmission error"),
    "mu": (0.05, 0.3, "friction of the teeth"),
    "zeta": (0.04, 0.3, "damping of the mesh"),
    "m1": (0.35, 0.1, "1 / mass of the pinion"),
    "m2": (0.35, 0.1, "1 / mass of the gear"),
    "k2": (1.4, 0.2, "bearing of the pinion"),
    "k4": (1.4, 0.2, "bearing of the gear"),
    "q": (0.35, 0.2, "shape of the mesh stiffness"),
}
random = np.random.default_rng(1)
points = {
    name: median * np.exp(scatter * random.normal(size=count))
    for name, (median, scatter, _) in known.items()
}

# %% One run for all points, at one mesh frequency
study = gs.Study.gear5(preset="coarse", omega=0.65).observe("dmf_max", "contact_class")
maps = gs.run(study.integrate(settle=200, record=50), points=points)
force = maps.dmf_max
high = float(force.quantile(0.95))
median = float(force.median())
print(f"largest meshing force [{force.units}]: median {median:.3f}, 95 % below {high:.3f}")

# %% Which parameters the force follows
ranks = {name: stats.spearmanr(values, force).correlation for name, values in points.items()}
for name in sorted(ranks, key=lambda name: -abs(ranks[name])):
    print(f"{name:5} {ranks[name]:+.2f}  {known[name][2]}")

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
bins = np.linspace(float(force.min()), float(force.quantile(0.999)), 80)
# The class has its names in an attribute, as the conventions of NetCDF want them.
kinds = maps.contact_class.attrs["flag_meanings"].split()
for code, kind in enumerate(kinds):
    chosen = force.where(maps.contact_class == code, drop=True)
    if chosen.size:
        left.hist(chosen, bins, alpha=0.7, label=f"{kind.replace('_', ' ')}: {chosen.size}")
left.axvline(high, color="black", linestyle="--", label="95 % lie below")
left.set_title("How large the force gets")
right.set_title("Which parameters it follows")
left.set_xlabel(r"largest meshing force ($k_0 b_n$)")
left.set_ylabel(f"gear pairs, of {count}")
left.legend(title="impacts", loc="center right")
order = sorted(ranks, key=lambda name: abs(ranks[name]))
labels = [f"{known[name][2]}  {name}" for name in order]
right.barh(labels, [ranks[name] for name in order])
right.axvline(0, color="black", linewidth=0.8)
right.set_xlabel("rank correlation with the largest force")
if arguments.out:
    figure.savefig(arguments.out, dpi=100)
else:
    plt.show()
