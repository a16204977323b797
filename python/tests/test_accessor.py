"""`maps.gear`: units of SI, pictures, traces and attractors of a result."""

from __future__ import annotations

import re
from pathlib import Path

import numpy
import pytest
import xarray
from conftest import MAP, SMALL, command

import gearsweep
from gearsweep import InputError

pyplot = pytest.importorskip("matplotlib.pyplot")
pyplot.switch_backend("agg")

GEAR = {"axes.omega.count": 5, "axes.mu.count": 3, **SMALL}


@pytest.fixture(autouse=True)
def close_figures():
    yield
    pyplot.close("all")


def refusal(call) -> str:
    with pytest.raises(InputError) as refused:
        call()
    return str(refused.value)


@pytest.fixture(scope="module")
def gear() -> xarray.Dataset:
    observed = ["x1_rms", "dmf_max", "poincare", "period", "section_min", "lyapunov_max"]
    changes = {"observe.quantities": observed, "observe.poincare": ["x1", "v1"]}
    return gearsweep.run("table1-gear", set={**GEAR, **changes})


@pytest.fixture(scope="module")
def bad() -> xarray.Dataset:
    """A map whose stiffer points diverge."""
    study = gearsweep.Study.gear5("coarse").sweep(k1=(1.0, 1e6, 6, "log"), omega=[0.7, 0.8, 0.9])
    study = study.integrate(settle=20, record=10, states="all", stop="never")
    with pytest.warns(RuntimeWarning, match="diverged at"):
        return study.observe("x1_rms", "contact_class").run()


@pytest.fixture(scope="module")
def curve() -> xarray.Dataset:
    quantities = ["poincare", "x1_rms", "period", "contact_class", "lyapunov_spectrum"]
    changes = {"axes.omega.count": 30, "observe.quantities": quantities, **SMALL}
    return gearsweep.run("coarse-bifurcation", set=changes)


def test_si_is_what_the_attributes_say(gear):
    si = gear.gear.si()
    assert (si.x1_rms.attrs["units"], si.dmf_max.attrs["units"]) == ("µm", "N")
    metres = gear.x1_rms * gear.x1_rms.attrs["scale_to_SI"]
    numpy.testing.assert_allclose(si.x1_rms, 1e6 * metres, rtol=1e-14)
    force = gear.dmf_max * gear.dmf_max.attrs["scale_to_SI"]
    numpy.testing.assert_allclose(si.dmf_max, force, rtol=1e-14)
    assert "scale_to_SI" not in si.x1_rms.attrs
    assert si.period.variable.identical(gear.period.variable)


def test_si_has_the_pinion_speed_as_its_axis(gear):
    omega = gear.gear.si().omega
    assert (omega.attrs["units"], omega.attrs["long_name"]) == ("rpm", "pinion speed")
    expected = gear.omega.values * gear.attrs["scale_rpm_per_omega"]
    numpy.testing.assert_allclose(omega, expected, rtol=1e-14)
    assert gear.gear.si().sel(omega=5000.0, method="nearest").omega > 1000.0


def test_si_goes_state_by_state_where_these_have_units_of_their_own(gear):
    si = gear.gear.si()
    assert si.state_units.values.tolist() == ["µm", "mm/s"]
    factors = gear.state_scale_to_SI * numpy.array([1e6, 1e3])
    numpy.testing.assert_allclose(si.poincare, gear.poincare * factors, rtol=1e-14)
    assert si.poincare.dims == gear.poincare.dims


def test_si_twice_is_si_once(gear):
    once = gear.gear.si()
    assert once.gear.si().identical(once)


def test_si_leaves_the_result_as_it_was(gear):
    before = gear.copy(deep=True)
    gear.gear.si()
    assert gear.identical(before)


def test_si_keeps_single_precision():
    changes = {**GEAR, "integrate.precision": "fp32", "observe.quantities": ["x1_rms", "poincare"]}
    made = gearsweep.run("table1-gear", set=changes).gear.si()
    assert made.x1_rms.dtype == made.poincare.dtype == numpy.float32


def test_si_needs_a_gear():
    assert "[gear]" in refusal(gearsweep.run("coarse-map", set=MAP).gear.si)
    assert "[gear]" in refusal(xarray.Dataset().gear.si)


def test_attractors_are_a_table():
    changes = {"axes.x1.count": 6, "axes.v1.count": 5, **SMALL}
    made = gearsweep.run("coarse-basins", set=changes)
    table = made.gear.attractors
    assert table.sizes == {"number": made.sizes["attractor_number"]}
    numpy.testing.assert_array_equal(table.x1_rms, made.attractor_x1_rms)
    kinds = {"undecided", "periodic", "quasi_periodic", "chaotic"}
    assert set(table.motion_class.values.tolist()) <= kinds
    assert float(table.share.sum()) == pytest.approx(1.0, abs=0.2)
    assert list(table.to_dataframe().columns) == list(table.data_vars)
    without = refusal(lambda: gearsweep.run("coarse-map", set=MAP).gear.attractors)
    assert "observe the quantity 'attractor'" in without


def test_at_is_a_trace_of_the_place(gear):
    place = {"record": 2, **{name: float(gear[name][0]) for name in gear.status.dims}}
    assert gear.gear.at(**place).equals(gearsweep.trace(gear, **place))


def script_of(maps: xarray.Dataset, quantity: str, folder: Path, *options: str) -> str:
    """What the command draws."""
    result, picture, script = (folder / name for name in ("maps.nc", "plot.svg", "plot.gp"))
    maps.to_netcdf(result)
    files = ("-o", str(picture), "--script", str(script))
    command("plot", str(result), "-q", quantity, *files, *options)
    return script.read_text()


def colour_ends(script: str) -> tuple[float, ...]:
    ends = re.search(r"set cbrange \[(.*):(.*)\]", script)
    assert ends is not None
    return tuple(float(end) for end in ends.groups())


def colours_of_palette(script: str) -> list[str]:
    palette = re.search(r"set palette defined \((.*)\)", script)
    assert palette is not None
    return re.findall(r"'(#\w+)'", palette.group(1))


def hexes(colours: object) -> list[str]:
    from matplotlib.colors import to_hex

    return [to_hex(colour) for colour in colours]


@pytest.mark.parametrize("quantity", ["period", "contact_class", "motion_class"])
def test_classes_have_the_colours_and_names_of_the_command(quantity, tmp_path):
    changes = {"axes.omega.count": 16, "axes.b.count": 12, **SMALL}
    observed = {"observe.quantities": ["period", "motion_class", "contact_class", "lyapunov_max"]}
    maps = gearsweep.run("coarse-backlash", set={**changes, **observed})
    script = script_of(maps, quantity, tmp_path)
    ax = maps.gear.plot(quantity)
    (mesh,) = ax.collections
    drawn = hexes(mesh.get_cmap().colors)
    assert drawn == colours_of_palette(script)[::2]
    names = [label.get_text() for label in ax.figure.axes[1].get_yticklabels()]
    assert len(names) == len(drawn)
    for name in names:
        assert f'"{name}"' in script


@pytest.mark.parametrize("quantity", ["dmf_max", "lyapunov_max"])
def test_shades_are_those_of_the_command(quantity, tmp_path):
    observed = {"observe.quantities": ["dmf_max", "lyapunov_max"]}
    chaos = {**MAP, "axes.omega.count": 16, "axes.e0.count": 12, **observed}
    maps = gearsweep.run("coarse-chaos", set=chaos)
    script = script_of(maps, quantity, tmp_path)
    (mesh,) = maps.gear.plot(quantity).collections
    assert mesh.get_clim() == colour_ends(script)
    expected = colours_of_palette(script)
    shade = mesh.get_cmap()
    assert hexes([shade(0.0), shade(1.0)]) == [expected[0], expected[-1]]
    if quantity == "lyapunov_max":
        assert min(shade(mesh.norm(0.0))) > 0.98  # white


def test_labels_are_those_of_the_command(gear):
    ax = gear.gear.plot("dmf_max")
    assert ax.get_title() == gear.attrs["title"]
    assert ax.get_xlabel() == "mesh frequency $ω$/$ϖ$"
    bar = ax.figure.axes[1].get_ylabel()
    assert bar == r"largest meshing force ($k$$_{\mathrm{0}}$$b$$_{\mathrm{n}}$)"
    ax.figure.canvas.draw()


def test_a_picture_in_si_is_that_of_the_command(gear, tmp_path):
    script = script_of(gear, "dmf_max", tmp_path, "--units", "SI")
    ax = gear.gear.si().gear.plot("dmf_max")
    assert ax.collections[0].get_clim() == pytest.approx(colour_ends(script), rel=1e-12)
    assert ax.get_xlabel() == "pinion speed (rpm)"
    assert '"pinion speed (rpm)"' in script


def test_values_lie_where_their_points_are(bad):
    ax = bad.gear.plot("x1_rms")
    (mesh,) = ax.collections
    drawn = mesh.get_array().reshape(bad.x1_rms.shape)
    numpy.testing.assert_array_equal(drawn.filled(numpy.nan), bad.x1_rms.values)
    assert ax.get_xscale() == "log"
    edges = mesh.get_coordinates()[0, :, 0]
    numpy.testing.assert_allclose(edges[1:-1] ** 2, bad.k1.values[1:] * bad.k1.values[:-1])


@pytest.mark.parametrize(
    ("quantity", "colour"), [("x1_rms", "#b3b3b3"), ("contact_class", "#000000")]
)
def test_points_without_a_value_have_their_own_colour_and_are_counted(bad, quantity, colour):
    ax = bad.gear.plot(quantity)
    assert hexes([ax.collections[0].get_cmap().get_bad()]) == [colour]
    count = int((bad.status == 1).sum())
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert f"diverged at {count} of {bad.status.size} points" in texts


def test_a_cut_is_a_curve_that_says_where(bad):
    one = bad.sel(omega=0.8, method="nearest")
    ax = one.gear.plot("x1_rms")
    numpy.testing.assert_array_equal(ax.lines[0].get_ydata(), one.x1_rms)
    assert any("$ω$ = 0.8" in text.get_text() for text in ax.texts)
    marks = ax.lines[-1].get_xdata()
    numpy.testing.assert_array_equal(marks, one.k1[one.x1_rms.isnull()])


def test_samples_are_dots(curve):
    ax = curve.gear.plot()
    (dots,) = [line for line in ax.lines if line.get_alpha() is not None]
    samples = curve.poincare.sel(state="x1").values.ravel()
    numpy.testing.assert_array_equal(dots.get_ydata(), samples)
    assert ax.get_ylabel().startswith("$x$")


def test_parts_are_curves_with_names(curve):
    ax = curve.gear.plot("lyapunov_spectrum")
    assert len(ax.lines) >= curve.sizes["exponent"]
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert texts == ["exponent 1", f"exponent 2 to {curve.sizes['exponent']}"]
    alone = curve.gear.plot("lyapunov_spectrum:2")
    numpy.testing.assert_array_equal(alone.lines[0].get_ydata(), curve.lyapunov_spectrum[:, 1])


def test_classes_over_one_axis_are_named(curve):
    ax = curve.gear.plot("contact_class")
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert set(names) <= {"no impact", "single sided", "double sided", "wedged"}
    assert names


def test_a_picture_goes_where_it_is_told(curve, bad):
    figure, axes = pyplot.subplots(1, 2)
    assert curve.gear.plot("x1_rms", ax=axes[0], title="", log=True) is axes[0]
    assert axes[0].get_title() == ""
    assert axes[0].get_yscale() == "log"
    bad.gear.plot("x1_rms", ax=axes[1], title="own $", colormap="magma_r", range=(0.5, 2.0))
    assert axes[1].collections[0].get_clim() == (0.5, 2.0)
    assert axes[1].get_title() == r"own \$"
    figure.canvas.draw()


def test_what_cannot_be_drawn_is_told(curve, bad, gear):
    assert "did you mean 'x1_rms'?" in refusal(lambda: bad.gear.plot("x1_rm"))
    assert "did you mean" in refusal(lambda: curve.gear.plot("poincare:x2"))
    assert "isel(mu=0)" in refusal(lambda: gear.gear.plot("poincare"))
    assert "viridis" in refusal(lambda: bad.gear.plot("x1_rms", colormap="viridi"))
    assert "colormap" in refusal(lambda: curve.gear.plot("x1_rms", colormap="viridis"))
    assert "range" in refusal(lambda: bad.gear.plot("x1_rms", range=(5.0, 1.0)))
    assert "two ends" in refusal(lambda: bad.gear.plot("x1_rms", range=5.0))
    assert "a name" in refusal(lambda: bad.gear.plot(3))
    assert "gearsweep did not make it" in refusal(xarray.Dataset().gear.plot)
    assert "one point" in refusal(bad.isel(k1=0, omega=0).gear.plot)


def test_points_of_a_list_are_dots_over_a_column():
    points = {"omega": [1.3, 0.6, 0.7], "mu": [0.0, 0.1, 0.05]}
    maps = gearsweep.run("coarse-map", points=points, set=SMALL)
    (dots,) = maps.gear.plot("dmf_max", over="omega").lines
    assert dots.get_linestyle() == "None"
    numpy.testing.assert_array_equal(dots.get_xdata(), points["omega"])
    assert list(maps.gear.plot("dmf_max").lines[0].get_xdata()) == [1, 2, 3]
    assert "there are omega, mu" in refusal(lambda: maps.gear.plot("dmf_max", over="b"))
    assert "no column" in refusal(lambda: gearsweep.run("coarse-map", set=MAP).gear.plot(over="b"))


def test_what_is_no_map_says_how_it_is_drawn(gear):
    place = {name: float(gear[name][0]) for name in gear.status.dims}
    trace = gearsweep.trace(gear, record=2, **place)
    assert "as in 'spectrum:dmf'" in refusal(lambda: trace.gear.plot("x1"))
    assert "maps.gear.at" in refusal(lambda: gear.gear.si().gear.at(**place))


def test_plot_has_the_band_of_tolerances():
    study = gearsweep.Study.gear5("coarse").sweep(omega=(0.6, 0.9, 4)).observe("x1_rms", "dmf_max")
    study = study.integrate(settle=20, record=8, stop="never")
    mass = {"distribution": "uniform", "from": 0.3, "to": 0.4}
    maps = study.uncertain(samples=5, m1=mass, percentiles=[10, 90]).run()
    ax = maps.gear.plot("x1_rms")
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == ["nominal", "percentiles 10 to 90"]
    low, high = ax.get_ylim()
    assert low < float(maps.x1_rms_p10.min())
    assert high > float(maps.x1_rms_p90.max())
    bare = maps.gear.plot("x1_rms", band=False)
    assert bare.get_legend() is None
    assert not bare.collections


def test_classes_have_their_names():
    maps = gearsweep.run("coarse-map", set=MAP)
    classes = maps.gear.classes("contact_class")
    names = maps.contact_class.attrs["flag_meanings"].split()
    numbers = maps.contact_class.values.astype(int)
    assert classes.dims == maps.contact_class.dims
    assert classes.values.tolist() == [[names[code] for code in row] for row in numbers]
    assert (maps.gear.classes("status") == "ok").all()
    assert "did you mean 'contact_class'" in refusal(lambda: maps.gear.classes("contact_clas"))
    assert "no map of classes 'dmf_max'" in refusal(lambda: maps.gear.classes("dmf_max"))


def test_points_without_a_class_have_no_name(bad):
    classes = bad.gear.classes("contact_class")
    assert ((classes == "") == bad.contact_class.isnull()).all()
    assert (classes == "").any()


def test_units_are_ones_that_pint_knows(gear):
    pytest.importorskip("pint_xarray")
    quantified = gear.gear.quantify()
    si = gear.gear.si()
    place = dict.fromkeys(gear.status.dims, 1)
    for name, unit in {"dmf_max": "newton", "x1_rms": "micrometer"}.items():
        value = quantified[name].isel(place).data.to(unit).magnitude
        assert value == pytest.approx(float(si[name].isel(place)), rel=1e-12)
    registry = quantified.dmf_max.data.units._REGISTRY
    speed = registry.Quantity(1.0, "b_n varpi").to("mm/s").magnitude
    trace = gear.gear.at(record=1, **{name: float(gear[name][0]) for name in gear.status.dims})
    assert speed == pytest.approx(1e3 * trace.v1.attrs["scale_to_SI"], rel=1e-12)
    without = gearsweep.run("coarse-map", set=MAP).gear.quantify()
    assert str(without.x1_rms.data.units) == "b_n"
    damping = gearsweep.Study.gear5("coarse").sweep(c1=[1.0, 2.0]).observe("x1_rms")
    swept = damping.integrate(settle=20, record=8, stop="never").run().gear.quantify()
    assert str(swept.c1.attrs.get("units", swept.c1.pint.units)) == "c_m", "and no centimetre"
