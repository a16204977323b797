#include "equations/detail/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {
namespace {

// A study holds the numbers of all.
constexpr std::size_t kMaxTables = 16;

}  // namespace

void refuse_states(const TableCall& call, const Formula& formula) {
  const std::vector<NodeId> parts = parts_of(formula.graph, {call.argument});
  for (const NodeId state : formula.states) {
    if (std::ranges::find(parts, state) == parts.end()) continue;
    throw ExpressionError(call.argument_at,
                          fmt::format("a table may be read at a phase alone, not at a state '{}'",
                                      formula.graph[state].symbol));
  }
}

std::shared_ptr<const PeriodicTable> Tables::read(const TableCall& call, const Formula& formula) {
  refuse_states(call, formula);
  std::shared_ptr<const PeriodicTable>& table = known_[{call.file, call.interpolation}];
  if (table == nullptr) {
    if (!points_of_) throw ExpressionError(call.file_at, "there are no tables here");
    if (known_.size() > kMaxTables) {
      throw ExpressionError(call.file_at,
                            fmt::format("a model reads at most {} tables", kMaxTables));
    }
    try {
      table = std::make_shared<const PeriodicTable>(call.file, points_of_(call.file),
                                                    call.interpolation);
    } catch (const InputError& error) {
      throw ExpressionError(call.file_at, error.what());
    }
  }
  return table;
}

}  // namespace gearsweep
