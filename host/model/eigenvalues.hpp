// Eigenvalues, of derivatives of maps for the most part. Whoever asks needs not compile the solver.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace gearsweep {

// The eigenvalues of a square matrix of finite numbers, `size` rows in column-major order; as they
// come out of the real Schur form, complex pairs next to each other, the one above the real axis
// first. Empty when the iteration does not converge.
std::vector<std::complex<double>> eigenvalues(const double* matrix, std::size_t size);

}  // namespace gearsweep
