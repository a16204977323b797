#include "report/detail/equal_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/detail/html.hpp"
#include "report/detail/names.hpp"
#include "report/detail/words.hpp"

namespace gearsweep {
namespace {

// How much of a value, or of the time, the shares of equal parts differ where their motion is not
// periodic: the stretch that is recorded is finite.
constexpr double kByChance = 0.05;

// The largest difference at any speed, of the value; of shares in shares. Infinity where one has no
// value and the other has one, and of classes that differ.
double difference(const ResultMap& first, const ResultMap& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < first.values.size(); ++i) {
    const double a = first.values[i], b = other.values[i];
    if (a == b || (std::isnan(a) && std::isnan(b))) continue;
    if (!std::isfinite(a) || !std::isfinite(b) || !first.flags.empty()) return HUGE_VAL;
    const double unit = is_share(first) ? 1.0 : std::max(std::abs(a), std::abs(b));
    most = std::max(most, std::abs(a - b) / unit);
  }
  return most;
}

// Of all sides.
double difference(const Sides& sides, const std::string& first, const std::string& other) {
  double most = 0.0;
  for (const ReportFindings& findings : sides) {
    most = std::max(most, difference(findings.over_speed("line.nc", first),
                                     findings.over_speed("line.nc", other)));
  }
  return most;
}

bool all_know(const Sides& sides, const std::string& quantity) {
  return std::ranges::all_of(sides, [&](const ReportFindings& findings) {
    return std::ranges::find(findings.quantities, quantity) != findings.quantities.end();
  });
}

// Those of parts 2, 3, ... that go with the quantity of part 1.
std::vector<std::string> others_of(const Sides& sides, const std::string& quantity) {
  std::vector<std::string> others;
  const std::optional<NumberedQuantity> first = numbered(quantity);
  if (!first || first->number != 1) return others;
  for (int number = 2;; ++number) {
    const NumberedQuantity other = {first->before, first->after, number};
    const std::string name = other.stem() + other.after;
    const bool goes_on =
        all_know(sides, name) && std::ranges::all_of(sides, [&](const ReportFindings& findings) {
          return are_of_equal_parts(*findings.study.model, *first, other);
        });
    if (!goes_on) return others;
    others.push_back(name);
  }
}

void rename(const std::map<std::string, std::string>& first_of, std::string* name) {
  const auto found = first_of.find(*name);
  if (found != first_of.end()) *name = found->second;
}

void join(const std::map<std::string, std::string>& first_of, ReportFindings* findings) {
  const auto is_joined = [&](const std::string& name) { return first_of.contains(name); };
  std::erase_if(findings->quantities, is_joined);
  std::erase_if(findings->apart, is_joined);
  for (std::string* name : {&findings->force, &findings->load_factor, &findings->iso_load_factor,
                            &findings->vibration, &findings->ranking}) {
    rename(first_of, name);
  }
  if (findings->mesh.empty()) return;
  for (const ChannelInfo& force : findings->study.model->signals_of(Role::mesh_force)) {
    if (findings->force == force.name + "_max") {
      findings->mesh = force_words(force, findings->count_of(findings->force));
    }
  }
}

}  // namespace

void join_equal_parts(Sides* sides) {
  std::map<std::string, std::string> first_of;
  std::map<std::string, int> alike;
  double most = 0.0;
  for (const std::string& quantity : sides->front().quantities) {
    if (!all_know(*sides, quantity)) continue;
    const std::vector<std::string> others = others_of(*sides, quantity);
    double own = 0.0;
    for (const std::string& other : others) {
      own = std::max(own, difference(*sides, quantity, other));
    }
    if (others.empty() || !(own <= kByChance)) continue;
    most = std::max(most, own);
    for (const std::string& other : others) first_of[other] = quantity;
    alike[quantity] = static_cast<int>(others.size()) + 1;
  }
  for (ReportFindings& findings : *sides) {
    findings.alike = alike;
    findings.unlike = most;
    join(first_of, &findings);
  }
}

std::string equal_parts_html(const ReportFindings& findings) {
  constexpr double kShown = 5e-4;  // four digits
  if (findings.unlike < kShown) return "";
  return fmt::format(
      "Equal parts are shown as one, by the first of them. At some speeds the others differ from "
      "it, by at most {}, as their motion is not periodic there, or not the same for each.",
      html_percent(findings.unlike));
}

}  // namespace gearsweep
