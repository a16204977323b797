// A small study without a mistake, for tests that put one in or write it where it must not go.
#pragma once

namespace gearsweep::testing {

inline constexpr const char* kGoodStudy = R"([model]
name = "gear5"
preset = "coarse"
[parameters]
mu = 0.05
[[axes]]
name = "omega"
from = 0.6
to = 0.7
count = 2
[integrate]
settle = 1
record = 1
[observe]
quantities = ["x1_rms"]
)";

}  // namespace gearsweep::testing
