#include "result/border_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <string_view>

#include "borders/border_search.hpp"
#include "model/error.hpp"
#include "result/detail/dataset_file.hpp"
#include "result/detail/file_notes.hpp"
#include "result/detail/netcdf_file.hpp"

namespace gearsweep {
namespace {

constexpr const char* kContentOfBorders = "border curves of gearsweep";

// A parameter with the name of something else here gives way.
std::string variable_of(const std::string& parameter) {
  constexpr std::array<std::string_view, 9> kOwn = {"point",      "state", "section",
                                                    "multiplier", "angle", "stable",
                                                    "residual",   "side",  "parameter"};
  const bool is_taken = std::ranges::find(kOwn, parameter) != kOwn.end() ||
                        parameter.starts_with("curve") || parameter.starts_with("special") ||
                        parameter.starts_with("border") || parameter.starts_with("multiplier_") ||
                        parameter.starts_with("state_");
  return is_taken ? "parameter_" + parameter : parameter;
}

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

[[noreturn]] void refuse_no_curves(const std::string& path) {
  throw InputError(
      fmt::format("'{}' holds no curves; give a file that 'gearsweep curves' wrote", path));
}

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

namespace {

constexpr double kMaxPeriod = 4096.0;  // far above what a search looks at

// The variables of a file, and below those of a table, in one way. Where there is no such variable
// nothing is given.
class FileSource {
 public:
  explicit FileSource(const std::string& path) : file_(NetcdfFile::open(path)) {}

  std::string note(const std::string& name) const {
    return file_.text_attribute(NC_GLOBAL, name).value_or("");
  }

  std::optional<double> steps() const {
    const std::vector<double> steps = file_.number_attribute(NC_GLOBAL, "steps_per_period");
    return steps.size() == 1 ? std::optional(steps.front()) : std::nullopt;
  }

  std::optional<std::vector<std::string>> texts(const std::string& name) const {
    const int variable = file_.find_variable(name);
    return variable < 0 ? std::nullopt : std::optional(file_.read_texts(variable));
  }

  std::vector<std::size_t> shape(const std::string& name) const {
    std::vector<std::size_t> sizes;
    const int variable = file_.find_variable(name);
    if (variable < 0) return sizes;
    for (const int dimension : file_.dimensions_of(variable)) {
      sizes.push_back(file_.dimension_size(dimension));
    }
    return sizes;
  }

  // Of a shape that was asked for.
  std::vector<double> numbers(const std::string& name) const {
    const std::vector<std::size_t> sizes = shape(name);
    return file_.read(file_.find_variable(name), std::vector<std::size_t>(sizes.size()), sizes);
  }

 private:
  NetcdfFile file_;
};

class TableSource {
 public:
  explicit TableSource(const BorderTable& table) : table_(table) {}

  std::string note(const std::string& name) const {
    const auto found = table_.notes.find(name);
    return found == table_.notes.end() ? "" : found->second;
  }

  std::optional<double> steps() const { return table_.steps; }

  std::optional<std::vector<std::string>> texts(const std::string& name) const {
    const auto found = table_.texts.find(name);
    return found == table_.texts.end() ? std::nullopt : std::optional(found->second);
  }

  std::vector<std::size_t> shape(const std::string& name) const {
    const auto found = table_.numbers.find(name);
    return found == table_.numbers.end() ? std::vector<std::size_t>{} : found->second.shape;
  }

  std::vector<double> numbers(const std::string& name) const {
    return table_.numbers.at(name).elements;
  }

 private:
  const BorderTable& table_;
};

// Reads a file of curves; whatever is not as write_borders() leaves it refuses the file.
template <typename Source>
class BorderReader {
 public:
  BorderReader(const std::string& path, Source source) : path_(path), file_(std::move(source)) {}

  StoredCurves read() {
    if (note("content") != kContentOfBorders) refuse();
    StoredCurves out;
    out.x = note("x");
    out.y = note("y");
    out.states = texts("state");
    const std::optional<double> steps = file_.steps();
    if (!steps || !(*steps >= 1.0 && *steps <= 1e9)) refuse();
    out.steps = static_cast<std::size_t>(*steps);
    read_points(out);
    const std::vector<double> counts = row("curve_points"), periods = row("curve_period");
    const std::vector<double> errors = row("curve_step_error");
    const std::vector<std::string> kinds = texts("curve_kind");
    const std::vector<std::string> limits = texts("curve_limit");
    for (const std::size_t size : {kinds.size(), limits.size(), periods.size(), errors.size()}) {
      if (size != counts.size()) refuse();
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double left = static_cast<double>(places_.size() - next);
      if (!(counts[i] >= 0.0 && counts[i] <= left)) refuse();
      if (!(periods[i] >= 1.0 && periods[i] <= kMaxPeriod) || !is_kind(kinds[i])) refuse();
      const std::size_t end = next + static_cast<std::size_t>(counts[i]);
      out.curves.push_back({.kind = kinds[i],
                            .period = static_cast<int>(periods[i]),
                            .places = part(places_, next, end),
                            .is_stable = part(is_stable_, next, end),
                            .orbits = part(orbits_, next, end),
                            .limit = limits[i],
                            .step_error = errors[i]});
      next = end;
    }
    read_special(&out);
    return out;
  }

 private:
  [[noreturn]] void refuse() const { refuse_no_curves(path_); }

  std::string note(const char* name) const { return file_.note(name); }

  std::vector<std::string> texts(const std::string& name) const {
    std::optional<std::vector<std::string>> found = file_.texts(name);
    if (!found) refuse();
    return *std::move(found);
  }

  std::vector<double> row(const std::string& name) const {
    if (file_.shape(name).size() != 1) refuse();
    return file_.numbers(name);
  }

  // Of so many rows and columns, row by row.
  std::vector<double> matrix(const std::string& name, std::size_t rows, std::size_t columns) const {
    if (file_.shape(name) != std::vector{rows, columns}) refuse();
    return file_.numbers(name);
  }

  void read_points(const StoredCurves& out) {
    const std::vector<double> x = row(variable_of(out.x)), y = row(variable_of(out.y));
    const std::vector<double> stable = row("stable"), angles = row("angle"),
                              residuals = row("residual");
    for (const std::size_t size : {y.size(), stable.size(), angles.size(), residuals.size()}) {
      if (size != x.size()) refuse();
    }
    const std::size_t states = out.states.size();
    const std::vector<double> sections = matrix("section", x.size(), states),
                              real = matrix("multiplier_real", x.size(), states),
                              imag = matrix("multiplier_imag", x.size(), states);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i])) refuse();
      places_.emplace_back(x[i], y[i]);
      is_stable_.push_back(stable[i] == 1.0);
      StoredOrbit orbit{{}, {}, angles[i], residuals[i]};
      for (std::size_t k = i * states; k < (i + 1) * states; ++k) {
        if (!std::isfinite(sections[k])) refuse();
        orbit.state.push_back(sections[k]);
        orbit.multipliers.emplace_back(real[k], imag[k]);
      }
      orbits_.push_back(std::move(orbit));
    }
  }

  void read_special(StoredCurves* out) const {
    const std::optional<std::vector<std::string>> special = file_.texts("special_kind");
    if (!special) return;
    const std::vector<std::string>& names = *special;
    const std::vector<double> x = row("special_" + out->x), y = row("special_" + out->y);
    if (x.size() != names.size() || y.size() != names.size()) refuse();
    for (std::size_t i = 0; i < names.size(); ++i) {
      out->special.push_back({names[i], {x[i], y[i]}});
    }
  }

  static bool is_kind(const std::string& name) {
    constexpr std::array<BorderKind, 5> kKinds = {
        BorderKind::fold, BorderKind::flip, BorderKind::neimark_sacker,
        BorderKind::symmetry_breaking, BorderKind::grazing};
    return std::ranges::find(kKinds, name, [](BorderKind kind) { return name_of(kind); }) !=
           kKinds.end();
  }

  template <typename Element>
  static std::vector<Element> part(const std::vector<Element>& all, std::size_t from,
                                   std::size_t to) {
    const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    return {at(from), at(to)};
  }

  const std::string& path_;
  const Source file_;
  // Of all curves, one after the other.
  std::vector<std::pair<double, double>> places_;
  std::vector<bool> is_stable_;
  std::vector<StoredOrbit> orbits_;
};

}  // namespace

StoredCurves read_borders(const std::string& path) {
  return BorderReader(path, FileSource(path)).read();
}

StoredCurves read_borders(const BorderTable& table, const std::string& origin) {
  return BorderReader(origin, TableSource(table)).read();
}

}  // namespace gearsweep
