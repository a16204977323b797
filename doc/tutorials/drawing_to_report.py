# %% [markdown]
# # From a drawing to the report
#
# You begin with the numbers of teeth and the module of a gear pair, see what follows from them, and make the
# page that goes to a colleague. A line that begins with `!` is a command of the terminal.

# %%
# !gearsweep gear new 19/61 --module 2.5 -o pair.toml
# !gearsweep gear pair.toml

# %% [markdown]
# Every number that you did not give is an estimate, and the file says at each how it came about. Open
# `pair.toml`, and replace what your drawing has.

# %%
import gearsweep as gs

study = gs.Study.read("pair.toml").set({"axes.pinion_speed_rpm.count": 60})
maps = study.run(progress=None)
si = maps.gear.si()
si

# %% [markdown]
# ## The worst speed
#
# `gear.si()` gives speeds in rpm and forces in N.

# %%
import matplotlib.pyplot as plt

print(list(maps.data_vars))
maps.gear.plot("dmf_max")
worst = float(si.pinion_speed_rpm[int(si.dmf_max.argmax())])
print(f"the largest mesh force is at {worst:.0f} rpm")
plt.show()

# %% [markdown]
# ## The report
#
# One page with the worst speeds, the critical ones, an order map and all that was assumed
# ([what it has](../report.md)). `-o pair.pdf` prints it, where Chromium is.

# %%
# !gearsweep report pair.toml --set axes.pinion_speed_rpm.count=40 -o pair.html
# !ls -l pair.html
