#include "study/table_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "model/error.hpp"
#include "study/detail/heading_unit.hpp"
#include "study/detail/number_lines.hpp"

namespace gearsweep {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kMaxTableBytes = std::size_t{8} << 20U;
constexpr std::size_t kMinTablePoints = 2, kMaxTablePoints = 100'000;
constexpr std::size_t kMaxJumps = 100;  // the phase grid has a segment for each
// In rad. Points of different phases are not closer; a last phase that is rounded to five digits is
// still the period's end.
constexpr double kNearest = 3e-5, kSame = 1.5e-5;
constexpr double kSameValue = 1e-9;  // of the range
constexpr double kLargest = 1e100;   // slopes and bends stay finite

struct Unit {
  const char* name;
  double turn;  // of a period
  double in_rad;
};
constexpr Unit kUnits[] = {
    {"phase", kTurn, 1.0}, {"share", 1.0, kTurn}, {"degree", 360.0, kTurn / 360.0}};

// What messages call it.
constexpr const char* kTable = "a table";

class TableFileReader {
 public:
  TableFileReader(std::string_view text, const std::string& source,
                  std::span<const ValueUnit> units)
      : lines_(text, kMaxTableBytes, kTable, source), source_(source), units_(units) {}

  std::vector<TablePoint> run() {
    std::vector<std::string_view> fields;
    while (lines_.next(&fields)) read_line(fields);
    if (points_.size() >= kMinTablePoints) close();
    if (points_.size() < kMinTablePoints) {
      throw InputError(fmt::format("{}: a table of {} point{}; it needs at least {} in a period",
                                   source_, points_.size(), points_.size() == 1 ? "" : "s",
                                   kMinTablePoints));
    }
    return std::move(points_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }

  void read_line(const std::vector<std::string_view>& fields) {
    const bool is_header = !has_content_ && !number_in(fields[0]);
    has_content_ = true;
    if (is_header) {
      read_header(fields[0]);
      scale_ = scale_in_heading(units_, std::span(fields).subspan(1), lines_);
      return;
    }
    if (fields.size() != 2) {
      fail(
          fmt::format("{} column{}; a line has two, the phase and the value, and numbers have a "
                      "decimal point: 0.5, 1.25",
                      fields.size(), fields.size() == 1 ? "" : "s"));
    }
    const double phase = number(fields[0]);
    add(phase, number(fields[1]));
  }

  void read_header(std::string_view field) {
    std::string name(field);
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto* const known = std::ranges::find(kUnits, name, &Unit::name);
    if (known == std::end(kUnits)) {
      const bool is_time = name == "time" || name == "t" || name == "s";
      fail(fmt::format(
          "'{}' is neither a number nor what a first column is called: 'phase' (in "
          "radians), 'share' (of the period) or 'degree'{}",
          shown_field(field), is_time ? "; a time over that of the period is its share" : ""));
    }
    unit_ = *known;
  }

  double number(std::string_view field) const {
    const std::optional<double> value = number_in(field);
    if (!value) {
      fail(fmt::format("'{}' is not a number; write it as 0.5 or 5e-1", shown_field(field)));
    }
    if (!std::isfinite(*value) || std::fabs(*value) > kLargest) {
      fail(fmt::format("'{}' is out of range; finite numbers up to {:.0e} are possible",
                       shown_field(field), kLargest));
    }
    return *value;
  }

  void add(double given, double value) {
    const double phase = given * unit_.in_rad;
    const double begin = points_.empty() ? 0.0 : points_.front().phase;
    const double end = begin + kTurn;
    if (phase < 0.0 || phase >= end + kSame || (points_.empty() && phase >= kTurn)) {
      fail(
          fmt::format("{} {} is outside of the period from {:.6g} to {:.6g}; other first columns "
                      "are 'phase', 'share' and 'degree'",
                      unit_.name, given, begin / unit_.in_rad, end / unit_.in_rad));
    }
    if (!points_.empty()) refuse_close(given, phase);
    if (points_.size() == kMaxTablePoints) {
      fail(fmt::format("more than {} points; leave some out", kMaxTablePoints));
    }
    points_.push_back({phase, value * scale_});
  }

  void refuse_close(double given, double phase) {
    const double distance = phase - points_.back().phase;
    if (distance == 0.0) {
      const bool is_third = points_.size() > 1 && points_[points_.size() - 2].phase == phase;
      if (is_third) {
        fail(fmt::format("a third point at {} {}; two are a jump from one value to the other",
                         unit_.name, given));
      }
      if (++jumps_ > kMaxJumps) fail(fmt::format("more than {} jumps", kMaxJumps));
    } else if (distance < 0.0) {
      fail(fmt::format("{} {} follows {:.10g}; phases must rise", unit_.name, given,
                       points_.back().phase / unit_.in_rad));
    } else if (distance < kNearest) {
      fail(
          fmt::format("{} {} is closer to the one before than {} rad; a jump is two points of the "
                      "same phase",
                      unit_.name, given, kNearest));
    }
  }

  // Points at the end of the period are those at its beginning.
  void close() {
    const double end = points_.front().phase + kTurn;
    const auto is_at_end = [&] {
      return points_.size() > 1 && std::fabs(points_.back().phase - end) < kSame;
    };
    if (!is_at_end()) return;
    const bool begins_with_jump = points_[0].phase == points_[1].phase;
    const TablePoint last = points_.back();
    points_.pop_back();
    if (!is_at_end()) {
      refuse_difference(last.value, points_[0].value);
      return;
    }
    // It jumps there.
    const TablePoint before = points_.back();
    points_.pop_back();
    refuse_difference(last.value, points_[begins_with_jump ? 1 : 0].value);
    if (begins_with_jump) {
      refuse_difference(before.value, points_[0].value);
    } else {
      points_.insert(points_.begin(), {points_[0].phase, before.value});
    }
  }

  void refuse_difference(double last, double first) const {
    const auto [least, most] = std::ranges::minmax(points_, {}, &TablePoint::value);
    if (std::fabs(last - first) <= kSameValue * (most.value - least.value)) return;
    fail(
        fmt::format("a table that is not periodic: {} at its end, {} at its beginning, a period "
                    "before; where it jumps, two points have the same phase",
                    last, first));
  }

  NumberLines lines_;
  const std::string& source_;
  bool has_content_ = false;
  std::size_t jumps_ = 0;
  std::span<const ValueUnit> units_;
  Unit unit_ = kUnits[0];
  double scale_ = 1.0;  // of the values
  std::vector<TablePoint> points_;
};

}  // namespace

std::vector<TablePoint> parse_table(std::string_view text, const std::string& source,
                                    std::span<const ValueUnit> units) {
  return TableFileReader(text, source, units).run();
}

std::string table_text(const std::vector<TablePoint>& points) {
  std::string text;
  for (const TablePoint& point : points) text += fmt::format("{} {}\n", point.phase, point.value);
  return text;
}

std::vector<TablePoint> read_table(const std::string& path, std::span<const ValueUnit> units) {
  return parse_table(number_file_text(path, kMaxTableBytes, kTable), path, units);
}

TablePoints tables_beside(const std::string& model_file) {
  return [folder = std::filesystem::path(model_file).parent_path()](const std::string& name) {
    return read_table((folder / name).string());
  };
}

}  // namespace gearsweep
