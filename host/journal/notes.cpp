#include "journal/notes.hpp"

#include <fmt/format.h>

#include <charconv>

#include "model/error.hpp"

namespace gearsweep {
namespace {

template <class Number>
Number read(const std::string& note, Number min, Number max) {
  Number number{};
  const char* end = note.data() + note.size();
  const auto [rest, error] = std::from_chars(note.data(), end, number);
  if (error != std::errc() || rest != end || !(number >= min) || !(number <= max)) {
    throw InputError(
        fmt::format("the journal is damaged ('{}' stands where a number should); delete it", note));
  }
  return number;
}

}  // namespace

std::size_t read_count(const std::string& note, std::size_t min) {
  return read(note, min, std::size_t{1} << 40U);
}

double read_step(const std::string& note) { return read(note, 1e-9, 10.0); }

}  // namespace gearsweep
