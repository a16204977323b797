# %% [markdown]
# # A study on a cluster
#
# You share a study out among workers, lose some of them, and get the same bits as from one run. The workers
# here are processes of this machine; `executor=client.get_executor()` of Dask takes their place on a cluster.

# %%
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
import os
import signal

import gearsweep as gs

study = (
    gs.Study.of("duffing")
    .sweep(omega=(0.5, 1.5, 40), amplitude=(0.2, 0.4, 20))
    .observe("x_rms", "period")
)
whole = study.run(progress=None)

# %% [markdown]
# ## Shards
#
# Each of `shards` is a part of the points that one worker computes by itself. With `journal` what is finished
# is kept. Here a worker is killed while it computes, as by a cluster that takes its node away.

# %%
killed = []


def kill_one(news):
    if not killed:
        killed.extend(list(pool._processes)[:1])
        os.kill(killed[0], signal.SIGKILL)


pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
try:
    with pool:
        gs.run(study, executor=pool, shards=16, journal="map", progress=kill_one)
except gs.RunError as error:
    print(error)

# %% [markdown]
# The same call computes the missing shards alone.

# %%
with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
    maps = gs.run(study, executor=pool, shards=16, journal="map", progress=None)
assert all((maps[name].values == whole[name].values).all() for name in ("x_rms", "period"))
print("the same bits as of one run")

# %% [markdown]
# ## Without Python on the nodes
#
# `gearsweep slurm` prints a job array for Slurm. A job that is preempted goes on when it is requeued.

# %%
# !gearsweep slurm coarse-map --jobs 4 -o map.nc | head -n 30
