"""Basins of attraction, and the motions that they lead to.

You learn to sweep initial states: the same gear, at one speed and load, stays in contact from some
starts and hammers from others. Each motion is then traced from one of its starts.
"""

# %%
import argparse

import matplotlib.pyplot as plt
import numpy as np

import gearsweep as gs

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--out", help="write the picture here, in place of showing it")
parser.add_argument("--small", action="store_true", help="few points, for a look within seconds")
arguments, _ = parser.parse_known_args()
size = (12, 8) if arguments.small else (200, 150)

# %% Where each start ends
maps = gs.run("coarse-basins", set={"axes.x1.count": size[0], "axes.v1.count": size[1]})
motions = maps.gear.attractors
print(motions)

# %% One start of each of the two largest basins, and what becomes of it
largest = motions.number[np.argsort(-motions.share.values)][:2].values
starts = []
for number in largest:
    place = np.argwhere((maps.attractor == number).values)
    v1, x1 = place[len(place) // 2]
    starts.append({"x1": float(maps.x1[x1]), "v1": float(maps.v1[v1])})
traces = gs.trace(maps, at=starts, record=4, samples_per_period=256)

# %%
figure, axes = plt.subplot_mosaic(
    [["basins", "first"], ["basins", "second"]], figsize=(10, 6), width_ratios=(3, 2),
    layout="constrained",
)
maps.gear.plot("attractor", ax=axes["basins"])
for panel, number, start, trace in zip(("first", "second"), largest, starts, range(len(starts))):
    axes["basins"].annotate(
        f"{number}", start.values(), color="white", weight="bold", ha="center", va="center",
        bbox={"boxstyle": "circle", "facecolor": "black"},
    )
    motion = traces.isel(trace=trace)
    axes[panel].plot(motion.x1, motion.v1, color="black")
    found = motions.sel(number=number)
    axes[panel].set_title(
        f"motion {number}: period {int(found.period)}, force up to {float(found.dmf_max):.2f}"
    )
    axes[panel].set_xlabel(r"$x_1$ ($b_n$)")
    axes[panel].set_ylabel(r"$v_1$ ($b_n \varpi$)")
if arguments.out:
    figure.savefig(arguments.out, dpi=100)
else:
    plt.show()
