"""Maps: what the library computes of a study, and what is said of it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

import xarray

from gearsweep._flags import flags_of
from gearsweep._progress import Watch, watched
from gearsweep._result import dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._value import path_of
from gearsweep._warning import warn

if TYPE_CHECKING:
    from gearsweep._core import Study


class Means(NamedTuple):
    """What a run computes with: texts as the command takes them."""

    journal: str
    device: str


def means_of(journal: str | os.PathLike[str] | None, device: int | str | None) -> Means:
    """The means that users gave, as `gearsweep.run` takes them; what is wrong is said at once."""
    path = "" if journal is None else path_of(journal, "a path as journal")
    return Means(path, device_text(device))


def maps_of(
    study: Study, call: str, means: Means, progress: Watch, priority: int = 0
) -> xarray.Dataset:
    """Compute the maps of a study, and warn of what failed.

    Parameters
    ----------
    study : Study of the core
        What to compute.
    call : str
        The call that asks for it, for the record.
    means : Means
        As `means_of` makes them.
    progress
        As `gearsweep.run` takes it.
    priority : int
        As `gearsweep.submit` takes it.

    Returns
    -------
    xarray.Dataset
    """
    with watched(progress) as tell:
        described, warnings = SESSION.run(
            study=study,
            device=means.device,
            journal=means.journal,
            call=call,
            progress=tell,
            priority=priority,
        )
    for warning in warnings:
        warn(warning)
    return told(described)


def told(described: Any) -> xarray.Dataset:
    """The Dataset of what the core describes; warns of the points that failed."""
    made = dataset_of(*described)
    _warn_of_failures(made.status)
    return made


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
