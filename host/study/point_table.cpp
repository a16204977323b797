#include "study/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "study/detail/model_names.hpp"
#include "study/detail/number_lines.hpp"

namespace gearsweep {
namespace {

constexpr const char* kPoints = "a list of points";
constexpr std::size_t kMaxPointBytes = std::size_t{1} << 30U;

class PointReader {
 public:
  PointReader(std::string_view text, const std::string& source)
      : lines_(text, kMaxPointBytes, kPoints, source) {}

  PointTable run(const std::vector<std::string>& names) {
    std::vector<std::string_view> fields;
    if (!names.empty()) {
      take_names({names.begin(), names.end()});
    } else if (lines_.next(&fields)) {
      refuse_number(fields.front());
      take_names(fields);
    }
    while (lines_.next(&fields)) take_point(fields);
    if (out_.points() == 0) {
      lines_.fail("there are no points; a line of names comes first, then a line for each point");
    }
    return std::move(out_);
  }

 private:
  void refuse_number(std::string_view field) const {
    if (!number_in(field)) return;
    lines_.fail(fmt::format(
        "'{}' is a number; the first line has the names of parameters and initial states",
        shown_field(field)));
  }

  void take_names(const std::vector<std::string_view>& names) {
    for (const std::string_view name : names) {
      if (!is_model_name(std::string(name))) {
        lines_.fail(
            fmt::format("'{}' is no name of a parameter or an initial state; the first "
                        "line has these names, such as omega, x1",
                        shown_field(name)));
      }
      if (std::ranges::find(out_.names, name) != out_.names.end()) {
        lines_.fail(fmt::format("the column '{}' is there twice", shown_field(name)));
      }
      out_.names.emplace_back(name);
    }
    out_.columns.resize(names.size());
  }

  void take_point(const std::vector<std::string_view>& fields) {
    if (fields.size() != out_.names.size()) {
      lines_.fail(fmt::format(
          "{} number{} for {} column{}; each point needs a number in each, with a decimal point: "
          "0.5",
          fields.size(), fields.size() == 1 ? "" : "s", out_.names.size(),
          out_.names.size() == 1 ? "" : "s"));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::optional<double> value = number_in(fields[i]);
      if (!value || !std::isfinite(*value)) {
        lines_.fail(fmt::format("{} = '{}' is not a finite number; write it as 0.5 or 5e-1",
                                out_.names[i], shown_field(fields[i])));
      }
      out_.columns[i].push_back(*value);
    }
  }

  NumberLines lines_;
  PointTable out_;
};

}  // namespace

PointTable parse_points(std::string_view text, const std::string& source) {
  return PointReader(text, source).run({});
}

PointTable parse_points(const std::vector<std::string>& names, std::string_view lines,
                        const std::string& source) {
  return PointReader(lines, source).run(names);
}

std::string lines_of(const PointTable& points) {
  std::string text;
  for (std::size_t point = 0; point < points.points(); ++point) {
    for (std::size_t i = 0; i < points.names.size(); ++i) {
      fmt::format_to(std::back_inserter(text), "{}{}", i == 0 ? "" : ", ",
                     points.columns[i][point]);
    }
    text += '\n';
  }
  return text;
}

PointTable read_points(const std::string& path) {
  return parse_points(number_file_text(path, kMaxPointBytes, kPoints), path);
}

}  // namespace gearsweep
