"""The devices that this process has opened, and what they are."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._value import shown, text_of

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


def device_text(device: int | str | None) -> str:
    """A device, or several, as the command takes them; empty stands for the default one."""
    if device is None:
        return ""
    if isinstance(device, bool) or not isinstance(device, int | numpy.integer | str):
        raise InputError(f"device: expected a number or a text such as '0,1', not {shown(device)}")
    if not isinstance(device, str) and not 0 <= device < 1 << 63:
        raise InputError(f"device: {shown(device)} is no number of gearsweep.devices()")
    return text_of(str(device), "numbers of devices")
