"""Runs: from whatever stands for a study to its maps, now or in the background."""

from __future__ import annotations

import os
from collections.abc import Mapping
from concurrent.futures import Executor, Future
from threading import Thread
from typing import Any

import xarray

from gearsweep._errors import InputError
from gearsweep._maps import maps_of, means_of
from gearsweep._named import options_by_name
from gearsweep._progress import Progress, Watch
from gearsweep._shards import computed
from gearsweep._study import Study
from gearsweep._study_source import study_of
from gearsweep._value import shown

# No number of a priority is larger.
_FAR = 1 << 30


@options_by_name
def run(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    set: Mapping[str, Any] | None = None,
    points: Any = None,
    progress: Watch = True,
    journal: str | os.PathLike[str] | None = None,
    device: int | str | None = None,
    executor: Executor | None = None,
    shards: int | None = None,
) -> xarray.Dataset:
    """Compute the maps of a study.

    Parameters
    ----------
    study : str, path, Study or Dataset
        The name of a built-in study, a path of a study or a result, TOML, a `Study`, or the
        Dataset of an earlier run.
    set : mapping of str to object, optional
        Changes of the study, such as ``{"parameters.mu": 0, "axes.omega.count": 100}``.
    points : mapping of str to array_like, or DataFrame, optional
        Points that lie on no grid, in place of the study's axes: see `Study.points`. The maps have
        the dimension ``point`` and the columns as coordinates.
    progress : bool, callable or None, optional
        True, the default: a bar in terminals and notebooks where tqdm is installed. None or False:
        nothing. A function is called with a `Progress` now and then, by the thread that called
        `run`; what it raises stops the run.
    journal : path, optional
        Where finished parts are kept until all are there. A run with the same study and journal
        goes on where an interrupted one ended.
    device : int or str, optional
        A number of `devices`, or several as in the command: ``"0,1"``, ``"all"``.
    executor : concurrent.futures.Executor, optional
        Whose workers compute the study, in shards: a pool of processes (not forked), Dask's
        ``client.get_executor()``, mpi4py's, ipyparallel's, Parsl's. They need no common disk. With
        a journal, a shard that a worker has finished is kept, and the same call computes the others
        alone.
    shards : int, optional
        How many there are, for an executor; four a worker, or 32, unless given.

    Returns
    -------
    xarray.Dataset
        What ``xarray.open_dataset`` makes of the file that ``gearsweep run`` writes. A quantity has
        one dimension for each axis, the first axis last; its unit is its attribute ``units``.

    Raises
    ------
    InputError
        The study or an option is wrong.
    RunError
        A device, a disk or a worker failed.
    KeyboardInterrupt
        After Ctrl-C, once the running round is over. A journal keeps what is finished.

    Warns
    -----
    RuntimeWarning
        Some points failed; the message says how many.

    Examples
    --------
    >>> study = Study.of("duffing").sweep(omega=(0.5, 1.5, 3)).observe("x_rms")
    >>> maps = run(study.integrate(settle=20, record=10))
    >>> dict(maps.x_rms.sizes)
    {'omega': 3}
    """
    asked, call = _asked("run", study, set, points)
    return computed(asked._core, call, means_of(journal, device), progress, executor, shards)


class Running(Future[xarray.Dataset]):
    """A run in the background, as `submit` begins it.

    It is a `concurrent.futures.Future`: `result()` waits for the maps, `done()` tells whether they
    are there, `cancel()` stops the run when its round is over, and `concurrent.futures.wait`,
    `as_completed` and `asyncio.wrap_future` take it.
    """

    progress: Progress | None = None
    """How far it is; None before the first news."""

    def running(self) -> bool:
        """Whether it neither ended nor was cancelled."""
        return not self.done()


class _Cancelled(Exception):
    """Raised by the progress function of a run that nobody waits for any more."""


@options_by_name
def submit(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    set: Mapping[str, Any] | None = None,
    points: Any = None,
    journal: str | os.PathLike[str] | None = None,
    device: int | str | None = None,
    priority: int = 0,
) -> Running:
    """Begin to compute the maps of a study, in the background.

    Parameters
    ----------
    study, set, points, journal, device
        As `run` takes them.
    priority : int, optional
        Of the runs that are there, those of the highest priority compute; the others wait between
        two of their rounds. That of `run` is 0.

    Returns
    -------
    Running
        A `concurrent.futures.Future` of the Dataset that `run` returns.

    Raises
    ------
    InputError
        The study or an option is wrong. What fails later, `result()` raises.

    Examples
    --------
    >>> study = Study.of("duffing").sweep(omega=(0.5, 1.5, 3)).observe("x_rms")
    >>> running = submit(study.integrate(settle=20, record=10), priority=-1)
    >>> dict(running.result().x_rms.sizes)
    {'omega': 3}
    """
    asked, call = _asked("submit", study, set, points)
    if isinstance(priority, bool) or not isinstance(priority, int) or abs(priority) > _FAR:
        raise InputError(f"priority: expected a whole number such as -1, not {shown(priority)}")
    means = means_of(journal, device)
    running = Running()

    def tell(news: Progress) -> None:
        running.progress = news
        if running.cancelled():
            raise _Cancelled

    def compute() -> None:
        try:
            made = maps_of(asked._core, call, means, tell, priority)
        except BaseException as error:
            if running.set_running_or_notify_cancel():
                running.set_exception(error)
        else:
            if running.set_running_or_notify_cancel():
                running.set_result(made)

    Thread(target=compute, name="gearsweep.submit", daemon=True).start()
    return running


def _asked(
    function: str, study: Any, changes: Mapping[str, Any] | None, points: Any
) -> tuple[Study, str]:
    """The study that is asked for, and the call in words."""
    asked = study_of(study, changes)
    if points is not None and not isinstance(study, Study):
        # Who gives a Study has chosen its axes, and is warned that they go.
        asked = asked.set({"axes": []})
    return asked._asked(function, study, changes, points)
