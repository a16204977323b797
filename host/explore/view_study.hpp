// A view of the explorer as a study of its own.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "explore/preview.hpp"
#include "explore/scene.hpp"

namespace gearsweep {

struct ViewRange {
  ShareRange shares;
  std::array<std::size_t, 2> count = {200, 150};  // of values
};

// TOML that 'gearsweep run' takes: the scene's study over this view, with the scene's step. Throws
// InputError for a view that is none.
std::string view_study(const Scene& scene, const ViewRange& view);

// The scene's study with its step and other axes, each as a table of TOML.
Study study_with_axes(const Scene& scene, const std::vector<std::string>& axes);

}  // namespace gearsweep
