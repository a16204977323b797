// Where a motion that nothing drives is looked at: at the first section of its model (SectionInfo);
// of a model without one, where the first state that is no angle is largest.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/held_field.hpp"
#include "model/model.hpp"

namespace gearsweep {

// "where x is largest", "where theta goes up through 0".
std::string place_of_returns(const Model& model);
// "1 return to where x is largest".
std::string describe_returns(const Model& model, std::size_t count);

// What rises through 0 where a motion returns.
class ReturnLevel {
 public:
  // Both must outlive it.
  ReturnLevel(const Model& model, HeldField* field);

  // 0 where rounding alone makes it another number.
  double operator()(const double* coefs, const double* x);

 private:
  const Model& model_;
  HeldField* field_;
  std::vector<double> values_;  // signals, or rates
};

// Counts the returns of a motion from one moment to the next.
class ReturnCount {
 public:
  void take(double level);
  std::size_t so_far() const { return count_; }
  // Where the way ends, it begins again: of a return at that moment one is counted.
  std::size_t of_closed_way() const;

 private:
  std::vector<double> ends_;  // the first level and the last
  std::size_t count_ = 0;
};

}  // namespace gearsweep
