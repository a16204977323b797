// The reference engine's observables of a contact (kernels/observables/contact.h and
// contact_impacts.h): bisection finds where a flank is lost and regained inside a step.
#pragma once

#include <memory>

#include "model/model.hpp"
#include "reference/detail/observables.hpp"

namespace gearsweep {

// Fractions of time, losses and class.
std::unique_ptr<ReferenceObservable> make_contact(const Model& model, const ContactInfo& contact);
// Impacts on the drive flank and on the back flank, speed of the hardest, largest depth.
std::unique_ptr<ReferenceObservable> make_contact_impacts(const Model& model,
                                                          const ContactInfo& contact);

}  // namespace gearsweep
