// A bound on how deep TOML text nests.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gearsweep {

// A table of tables is taken down by recursion, and a dotted key of a megabyte overflows the stack.
inline constexpr std::size_t kMaxParts = 64;

// Throws InputError when a key has more than kMostParts parts, as in a.b.c, which has 3. `source`
// names the text in messages.
void refuse_deep_keys(std::string_view text, const std::string& source);

}  // namespace gearsweep
