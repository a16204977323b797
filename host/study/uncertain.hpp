// Parameters that are known within tolerances: each point is integrated with many draws of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gearsweep {

// One of them, with its draws (study.hpp).
struct UncertainParameter;

inline constexpr std::size_t kUsualSamples = 200;

// What a study says of them. The draws are the same for all points (common random numbers), so that
// neighbours differ by their own parameters alone.
struct Uncertain {
  // Draws of each point, but for Sobol indices: those take as many of each of their matrices. 0: no
  // parameter is uncertain.
  std::size_t samples = 0;
  std::size_t seed = 1;
  std::vector<double> percentiles;  // in percent, increasing
  // A draw starts from where the motion of the nominal parameters ends at its point, so that it
  // needs to settle what its tolerances change alone. Otherwise it starts as any point does.
  bool starts_at_nominal = false;
  bool sobol = false;  // indices of first order and total ones are asked for
  bool keep = false;   // the values in each draw are part of the result
  std::vector<UncertainParameter> parameters;

  // Trajectories of a point beside that of the nominal parameters. With Sobol indices the rows of
  // Saltelli's matrices A, B, and for each parameter A with the column of B.
  std::size_t draws() const;
  // Those of them that are draws of the distributions as given, independent of each other: the
  // first ones.
  std::size_t independent_draws() const;
};

}  // namespace gearsweep
