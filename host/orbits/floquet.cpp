#include "orbits/floquet.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "model/eigenvalues.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kCarried = 1e-2;  // of what a period makes of magnitudes: the same for residuals

// What sizes of all states become in each of them, at most.
VectorXd carried(const VectorXd& sizes, const MatrixXd& monodromy) {
  return monodromy.cwiseAbs() * sizes;
}

VectorXcd eigenvalues_of(const MatrixXd& matrix) {
  if (matrix.size() == 0) return {};
  const std::vector<std::complex<double>> found =
      eigenvalues(matrix.data(), static_cast<std::size_t>(matrix.rows()));
  if (found.empty()) throw RunError("the multipliers of an orbit cannot be computed");
  return Eigen::Map<const VectorXcd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

// A complex pair has one modulus: the member above the real axis comes first.
void sort_by_modulus(VectorXcd* multipliers) {
  std::stable_sort(multipliers->begin(), multipliers->end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
}

// A way that returns, with all but its multipliers.
Orbit without_multipliers(OrbitKind kind, const VectorXd& state, const PeriodImage& image) {
  Orbit orbit;
  orbit.kind = kind;
  orbit.state = state;
  orbit.monodromy = image.monodromy;
  orbit.grazes = image.grazes;
  orbit.sizes = sizes_of(image);
  orbit.extent = image.extent;
  return orbit;
}

}  // namespace

std::string name_of(OrbitKind kind) {
  switch (kind) {
    case OrbitKind::forced:
      return "forced";
    case OrbitKind::cycle:
      return "cycle";
    case OrbitKind::equilibrium:
      return "equilibrium";
  }
  return "";
}

std::string name_of(Bifurcation kind, OrbitKind of) {
  switch (kind) {
    case Bifurcation::fold:
      return "fold";
    case Bifurcation::branching:
      return of == OrbitKind::forced ? "symmetry breaking" : "branch point";
    case Bifurcation::flip:
      return "flip";
    case Bifurcation::neimark_sacker:
      return "Neimark-Sacker";
    case Bifurcation::hopf:
      return "Hopf";
  }
  return "";
}

bool Orbit::stable() const { return unstable_count() == 0; }

std::size_t Orbit::unstable_count() const {
  const auto count = kind == OrbitKind::equilibrium
                         ? (multipliers.real().array() > 0.0).count()
                         : (multipliers.cwiseAbs().array() > 1.0).count();
  return static_cast<std::size_t>(count);
}

const Graze* Orbit::graze_within(const VectorXd& errors) const {
  const Graze* nearest = nullptr;
  double share = 1.0;  // of what the distance is known by
  for (const Graze& graze : grazes) {
    if (!std::isfinite(graze.distance)) continue;
    const double known = graze.gradient.cwiseAbs().dot(errors);
    if (graze.distance >= share * known) continue;
    share = graze.distance / known;
    nearest = &graze;
  }
  return nearest;
}

std::optional<Nearest> nearest_bifurcation(const Orbit& orbit) {
  if (orbit.multipliers.size() == 0) return std::nullopt;
  const bool rests = orbit.kind == OrbitKind::equilibrium;
  const auto margin = [&](const std::complex<double>& m) {
    return rests ? -m.real() : 1.0 - std::abs(m);
  };
  const std::complex<double> nearest = *std::min_element(
      orbit.multipliers.begin(), orbit.multipliers.end(),
      [&](const auto& a, const auto& b) { return std::fabs(margin(a)) < std::fabs(margin(b)); });
  Nearest out;
  out.of = orbit.kind;
  out.multiplier = nearest;
  out.margin = margin(nearest);
  if (nearest.imag() != 0.0) {
    out.kind = rests ? Bifurcation::hopf : Bifurcation::neimark_sacker;
  } else {
    out.kind = rests || nearest.real() > 0.0 ? Bifurcation::fold : Bifurcation::flip;
  }
  return out;
}

std::string name_of(const Nearest& nearest) {
  if (nearest.kind != Bifurcation::fold) return name_of(nearest.kind, nearest.of);
  return "fold or " + name_of(Bifurcation::branching, nearest.of);
}

Orbit make_orbit(const VectorXd& state, const PeriodImage& image, std::size_t period) {
  Orbit orbit = without_multipliers(OrbitKind::forced, state, image);
  orbit.period = period;
  orbit.multipliers = eigenvalues_of(image.monodromy);
  sort_by_modulus(&orbit.multipliers);
  return orbit;
}

Orbit make_cycle(const VectorXd& state, const PeriodImage& image, const TimeSpan& span,
                 const VectorXd& rate, std::size_t returns) {
  Orbit orbit = without_multipliers(OrbitKind::cycle, state, image);
  orbit.period = std::max<std::size_t>(returns, 1);
  orbit.duration = span.duration;
  orbit.steps = span.steps;
  // In a basis of which the first vector is along the motion, the rest is the return map's.
  const VectorXd direction = rate.cwiseQuotient(orbit.sizes);
  const MatrixXd basis = Eigen::HouseholderQR<MatrixXd>(direction).householderQ();
  const MatrixXd scaled =
      orbit.sizes.cwiseInverse().asDiagonal() * image.monodromy * orbit.sizes.asDiagonal();
  const MatrixXd turned = basis.transpose() * scaled * basis;
  const Eigen::Index across = state.size() - 1;
  orbit.along = turned(0, 0);
  orbit.slack = turned.col(0).tail(across).norm() * turned.row(0).tail(across).norm();
  orbit.multipliers = eigenvalues_of(turned.bottomRightCorner(across, across));
  sort_by_modulus(&orbit.multipliers);
  return orbit;
}

Orbit make_equilibrium(const VectorXd& state, const MatrixXd& jacobian, const VectorXd& sizes) {
  Orbit orbit;
  orbit.kind = OrbitKind::equilibrium;
  orbit.state = state;
  orbit.monodromy = jacobian;
  orbit.sizes = sizes;
  orbit.extent = {state, state};
  // The same in the sizes of states, where rounding weighs least.
  orbit.multipliers =
      eigenvalues_of(sizes.cwiseInverse().asDiagonal() * jacobian * sizes.asDiagonal());
  std::stable_sort(orbit.multipliers.begin(), orbit.multipliers.end(),
                   [](const auto& a, const auto& b) { return a.real() > b.real(); });
  return orbit;
}

VectorXd above_zero(const VectorXd& sizes) {
  return sizes.unaryExpr([](double size) { return size > 0.0 ? size : 1.0; });
}

VectorXd spread_of(const VectorXd& sizes, const MatrixXd& jacobian, double share) {
  if (!jacobian.allFinite()) return sizes;
  const double fastest = eigenvalues_of(jacobian).cwiseAbs().maxCoeff();
  VectorXd spread = sizes;
  // A chain of states is no longer than all of them.
  for (Eigen::Index i = 0; i < sizes.size() && fastest > 0.0; ++i) {
    spread = spread.cwiseMax(share / fastest * (jacobian.cwiseAbs() * spread));
  }
  return spread;
}

VectorXd sizes_of(const Extent& extent) {
  return above_zero(extent.swing().cwiseMax(kMinSize * extent.reach()));
}

VectorXd sizes_of(const PeriodImage& image) {
  const VectorXd swing = image.extent.swing();
  return above_zero(swing.cwiseMax(kMinSize * image.extent.reach())
                        .cwiseMax(kMinSize * carried(swing, image.monodromy)));
}

VectorXd rounding_sizes(const PeriodImage& image, const VectorXd& sizes) {
  const VectorXd reach = image.extent.reach();
  return sizes.cwiseMax(reach).cwiseMax(kCarried * carried(reach, image.monodromy));
}

double offset_of(const Extent& extent, const VectorXd& sizes) {
  return extent.reach().cwiseQuotient(sizes).maxCoeff();
}

double stretch_of(const MatrixXd& matrix, const VectorXd& sizes) {
  return (sizes.cwiseInverse().asDiagonal() * matrix * sizes.asDiagonal()).cwiseAbs().maxCoeff();
}

double distance_of(const VectorXd& difference, const VectorXd& sizes) {
  return difference.cwiseQuotient(sizes).cwiseAbs().maxCoeff();
}

}  // namespace gearsweep
