#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "model/error.hpp"
#include "reference/continuation.hpp"
#include "reference/oscillators.hpp"
namespace gearsweep::testing {
namespace {
void go(const Model& m, double p, double x, double v, std::size_t settle, double from, double to,
        std::size_t steps) {
  auto t0 = std::chrono::steady_clock::now();
  PeriodMap map(m, {{p}, {}}, steps);
  auto s = map.advance(Eigen::Vector2d(x, v), settle);
  try {
    Orbit o = find_orbit(map, *s, std::nullopt);
    std::printf("%s p=%g period %zu state %.9f %.9f mult", m.name.c_str(), p, o.period, o.state[0],
                o.state[1]);
    for (auto q : o.multipliers) std::printf(" (%.6f,%.6f)", q.real(), q.imag());
    std::printf("\n");
    for (bool up : {false, true}) {
      Branch b = follow_orbit({&m, {{p}, {}}, 0, from, to, steps, up}, o);
      std::printf("  up %d orbits %zu ended %s\n", up, b.orbits.size(), b.ended.c_str());
      for (auto& f : b.bifurcations)
        std::printf("    %s %.9f\n", name_of(f.kind).c_str(), f.parameter);
    }
  } catch (const std::exception& e) {
    std::printf("%s p=%g: %s\n", m.name.c_str(), p, e.what());
  }
  std::printf("  %.2f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
  std::fflush(stdout);
}
TEST(F, X) {
  const Model p = pendulum(), d = duffing();
  for (std::size_t n : {512, 1024, 2048}) {
    std::printf("N %zu\n", n);
    go(p, 1.2, 0, 0, 300, 1.2, 1.4, n);
    go(p, 1.3, 0, 0, 300, 1.2, 1.4, n);
    go(p, 1.36, 0, 0, 300, 1.34, 1.375, n);
    go(p, 1.372, 0, 0, 500, 1.37, 1.376, n);
    go(p, 1.375, 0, 0, 800, 1.3742, 1.376, n);
    go(d, 0.25, 1, 0, 300, 0.2, 0.3, n);
    go(d, 0.275, 1, 0, 300, 0.26, 0.3, n);
    go(d, 0.289, 1, 0, 300, 0.28, 0.3, n);
  }
}
}  // namespace
}  // namespace gearsweep::testing
