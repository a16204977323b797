// The bifurcation curves that explore was started with, and the orbits on them.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "explore/motion.hpp"
#include "explore/scene.hpp"
#include "result/border_file.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct ExploredCurves {
  StoredCurves stored;
  Study study;  // of the map that they are of
  // The states that the file has, in the model, and those that mirror some of them.
  std::vector<std::size_t> kept;
  std::vector<MirrorPairs::Pair> mirrors;
};

// study: explorable(). No other thread may be at a NetCDF file meanwhile. Throws InputError where
// the file holds no curves, or those of another plane than the study's.
// option: what messages call the one that named the file.
ExploredCurves read_explored_curves(const std::string& path, const Study& study,
                                    const std::string& option = "--curves");
// The same of curves that a program has read, with the study of their map. Messages call them
// `name`.
ExploredCurves explored_curves(StoredCurves stored, Study of_curves, const Study& study,
                               const std::string& name);

struct CurvePlace {
  std::size_t curve = 0, point = 0;
};

struct BorderMotion {
  CurvePlace place;
  Motion motion;                  // one turn of the orbit, from the file's own state on; no values
  std::vector<NamedValue> start;  // states at phase 0: those of the file, and what mirrors them
  std::size_t turn = 0;           // in mesh periods
  // How far the file's states are from where they began after that turn, in their ranges; no number
  // without a trace.
  double gap = std::numeric_limits<double>::quiet_NaN();
};

// The scene is in the plane of the curves, and place is a point of them. Throws as find_motion().
BorderMotion find_border_motion(const Scene& scene, const ExploredCurves& curves,
                                const CurvePlace& place, const SweepOptions& options);

}  // namespace gearsweep
