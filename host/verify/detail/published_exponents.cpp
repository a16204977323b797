#include "verify/detail/published_exponents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "study/builtin_models.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kStarts = 64;

}  // namespace

// With 64 starts, `record` makes the standard error of the mean a fifth of the tolerance or less.
const std::vector<PublishedExponents>& published_exponents() {
  static const std::vector<PublishedExponents> kRows = {
      {"lorenz",
       "lorenz",
       "classic",
       0.0,
       "y = -0.01, z = 9.0",
       {0.9056, 0.0, -14.5723},
       0.003,
       -41.0 / 3.0,
       100,
       2000},
      {"rossler",
       "rossler",
       "classic",
       -9.0,
       "",
       {0.0714, 0.0, -5.3943},
       0.0015,
       std::nullopt,
       40,
       4000},
      {"ueda", "duffing", "ueda", 2.5, "", {0.1034, -0.1534}, 0.003, -0.05, 160, 1000},
      {"two_well", "duffing", "two_well", 0.2, "", {0.1572, -0.4072}, 0.004, -0.25, 128, 1000},
      {"pendulum", "pendulum", "sprott", 0.0, "", {0.1414, -0.1914}, 0.005, -0.05, 160, 1000},
      {"vanderpol", "vanderpol", "sprott", -1.9, "", {0.1933}, 0.005, std::nullopt, 256, 1000},
      {"jerk", "jerk", "classic", 0.0, "v = -0.7", {0.0362, 0.0, -0.6362}, 0.003, -0.6, 20, 4000},
  };
  return kRows;
}

const PublishedExponents& published_exponents_of(const std::string& name) {
  const std::vector<PublishedExponents>& rows = published_exponents();
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const PublishedExponents& row) { return row.name == name; });
  if (found == rows.end()) throw std::logic_error("there are no published exponents of " + name);
  return *found;
}

std::string study_of(const PublishedExponents& row, std::size_t steps_per_period,
                     std::size_t record) {
  const std::string first_state = find_model(row.model)->states.front().name;
  return fmt::format(
      "[model]\nname = '{}'\npreset = '{}'\n[[axes]]\nname = '{}'\nfrom = {}\nto = {}\ncount = "
      "{}\n[initial]\nstate = {{{}}}\n[integrate]\nsettle = 200\nsteps_per_period = {}\nrecord = "
      "{}\n[observe]\nquantities = ['lyapunov_spectrum']\n",
      row.model, row.preset, first_state, row.first, row.first + 0.001 * (kStarts - 1), kStarts,
      row.state, steps_per_period, record);
}

std::vector<double> mean_exponents(const SweepResult& result) {
  const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
  const std::size_t points = result.status.size();
  std::vector<double> mean(spectrum.size() / points, 0.0);
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    mean[i % mean.size()] += spectrum[i] / static_cast<double>(points);
  }
  return mean;
}

std::vector<Compared> compare_exponents(const PublishedExponents& row, const SweepResult& result) {
  const std::vector<double> found = mean_exponents(result);
  std::vector<Compared> compared;
  for (std::size_t i = 0; i < row.exponents.size(); ++i) {
    compared.push_back({fmt::format("exponent {} of {}", i + 1, row.name), row.exponents[i],
                        found[i], row.tolerance});
  }
  return compared;
}

}  // namespace gearsweep
