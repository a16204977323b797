#include "study/detail/zoom.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

struct Stretch {
  double from = 0.0, to = 0.0;
  std::optional<std::int64_t> count;
};

template <class Number>
bool parse(const std::string& text, Number* value) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && stopped == end;
}

// "1.5:1.9" or "1.5:1.9:400".
Stretch parse_stretch(const std::string& text, const std::string& source) {
  const std::vector<std::string> parts = split(text, ':');
  Stretch stretch;
  std::int64_t count = 0;
  const bool is_right = (parts.size() == 2 || parts.size() == 3) &&
                        parse(parts[0], &stretch.from) && parse(parts[1], &stretch.to) &&
                        std::isfinite(stretch.from) && std::isfinite(stretch.to) &&
                        (parts.size() == 2 || parse(parts[2], &count));
  if (!is_right) {
    throw InputError(fmt::format(
        "{}: expected AXIS=FROM:TO or AXIS=FROM:TO:COUNT, as in omega=1.5:1.9:400", source));
  }
  if (parts.size() == 3) stretch.count = count;
  const bool is_single = stretch.count == 1 && stretch.from == stretch.to;
  if (!(stretch.to > stretch.from) && !is_single) {
    throw InputError(
        fmt::format("{}: {} is not greater than {}; a stretch goes from its lower end "
                    "to its upper end",
                    source, parts[1], parts[0]));
  }
  return stretch;
}

toml::table* find_axis(const std::string& name, const std::string& source, toml::table* study) {
  std::vector<std::string> names;
  if (toml::array* axes = (*study)["axes"].as_array()) {
    for (toml::node& axis : *axes) {
      if (!axis.is_table()) continue;
      names.push_back((*axis.as_table())["name"].value_or(std::string()));
      if (names.back() == name) return axis.as_table();
    }
  }
  throw InputError(
      fmt::format("{}: the study has no axis '{}'{}", source, name, suggest_name(name, names)));
}

// 1 where neither says, so that the reader judges the axis.
std::int64_t count_of(const toml::table& axis) {
  if (const toml::array* values = axis["values"].as_array()) {
    return static_cast<std::int64_t>(values->size());
  }
  return axis["count"].value_or(std::int64_t{1});
}

}  // namespace

void apply_zoom(const std::string& zoom, toml::table* study) {
  const std::string source = "--zoom " + zoom;
  const std::size_t equals = zoom.find('=');
  const std::string name = zoom.substr(0, equals);
  const Stretch stretch =
      parse_stretch(equals == std::string::npos ? "" : zoom.substr(equals + 1), source);
  toml::table* axis = find_axis(name, source, study);
  if (const toml::node* from = axis->get("from"); from && place_of(*from).starts_with("--zoom")) {
    throw InputError(fmt::format("{}: axis '{}' is zoomed twice", source, name));
  }
  const std::int64_t count = stretch.count.value_or(count_of(*axis));
  axis->erase("values");
  // Parsed, so that messages about the numbers name where they come from.
  toml::table given = toml::parse(
      fmt::format("from = {}\nto = {}\ncount = {}", stretch.from, stretch.to, count), source);
  for (auto&& [key, node] : given) axis->insert_or_assign(key, std::move(node));
}

}  // namespace gearsweep
