#include "expression/detail/cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "expression/expression_error.hpp"

namespace gearsweep {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool Cursor::is_in_name(std::size_t at) const {
  return at < text_.size() && (is_letter(text_[at]) || is_digit(text_[at]));
}

std::size_t Cursor::here() {
  while (at_ < text_.size() &&
         (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r')) {
    ++at_;
  }
  return at_;
}

char Cursor::next() { return here() < text_.size() ? text_[at_] : '\0'; }

bool Cursor::take(std::string_view token) {
  if (!text_.substr(here()).starts_with(token)) return false;
  at_ += token.size();
  return true;
}

bool Cursor::take_word(std::string_view word) {
  if (!text_.substr(here()).starts_with(word) || is_in_name(at_ + word.size())) return false;
  at_ += word.size();
  return true;
}

bool Cursor::take_times() { return !text_.substr(here()).starts_with("**") && take("*"); }

std::string Cursor::take_name(bool choice) {
  const std::size_t start = here();
  if (start == text_.size() || !is_letter(text_[start])) return "";
  while (is_in_name(at_)) ++at_;
  if (choice && at_ < text_.size() && text_[at_] == '.' && is_in_name(at_ + 1)) ++at_;
  while (is_in_name(at_)) ++at_;
  return std::string(text_.substr(start, at_ - start));
}

double Cursor::take_number() {
  const std::size_t start = here();
  double value = 0.0;
  const char* const begin = text_.data() + start;
  const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw ExpressionError(start, "the number is too large or too small");
  }
  if (error != std::errc() || !std::isfinite(value)) {
    throw ExpressionError(start, "this is no number");
  }
  at_ = start + static_cast<std::size_t>(end - begin);
  if (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '.')) {
    throw ExpressionError(
        at_, fmt::format("'{}' follows a number; a product is written with '*'", text_[at_]));
  }
  return value;
}

std::string Cursor::take_file() {
  const std::size_t start = here();
  const char quote = next();
  if (quote != '"' && quote != '\'') {
    throw ExpressionError(
        start, "the name of a file must stand here, in quotes: table(\"file.csv\", phase)");
  }
  const std::size_t end = text_.find(quote, start + 1);
  if (end == std::string_view::npos) {
    throw ExpressionError(start, "the name of a file has no quote at its end");
  }
  const std::string_view name = text_.substr(start + 1, end - start - 1);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (name.empty() || std::ranges::any_of(name, is_control)) {
    throw ExpressionError(start, "this cannot be the name of a file");
  }
  at_ = end + 1;
  return std::string(name);
}

}  // namespace gearsweep
