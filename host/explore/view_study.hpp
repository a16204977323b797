// A view of the explorer as a study of its own.
#pragma once

#include <array>
#include <cstddef>
#include <string>

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

}  // namespace gearsweep
