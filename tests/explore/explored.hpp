// A small study to walk around in.
#pragma once

#include <string>

#include "explore/scene.hpp"

namespace gearsweep::testing {

inline const std::string kExplored =
    "[model]\nname = 'duffing'\n"
    "[[axes]]\nname = 'omega'\nfrom = 0.8\nto = 1.6\ncount = 20\n"
    "[[axes]]\nname = 'amplitude'\nfrom = 0.1\nto = 0.4\ncount = 10\nscale = 'log'\n"
    "[integrate]\nsettle = 30\nrecord = 8\n"
    "[observe]\nquantities = ['x_max', 'motion_class', 'period']\n";

inline ExploredStudy explored(const std::string& text = kExplored) {
  return {explorable(read_study(text, "test.toml")), std::nullopt};
}

}  // namespace gearsweep::testing
