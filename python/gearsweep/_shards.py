"""Runs that are shared out among the workers of an executor, wherever these are."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Executor, Future, as_completed
from typing import TYPE_CHECKING, Any

from gearsweep import _core
from gearsweep._errors import InputError, RunError
from gearsweep._maps import Means, maps_of, told
from gearsweep._progress import Watch, watched
from gearsweep._session import SESSION
from gearsweep._value import shown
from gearsweep._warning import warn

if TYPE_CHECKING:
    import xarray


# So many shards for a worker: one that is slow, or lost, holds up a part of its share.
_SHARDS_OF_WORKER = 4
# Where an executor does not tell how many workers it has.
_USUAL_SHARDS = 32
_MOST_SHARDS = 100_000


def compute_shard(toml: str, shard: str, device: str, call: str) -> tuple[bytes, list[str]]:
    """Compute a shard of a study, in a worker.

    Parameters
    ----------
    toml : str
        The study.
    shard : str
        Which of how many, "2/8".
    device : str
        As the command takes it, of the worker's machine.
    call : str
        The call that asks for it, for the record.

    Returns
    -------
    (bytes, list of str)
        The shard's journal, and what was warned of.
    """
    study = _core.read_study(toml, "study", [], [])
    with tempfile.TemporaryDirectory(prefix="gearsweep-") as folder:
        path = os.path.join(folder, "shard.journal")
        warnings = SESSION.run_shard(
            study=study, device=device, journal=path, shard=shard, call=call
        )
        with open(path, "rb") as journal:
            return journal.read(), warnings


def shards_of(executor: Any, shards: int | None) -> int:
    """How many shards there are; what is wrong with the options is said at once."""
    if shards is not None and executor is None:
        raise InputError("shards: they are for an executor; give one, or leave them out")
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise InputError(
            "executor: expected a concurrent.futures.Executor, such as "
            f"ProcessPoolExecutor(mp_context=get_context('spawn')), not {shown(executor)}"
        )
    if shards is None:
        workers = getattr(executor, "_max_workers", None)
        return workers * _SHARDS_OF_WORKER if isinstance(workers, int) else _USUAL_SHARDS
    if isinstance(shards, bool) or not isinstance(shards, int) or not 1 <= shards <= _MOST_SHARDS:
        raise InputError(
            f"shards: expected a whole number from 1 to {_MOST_SHARDS}, not {shown(shards)}"
        )
    return shards


def computed(
    study: _core.Study,
    call: str,
    means: Means,
    progress: Watch,
    executor: Executor | None,
    shards: int | None,
) -> xarray.Dataset:
    """Compute a study here or, in shards, by the workers of an executor.

    Parameters
    ----------
    study : Study of the library
        What to compute.
    call : str
        The call that asks for it, for the record.
    means : Means
        For shards, the journal's path begins the names of the files that keep those that are
        finished; without one they are in a folder of their own until the maps are there. The device
        is that of each worker.
    progress
        As `gearsweep.run` takes it.
    executor : Executor or None
        Its workers import this package.
    shards : int or None
        At most so many.

    Returns
    -------
    xarray.Dataset
    """
    count = shards_of(executor, shards)
    if executor is None:
        return maps_of(study, call, means, progress)
    with watched(progress) as tell:
        return told(_maps_by_shards(study, call, means, executor, count, tell))


def _maps_by_shards(
    study: _core.Study,
    call: str,
    means: Means,
    executor: Executor,
    shards: int,
    tell: Callable[..., object] | None,
) -> Any:
    """What the core describes of the maps."""
    points = study.trajectories
    shards = max(1, min(shards, points))
    if tile := _core.tile_for_shards(study, shards):
        study = _core.read_study(study.toml, "study", [f"integrate.tile={tile}"], [])
    with tempfile.TemporaryDirectory(prefix="gearsweep-") as folder:
        begin = means.journal or os.path.join(folder, "map")
        work = _Work(study, call, means.device, begin, shards)
        work.compute(executor, points, tell)
        described = _core.merge_shards(work.paths, call)
        for path in work.paths if means.journal else []:
            os.remove(path)
    return described


class _Work:
    """The shards of a study, and the files that keep them."""

    def __init__(self, study: _core.Study, call: str, device: str, begin: str, shards: int) -> None:
        self._study = study
        self._call = call
        self._device = device
        # Shards of another study, or of another version, are others.
        key = hashlib.sha256(f"{_core.version()}\n{study.toml}".encode()).hexdigest()[:8]
        self._names = [f"{number}/{shards}" for number in range(1, shards + 1)]
        self.paths = [
            f"{begin}.{key}.shard-{number}-of-{shards}.journal"
            for number in range(1, shards + 1)
        ]

    def compute(
        self, executor: Executor, points: int, tell: Callable[..., object] | None
    ) -> None:
        """Compute the shards that are not there; RunError where some failed."""
        begin = time.monotonic()
        toml = self._study.toml
        waiting: dict[Future[tuple[bytes, list[str]]], int] = {}
        failures: list[BaseException] = []
        told: set[str] = set()
        missing = [i for i, path in enumerate(self.paths) if not os.path.exists(path)]
        done = len(self.paths) - len(missing)
        for i in missing:
            try:
                future = executor.submit(
                    compute_shard, toml, self._names[i], self._device, self._call
                )
            except RuntimeError as error:  # a pool that has lost a worker takes no more
                failures.append(error)
                break
            waiting[future] = i
        try:
            for future in as_completed(waiting):
                try:
                    journal, warnings = future.result()
                except InputError:
                    raise
                except Exception as error:  # of a worker, or of its loss
                    failures.append(error)
                    continue
                _write(self.paths[waiting[future]], journal)
                done += 1
                told.update(warnings)
                if tell is not None:
                    share = done / len(self.paths)
                    seconds = time.monotonic() - begin
                    tell(share, round(share * points), points, seconds)
        finally:
            for future in waiting:
                with contextlib.suppress(NotImplementedError):  # Parsl's cannot
                    future.cancel()
        for warning in sorted(told):
            warn(warning)
        if failures:
            self._fail(failures)

    def _fail(self, failures: list[BaseException]) -> None:
        missing = sum(not os.path.exists(path) for path in self.paths)
        raise RunError(
            f"{missing} of {len(self.paths)} shards are not there: {failures[0]} "
            f"({type(failures[0]).__name__}). The same call with a journal keeps what is finished "
            "and computes the others alone"
        ) from failures[0]


def _write(path: str, content: bytes) -> None:
    """A file that is there whole or not at all."""
    part = f"{path}.part"
    with open(part, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)
