# %% [markdown]
# # A study on a cluster
#
# You distribute a study over workers, lose a worker, and still get the same bits as from one run. The workers
# here are processes of this machine. On a cluster give `executor=client.get_executor()` of Dask instead.

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
# The points are divided into `shards` parts. A worker computes one shard at a time. With `journal` finished
# shards are kept. Here we kill a worker while it computes, as a cluster does when it takes a node away.

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
# The same call again computes only the missing shards.

# %%
with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
    maps = gs.run(study, executor=pool, shards=16, journal="map", progress=None)
assert all((maps[name].values == whole[name].values).all() for name in ("x_rms", "period"))
print("the same bits as of one run")

# %% [markdown]
# ## Without Python on the nodes
#
# `gearsweep slurm` prints a job array for Slurm. A preempted job is put back into the queue, and continues.

# %%
# !gearsweep slurm coarse-map --jobs 4 -o map.nc | head -n 30
