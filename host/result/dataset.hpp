// What a result consists of: variables with dimensions, numbers and attributes. The file has them
// from here, and so has whoever hands results on without one, so that all have the same.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/result.hpp"
#include "engine/trace.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

// The attribute of a coordinate that is a column of an axis, such as a list of points: the
// parameter, or the state whose initial values it has.
inline constexpr const char* kSweeps = "sweeps";

struct Attribute {
  std::string name;
  std::variant<std::string, double, float, std::vector<signed char>> value;
};

struct Dimension {
  std::string name;
  std::size_t size = 0;
};

// How an element is stored: a letter, a class, a count, a number of single or double precision.
enum class Stored { letter, byte, integer, single, real };

// The class of a point that has none.
inline constexpr signed char kNoClass = -1;

struct DataVariable {
  std::string name;
  Stored stored = Stored::real;
  std::vector<std::string> dimensions;
  std::vector<Attribute> attributes;
  // In the order of the elements, the last dimension fastest: its own, or those of the result.
  // Letters are a text, all others numbers.
  std::variant<std::vector<double>, std::span<const double>, std::span<const std::uint8_t>,
               std::string>
      elements = {};
  // For a file alone: whether it is compressed, and in what pieces, each of which is one stretch of
  // the elements; none: as the NetCDF library likes it.
  bool is_compressed = false;
  std::vector<std::size_t> chunk = {};

  // Elements from `first` on, as they are stored. What is no number has no class.
  template <typename T>
  void copy(std::size_t first, std::span<T> out) const {
    const auto convert = [](auto element) {
      if constexpr (std::is_same_v<T, signed char> && std::is_floating_point_v<decltype(element)>) {
        return std::isfinite(element) ? static_cast<T>(std::lround(element)) : T{kNoClass};
      } else {
        return static_cast<T>(element);
      }
    };
    const auto copy_all = [&](const auto& all) {
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = convert(all[first + i]);
    };
    std::visit(copy_all, elements);
  }
};

struct Dataset {
  std::vector<Attribute> attributes;
  std::vector<Dimension> dimensions;
  std::vector<DataVariable> variables;

  // The size of a dimension. Throws std::logic_error when there is none of that name.
  std::size_t size_of(const std::string& dimension) const;
  // One size for each dimension of a variable.
  std::vector<std::size_t> shape_of(const DataVariable& variable) const;
};

// All that the result's file has, in its order. The result must outlive it.
Dataset dataset_of(const SweepResult& result, const Provenance& provenance);

// All that a file of traces has: see write_traces(). The traces must outlive it.
Dataset dataset_of(const std::vector<Trace>& traces, const std::vector<std::string>& labels,
                   const std::vector<std::string>& placed, const Study& study,
                   const Provenance& provenance);

}  // namespace gearsweep
