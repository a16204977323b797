# %% [markdown]
# # A figure for a thesis
#
# You sweep a gear pair over its mesh frequency, see two quantities above each other, and write a figure that
# has the size of a column and the letters of the text. It takes a minute.

# %%
import gearsweep as gs
import matplotlib.pyplot as plt
import numpy as np

plt.rcParams.update({"font.size": 9, "font.family": "serif"})

# %% [markdown]
# ## The gear, and what to ask of it
#
# `coarse` is a preset of the built-in model. `poincare` keeps the state once in each mesh period, and
# `lyapunov_max` tells whether neighbouring motions part: above zero, the motion is chaotic.

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
# Two axes share the mesh frequency. `gear.plot` draws what the command `gearsweep plot` draws, on axes of
# yours, so all that matplotlib has is at hand.

# %%
figure, (above, below) = plt.subplots(2, 1, figsize=(3.5, 4.0), sharex=True, layout="constrained")
maps.gear.plot("poincare", ax=above, title="")
maps.gear.plot("lyapunov_max", ax=below, title="")
above.set_xlabel("")
below.axhline(0.0, color="black", linewidth=0.5)
figure.savefig("thesis.pdf")
plt.show()

# %% [markdown]
# ## What to write below it
#
# The numbers of the caption come from the result, not from the eye. The file keeps the study, so the figure
# can be computed again: `gearsweep run thesis.nc`.

# %%
chaotic = (maps.lyapunov_max > 0.01).mean().item()
worst = float(maps.omega[int(maps.dmf_max.argmax())])
print(f"chaotic at {chaotic:.0%} of the frequencies; the largest force at omega = {worst:.3f}")
assert np.isfinite(maps.dmf_max).all()
maps.to_netcdf("thesis.nc")
