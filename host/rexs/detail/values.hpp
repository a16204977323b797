// Values of attributes as REXS writes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// Files are refused that are nested deeper; a matrix in a load case is 8 deep.
inline constexpr int kDeepestRexs = 32;

// Without blanks around it.
std::string_view trimmed(std::string_view text);

// A whole text that is a finite number; applications write NaN for what they do not know.
std::optional<double> rexs_number(std::string_view text);

// A list that is coded in base64 (since version 1.4), with or without its padding: little-endian
// numbers of code float32, float64, int32 or int64. Nothing for another code or broken text; of
// what is not finite, too.
std::optional<std::vector<double>> decoded_numbers(std::string_view code, std::string_view text);

}  // namespace gearsweep
