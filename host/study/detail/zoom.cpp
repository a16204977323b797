#include "study/detail/zoom.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

struct Stretch {
  double from = 0.0, to = 0.0;
  std::optional<std::int64_t> count;
};

// "1.5:1.9" or "1.5:1.9:400".
Stretch parse_stretch(const std::string& text, const std::string& source) {
  const std::vector<std::string> parts = split(text, ':');
  const bool has_count = parts.size() == 3;
  const auto from = parse_number<double>(parts.front());
  const auto to = parse_number<double>(parts.size() > 1 ? parts[1] : "");
  const auto count = has_count ? parse_number<std::int64_t>(parts[2]) : std::nullopt;
  const bool is_right = (parts.size() == 2 || (has_count && count)) && from && to &&
                        std::isfinite(*from) && std::isfinite(*to);
  if (!is_right) {
    throw InputError(fmt::format(
        "{}: expected AXIS=FROM:TO or AXIS=FROM:TO:COUNT, as in omega=1.5:1.9:400", source));
  }
  const Stretch stretch = {*from, *to, count};
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

// Gives the axis a key. Parsed, so that messages about the number name where it comes from.
template <class Number>
void set_number(const std::string& key, Number value, const std::string& source,
                toml::table* axis) {
  toml::table given = toml::parse(fmt::format("{} = {}", key, value), source);
  axis->insert_or_assign(key, std::move(*given.get(key)));
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
  std::optional<std::int64_t> count = stretch.count;
  if (const toml::array* values = (*axis)["values"].as_array(); values != nullptr && !count) {
    count = static_cast<std::int64_t>(values->size());
  }
  axis->erase("values");
  set_number("from", stretch.from, source, axis);
  set_number("to", stretch.to, source, axis);
  // Otherwise the axis keeps its own, and the reader judges that.
  if (count) set_number("count", *count, source, axis);
}

}  // namespace gearsweep
