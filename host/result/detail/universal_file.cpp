#include "result/detail/universal_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace gearsweep {
namespace {

constexpr std::size_t kLineLength = 80, kLabelLength = 20;

// An empty line is not allowed: it has the word NONE.
std::string ascii(const std::string& text, std::size_t most) {
  constexpr std::string_view kMicro = "\xc2\xb5";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    if (text.compare(i, kMicro.size(), kMicro) == 0) {
      out += 'u';
      ++i;
    } else if (code >= 0xc0U) {
      out += '?';
    } else if (code < 0x80U) {
      out += code < 0x20U ? ' ' : text[i];
    }
  }
  out.resize(std::min(out.size(), most));
  return out.empty() ? "NONE" : out;
}

// Records 8 to 11: the units go by their label, so exponents of length, force and temperature are
// 0.
std::string axis_record(const UniversalAxis& axis) {
  return fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", axis.kind, 0, 0, 0,
                     ascii(axis.label, kLabelLength), ascii(axis.unit, kLabelLength));
}

}  // namespace

std::string universal_dataset(const UniversalSpectrum& spectrum, std::size_t number) {
  constexpr int kSpectrum = 12, kRealDouble = 4, kEven = 1;
  constexpr std::size_t kInALine = 4;
  std::string text = fmt::format("{:6}\n{:6}\n", -1, 58);
  for (const std::string& line : {spectrum.title, spectrum.subtitle}) {
    text += fmt::format("{:<80}\n", ascii(line, kLineLength));
  }
  for (int i = 0; i < 3; ++i) text += fmt::format("{:<80}\n", "NONE");
  text += fmt::format("{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}\n", kSpectrum, number, 1,
                      0, "NONE", 0, 0, "NONE", 0, 0);
  text +=
      fmt::format("{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}\n", kRealDouble, spectrum.values.size(),
                  kEven, spectrum.first, spectrum.increment, spectrum.place);
  text += axis_record(spectrum.abscissa) + axis_record(spectrum.ordinate) + axis_record({}) +
          axis_record(spectrum.third);
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    text += fmt::format("{:20.12E}", spectrum.values[i]);
    if (i % kInALine == kInALine - 1 || i + 1 == spectrum.values.size()) text += '\n';
  }
  return text + fmt::format("{:6}\n", -1);
}

}  // namespace gearsweep
