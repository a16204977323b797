#include "borders/held_orbits.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace gearsweep {
namespace {

constexpr double kCloseEnough = 1e-9;  // of the states' sizes
constexpr double kSameState = 1e-5;    // of these sizes: it is back
constexpr int kMaxSteps = 10;

}  // namespace

Eigen::VectorXd residual_of(const ParameterPlane& plane, const OrbitAnswer& answer,
                            const Eigen::VectorXd& state, const Eigen::VectorXd& sizes) {
  Eigen::VectorXd out = answer.image - state;
  for (const std::size_t angle : plane.model->angles) {
    double& turn = out[static_cast<Eigen::Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  return out.cwiseQuotient(sizes);
}

std::vector<bool> return_sooner(const ParameterPlane& plane, OrbitMap* map,
                                const std::vector<HeldOrbit>& orbits) {
  std::vector<std::size_t> owners;
  std::vector<OrbitQuery> queries;
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    for (const std::size_t prime : {2U, 3U, 5U, 7U, 11U, 13U}) {
      if (orbits[i].period % prime != 0) continue;
      const PlanePlace& place = orbits[i].place;
      owners.push_back(i);
      queries.push_back({{place.begin(), place.end()}, orbits[i].state, orbits[i].period / prime});
    }
  }
  std::vector<bool> out(orbits.size(), false);
  if (queries.empty()) return out;
  const auto answers = map->answer(queries);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const HeldOrbit& orbit = orbits[owners[i]];
    if (!answers[i]) continue;
    const double off =
        residual_of(plane, *answers[i], orbit.state, orbit.sizes).cwiseAbs().maxCoeff();
    if (off < kSameState) out[owners[i]] = true;
  }
  return out;
}

std::vector<std::optional<HeldOrbit>> hold_orbits(const ParameterPlane& plane, OrbitMap* map,
                                                  const std::vector<HeldOrbit>& guesses,
                                                  double reach) {
  std::vector<std::optional<HeldOrbit>> out(guesses.size());
  std::vector<HeldOrbit> at = guesses;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    if (plane.is_allowed(guesses[i].place)) open.push_back(i);
  }
  for (int step = 0; step < kMaxSteps && !open.empty(); ++step) {
    std::vector<OrbitQuery> queries;
    for (const std::size_t i : open) {
      queries.push_back({{at[i].place.begin(), at[i].place.end()}, at[i].state, at[i].period});
    }
    const std::vector<std::optional<OrbitAnswer>> answers = map->answer(queries);
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const std::size_t i = open[k];
      if (!answers[k]) continue;
      const Eigen::VectorXd residual = residual_of(plane, *answers[k], at[i].state, at[i].sizes);
      const Eigen::Index n = residual.size();
      const Eigen::MatrixXd monodromy = at[i].sizes.cwiseInverse().asDiagonal() *
                                        answers[k]->derivative * at[i].sizes.asDiagonal();
      if (residual.cwiseAbs().maxCoeff() <= kCloseEnough) {
        at[i].multipliers = monodromy.eigenvalues();
        out[i] = at[i];
        continue;
      }
      const Eigen::VectorXd way =
          (Eigen::MatrixXd::Identity(n, n) - monodromy).fullPivLu().solve(residual);
      at[i].state += at[i].sizes.cwiseProduct(way);
      const double gone =
          (at[i].state - guesses[i].state).cwiseQuotient(at[i].sizes).cwiseAbs().maxCoeff();
      if (std::isfinite(gone) && gone <= reach) left.push_back(i);
    }
    open = left;
  }
  return out;
}

}  // namespace gearsweep
