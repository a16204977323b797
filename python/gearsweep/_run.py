"""Runs: from a study to its maps."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import xarray

from gearsweep._flags import flags_of
from gearsweep._progress import Watch, watched
from gearsweep._result import call_text, dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._study import Study
from gearsweep._study_source import study_of
from gearsweep._value import path_of
from gearsweep._warning import warn


def run(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    set: Mapping[str, Any] | None = None,
    points: Any = None,
    progress: Watch = True,
    journal: str | os.PathLike[str] | None = None,
    device: int | str | None = None,
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
        A device or a disk failed.
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
    asked = study_of(study, set)
    if points is not None:
        # Who gives a Study has chosen its axes, and is warned that they go.
        own = isinstance(study, Study)
        asked = (asked if own else asked.set({"axes": []})).points(points)
    with watched(progress) as tell:
        described, troubles = SESSION.run(
            study=asked._core,
            device=device_text(device),
            journal="" if journal is None else path_of(journal, "a path as journal"),
            call=call_text("run", study, set=set, points=_shown(points)),
            progress=tell,
        )
    for trouble in troubles:
        warn(trouble)
    made = dataset_of(*described)
    _warn_of_failures(made.status)
    return made


def _shown(points: Any) -> str | None:
    """What the record of the call says of points, whose numbers the result has."""
    return None if points is None else f"columns {', '.join(map(str, points))}"


def _warn_of_failures(status: xarray.DataArray) -> None:
    points = status.size
    counts = {name: int((status.values == code).sum()) for code, name in flags_of(status).items()}
    if unstable := counts.pop("unstable_start", 0):
        warn(
            f"unstable_start at {unstable} of {points} points: "
            "they show an unstable equilibrium, or what rounding makes of it"
        )
    counts.pop("ok")
    failures = [f"{name} at {count} of {points} points" for name, count in counts.items() if count]
    said = ", ".join(failures)
    if not failures:
        return
    if sum(counts.values()) == points:
        warn(f"every point failed; the maps are empty ({said})")
    else:
        warn(f"{said}: these have no values, and 'status' tells which they are")
