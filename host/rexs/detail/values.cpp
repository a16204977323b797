#include "rexs/detail/values.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "model/parse_number.hpp"

namespace gearsweep {
namespace {

std::optional<std::uint32_t> digit_of(char letter) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t digit = kDigits.find(letter);
  if (digit == std::string_view::npos) return std::nullopt;
  return static_cast<std::uint32_t>(digit);
}

std::optional<std::vector<std::uint8_t>> bytes_in(std::string_view base64) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (const char letter : base64) {
    if (letter == '=') break;
    if (std::string_view(" \t\r\n").find(letter) != std::string_view::npos) continue;
    const std::optional<std::uint32_t> digit = digit_of(letter);
    if (!digit) return std::nullopt;
    bits = (bits << 6U | *digit) & 0xFFFFFFU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count & 0xFFU));
  }
  return bytes;
}

template <typename Number, typename Bits>
std::optional<std::vector<double>> numbers_of(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() % sizeof(Bits) != 0) return std::nullopt;
  std::vector<double> numbers;
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Bits)) {
    Bits bits = 0;
    for (std::size_t i = sizeof(Bits); i-- > 0;) {
      bits = static_cast<Bits>(bits << 8U | bytes[at + i]);
    }
    const auto number = static_cast<double>(std::bit_cast<Number>(bits));
    if (!std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::optional<double> rexs_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::optional<double> number = parse_number<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::vector<double>> decoded_numbers(std::string_view code, std::string_view text) {
  const std::optional<std::vector<std::uint8_t>> bytes = bytes_in(text);
  if (!bytes) return std::nullopt;
  if (code == "float32") return numbers_of<float, std::uint32_t>(*bytes);
  if (code == "float64") return numbers_of<double, std::uint64_t>(*bytes);
  if (code == "int32") return numbers_of<std::int32_t, std::uint32_t>(*bytes);
  if (code == "int64") return numbers_of<std::int64_t, std::uint64_t>(*bytes);
  return std::nullopt;
}

}  // namespace gearsweep
