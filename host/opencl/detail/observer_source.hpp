// The part of a kernel program that is written for each study: the functions that call its
// observables by name.
#pragma once

#include <string>

#include "study/study.hpp"

namespace gearsweep {

// The text of observers.h (kernels/sweep.cl includes it): the observables that the study asks for,
// what they keep between rounds, and observers_init, _step, _end_period, _finish, _load and _store.
std::string observers_header(const Study& study);

}  // namespace gearsweep
