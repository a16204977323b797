"""Values of Python as a study writes them."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy

from gearsweep._errors import InputError

# Words that a study takes without quotes, and that its messages then show as they were given.
_WORD = re.compile(r"(?!(?:true|false|inf|nan)\Z)[A-Za-z][A-Za-z0-9_-]*\Z")


def text_of(value: Any, expected: str) -> str:
    """A text that users gave.

    Parameters
    ----------
    value : str
        What they gave.
    expected : str
        What would be right, for the message.

    Raises
    ------
    InputError
        It is no text, or has characters that no file can hold.
    """
    if not isinstance(value, str):
        raise InputError(f"expected {expected}, not one of the type {type(value).__name__}")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise InputError(f"expected {expected}, but {value!r} is no text: {error.reason}") from None
    return value


def path_of(value: Any, expected: str) -> str:
    """A path that users gave, as `text_of`."""
    return text_of(os.fspath(value) if isinstance(value, os.PathLike) else value, expected)


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
    return text_of(path, "a path of a key, such as 'integrate.record'")


def _toml(value: Any, path: str) -> str:
    if isinstance(value, numpy.ndarray | numpy.generic):
        value = value.tolist()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return value if _WORD.match(value) else _quoted(value, path)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_quoted(item, path) for item in value) + "]"
    if isinstance(value, Mapping):
        items = (f"{_quoted(str(key), path)} = {_quoted(item, path)}" for key, item in value.items())
        return "{" + ", ".join(items) + "}"
    raise InputError(f"--set {path}: a study has no values of the type {type(value).__name__}")


def _quoted(value: Any, path: str) -> str:
    if isinstance(value, str):
        return json.dumps(text_of(value, f"a text for {path}"), ensure_ascii=False)
    return _toml(value, path)
