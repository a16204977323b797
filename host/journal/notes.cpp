#include "journal/notes.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "model/parse_number.hpp"

namespace gearsweep {
namespace {

template <class Number>
Number read(const std::string& note, Number min, Number max) {
  const std::optional<Number> number = parse_number<Number>(note);
  if (!number || !(*number >= min) || !(*number <= max)) {
    throw InputError(
        fmt::format("the journal is damaged ('{}' stands where a number should); delete it", note));
  }
  return *number;
}

}  // namespace

std::size_t read_count(const std::string& note, std::size_t min) {
  return read(note, min, std::size_t{1} << 40U);
}

double read_step(const std::string& note) { return read(note, 1e-9, 10.0); }

}  // namespace gearsweep
