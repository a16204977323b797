"""Studies: what to compute."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from typing import TYPE_CHECKING, Any

import xarray

from gearsweep import _core
from gearsweep._axis import axis_table
from gearsweep._errors import InputError
from gearsweep._maps import means_of
from gearsweep._model import Model
from gearsweep._model import model as builtin_model
from gearsweep._points import columns_of
from gearsweep._progress import Watch
from gearsweep._result import call_text
from gearsweep._shards import computed
from gearsweep._study_text import StudyText
from gearsweep._value import assignments, path_of, text_of
from gearsweep._warning import warn

if TYPE_CHECKING:
    from typing import Self

# A study that says nothing: read_draft takes no empty text.
_NOTHING = "[model]\n"


class Study(StudyText):
    """What to compute: a model, its parameters, axes, and what to observe. It never changes.

    Each of its functions that names something makes another study. A study needs no axes until it
    is run.

    Parameters
    ----------
    source : str or Model
        The study as TOML; or a model, which is then swept.

    Raises
    ------
    InputError
        The text is no study; the message says where and what would be right.

    Examples
    --------
    >>> study = Study.gear5(preset="coarse", mu=0.05).sweep(omega=(0.4, 2.0, 64), b=[0.6, 1.0])
    >>> study.observe("x1_rms", "dmf_max")
    <gearsweep.Study: gear5 over 64 values of omega, 2 values of b>
    >>> print(study.integrate(record=50))
    [model]
    name = 'gear5'
    preset = 'coarse'
    <BLANKLINE>
    [parameters]
    mu = 0.05
    <BLANKLINE>
    [[axes]]
    name = 'omega'
    from = 0.4
    to = 2.0
    count = 64
    <BLANKLINE>
    [[axes]]
    name = 'b'
    values = [ 0.6, 1.0 ]
    <BLANKLINE>
    [integrate]
    record = 50
    <BLANKLINE>
    """

    __slots__ = ()

    def __init__(self, source: str | Model) -> None:
        if isinstance(source, Model):
            self._take(Study.of(source)._core)
            return
        text = text_of(source, "a study as TOML, or a Model (Study.read takes names and paths)")
        if text.strip() and not set(text) & set("\n=["):
            raise InputError(f"{text!r} is no TOML; Study.read({text!r}) reads files and built-ins")
        self._take(_core.read_draft(text, "study", [], []))

    @classmethod
    def of(cls, model: str | Model, /, preset: str | None = None, **settings: Any) -> Study:
        """A study of a model, without axes yet.

        Parameters
        ----------
        model : str or Model
            The name of a built-in model, or a `Model`.
        preset : str, optional
            Values to start from; the model's first without one.
        **settings : number, list or str
            Parameters and options of the model, as `parameters` takes them.

        Returns
        -------
        Study

        Examples
        --------
        >>> Study.of("duffing", preset="two_well", damping=0.1)
        <gearsweep.Study: duffing, without axes>
        """
        used = model if isinstance(model, Model) else builtin_model(model)
        table = used._settings() | ({} if preset is None else {"preset": preset})
        assigned = assignments({f"model.{key}": value for key, value in table.items()})
        return cls._of(_core.read_draft(_NOTHING, "study", assigned, [])).parameters(**settings)

    @classmethod
    def gear5(cls, preset: str | None = None, **settings: Any) -> Study:
        """A study of the geared rotor-bearing pair, as `of` makes it.

        Parameters
        ----------
        preset : str, optional
            One of ``gearsweep.model("gear5").presets``.
        **settings : number, list or str
            Parameters and options of ``gearsweep.model("gear5")``.

        Returns
        -------
        Study

        Examples
        --------
        >>> Study.gear5(preset="coarse", mu=0.05, stiffness="rectangular")
        <gearsweep.Study: gear5, without axes>
        """
        return cls.of("gear5", preset, **settings)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Self:
        """Read a study.

        Parameters
        ----------
        path : path
            A TOML file, a result file (the study that made it), or the name of a built-in study.

        Returns
        -------
        Study
        """
        return cls._of(_core.find_study(path_of(path, "a path or the name of a study"), []))

    def sweep(self, **axes: Any) -> Study:
        """Make a study with these axes in place of those it had.

        Parameters
        ----------
        **axes : tuple or array_like
            One or two parameters of the model, or states: then the initial value is swept. The
            first is x. ``(0.4, 2.0, 640)`` are 640 values from 0.4 to 2.0,
            ``(0.1, 10, 50, "log")`` the same with even ratios; anything else is the values
            themselves, which increase.

        Returns
        -------
        Study

        Examples
        --------
        >>> Study.gear5().sweep(omega=(0.4, 2.0, 640), b=[0.5, 0.7, 1.0]).axes
        {'omega': 640, 'b': 3}
        >>> Study.gear5().sweep(zeta=(0.01, 0.1, 20, "log")).axes
        {'zeta': 20}
        """
        if not axes:
            raise InputError("sweep: give one or two axes, as in sweep(omega=(0.4, 2.0, 100))")
        tables = [axis_table(name, values) for name, values in axes.items()]
        return self._built("sweep", axes, {"axes": tables})

    def points(self, points: Any) -> Study:
        """Make a study of these points in place of its axes.

        Parameters
        ----------
        points : mapping of str to array_like, or DataFrame
            Parameters of the model, and states, whose initial value it is then, with a number for
            each point, shape ``(points,)``. A single number stands for all points.

        Returns
        -------
        Study
            With the axis ``point``. A `sweep` over one axis after this gives each point all values
            of the axis.

        Examples
        --------
        >>> study = Study.gear5().points({"omega": [0.6, 0.7, 1.3], "mu": [0, 0.05, 0.1]})
        >>> study.axes
        {'point': 3}
        >>> study.sweep(b=(0.5, 1, 10)).axes
        {'b': 10, 'point': 3}
        """
        columns = columns_of(points)
        # Other points in place of points are no surprise.
        lost = [name for name in self.axes if name != "point"]
        if lost:
            warn(
                f"the points take the place of the axes {', '.join(lost)}; to give each point all "
                "values of an axis, sweep it after the points"
            )
        return Study._of(_core.read_draft(self.toml, "study", ["axes=[]"], columns))

    def observe(
        self, *quantities: str, poincare: Sequence[str] | None = None, **keys: Any
    ) -> Study:
        """Make a study with these maps in place of those it had.

        Parameters
        ----------
        *quantities : str
            What becomes a map; ``gearsweep model NAME`` lists them.
        poincare : sequence of str, optional
            States to sample at phase 0 of each recorded period, for the quantity ``poincare``,
            which then need not be named.
        **keys : number
            Other keys of ``[observe]``: ``period_tolerance``.

        Returns
        -------
        Study

        Examples
        --------
        >>> study = Study.gear5().sweep(omega=(0.4, 2.0, 640)).observe("x1_rms", poincare=["x1"])
        >>> "quantities = [ 'x1_rms', 'poincare' ]" in study.toml
        True
        """
        if len(quantities) == 1 and isinstance(quantities[0], list | tuple):
            quantities = tuple(quantities[0])
        named = list(quantities)
        if poincare is not None:
            keys["poincare"] = [poincare] if isinstance(poincare, str) else poincare
            named += [] if "poincare" in named else ["poincare"]
        return self._built("observe", keys, {"observe": {"quantities": named, **keys}})

    def parameters(self, **settings: Any) -> Study:
        """Make a study with other values of parameters and options.

        Parameters
        ----------
        **settings : number, list or str
            Parameters of the model with numbers or with expressions of others, as ``"0.5*wn"``, and
            options with their choices. A list fills ``kappa``, ``kappa_2``, ...

        Returns
        -------
        Study

        Examples
        --------
        >>> "mu = 0.1" in Study.gear5().parameters(mu=0.1, backlash="dynamic").toml
        True
        """
        options = self._core.option_names
        parameters = self._core.parameter_names + self._core.constant_names

        def table(name: str, value: Any) -> str:
            is_option = name in options or (isinstance(value, str) and name not in parameters)
            return "model" if is_option else "parameters"

        changes = {f"{table(name, value)}.{name}": value for name, value in settings.items()}
        return self._built("parameters", settings, changes)

    def initial(self, **keys: Any) -> Study:
        """Make a study whose points start otherwise.

        Parameters
        ----------
        **keys : str, number or mapping
            Keys of ``[initial]``: ``policy``, ``state``, ``along``, ``ensemble``, ``seed``,
            ``spread``.

        Returns
        -------
        Study

        Examples
        --------
        >>> study = Study.gear5().initial(policy="fixed", state={"x1": 0.2})
        >>> "x1 = 0.2" in study.toml
        True
        """
        return self._with("initial", keys)

    def uncertain(self, **keys: Any) -> Study:
        """Make a study whose parameters are known within tolerances.

        Parameters
        ----------
        **keys : mapping, number or bool
            Parameters with their distributions, as `gearsweep.normal`, `gearsweep.uniform`,
            `gearsweep.triangular` and `gearsweep.values` make them, or as a mapping of the keys:
            ``mu={"distribution": "normal", "std": 0.01}``; and other keys of ``[uncertain]``:
            ``samples``, ``seed``, ``percentiles``, ``start``, ``sobol``, ``keep``.

        Returns
        -------
        Study

        Examples
        --------
        >>> study = Study.gear5().sweep(omega=(0.4, 2.0, 64)).observe("dmf_max")
        >>> from gearsweep import normal
        >>> study = study.uncertain(samples=50, b=normal(0.01))
        >>> "std = 0.01" in study.toml
        True
        """
        return self._with("uncertain", keys)

    def integrate(self, **keys: Any) -> Study:
        """Make a study that is integrated otherwise.

        Parameters
        ----------
        **keys : number, str or bool
            Keys of ``[integrate]``: ``settle`` and ``record`` (periods), ``precision``,
            ``tolerance``, ``max_step``, ...

        Returns
        -------
        Study

        Examples
        --------
        >>> "settle = 200" in Study.gear5().integrate(settle=200, record=50).toml
        True
        """
        return self._with("integrate", keys)

    def run(
        self,
        *,
        set: Mapping[str, Any] | None = None,
        points: Any = None,
        progress: Watch = True,
        journal: str | os.PathLike[str] | None = None,
        device: int | str | None = None,
        executor: Executor | None = None,
        shards: int | None = None,
    ) -> xarray.Dataset:
        """Compute it, as `gearsweep.run` does with the same options."""
        asked, call = (self.set(set) if set else self)._asked("run", self, set, points)
        return computed(asked._core, call, means_of(journal, device), progress, executor, shards)

    def _asked(
        self, function: str, given: Any, changes: Mapping[str, Any] | None, points: Any
    ) -> tuple[Study, str]:
        """The study at these points, if any, and the call that asks for it in words."""
        asked, columns = self, None
        if points is not None:
            asked = self.points(points)
            # The result has the numbers themselves.
            columns = f"columns {', '.join(map(str, points))}"
        return asked, call_text(function, given, set=changes, points=columns)

def study_text(source: Any) -> str:
    """The text, name or path of a study that users gave."""
    return text_of(
        source,
        "a study: the name of a built-in one, a path, TOML, a Study or the Dataset of a run",
    )
