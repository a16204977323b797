// gearsweep verify --zoo and --model: the known answers of models, a line for each number.
#pragma once

#include <string>
#include <vector>

#include "cli/detail/named_model.hpp"
#include "cli/detail/signal_watch.hpp"
#include "verify/verify.hpp"

namespace gearsweep {

// Computes and prints them; device: names it. The exit status of the command. Throws InputError
// where a model has no answers, RunError where the device has no fp64.
int check_answers(const std::vector<NamedModel>& models, const Subject& subject,
                  const std::string& device, bool as_json, SignalWatch* signals);

}  // namespace gearsweep
