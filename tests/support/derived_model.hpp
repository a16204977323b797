// A model some of whose parameters follow others, and constants that are plain numbers.
#pragma once

#include <string>

#include "support/study_text.hpp"

namespace gearsweep::testing {

inline std::string derived_model() {
  return R"~([model]
name = "own"
[states]
x = {}
v = {}
[parameters]
wn = { value = 2.0, min = -5, max = 50 }
omega = { value = "0.5*wn", min = 0.01, max = 10, unit = "1/s", meaning = "frequency" }
zeta = 0.05
e = [0.3, "e[1]/2", 0.1]
[constants]
g = 9.75
weight = "g/2 + wn"
[equations]
x = "v"
v = "sum(i, 1, 3, e[i]*sin(i*phase)) - 2*zeta*v - wn^2*x - weight"
[forcing]
period = "2*pi/omega"
)~";
}

inline std::string with_instead(std::string text, const std::string& what,
                                const std::string& instead) {
  return text.replace(text.find(what), what.size(), instead);
}

}  // namespace gearsweep::testing
