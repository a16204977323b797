#include "result/border_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "borders/border_search.hpp"
#include "result/detail/border_names.hpp"
#include "result/detail/dataset_file.hpp"
#include "result/detail/file_notes.hpp"
#include "result/detail/netcdf_file.hpp"

namespace gearsweep {
namespace {

// Puts the dataset together, variable by variable.
class BorderDescription {
 public:
  explicit BorderDescription(const BorderFindings& findings)
      : findings_(findings),
        model_(*findings.study.model),
        notes_(findings.study, {parameter(0).name, parameter(1).name}) {
    for (const BorderCurve& curve : findings.curves) {
      for (const BorderPoint& point : curve.points) points_.push_back(&point);
    }
  }

  Dataset make(const Provenance& provenance) {
    out_.attributes = {{"content", kContentOfBorders}};
    for (Attribute& own : notes_.provenance(provenance)) out_.attributes.push_back(std::move(own));
    out_.attributes.push_back({"x", parameter(0).name});
    out_.attributes.push_back({"y", parameter(1).name});
    out_.attributes.push_back({"steps_per_period", static_cast<double>(findings_.steps)});
    if (findings_.contacts.pairs > 0) {
      out_.attributes.push_back({"contact_pairs", static_cast<double>(findings_.contacts.pairs)});
      out_.attributes.push_back(
          {"contact_pairs_on_curve", static_cast<double>(findings_.contacts.on_curve)});
    }
    const std::size_t states = model_.states.size();
    out_.dimensions = {{"curve", findings_.curves.size()},
                       {"point", points_.size()},
                       {"state", states},
                       {"multiplier", states},
                       {"border", findings_.borders.size()},
                       {"side", 2}};
    add_points();
    add_curves();
    add_special();
    add_borders();
    return std::move(out_);
  }

 private:
  const ParameterInfo& parameter(std::size_t axis) const {
    return model_.parameters[findings_.study.axes[axis].index];
  }

  void add(const std::string& name, Stored stored, const std::vector<std::string>& dimensions,
           const std::string& unit, const std::string& meaning, std::vector<double> numbers) {
    out_.variables.push_back({.name = name,
                              .stored = stored,
                              .dimensions = dimensions,
                              .attributes = notes_.describe(unit, meaning),
                              .elements = std::move(numbers)});
  }

  std::vector<double> each_point(const std::function<double(const BorderPoint&)>& part) const {
    std::vector<double> out;
    for (const BorderPoint* point : points_) out.push_back(part(*point));
    return out;
  }

  void add_points() {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      add(variable_of(parameter(axis).name), Stored::real, {"point"}, parameter(axis).unit,
          parameter(axis).meaning,
          each_point([axis](const BorderPoint& point) { return point.place[axis]; }));
    }
    add_texts("state", "state of the model", "state", model_.state_names(), &out_);
    notes_.add_channels(model_.states, "state", "state", &out_);
    std::vector<double> sections, real, imag;
    for (const BorderPoint* point : points_) {
      sections.insert(sections.end(), point->state.begin(), point->state.end());
      for (const std::complex<double>& m : point->multipliers) {
        real.push_back(m.real());
        imag.push_back(m.imag());
      }
    }
    add("section", Stored::real, {"point", "state"}, "", "states of the orbit at phase 0",
        sections);
    out_.variables.back().attributes =
        notes_.describe(model_.states, "state", "states of the orbit at phase 0");
    add("multiplier_real", Stored::real, {"point", "multiplier"}, "1",
        "Floquet multipliers of the orbit, largest modulus first, real part", real);
    add("multiplier_imag", Stored::real, {"point", "multiplier"}, "1",
        "Floquet multipliers of the orbit, largest modulus first, imaginary part", imag);
    add("angle", Stored::real, {"point"}, "rad", "angle of the multiplier on the unit circle",
        each_point([](const BorderPoint& point) { return point.angle; }));
    add("stable", Stored::byte, {"point"}, "1",
        "1: no other multiplier is outside the unit circle, so that a stable motion bifurcates",
        each_point(
            [](const BorderPoint& point) { return point.is_of_stable_motion() ? 1.0 : 0.0; }));
    add("residual", Stored::real, {"point"}, "1",
        "largest residual of the equations that the point solves, in sizes of the states",
        each_point([](const BorderPoint& point) { return point.residual; }));
  }

  void add_curves() {
    std::vector<std::string> kinds, begins, ends, limits;
    std::vector<double> periods, counts, closed, errors;
    for (const BorderCurve& curve : findings_.curves) {
      kinds.push_back(name_of(curve.kind));
      begins.push_back(name_of(curve.begins));
      ends.push_back(name_of(curve.ends));
      periods.push_back(static_cast<double>(curve.period));
      counts.push_back(static_cast<double>(curve.points.size()));
      closed.push_back(curve.is_closed ? 1.0 : 0.0);
      errors.push_back(curve.step_error);
      limits.push_back(curve.kind == BorderKind::grazing ? describe(model_, curve.limit)
                                                         : std::string());
    }
    add_texts("curve_kind", "what happens at the curve", "curve", kinds, &out_);
    add_texts("curve_begins", "why the curve begins where it does", "curve", begins, &out_);
    add_texts("curve_ends", "why the curve ends where it does", "curve", ends, &out_);
    add_texts("curve_limit", "of a grazing curve: what the orbit only just does", "curve", limits,
              &out_);
    add("curve_period", Stored::integer, {"curve"}, "1",
        "forcing periods of the orbit that bifurcates", periods);
    add("curve_points", Stored::integer, {"curve"}, "1", "how many points the curve has", counts);
    out_.variables.back().attributes.push_back({"sample_dimension", "point"});
    add("curve_closed", Stored::byte, {"curve"}, "1", "1: the curve is closed", closed);
    add("curve_step_error", Stored::real, {"curve"}, "1",
        "how far the curve moves across itself with twice the steps, in pixels of the map, at most",
        errors);
    add_gradients();
  }

  void add_gradients() {
    std::vector<double> judged;
    std::array<std::vector<double>, 2> moved;
    for (const BorderCurve& curve : findings_.curves) {
      judged.push_back(static_cast<double>(curve.judged));
      for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t i = 0; i < model_.parameters.size(); ++i) {
          moved[axis].push_back(curve.gradients.empty() ? std::nan("") : curve.gradients[i][axis]);
        }
      }
    }
    std::vector<std::string> names;
    for (const ParameterInfo& info : model_.parameters) names.push_back(info.name);
    out_.dimensions.push_back({"parameter", names.size()});
    add_texts("parameter", "parameter of the model", "parameter", names, &out_);
    add("curve_judged", Stored::integer, {"curve"}, "1",
        "the point of the curve, from 0, whose gradient is given", judged);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      add("curve_gradient_" + parameter(axis).name, Stored::real, {"curve", "parameter"}, "1",
          "how far the curve moves across itself with a parameter, where shafts mirror each other "
          "with both of a pair, at the first: in its unit over that one's",
          moved[axis]);
    }
  }

  void add_special() {
    std::vector<std::string> kinds;
    std::vector<double> curves;
    std::array<std::vector<double>, 2> places;
    for (std::size_t i = 0; i < findings_.curves.size(); ++i) {
      for (const SpecialPoint& special : findings_.curves[i].special) {
        kinds.push_back(name_of(special.kind));
        curves.push_back(static_cast<double>(i));
        for (std::size_t axis = 0; axis < 2; ++axis) places[axis].push_back(special.place[axis]);
      }
    }
    if (kinds.empty()) return;
    out_.dimensions.push_back({"special", kinds.size()});
    add_texts("special_kind", "what meets at a special point", "special", kinds, &out_);
    add("special_curve", Stored::integer, {"special"}, "1", "the curve it lies on, from 0", curves);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      add("special_" + parameter(axis).name, Stored::real, {"special"}, parameter(axis).unit,
          parameter(axis).meaning, places[axis]);
    }
  }

  void add_borders() {
    std::vector<double> labels, pairs;
    for (const ExplainedBorder& border : findings_.borders) {
      for (const int label : border.border.labels) labels.push_back(label);
      pairs.push_back(static_cast<double>(border.reasons.size()));
    }
    add("border_period", Stored::integer, {"border", "side"}, "1",
        "periods on both sides of a border of the map; 0: none", labels);
    add("border_pairs", Stored::integer, {"border"}, "1",
        "pairs of neighbouring pixels that the border parts", pairs);
    const std::array<std::string, kEdgeReasons> names = {
        "border_on_curve", "border_basin", "border_lost", "border_unsettled", "border_grazing"};
    for (std::size_t i = 0; i < kEdgeReasons; ++i) {
      const auto reason = static_cast<EdgeReason>(i);
      std::vector<double> counts;
      for (const ExplainedBorder& border : findings_.borders) {
        counts.push_back(static_cast<double>(border.count(reason)));
      }
      add(names[i], Stored::integer, {"border"}, "1", "of these pairs: " + describe(reason),
          counts);
    }
  }

  const BorderFindings& findings_;
  const Model& model_;
  const FileNotes notes_;
  std::vector<const BorderPoint*> points_;
  Dataset out_;
};

}  // namespace

Dataset dataset_of(const BorderFindings& findings, const Provenance& provenance) {
  return BorderDescription(findings).make(provenance);
}

void write_borders(const BorderFindings& findings, const std::string& path,
                   const Provenance& provenance) {
  write_dataset(dataset_of(findings, provenance), path);
}

bool holds_borders(const std::string& path) {
  const NetcdfFile file = NetcdfFile::open(path);
  return file.text_attribute(NC_GLOBAL, "content").value_or("") == kContentOfBorders;
}

}  // namespace gearsweep
