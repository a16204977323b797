#include "study/detail/spectrum_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/detail/load_factor.hpp"
#include "study/detail/toml_access.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr double kRounding = 1e-3;  // of a sum of shares that are written with three digits

}  // namespace

void read_spectrum(const toml::table& root, Study* study) {
  const toml::table* const points = root["points"].as_table();
  if (points == nullptr) return;
  TableReader reader(points, study_table("points"));
  const toml::node* const slope = reader.find("slope");
  const std::vector<Swept>& columns = study->axes.back().others;
  const auto shares = std::ranges::find(columns, kTimeShare, &Swept::name);
  if (shares == columns.end()) {
    if (slope == nullptr) return;
    fail_at(*slope, fmt::format("slope is of a load spectrum, which has a column {}", kTimeShare));
  }
  if (study->axes.size() > 1) {
    const Axis& axis = study->axes.front();
    // A key of a drawing has another name there than on an axis.
    const std::string setting =
        axis.is_list ? ""
                     : fmt::format(", as in --set {}.{}=VALUE",
                                   axis.is_state ? "initial" : "parameters", axis.name);
    fail_at(*root.get("axes"),
            fmt::format("a load spectrum is answered as a whole, so no axis can stand beside it: "
                        "leave out [[axes]], and run the study for each value of {}{}; without the "
                        "column time_share each point of the list has all values of the axis",
                        axis.name, setting));
  }
  LoadSpectrum spectrum{shares->values, reader.number("slope", kUsualSlope)};
  const double sum = std::accumulate(spectrum.shares.begin(), spectrum.shares.end(), 0.0);
  if (!(sum > 0.0)) fail_at(*points, fmt::format("no point has a {} above 0", kTimeShare));
  for (double& share : spectrum.shares) share /= sum;
  if (std::abs(sum - 1.0) > kRounding) {
    study->notices.push_back(
        fmt::format("{}: the shares of time add up to {:.6g}, not to 1; each is divided by that",
                    place_of(*points), sum));
  }
  study->spectrum = std::move(spectrum);
}

std::vector<std::string> spectrum_quantities(const Model& model) {
  const std::vector<Quantity> offered = offered_quantities(model);
  std::vector<std::string> wanted;
  const auto add = [&](const std::string& name) {
    const bool is_there = std::ranges::find(offered, name, &Quantity::name) != offered.end();
    if (is_there) wanted.push_back(name);
  };
  for (const LoadFactor& factor : load_factors(model)) {
    add(factor.force + "_max");
    add(factor.quantity.name);
  }
  for (const Quantity& quantity : offered) {
    if (quantity.name.ends_with("contact_class")) wanted.push_back(quantity.name);
  }
  return wanted;
}

}  // namespace gearsweep
