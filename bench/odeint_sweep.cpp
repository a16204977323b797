// It gets what the kernel has: coefficients from the table, options known to the compiler, a state
// of fixed size, and -O3 -march=native with contraction. Whether to inline the right-hand side is
// left to the compiler: told to, it makes slower code.
#include "odeint_sweep.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4_classic.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <experimental/simd>
#include <functional>
#include <thread>
#include <vector>

#define REAL_BITS ((int)(8 * sizeof(scalar)))
#include "dialect.h"
#include "header_points.hpp"
// The same for a type whose comparisons give a mask.
#undef lane_select
#undef all_lanes
#define lane_select(condition, yes, no) choose(condition, yes, no)
#define all_lanes(m) all(m)

namespace gearsweep::bench {
namespace {

using std::fabs;
using std::sqrt;

constexpr std::size_t kRunPoints = 16;

// Neighbouring points of a tile that share a phase grid.
struct Run {
  std::size_t first = 0;  // position in the tile
  std::size_t grid = 0;
};

std::vector<Run> choose_runs(const Tile& tile, std::size_t share) {
  std::vector<Run> runs;
  for (std::size_t grid = 0; grid < tile.grid_starts.size(); ++grid) {
    const bool is_last = grid + 1 == tile.grid_starts.size();
    const std::size_t end = is_last ? tile.points.size() : tile.grid_starts[grid + 1];
    for (std::size_t first = tile.grid_starts[grid]; first + kRunPoints <= end;
         first += kRunPoints * share) {
      runs.push_back({first, grid});
    }
  }
  return runs;
}

void on_all_cores(const std::function<void()>& work) {
  std::vector<std::jthread> threads;
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  for (unsigned core = 0; core < cores; ++core) threads.emplace_back(work);
}

template <class T>
T choose(bool condition, T yes, T no) {
  return condition ? yes : no;
}
inline bool all(bool condition) { return condition; }

namespace simd {

using std::experimental::native_simd;

template <class T>
native_simd<T> choose(const typename native_simd<T>::mask_type& condition, native_simd<T> yes,
                      const native_simd<T>& no) {
  std::experimental::where(!condition, yes) = no;
  return yes;
}
template <class Mask>
bool all(const Mask& condition) {
  return std::experimental::all_of(condition);
}
template <class Real>
Real lane_min(const Real& a, const Real& b) {
  return std::experimental::min(a, b);
}
template <class Real>
Real lane_max(const Real& a, const Real& b) {
  return std::experimental::max(a, b);
}
template <class Real>
Real lane_clamp(const Real& a, const Real& low, const Real& high) {
  return lane_min(lane_max(a, low), high);
}

}  // namespace simd

namespace fp64 {
using real = double;
using scalar = double;
constexpr std::size_t kLanes = 1;
template <class Get>
real fill_lanes(const Get& get) {
  return get(0);
}
#include "odeint_points.hpp"
}  // namespace fp64

namespace fp32 {
using real = float;
using scalar = float;
constexpr std::size_t kLanes = 1;
template <class Get>
real fill_lanes(const Get& get) {
  return static_cast<real>(get(0));
}
#include "odeint_points.hpp"
}  // namespace fp32

namespace simd::fp64 {
using real = native_simd<double>;
using scalar = double;
constexpr std::size_t kLanes = real::size();
template <class Get>
real fill_lanes(const Get& get) {
  return real([&](std::size_t lane) { return get(lane); });
}
#include "odeint_points.hpp"
}  // namespace simd::fp64

namespace simd::fp32 {
using real = native_simd<float>;
using scalar = float;
constexpr std::size_t kLanes = real::size();
template <class Get>
real fill_lanes(const Get& get) {
  return real([&](std::size_t lane) { return static_cast<float>(get(lane)); });
}
#include "odeint_points.hpp"
}  // namespace simd::fp32

}  // namespace

std::unique_ptr<OdeintSweep> make_odeint_sweep(const Plan& plan, const Tile& tile,
                                               std::size_t share, OdeintStepper stepper,
                                               OdeintNumber number) {
  const std::vector<Run> runs = choose_runs(tile, share);
  const bool is_simd = number == OdeintNumber::simd;
  if (plan.study().integrate.fp64) {
    return is_simd ? simd::fp64::make_points(plan, tile, runs, stepper)
                   : fp64::make_points(plan, tile, runs, stepper);
  }
  return is_simd ? simd::fp32::make_points(plan, tile, runs, stepper)
                 : fp32::make_points(plan, tile, runs, stepper);
}

}  // namespace gearsweep::bench
