// The reference engine's Lyapunov exponents, by Householder's QR decomposition of all tangent
// vectors once a period (Eckmann and Ruelle, Reviews of Modern Physics 57 (1985) 617-656). Between
// two decompositions the vectors keep 16 digits in all, so a period must not be so long that the
// smallest exponent's share of them vanishes beside the largest's.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "reference/detail/observables.hpp"

namespace gearsweep {

// Gives a trajectory the first `count` tangent vectors of start_tangents() (none: nothing changes).
void set_start_tangents(std::size_t count, const Model& model, Trajectory* trajectory);

// Makes the tangent vectors orthonormal again. Returns the logarithms of how far each had grown in
// the directions orthogonal to those before it; empty when there are none.
Eigen::VectorXd orthonormalize_tangents(Trajectory* trajectory);

// Largest exponent, its standard error (NaN with one block), largest exponent times the period.
// is_clockless: of a model that nothing drives, whose periods count by a window.
std::unique_ptr<ReferenceObservable> make_lyapunov_max(bool is_clockless = false);
// All exponents, the largest first.
std::unique_ptr<ReferenceObservable> make_lyapunov_spectrum(bool is_clockless = false);
std::unique_ptr<ReferenceObservable> make_kaplan_yorke(const Model& model);

}  // namespace gearsweep
