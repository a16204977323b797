// The tables that the expressions of a model read.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "equations/definition.hpp"
#include "equations/detail/formula.hpp"
#include "expression/parse.hpp"

namespace gearsweep {

// Throws ExpressionError where a table or curve is read at a state.
void refuse_states(const TableCall& call, const Formula& formula);

class Tables {
 public:
  explicit Tables(const TablePoints& points_of) : points_of_(points_of) {}

  // What a text of the formula reads. Throws ExpressionError where there are no such numbers, or
  // where their place is no phase alone.
  std::shared_ptr<const PeriodicTable> read(const TableCall& call, const Formula& formula);

 private:
  using Key = std::pair<std::string, Interpolation>;

  const TablePoints& points_of_;
  std::map<Key, std::shared_ptr<const PeriodicTable>> known_;
};

}  // namespace gearsweep
