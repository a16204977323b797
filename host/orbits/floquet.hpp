// Periodic orbits and equilibria, and what tells how far they are from each bifurcation: Floquet
// multipliers, the eigenvalues of the monodromy matrix, or the eigenvalues of the field's Jacobian
// (Y. A. Kuznetsov, Elements of Applied Bifurcation Theory, chapters 3, 5 and 10).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "orbits/period_map.hpp"

namespace gearsweep {

enum class OrbitKind {
  forced,       // its length is a whole number of forcing periods
  cycle,        // of a model without a phase: its length is its own
  equilibrium,  // of a model without a phase: it does not move
};

// "forced", "cycle", "equilibrium".
std::string name_of(OrbitKind kind);

// What happens when a multiplier crosses the unit circle, or an eigenvalue the imaginary axis.
enum class Bifurcation {
  fold,       // at +1 or 0, and the branch of orbits turns back
  branching,  // at +1 or 0, and the branch goes on: symmetry breaking (pitchfork), transcritical
  flip,       // at -1: the period doubles
  neimark_sacker,  // a complex pair: the orbit becomes a torus
  hopf,            // a complex pair of eigenvalues: cycles are born at the equilibrium
};

// "fold", "symmetry breaking", "flip", "Neimark-Sacker", "Hopf"; where nothing drives the model
// "branch point" for any branching.
std::string name_of(Bifurcation kind, OrbitKind of);

struct Orbit {
  OrbitKind kind = OrbitKind::forced;
  Eigen::VectorXd state;  // at phase 0; of a cycle anywhere on it
  // The smallest, in forcing periods; of a cycle, its returns (orbits/returns.hpp); 1 of an
  // equilibrium.
  std::size_t period = 1;
  double duration = 0.0;      // of the whole orbit, in dimensionless time; 0 of an equilibrium
  std::size_t steps = 0;      // that a cycle was computed with
  Eigen::MatrixXd monodromy;  // of an equilibrium, the field's Jacobian
  // Eigenvalues of the monodromy matrix, the largest modulus first: its Floquet multipliers. A
  // cycle has one that is 1, along itself: it stands in `along`, and these are those of its return
  // map. Of an equilibrium: eigenvalues of the Jacobian, the largest real part first.
  Eigen::VectorXcd multipliers;
  std::optional<double> along;
  // By so much multipliers of a cycle may be off: what is carried round along it comes back a
  // little across it, which is an error, times what from across comes back along it.
  double slack = 0.0;
  std::vector<Graze> grazes;
  // What counts as the size of each state, above 0: see sizes_of. Residuals and distances are
  // judged in these sizes, so that no unit of a state or of the time decides anything.
  Eigen::VectorXd sizes;
  Extent extent;

  bool stable() const;
  // How many multipliers lie outside the unit circle, or eigenvalues right of the imaginary axis.
  std::size_t unstable_count() const;
  // The turn nearest to a limit of a backlash among those that are nearer to it than states are
  // known; null when there is none. errors: of each state.
  const Graze* graze_within(const Eigen::VectorXd& errors) const;
};

// The multiplier nearest to the unit circle, or the eigenvalue nearest to the imaginary axis, and
// the bifurcation that it would make by crossing it.
struct Nearest {
  Bifurcation kind = Bifurcation::fold;  // fold stands for any crossing at +1 or 0
  OrbitKind of = OrbitKind::forced;
  std::complex<double> multiplier;
  double margin = 0.0;  // 1 - modulus; of an eigenvalue, its real part with the sign changed
};
// Nothing of a cycle that has no multiplier but the one along it.
std::optional<Nearest> nearest_bifurcation(const Orbit& orbit);

// A crossing at +1 or 0 is a fold or a branching; one orbit does not tell which.
std::string name_of(const Nearest& nearest);

// The orbit through a state that `image` brings back; multipliers computed.
Orbit make_orbit(const Eigen::VectorXd& state, const PeriodImage& image, std::size_t period);
// The same of a cycle; rate: of the motion at the state.
Orbit make_cycle(const Eigen::VectorXd& state, const PeriodImage& image, const TimeSpan& span,
                 const Eigen::VectorXd& rate, std::size_t returns);
// sizes: magnitudes whose rounding is that of the state.
Orbit make_equilibrium(const Eigen::VectorXd& state, const Eigen::MatrixXd& jacobian,
                       const Eigen::VectorXd& sizes);

// The size of each state on a way: half of its extent there, which does not know from where a state
// is counted; at least a millionth of its magnitude, and of what the others' sizes become in it; 1
// where that is 0.
Eigen::VectorXd sizes_of(const PeriodImage& image);
// The same by the extent alone.
Eigen::VectorXd sizes_of(const Extent& extent);
// A state's size is at least this of its magnitude.
inline constexpr double kMinSize = 1e-6;
// What has no size at all is judged as it is: in 1.
Eigen::VectorXd above_zero(const Eigen::VectorXd& sizes);
// Sizes, and a share of what a field with this Jacobian makes of them in the time of its fastest
// rate: a velocity that is 0 at a place, or rounding, is not of no size.
Eigen::VectorXd spread_of(const Eigen::VectorXd& sizes, const Eigen::MatrixXd& jacobian,
                          double share);
// The share that is a size, where nothing better tells one.
inline constexpr double kMadeOfOthers = 1e-3;

// The sizes that the residual of shooting is judged in: rounding of the end state is that of the
// start, as far as the flow stretches it.
Eigen::VectorXd rounding_sizes(const PeriodImage& image, const Eigen::VectorXd& sizes);
// The largest magnitude of a state, in its size: where a state is counted from far off, all that
// has to do with it is rounded by so much more.
double offset_of(const Extent& extent, const Eigen::VectorXd& sizes);

// How far a matrix that carries states to states stretches: its largest entry between states in
// their own sizes.
double stretch_of(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& sizes);

// The largest component of a difference of states, in their sizes.
double distance_of(const Eigen::VectorXd& difference, const Eigen::VectorXd& sizes);

}  // namespace gearsweep
