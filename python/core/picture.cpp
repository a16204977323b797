// What accessors of results need: units of SI, and the colours and labels of pictures.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/parts.hpp"
#include "model/names.hpp"
#include "orders/spectrum.hpp"
#include "plot/band.hpp"
#include "plot/classes.hpp"
#include "plot/colours.hpp"
#include "plot/curve_styles.hpp"
#include "plot/labels.hpp"
#include "plot/value_range.hpp"
#include "result/si_units.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> vector_of(const Numbers& numbers) {
  return {numbers.data(), numbers.data() + numbers.size()};
}

// Kind, colour and dashes of border curves, in widths of the line.
std::vector<std::tuple<std::string, std::string, std::vector<double>>> curve_styles() {
  std::vector<std::tuple<std::string, std::string, std::vector<double>>> out;
  for (const CurveStyle& style : kCurveStyles) {
    out.emplace_back(style.kind, style.colour, dash_lengths(style));
  }
  return out;
}

// The scales in a Dataset's attributes; none without a [gear] table.
std::optional<Scales> scales_in(const py::dict& attributes) {
  const Scales scales = scales_of([&](const std::string& name) -> std::optional<double> {
    const py::str key(name);
    if (!attributes.contains(key)) return std::nullopt;
    try {
      return attributes[key].cast<double>();
    } catch (const py::cast_error&) {
      return std::nullopt;
    }
  });
  return scales.known() ? std::optional(scales) : std::nullopt;
}

// (scale, unit, meaning of an axis in this unit), or None where the unit has none of SI.
py::object shown(const std::string& unit, const Scales& scales) {
  const SiUnit si = shown_unit(unit, scales);
  if (si.scale <= 0.0) return py::none();
  return py::make_tuple(si.scale, si.name, si.axis_meaning);
}

ResultMap map_of(const std::string& name, const std::vector<std::string>& flags,
                 const Numbers& values) {
  ResultMap map;
  map.name = name;
  map.flags = flags;
  map.values = vector_of(values);
  return map;
}

using Companion = std::optional<std::pair<std::vector<std::string>, Numbers>>;

std::optional<ResultMap> map_of(const char* name, const Companion& companion) {
  if (!companion) return std::nullopt;
  return map_of(name, companion->first, companion->second);
}

// (index of each value, names, colours), or None of a map without classes. motion, contact: the
// maps motion_class and contact_class of the same points, where they are known.
py::object classes_of(const std::string& name, const std::vector<std::string>& flags,
                      const Numbers& values, const Companion& motion, const Companion& contact) {
  ResultMap map = map_of(name, flags, values);
  const std::optional<ResultMap> motions = map_of("motion_class", motion);
  const std::optional<ResultMap> contacts = map_of("contact_class", contact);
  tell_classes_apart(motions ? &*motions : nullptr, contacts ? &*contacts : nullptr, &map);
  const std::optional<MapClasses> classes = classes_in(map);
  if (!classes) return py::none();
  py::array_t<double> indices(std::vector<py::ssize_t>{values.size()});
  double* out = indices.mutable_data();
  for (const double value : map.values) *out++ = classes->index_of(value);
  return py::make_tuple(indices, classes->names, classes->colours);
}

// (low, median, high, meaning): names of maps, of which the second may be empty; None of a quantity
// without percentiles.
py::object band_of(const std::string& quantity, const std::vector<std::string>& names) {
  const std::optional<BandMaps> maps = band_maps(quantity, names);
  if (!maps) return py::none();
  return py::make_tuple(maps->low, maps->median, maps->high, maps->meaning);
}

py::list anchors_of(const std::string& name, double min, double max) {
  ensure_colormap(name);
  py::list anchors;
  for (const ColourAnchor& anchor : colour_anchors(name, min, max)) {
    anchors.append(py::make_tuple(anchor.place, anchor.colour));
  }
  return anchors;
}

py::tuple ends_of(const ValueRange& range) {
  return py::make_tuple(range.min, range.max, range.clipped);
}

// Ends that are not given follow the values. Also whether there are values below, and above.
py::tuple colour_range_of(const Numbers& values, const std::optional<double>& min,
                          const std::optional<double>& max, bool is_log,
                          const std::string& colormap, const std::string& quantity) {
  const std::vector<double> all = vector_of(values);
  const ValueRange own =
      is_log ? colour_range(all) : with_middle(colormap, quantity, colour_range(all));
  const ValueRange range = scale_range(own, all, {min, max}, is_log, "range");
  const Beyond out = beyond(range, all);
  return py::make_tuple(range.min, range.max, range.clipped, static_cast<int>(out.below),
                        static_cast<int>(out.above));
}

// (orders between bins, amplitudes) of evenly spaced samples over so many whole periods.
py::tuple spectrum_of(const Numbers& samples, std::size_t periods) {
  const Spectrum spectrum = amplitude_spectrum(vector_of(samples), periods);
  return py::make_tuple(spectrum.order_step,
                        py::array_t<double>(static_cast<py::ssize_t>(spectrum.amplitude.size()),
                                            spectrum.amplitude.data()));
}

std::string axis_label_of(const std::string& name, const std::string& unit,
                          const std::string& meaning) {
  ResultAxis axis;
  axis.name = name;
  axis.unit = unit;
  axis.meaning = meaning;
  return axis_mathtext(axis);
}

}  // namespace

void add_picture(py::module_* module) {
  py::class_<Scales>(*module, "Scales");
  module->def("scales_in", scales_in);
  module->def("shown_unit", shown);
  module->def("classes_of", classes_of);
  module->def("band_of", band_of);
  module->def("usual_colormap", &usual_colormap);
  module->def("curve_styles", &curve_styles);
  module->def("colour_anchors", anchors_of);
  module->def("colour_range", colour_range_of);
  module->def("amplitude_spectrum", spectrum_of);
  module->def("padded_range",
              [](const Numbers& values) { return ends_of(padded_range(vector_of(values))); });
  module->def("suggest_name", [](const std::string& name, const std::vector<std::string>& known) {
    return suggest_name(name, known);
  });
  module->def("axis_label", axis_label_of);
  module->def("quantity_label", &quantity_mathtext);
  module->def("literal_label", [](const std::string& text) { return literal_mathtext(text); });
  module->def("typeset_label", [](const std::string& text) { return typeset_mathtext(text); });
  module->attr("MISSING_COLOUR") = kMissingColour;
  module->attr("MISSING_CLASS_COLOUR") = kMissingClassColour;
  module->attr("FIRST_PART_COLOUR") = kFirstPartColour;
  module->attr("OTHER_PARTS_COLOUR") = kOtherPartsColour;
  module->attr("BAND_COLOUR") = kBandColour;
  module->attr("MEDIAN_COLOUR") = kMedianColour;
  module->attr("NOMINAL_MEANING") = kNominalMeaning;
  module->attr("MEDIAN_MEANING") = kMedianMeaning;
  module->attr("DOT_COLOUR") = dot_colour(0, 1);
  module->attr("CURVE_COLOUR") = layer_colour(0);
}

}  // namespace gearsweep::python
