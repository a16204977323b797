"""How far a run is, and the bar that shows it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any, NamedTuple

from gearsweep._errors import InputError

# A run that ends sooner needs no bar.
_SECONDS_BEFORE_THE_BAR = 0.5


class Progress(NamedTuple):
    """How far a run is: share of the work from 0 to 1, points, and seconds since it began."""

    share: float
    points_done: int
    points: int
    seconds: float


# What a run takes as its `progress`.
Watch = bool | Callable[[Progress], object] | None


@contextmanager
def watched(progress: Watch) -> Iterator[Callable[..., object] | None]:
    """What the core tells of its progress; a bar ends with the block.

    Parameters
    ----------
    progress : bool, callable or None
        As `gearsweep.run` takes it.

    Yields
    ------
    callable or None
        Takes the fields of a `Progress`.
    """
    if progress is None or progress is False:
        yield None
    elif progress is True:
        with _bar() as show:
            yield show
    elif callable(progress):
        tell = progress
        yield lambda *news: tell(Progress(*news))
    else:
        raise InputError(
            "progress: expected True (a bar), None (nothing) or a function that takes a Progress, "
            f"not {progress!r}"
        )


@contextmanager
def _bar() -> Iterator[Callable[..., object] | None]:
    """A bar of tqdm, where that is installed and somebody looks."""
    tqdm = _tqdm() if _has_reader() else None
    if tqdm is None:
        yield None
        return
    with ExitStack() as at_end:
        bar: Any = None

        def show(share: float, points_done: int, points: int, seconds: float) -> None:
            nonlocal bar
            if bar is None:
                bar = at_end.enter_context(
                    tqdm(total=points, unit=" points", delay=_SECONDS_BEFORE_THE_BAR, leave=False)
                )
            # By the share of the work: points end in bunches.
            bar.update(round(share * points) - bar.n)

        yield show


def _tqdm() -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm


def _has_reader() -> bool:
    """Whether stderr is a terminal, or this is a notebook."""
    stderr_is_terminal = sys.stderr is not None and sys.stderr.isatty()
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return stderr_is_terminal or hasattr(shell, "kernel")
