# %% [markdown]
# # A figure for a thesis
#
# You sweep a gear pair over its mesh frequency, draw two quantities one above the other, and write a figure
# with the width of a column and the font of the text. It takes a minute.

# %%
import gearsweep as gs
import matplotlib.pyplot as plt
import numpy as np

plt.rcParams.update({"font.size": 9, "font.family": "serif"})

# %% [markdown]
# ## The gear, and what to ask of it
#
# `coarse` is a preset of the built-in model. `poincare` keeps the state once in each mesh period.
# `lyapunov_max` is the rate at which neighbouring motions separate. If it is above 0, the motion is chaotic.

# %%
study = (
    gs.Study.gear5(preset="coarse")
    .sweep(omega=(0.4, 2.0, 400))
    .observe("poincare", "lyapunov_max", "dmf_max", poincare=["x1"])
    .integrate(settle=200, record=60)
)
maps = study.run(progress=None)
maps

# %% [markdown]
# ## The figure
#
# Two panels share the axis of the mesh frequency. `gear.plot` draws the same pictures as the command
# `gearsweep plot`, but on matplotlib axes of yours. So you can change them by all means of matplotlib.

# %%
figure, (above, below) = plt.subplots(2, 1, figsize=(3.5, 4.0), sharex=True, layout="constrained")
maps.gear.plot("poincare", ax=above, title="")
maps.gear.plot("lyapunov_max", ax=below, title="")
above.set_xlabel("")
below.axhline(0.0, color="black", linewidth=0.5)
figure.savefig("thesis.pdf")
plt.show()

# %% [markdown]
# ## The numbers for the caption
#
# Take the numbers of the caption from the result, not from the picture. The file contains the study, so you can
# compute the figure again: `gearsweep run thesis.nc`.

# %%
chaotic = (maps.lyapunov_max > 0.01).mean().item()
worst = float(maps.omega[int(maps.dmf_max.argmax())])
print(f"chaotic at {chaotic:.0%} of the frequencies; the largest force at omega = {worst:.3f}")
assert np.isfinite(maps.dmf_max).all()
maps.to_netcdf("thesis.nc")
