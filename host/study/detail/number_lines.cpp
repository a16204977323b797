#include "study/detail/number_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "model/error.hpp"
#include "model/parse_number.hpp"
#include "model/regular_file.hpp"

namespace gearsweep {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_separator(char c) { return c == ',' || c == ';'; }

}  // namespace

std::vector<std::string_view> fields_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  const auto skip = [&] {
    while (at < line.size() && is_blank(line[at])) ++at;
  };
  for (skip(); at < line.size(); skip()) {
    const std::size_t begin = at;
    while (at < line.size() && !is_blank(line[at]) && !is_separator(line[at])) ++at;
    fields.push_back(line.substr(begin, at - begin));
    skip();
    if (at < line.size() && is_separator(line[at])) ++at;
  }
  return fields;
}

std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  return parse_number<double>(field);
}

std::string shown_field(std::string_view field) {
  constexpr std::size_t kWidth = 30;
  std::string text(field.substr(0, kWidth));
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return field.size() > kWidth ? text + "..." : text;
}

NumberLines::NumberLines(std::string_view text, std::size_t max_bytes, const std::string& what,
                         std::string source)
    : text_(text), source_(std::move(source)) {
  if (text_.size() > max_bytes) {
    throw InputError(fmt::format("{}: too large for {}; at most {} bytes are possible", source_,
                                 what, max_bytes));
  }
  if (text_.find('\0') != std::string_view::npos) {
    throw InputError(fmt::format("{}: not a text file; {} is columns of text", source_, what));
  }
  // The mark with which some programs begin a text in UTF-8.
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
}

bool NumberLines::next(std::vector<std::string_view>* fields) {
  while (!text_.empty()) {
    ++line_;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    *fields = fields_of(text_.substr(0, end));
    text_.remove_prefix(std::min(end + 1, text_.size()));
    if (!fields->empty()) return true;
  }
  return false;
}

void NumberLines::fail(const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", source_, line_, message));
}

std::string number_file_text(const std::string& path, std::size_t max_bytes,
                             const std::string& what) {
  if (!has_regular_file(path, what)) {
    throw InputError(fmt::format("{}: there is no such file", path));
  }
  std::ifstream in(path, std::ios::binary);
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
  std::string text(std::min<std::uintmax_t>(bytes, max_bytes) + 1, '\0');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || !in.is_open()) throw InputError(fmt::format("{}: cannot be read", path));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace gearsweep
