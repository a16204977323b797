// Periodic orbits by Newton shooting on the period map, stable or not, and their Floquet
// multipliers (the eigenvalues of the monodromy matrix), which tell how far the orbit is from each
// bifurcation (Y. A. Kuznetsov, Elements of Applied Bifurcation Theory, chapters 5 and 10).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "orbits/period_map.hpp"

namespace gearsweep {

// What happens when a multiplier crosses the unit circle.
enum class Bifurcation {
  fold,            // at +1, and the branch of orbits turns back
  branching,       // at +1, and the branch goes on: symmetry breaking (pitchfork), transcritical
  flip,            // at -1: the period doubles
  neimark_sacker,  // a complex pair: the orbit becomes a torus
};

// "fold", "symmetry breaking", "flip", "Neimark-Sacker".
std::string name_of(Bifurcation kind);

struct Orbit {
  Eigen::VectorXd state;   // at phase 0
  std::size_t period = 1;  // in forcing periods; the smallest
  Eigen::MatrixXd monodromy;
  Eigen::VectorXcd multipliers;  // largest modulus first
  std::vector<Graze> grazes;
  // What counts as the size of each state, above 0: see sizes_of. Residuals and distances are
  // judged in these sizes, so that no unit of a state or of the time decides anything.
  Eigen::VectorXd sizes;
  Eigen::VectorXd reach;  // largest magnitude of each state on the orbit

  bool stable() const;
  // How many multipliers lie outside the unit circle.
  std::size_t unstable_count() const;
  // The turn nearest to a limit of a backlash among those that are nearer to it than states are
  // known; null when there is none. errors: of each state.
  const Graze* graze_within(const Eigen::VectorXd& errors) const;
};

// The multiplier nearest to the unit circle and the bifurcation that it would make by crossing it.
struct Nearest {
  Bifurcation kind = Bifurcation::fold;  // fold stands for any crossing at +1
  std::complex<double> multiplier;
  double margin = 0.0;  // 1 - modulus
};
Nearest nearest_bifurcation(const Orbit& orbit);

// A crossing at +1 is a fold or a branching; one orbit does not tell which.
std::string name_of(const Nearest& nearest);

// The orbit through a state that `image` brings back; multipliers computed.
Orbit make_orbit(const Eigen::VectorXd& state, const PeriodImage& image, std::size_t period);

// The size of each state on a way: half of its extent there, which does not know from where a state
// is counted; at least a millionth of its magnitude, and of what the others' sizes become in it; 1
// where that is 0.
Eigen::VectorXd sizes_of(const PeriodImage& image);

// The sizes that the residual of shooting is judged in: rounding of the end state is that of the
// start, as far as the flow stretches it.
Eigen::VectorXd rounding_sizes(const PeriodImage& image, const Eigen::VectorXd& sizes);

// How far a matrix that carries states to states stretches: its largest entry between states in
// their own sizes.
double stretch_of(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& sizes);

// Damped Newton's method on the `period`-th iterate from `guess`, to 1e-12 of the states' sizes.
// Nothing when it does not converge. The result's period is `period`, be it the smallest or not.
std::optional<Orbit> shoot(const PeriodMap& map, const Eigen::VectorXd& guess, std::size_t period);

// The largest period that find_orbit looks for by itself.
constexpr std::size_t kLongestPeriod = 64;

// The periodic orbit that a settled trajectory is on: looks for the smallest period of at most
// kLongestPeriod at which the state returns, then shoots. With `period`, shoots from where the
// trajectory comes closest to repeating itself after that many periods, so that an unstable orbit
// inside chaos can be found. Throws RunError that says what to try when there is no such orbit.
Orbit find_orbit(const PeriodMap& map, const Eigen::VectorXd& settled,
                 std::optional<std::size_t> period);

}  // namespace gearsweep
