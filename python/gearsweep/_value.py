"""Values of Python as a study writes them."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy

from gearsweep._errors import InputError

# Words that a study takes without quotes, and that its messages then show as they were given.
_WORD = re.compile(r"(?!(?:true|false|inf|nan)\Z)[A-Za-z][A-Za-z0-9_-]*\Z")


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
    return [f"{_path(path)}={_toml(value, str(path))}" for path, value in changes.items()]


def _path(path: Any) -> str:
    if not isinstance(path, str) or "=" in path:
        raise InputError(f"set: {path!r} is no path of a key, such as 'integrate.record'")
    return path


def _toml(value: Any, path: str) -> str:
    if isinstance(value, numpy.ndarray | numpy.generic):
        value = value.tolist()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return value if _WORD.match(value) else json.dumps(value, ensure_ascii=False)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_quoted(item, path) for item in value) + "]"
    if isinstance(value, Mapping):
        items = (f"{json.dumps(str(key))} = {_quoted(item, path)}" for key, item in value.items())
        return "{" + ", ".join(items) + "}"
    raise InputError(f"--set {path}: a study has no values of the type {type(value).__name__}")


def _quoted(value: Any, path: str) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return _toml(value, path)
