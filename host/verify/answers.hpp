// The known answers of a model, computed anew.
#pragma once

#include <string>
#include <vector>

#include "verify/compared.hpp"
#include "verify/verify.hpp"

namespace gearsweep {

// One number of an answer beside what came out.
struct ComputedAnswer {
  const KnownAnswer* answer = nullptr;
  Compared number;  // what: "x_max", of a list "lyapunov_spectrum[2]"
};

// All numbers of the model's answers, in the order of its file. model_key: what [model] of a study
// calls it, "name = 'duffing'" or "file = 'mine.toml'". What has the same place but for its numbers
// is computed by one study. Throws InputError, and what the sweep throws.
std::vector<ComputedAnswer> compute_answers(const Model& model, const std::string& model_key,
                                            const Subject& subject);

}  // namespace gearsweep
