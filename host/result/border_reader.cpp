#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "borders/border_search.hpp"
#include "model/error.hpp"
#include "result/border_file.hpp"
#include "result/detail/border_names.hpp"
#include "result/detail/netcdf_file.hpp"

namespace gearsweep {
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
  [[noreturn]] void refuse() const {
    throw InputError(
        fmt::format("'{}' holds no curves; give a file that 'gearsweep curves' wrote", path_));
  }

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
