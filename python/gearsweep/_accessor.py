"""What people do next with a result: `maps.gear`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray

from gearsweep._errors import InputError
from gearsweep._flags import class_names, names_of_flags
from gearsweep._pint import quantified
from gearsweep._si import IN_SI, in_si

if TYPE_CHECKING:
    import matplotlib.axes

_ATTRACTOR = "attractor_"


@xarray.register_dataset_accessor("gear")
class Gear:
    """`maps.gear` of each Dataset: what people do next with a result.

    Parameters
    ----------
    maps : Dataset
        A result of `gearsweep.run`, or of ``xarray.open_dataset``.
    """

    def __init__(self, maps: xarray.Dataset) -> None:
        self._maps = maps

    def si(self) -> xarray.Dataset:
        """Make the same result with coordinates and values in rpm, µm, mm/s, N, ...

        Returns
        -------
        Dataset

        Raises
        ------
        InputError
            The study has no [gear] table, so its numbers have no scales.

        Examples
        --------
        >>> import gearsweep
        >>> small = {"axes.omega.count": 3, "integrate.settle": 10, "integrate.record": 5}
        >>> maps = gearsweep.run("table1-gear", set=small)
        >>> maps.omega.attrs["units"], maps.gear.si().omega.attrs["units"]
        ('varpi', 'rpm')
        """
        return in_si(self._maps)

    def at(self, **place: Any) -> xarray.Dataset:
        """Trace the motion at a point of the result.

        Parameters
        ----------
        **place : float
            The place, such as ``omega=1.3, b=0.6``, in the units of the study; and options of
            `gearsweep.trace`.

        Returns
        -------
        Dataset
            What `gearsweep.trace` returns.
        """
        from gearsweep import trace

        if IN_SI in self._maps.attrs:
            raise InputError(
                "this Dataset is in rpm, µm and N; take the point of the result that it was made "
                "of, in the units of the study: maps.gear.at(...)"
            )
        return trace(self._maps, **place)

    def plot(
        self,
        quantity: str | None = None,
        *,
        over: str | None = None,
        ax: matplotlib.axes.Axes | None = None,
        colormap: str | None = None,
        range: tuple[float | None, float | None] = (None, None),
        log: bool = False,
        band: bool = True,
        title: str | None = None,
    ) -> matplotlib.axes.Axes:
        """Draw a quantity, in the colours and with the labels of ``gearsweep plot``.

        Over two axes it is a heat map, over one a curve or a bifurcation diagram. To see one value
        of an axis, select it: ``maps.sel(b=0.6, method="nearest").gear.plot("dmf_max")``.

        Parameters
        ----------
        quantity : str, optional
            A map of the result; ``"poincare:v1"`` is one of its states, ``"lyapunov_spectrum:1"``
            one of its numbers. Without one the samples over one axis, else the first map. Of an
            order map what stands upright: ``"frequency"``, as without one, or ``"order"``.
            Of traces the kind of picture, and after a colon what of: ``"time:dmf"``, ``"phase"``,
            ``"section"``, ``"spectrum:x1"`` or ``"force"``; ``"time"`` without one. Time is in
            periods, and in ms of a Dataset in SI: ``trace.gear.si().gear.plot("force")``.
            Of `gearsweep.curves` none: all curves, over the map that `ax` has.
        over : str, optional
            Of a list of points: the column along the horizontal axis, in place of the number.
        ax : Axes, optional
            Where to draw; a figure of its own without.
        colormap : str, optional
            Colours of a heat map, as ``gearsweep plot --colormap`` names them.
        range : tuple of float, optional
            Ends of the colours, or of the vertical axis; None follows the values.
        log : bool, optional
            Logarithmic colours, or a logarithmic vertical axis.
        band : bool, optional
            Around a curve whose study has tolerances, the band between its lowest and highest
            percentile, and the median as a thin line.
        title : str, optional
            In place of the study's; an empty one leaves out all that stands above the picture.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        InputError
            The result has no such quantity.
        """
        from gearsweep._curves import is_curves, plot_curves
        from gearsweep._order_plot import plot_orders, is_order_map
        from gearsweep._plot import draw
        from gearsweep._trace_plot import is_traces, plot_traces

        if is_curves(self._maps):
            return plot_curves(self._maps, ax, title)
        if is_traces(self._maps):
            return plot_traces(self._maps, quantity, ax=ax, limits=range, title=title)
        if is_order_map(self._maps):
            return plot_orders(
                self._maps, quantity, ax=ax, colormap=colormap, limits=range, title=title
            )
        return draw(
            self._maps,
            quantity,
            over=over,
            ax=ax,
            colormap=colormap,
            limits=range,
            is_log=log,
            has_band=band,
            title=title,
        )

    def classes(self, quantity: str) -> xarray.DataArray:
        """The names of a map's classes in place of their numbers.

        Parameters
        ----------
        quantity : str
            A map of classes: ``"motion_class"``, ``"contact_class"``, ``"status"``, ...

        Returns
        -------
        DataArray
            Texts; an empty one where a point has no class.

        Raises
        ------
        InputError
            The result has no such quantity, or it is none of classes.

        Examples
        --------
        >>> import gearsweep
        >>> study = gearsweep.Study.gear5("coarse", omega=1.4).sweep(e0=[0.05, 0.4, 0.8])
        >>> maps = study.observe("contact_class").integrate(settle=60, record=10).run()
        >>> maps.gear.classes("contact_class").values.tolist()
        ['single_sided', 'single_sided', 'double_sided']
        """
        return class_names(self._maps, quantity)

    def quantify(self) -> xarray.Dataset:
        """The same result with units that pint computes with; it needs pint-xarray.

        A unit of the model, as b_n, is one of its own; in a study with a [gear] table it is so
        many µm or N. Where a variable has several units, as samples of states have, it gets none.

        Returns
        -------
        Dataset
        """
        return quantified(self._maps)

    @property
    def attractors(self) -> xarray.Dataset:
        """The attractors that the points reach, one row for each ``number``.

        A Dataset, since it keeps the units; ``maps.gear.attractors.to_dataframe()`` is a table of
        pandas.

        Raises
        ------
        InputError
            The study did not ask for the quantity ``attractor``.
        """
        names = [
            name
            for name, variable in self._maps.data_vars.items()
            if variable.dims == (_ATTRACTOR + "number",)
        ]
        if not names:
            raise InputError(
                "the Dataset has no list of attractors; observe the quantity 'attractor'"
            )
        table = self._maps[names]
        kinds = table[_ATTRACTOR + "motion_class"]
        named = names_of_flags(kinds).assign_attrs({"long_name": "kind of motion"})
        table[_ATTRACTOR + "motion_class"] = named.variable
        kept = [name for name in table.coords if name not in table.dims]
        short = {name: str(name).removeprefix(_ATTRACTOR) for name in (*names, *table.dims)}
        table = table.drop_vars(kept).rename(short)
        table.attrs = {}
        return table
