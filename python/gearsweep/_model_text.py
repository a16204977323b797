"""The text of a model, as its file would have it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gearsweep._errors import InputError
from gearsweep._value import numbers_of, toml_key, toml_value

def model_text(
    *, name: str, summary: str, max_step: Any, period: Any, jumps: Any, **tables: Any
) -> str:
    """The TOML of a model; `gearsweep.Model` has the same parameters.

    Returns
    -------
    str
        What a model's file has.

    Raises
    ------
    InputError
        There is no period, or a table is no mapping.
    """
    if period is None:
        raise InputError(
            "the period is not known: give it, as in period='2*pi/omega' (of a model without "
            "forcing the time from section to section)"
        )
    given = {key: _mapping(value, key) for key, value in tables.items()}
    states, parameters, signals = given["states"], given["parameters"], given["signals"]
    notes = {"unit": given["units"], "meaning": given["meanings"], "start": given["start"]}
    _refuse_unknown(given["start"], "start", [*states])
    for key in ("units", "meanings"):
        _refuse_unknown(given[key], key, [*states, *parameters, *signals])

    def noted(rows: dict[str, Any], own: str) -> dict[str, Any]:
        return {key: _noted(value, key, notes, own) for key, value in rows.items()}

    parts = [
        _table("model", {"name": name, "summary": summary or None, "max_step": max_step}),
        _table("states", noted(dict.fromkeys(states, {}), "")),
        _table("parameters", noted(parameters, "value")),
        _table("options", {key: _option(value) for key, value in given["options"].items()}),
        _table("constants", given["constants"]),
        _table("equations", states),
        _table("forcing", {"period": period, "jumps": jumps}),
        _table("signals", noted(signals, "expression")),
    ]
    for preset, values in given["presets"].items():
        parts.append(f"[presets.{toml_key(preset)}]\n{_entries(_mapping(values, 'presets'))}")
    return "\n".join(part for part in parts if part)


def table_texts(tables: Mapping[str, Any] | None) -> dict[str, str]:
    """Measured curves as text.

    Parameters
    ----------
    tables : mapping of str to array_like, optional
        Arrays of shape (points, 2): the phase in radians and the value.

    Returns
    -------
    dict of str to str
        A phase and a value per line.
    """
    given = _mapping(tables, "tables")
    return {name: _table_text(name, points) for name, points in given.items()}


def _table_text(name: str, points: Any) -> str:
    array = numbers_of(points, f"table {name!r}", "an array of numbers")
    if array.ndim != 2 or array.shape[1] != 2:
        raise InputError(
            f"table {name!r}: expected the shape (points, 2), the phase in radians and the value, "
            f"not {array.shape}"
        )
    return "".join(f"{phase!r} {value!r}\n" for phase, value in array.tolist())


def _mapping(value: Any, key: str) -> dict[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise InputError(f"{key}: expected a dict, not {value!r}")
    return {str(name): one for name, one in value.items()}


def _refuse_unknown(given: dict[str, Any], key: str, known: list[str]) -> None:
    for name in given:
        if name not in known:
            raise InputError(f"{key}: the model has no {name!r}; it has {', '.join(known)}")


def _noted(value: Any, name: str, notes: dict[str, dict[str, Any]], own: str) -> Any:
    """A value with what is noted of its name; as it is without notes."""
    extra = {key: texts[name] for key, texts in notes.items() if name in texts}
    if isinstance(value, Mapping):
        return {**value, **extra}
    return {own: value, **extra} if extra else value


def _option(value: Any) -> Any:
    return value if isinstance(value, Mapping) else {"choices": value}


def _table(name: str, entries: Mapping[str, Any]) -> str:
    text = _entries(entries)
    return f"[{name}]\n{text}" if text else ""


def _entries(entries: Mapping[str, Any]) -> str:
    return "".join(
        f"{toml_key(key)} = {toml_value(value, key)}\n"
        for key, value in entries.items()
        if value is not None
    )
