"""The devices that this process has opened, and what they are."""

from __future__ import annotations

from typing import NamedTuple

from gearsweep import _core

# Devices stay open with the kernels that were built for them, so that the next run starts at once.
SESSION = _core.Session()


class Device(NamedTuple):
    """An OpenCL device of this machine; `number` is what `run` takes as its `device`."""

    number: int
    name: str
    platform: str
    driver: str
    kind: str
    compute_units: int
    fp64: bool


def devices() -> list[Device]:
    """The OpenCL devices of this machine.

    Returns
    -------
    list of Device

    Examples
    --------
    >>> import gearsweep as gs
    >>> gs.devices()[0].number
    0
    """
    return [Device(**row) for row in SESSION.devices()]
