"""The built-in models: what each has and takes."""

from __future__ import annotations

from typing import NamedTuple

from gearsweep import _core
from gearsweep._value import text_of


class Channel(NamedTuple):
    """A state or a signal, in the model's units."""

    name: str
    unit: str
    meaning: str


class Parameter(NamedTuple):
    """A parameter, with its default and the range that it may have."""

    name: str
    unit: str
    meaning: str
    default: float
    minimum: float
    maximum: float


class Option(NamedTuple):
    """A choice between variants of a model; the first one is the default."""

    name: str
    choices: tuple[str, ...]
    meaning: str


class Preset(NamedTuple):
    """A name for a set of parameters."""

    name: str
    meaning: str


class Model(NamedTuple):
    """A system that can be swept."""

    name: str
    summary: str
    states: tuple[Channel, ...]
    signals: tuple[Channel, ...]
    parameters: tuple[Parameter, ...]
    options: tuple[Option, ...]
    presets: tuple[Preset, ...]


def model(name: str) -> Model:
    """A built-in model.

    Parameters
    ----------
    name : str
        One of `models`.

    Returns
    -------
    Model

    Raises
    ------
    InputError
        There is none of this name.

    Examples
    --------
    >>> import gearsweep as gs
    >>> [preset.name for preset in gs.model("gear5").presets]
    ['consistent', 'coarse', 'paper']
    """
    found = _core.model(text_of(name, "the name of a model"))
    return Model(
        name=found["name"],
        summary=found["summary"],
        states=tuple(Channel(*row) for row in found["states"]),
        signals=tuple(Channel(*row) for row in found["signals"]),
        parameters=tuple(Parameter(*row) for row in found["parameters"]),
        options=tuple(Option(*row) for row in found["options"]),
        presets=tuple(Preset(*row) for row in found["presets"]),
    )


def models() -> dict[str, str]:
    """The built-in models.

    Returns
    -------
    dict of str to str
        Names with summaries.
    """
    return {name: _core.model(name)["summary"] for name in _core.model_names()}
