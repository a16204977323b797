# %% [markdown]
# # From a drawing to the report
#
# You begin with the tooth numbers and the module of a gear pair, see what follows from them, and write a report
# for a colleague. A line that begins with `!` is a command of the terminal.

# %%
# !gearsweep gear new 19/61 --module 2.5 -o pair.toml
# !gearsweep gear pair.toml

# %% [markdown]
# Every number that you did not give is an estimate. The file says how each estimate was made. Open `pair.toml`,
# and replace the numbers that your drawing has.

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
# The report is one page with the worst speeds, the critical speeds, an order map and all assumptions
# ([contents](../report.md)). If you have Chromium, `-o pair.pdf` writes a PDF.

# %%
# !gearsweep report pair.toml --set axes.pinion_speed_rpm.count=40 -o pair.html
# !ls -l pair.html
