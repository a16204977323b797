// Whether two result files hold the same numbers, bit for bit.
#pragma once

#include <cstring>
#include <filesystem>
#include <string>

#include "result/result_file.hpp"

namespace gearsweep::testing {

inline bool have_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// The first thing in which they differ; empty when there is none. Reads all of both files.
inline std::string difference_of_results(const std::filesystem::path& one,
                                         const std::filesystem::path& other) {
  const ResultFile a(one.string()), b(other.string());
  if (a.quantities() != b.quantities()) return "the list of quantities";
  for (std::size_t i = 0; i < a.axes().size(); ++i) {
    if (!have_same_bits(a.axes()[i].values, b.axes().at(i).values)) return a.axes()[i].name;
  }
  for (const std::string& quantity : a.quantities()) {
    if (!have_same_bits(a.read(quantity).values, b.read(quantity).values)) return quantity;
  }
  return "";
}

}  // namespace gearsweep::testing
