#include "equations/detail/kernel_size.hpp"

#include <fmt/format.h>

#include <vector>

#include "expression/parse.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr double kMegabyte = 1e6;
constexpr double kMaxKernel = 4.0 * kMegabyte;

// What is worked out for the rate of a state: its value, its derivatives, and how each contact's
// force acts on it.
std::vector<NodeId> made_of_equation(const Formula& formula, const Lowered& lowered,
                                     std::size_t state) {
  const std::size_t states = formula.states.size();
  std::vector<NodeId> nodes = {lowered.equations[state]};
  for (std::size_t j = 0; j < states; ++j) nodes.push_back(lowered.jacobian[state * states + j]);
  for (const Contact& contact : lowered.contacts.list) nodes.push_back(contact.direction[state]);
  return nodes;
}

}  // namespace

void refuse_large_kernel(const ModelDefinition& definition, const Formula& formula,
                         const Lowered& lowered, const std::string& kernel) {
  const auto size = static_cast<double>(kernel.size());
  if (size <= kMaxKernel) return;
  const ExpressionText* largest = nullptr;
  std::string name;
  std::size_t most = 0;
  const auto compare = [&](const std::vector<NodeId>& nodes, const ExpressionText& text,
                           const std::string& what) {
    const std::size_t parts = parts_of(formula.graph, nodes).size();
    if (parts <= most) return;
    most = parts;
    largest = &text;
    name = what;
  };
  for (std::size_t i = 0; i < definition.equations.size(); ++i) {
    compare(made_of_equation(formula, lowered, i), definition.equations[i],
            fmt::format("the equation of '{}'", definition.states[i].name));
  }
  for (std::size_t i = 0; i < definition.signal_values.size(); ++i) {
    compare({lowered.signals[i]}, definition.signal_values[i],
            fmt::format("signal '{}'", definition.signals[i].name));
  }
  throw InputError(fmt::format(
      "{}:{}:{}: {} is too large: the kernel of this model has {:.1f} MB, and at most {:.0f} MB "
      "are "
      "compiled; products of many corners (backlash, stop, min, max, abs) make most of such "
      "kernels\n{}",
      largest->file, largest->line, largest->column, name, size / kMegabyte, kMaxKernel / kMegabyte,
      with_caret(largest->text, 0)));
}

}  // namespace gearsweep
