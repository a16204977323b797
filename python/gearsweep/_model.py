"""Models: the built-in ones, and those that are given as equations."""

from __future__ import annotations

import html
import os
import tomllib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._model_text import model_text, table_texts
from gearsweep._value import path_of, text_of

if TYPE_CHECKING:
    from typing import NoReturn, Self

    import numpy.typing


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
    """A name for a set of parameters.

    Its values are numbers, expressions of other parameters, and choices of options; `policy` and
    `state` say where points start. What it does not name has the model's default.
    """

    name: str
    meaning: str
    values: dict[str, Any]


class GearKey(NamedTuple):
    """A key of the table [gear], with what a drawing without it has, and its range."""

    name: str
    unit: str
    meaning: str
    default: str
    minimum: float
    maximum: float


class Model:
    """A system that can be swept, given by its equations. It never changes.

    `gearsweep.model` gives the built-in ones, `Model.read` those of a file. The page of equations
    in the documentation says what an expression may have.

    Parameters
    ----------
    states : mapping of str to str or number
        The states in their order, each with its derivative.
    parameters : mapping of str to number, str or mapping
        The default of each: a number, or an expression of others, as ``"0.5*wn"``, that is worked
        out at each point; or a mapping of ``value`` and, if you like, ``min``, ``max``, ``unit``,
        ``meaning``, ``role``.
    constants : mapping of str to str, optional
        Names for parts that the other expressions use.
    signals : mapping of str to str or mapping, optional
        What else can be observed: an expression, or a mapping of ``expression``, ``unit``,
        ``meaning``, ``role``.
    options : mapping of str to list of str, optional
        Choices by name, the default first: ``law=["linear", "cubic"]`` makes ``law.cubic`` a
        condition.
    presets : mapping of str to mapping, optional
        Values of parameters and options by the preset's name.
    start : mapping of str to str or number, optional
        The equilibrium, where points start: an expression of the parameters; 0 without one.
    units, meanings : mapping of str to str, optional
        Of states, parameters and signals; the unit is ``"1"`` without one.
    period : str or number
        The forcing period, as ``"2*pi/omega"``. Of a model without forcing it is the time from
        section to section.
    jumps : list of str or number, optional
        Phases, in radians, at which an equation jumps.
    max_step : float, optional
        The longest step of a study that finds none.
    name, summary : str, optional
        What it is called, and what it is.
    tables : mapping of str to array_like, optional
        Measured curves that ``table('name', phase)`` reads: arrays of shape (points, 2), the phase
        in radians and the value.

    Raises
    ------
    InputError
        An equation is wrong; the message shows the place in it.

    Examples
    --------
    >>> oscillator = Model(
    ...     states=dict(x="v", v="-2*zeta*v - backlash(x, b) + F*cos(phase)"),
    ...     parameters=dict(omega=1.0, zeta=0.05, b=1.0, F=0.1),
    ...     start=dict(x="b"),
    ...     period="2*pi/omega",
    ... )
    >>> oscillator
    <gearsweep.Model 'own': states x, v; parameters omega, zeta, b, F>
    >>> [signal.name for signal in oscillator.signals]
    ['deflection', 'backlash']
    """

    __slots__ = ("_builtin", "_read")
    _read: dict[str, Any]
    _builtin: bool

    def __init__(
        self,
        states: Mapping[str, str | float],
        parameters: Mapping[str, float | str | Mapping[str, Any]],
        *,
        constants: Mapping[str, str | float] | None = None,
        signals: Mapping[str, str | Mapping[str, Any]] | None = None,
        options: Mapping[str, list[str] | tuple[str, ...]] | None = None,
        presets: Mapping[str, Mapping[str, Any]] | None = None,
        start: Mapping[str, str | float] | None = None,
        units: Mapping[str, str] | None = None,
        meanings: Mapping[str, str] | None = None,
        period: str | float | None = None,
        jumps: list[str | float] | None = None,
        max_step: float | None = None,
        name: str = "own",
        summary: str = "",
        tables: Mapping[str, numpy.typing.ArrayLike] | None = None,
    ) -> None:
        text = model_text(
            states=states,
            parameters=parameters,
            constants=constants,
            signals=signals,
            options=options,
            presets=presets,
            start=start,
            units=units,
            meanings=meanings,
            period=period,
            jumps=jumps,
            max_step=max_step,
            name=name,
            summary=summary,
        )
        read = _core.read_model(text, f"model {name}", table_texts(tables))
        self._take(read)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Self:
        """Read a model.

        Parameters
        ----------
        path : path
            A file of equations. The tables that it reads lie beside it.

        Returns
        -------
        Model
        """
        return cls._of(_core.read_model_file(path_of(path, "the path of a model's file")))

    @classmethod
    def _of(cls, read: dict[str, Any], builtin: bool = False) -> Self:
        model = object.__new__(cls)
        model._take(read, builtin)
        return model

    def _take(self, read: dict[str, Any], builtin: bool = False) -> None:
        object.__setattr__(self, "_read", read)
        object.__setattr__(self, "_builtin", builtin)

    @property
    def name(self) -> str:
        """What it is called."""
        return str(self._read["name"])

    @property
    def summary(self) -> str:
        """What it is."""
        return str(self._read["summary"])

    @property
    def states(self) -> tuple[Channel, ...]:
        """Its states."""
        return tuple(Channel(*row) for row in self._read["states"])

    @property
    def signals(self) -> tuple[Channel, ...]:
        """What else can be observed."""
        return tuple(Channel(*row) for row in self._read["signals"])

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Its parameters."""
        return tuple(Parameter(*row) for row in self._read["parameters"])

    @property
    def options(self) -> tuple[Option, ...]:
        """Its variants."""
        return tuple(Option(*row) for row in self._read["options"])

    @property
    def presets(self) -> tuple[Preset, ...]:
        """Its sets of parameters."""
        return tuple(
            Preset(name, meaning, tomllib.loads(text) | expressions)
            for name, meaning, text, expressions in self._read["presets"]
        )

    @property
    def text(self) -> str:
        """Its equations as a file has them; empty of a built-in model that is a program."""
        return str(self._read["text"])

    @property
    def tables(self) -> dict[str, str]:
        """The measured curves that it reads, as text: a phase in radians and a value per line."""
        return dict(self._read["tables"])

    def _settings(self) -> dict[str, Any]:
        """What a study writes into its table [model]."""
        if self._builtin:
            return {"name": self.name}
        return {"text": self.text} | ({"tables": self.tables} if self.tables else {})

    def _key(self) -> tuple[Any, ...]:
        return self.text or self.name, tuple(sorted(self.tables.items()))

    def __setattr__(self, name: str, value: Any) -> NoReturn:
        raise AttributeError("a Model never changes; make another one")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError("a Model never changes; make another one")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> tuple[Any, ...]:
        if self._builtin:
            return model, (self.name,)
        return _own_model, (self.name, self.text, self.tables)

    def __str__(self) -> str:
        return self.text or repr(self)

    def __repr__(self) -> str:
        states = ", ".join(state.name for state in self.states)
        parameters = ", ".join(parameter.name for parameter in self.parameters)
        return f"<gearsweep.Model {self.name!r}: states {states}; parameters {parameters}>"

    def _repr_html_(self) -> str:
        rows = [(s.name, "state", s.unit, s.meaning) for s in self.states]
        rows += [(p.name, f"{p.default:g}", p.unit, p.meaning) for p in self.parameters]
        rows += [(s.name, "signal", s.unit, s.meaning) for s in self.signals]
        cells = "".join(
            "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>"
            for row in rows
        )
        heads = "".join(f"<th>{head}</th>" for head in ("name", "kind, or default", "unit", "meaning"))
        head = f"<b>{html.escape(self.name)}</b> {html.escape(self.summary)}"
        table = f"<table><thead><tr>{heads}</tr></thead><tbody>{cells}</tbody></table>"
        text = f"<pre>{html.escape(self.text)}</pre>" if self.text else ""
        return f"<details><summary>{head}</summary>{table}{text}</details>"


def _own_model(name: str, text: str, tables: dict[str, str]) -> Model:
    """The model of a pickle."""
    return Model._of(_core.read_model(text, f"model {name}", tables))


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
    >>> [state.name for state in model("duffing").states]
    ['x', 'v']
    """
    return Model._of(_core.builtin_model(text_of(name, "the name of a model")), builtin=True)


def models() -> dict[str, str]:
    """The built-in models.

    Returns
    -------
    dict of str to str
        Names with summaries.
    """
    return {name: model(name).summary for name in _core.model_names()}


def gear_keys() -> dict[str, GearKey]:
    """The keys of the table [gear], in which a study says what the drawing of a gear pair says.

    Returns
    -------
    dict of str to GearKey

    Examples
    --------
    >>> gear_keys()["module_mm"]
    GearKey(name='module_mm', unit='mm', meaning='module', default='required', minimum=0.001, maximum=1000.0)
    """
    return {row[0]: GearKey(*row) for row in _core.gear_keys()}
