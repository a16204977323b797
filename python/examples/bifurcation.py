"""A bifurcation diagram above its Lyapunov exponents.

You learn to sweep one parameter of the geared pair and to see twice where its motion is chaotic: in
the samples of the motion, and in the largest Lyapunov exponent. Both come from one run.
"""

# %%
import argparse

import matplotlib.pyplot as plt

import gearsweep as gs

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--out", help="write the picture here, in place of showing it")
parser.add_argument("--small", action="store_true", help="few points, for a look within seconds")
arguments, _ = parser.parse_known_args()
values = 40 if arguments.small else 800

# %% One run: samples of x1 when each mesh period begins, and the exponent
study = (
    gs.Study.gear5(preset="coarse")
    .sweep(omega=(0.4, 2.0, values))
    .observe("lyapunov_max", poincare=["x1"])
    .integrate(settle=400, record=100)
)
maps = study.run()
chaotic = maps.lyapunov_max > 0.003
print(f"chaotic at {float(chaotic.mean()):.0%} of {values} frequencies")

# %% Two pictures over one axis
figure, (above, below) = plt.subplots(
    2, 1, sharex=True, figsize=(8, 6), height_ratios=(2, 1), layout="constrained"
)
maps.gear.plot("poincare", ax=above, title="")
maps.gear.plot("lyapunov_max", ax=below, title="")
above.set_title(r"Coarse gear pair: $x_1$ at each mesh period, and the largest Lyapunov exponent")
above.set_xlabel("")
below.set_ylabel(r"Lyapunov exponent ($1/\tau$)")
below.axhline(0, color="black", linewidth=0.8)
figure.align_ylabels()

# %%
if arguments.out:
    figure.savefig(arguments.out, dpi=100)
else:
    plt.show()
