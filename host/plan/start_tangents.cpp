#include "plan/start_tangents.hpp"

namespace gearsweep {

std::vector<double> start_tangents(std::size_t vectors, const Model& model) {
  const std::size_t states = model.perturbed_states();
  std::vector<double> normal(states);
  double squares = 0.0;
  for (std::size_t i = 0; i < states; ++i) {
    normal[i] = 1.0 / static_cast<double>(i + 1);
    squares += normal[i] * normal[i];
  }
  std::vector<double> out;
  out.reserve(vectors * states);
  for (std::size_t vector = 0; vector < vectors; ++vector) {
    for (std::size_t state = 0; state < states; ++state) {
      const double unit = vector == state ? 1.0 : 0.0;
      out.push_back(unit - 2.0 * normal[vector] * normal[state] / squares);
    }
    out.insert(out.end(), model.clocks, 0.0);
  }
  return out;
}

}  // namespace gearsweep
