// The numbers that a request carries, each within its limits.
#pragma once

#include <httplib.h>

#include <charconv>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "explore/diagram.hpp"
#include "explore/preview.hpp"
#include "explore/scene.hpp"

namespace gearsweep {

// What a request asks for that there is not, or that it may not.
struct Refusal {
  int status;
  std::string text;
};

// These throw Refusal, and json's exceptions where the body has another form.

template <typename Number>
Number read_number(const std::string& name, const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Refusal{400, "'" + text + "' of " + name + " is no such number as it takes"};
  }
  return value;
}

template <typename Number>
Number number_of(const httplib::Request& request, const std::string& name, Number fallback) {
  if (!request.has_param(name)) return fallback;
  return read_number<Number>(name, request.get_param_value(name));
}

// x, y and each set=NAME%3DNUMBER.
SceneChanges changes_of(const httplib::Request& request);

// x0, x1, y0, y1: the whole axes where they lack.
ShareRange shares_of(const httplib::Request& request);

// depth, kx, ky
Cell cell_of(const httplib::Request& request);

// [[depth, i, j], ...]
std::vector<TilePlace> read_places(const nlohmann::json& list);

// [x0, y0, x1, y1]
ShareRange read_view(const nlohmann::json& list);

// {"axis": 0, "at": [depth, k]}
Line read_line(const nlohmann::json& body);

// [[depth, i], ...]
std::vector<Strip> read_strips(const nlohmann::json& list);

}  // namespace gearsweep
