"""Values of Python as a study or a model writes them: TOML."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy

from gearsweep._errors import InputError

# Words that a study takes without quotes, and that its messages then show as they were given.
_WORD = re.compile(r"(?!(?:true|false|inf|nan)\Z)[A-Za-z][A-Za-z0-9_-]*\Z")
# Keys that TOML takes without quotes.
_KEY = re.compile(r"[A-Za-z0-9_-]+\Z")


def assignments(changes: Mapping[str, Any] | None) -> list[str]:
    """Changes as the command's --set takes them.

    Parameters
    ----------
    changes : mapping of str to object, optional
        Paths of keys, such as ``"integrate.record"``, with their values.

    Returns
    -------
    list of str
        One ``"path=value"`` for each.
    """
    if changes is None:
        return []
    if not isinstance(changes, Mapping):
        raise InputError("set: expected a dict such as {'integrate.record': 20}")
    return [f"{_path(path)}={_word(value, path)}" for path, value in changes.items()]


def toml_key(key: str) -> str:
    """A key, in quotes where it needs them."""
    return key if _KEY.match(key) else json.dumps(key, ensure_ascii=False)


def toml_value(value: Any, place: str) -> str:
    """A value.

    Parameters
    ----------
    value : bool, number, str, array, list or mapping
        What is written.
    place : str
        Where it belongs, for messages.

    Returns
    -------
    str
        TOML.
    """
    if isinstance(value, numpy.ndarray | numpy.generic):
        value = value.tolist()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml_value(item, place) for item in value) + "]"
    if isinstance(value, Mapping):
        items = (f"{toml_key(str(key))} = {toml_value(item, place)}" for key, item in value.items())
        return "{ " + ", ".join(items) + " }" if value else "{}"
    raise InputError(f"{place}: there are no values of the type {type(value).__name__}")


def _path(path: Any) -> str:
    if not isinstance(path, str) or "=" in path:
        raise InputError(f"set: {path!r} is no path of a key, such as 'integrate.record'")
    return path


def _word(value: Any, path: str) -> str:
    is_word = isinstance(value, str) and _WORD.match(value) is not None
    return str(value) if is_word else toml_value(value, f"--set {path}")
