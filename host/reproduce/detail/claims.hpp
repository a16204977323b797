// What the paper (Chen et al. 2011) says of its figures, each with the rule that judges it.
#pragma once

#include <string>
#include <vector>

#include "reproduce/detail/measured.hpp"

namespace gearsweep {

enum class Verdict { holds, in_part, does_not_hold };

// "holds", "holds in part", "does not hold".
std::string name_of(Verdict verdict);

struct Judgement {
  int figure = 0;
  std::string claim;     // in our words
  std::string rule;      // what "holds" asks for, and, where there is one, "in part"
  std::string measured;  // in words, with the numbers
  Verdict verdict = Verdict::does_not_hold;
};

std::vector<Judgement> judge(const MeasuredFigures& measured);

}  // namespace gearsweep
