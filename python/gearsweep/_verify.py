"""Whether this machine and its OpenCL driver compute right numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from gearsweep._errors import InputError
from gearsweep._session import SESSION, device_text


class Check(NamedTuple):
    """A check that was carried out: numbers compared, how many of them are wrong, and how.

    `verdict` is ``"pass"``, ``"FAIL"`` or ``"skipped"``; `figures` tells the number that comes
    nearest its limit, or why the check was skipped.
    """

    name: str
    what: str
    verdict: str
    seconds: float
    numbers: int
    failed: int
    figures: str

    def __str__(self) -> str:
        return f"{self.verdict:<7}  {self.name:<23} {self.seconds:4.1f} s  {self.figures}"


class Verification(NamedTuple):
    """All checks of a device; prints as a table."""

    device: str
    checks: tuple[Check, ...]

    @property
    def passed(self) -> bool:
        """Whether no check has failed."""
        return all(check.verdict != "FAIL" for check in self.checks)

    def __repr__(self) -> str:
        return "\n".join([self.device, *map(str, self.checks)])

    def __str__(self) -> str:
        return repr(self)


def verify(
    device: int | str | None = None, *, progress: Callable[[Check], object] | None = None
) -> Verification:
    """Check that a device computes right numbers, as ``gearsweep verify`` does.

    Takes less than a minute. The answers come from elsewhere: closed forms, published numbers, an
    outside integration, the host's own arithmetic, the reference engine.

    Parameters
    ----------
    device : int or str, optional
        A number of `devices`.
    progress : callable, optional
        Called with each `Check` when it has been carried out, by the thread that called
        `verify`. What it raises stops the rest.

    Returns
    -------
    Verification
        ``verify().passed`` tells whether all is well. A check that fails raises nothing.

    Raises
    ------
    InputError
        There is no such device.
    KeyboardInterrupt
        After Ctrl-C, once the running round is over.

    Examples
    --------
    >>> import gearsweep as gs
    >>> gs.verify().passed
    True
    """
    if progress is not None and not callable(progress):
        raise InputError("progress: expected a function that takes a Check")
    tell = None if progress is None else lambda row: progress(Check(*row))
    title, rows = SESSION.verify(device=device_text(device), tell=tell)
    return Verification(title, tuple(Check(*row) for row in rows))
