#include "study/detail/load_factor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gearsweep {
namespace {

// What a force between teeth carries on average: the parameter that it names. Where there is one
// force alone, it need not name the model's load; of several each may have its own.
std::optional<std::size_t> load_of(const Model& model, const ChannelInfo& force) {
  if (!force.load.empty()) return static_cast<std::size_t>(model.find_parameter(force.load));
  if (model.signals_of(Role::mesh_force).size() > 1) return std::nullopt;
  return model.parameter_of(Role::load);
}

}  // namespace

std::vector<LoadFactor> load_factors(const Model& model) {
  const std::vector<ChannelInfo> forces = model.signals_of(Role::mesh_force);
  std::vector<LoadFactor> factors;
  for (const ChannelInfo& force : forces) {
    const std::optional<std::size_t> load = load_of(model, force);
    if (!load) continue;
    Quantity quantity;
    quantity.name = forces.size() == 1 ? kLoadFactor : force.name + "_" + kLoadFactor;
    quantity.unit = "1";
    quantity.meaning = fmt::format("largest {} over the recorded periods, divided by {}",
                                   force.name, model.parameters[*load].name);
    quantity.divided_by = load;
    factors.push_back({quantity, force.name});
  }
  return factors;
}

std::string lack_of_load(const Model& model) {
  const std::vector<ChannelInfo> forces = model.signals_of(Role::mesh_force);
  if (forces.size() > 1) {
    return fmt::format(
        "model '{0}' has several forces between teeth, and each has a factor of its own, {1}_{2}, "
        "where its signal names the parameter that is its load: load = \"NAME\"",
        model.name, forces.front().name, kLoadFactor);
  }
  std::vector<std::string> lines;
  if (!model.parameter_of(Role::load)) {
    lines.emplace_back("a parameter is its load, as in\n  F = { value = 0.1, role = \"load\" }");
  }
  if (model.contact_force() == nullptr) {
    lines.emplace_back(
        "a signal is its force between teeth, as in\n"
        "  force = { expression = \"k*x\", role = \"mesh_force\" }");
  }
  if (lines.empty()) return "";
  return fmt::format("model '{}' has no {}: its file must say that {}", model.name, kLoadFactor,
                     fmt::join(lines, "\nand that "));
}

}  // namespace gearsweep
