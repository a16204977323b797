#include "study/table_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>

#include "model/error.hpp"
#include "model/regular_file.hpp"

namespace gearsweep {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kMaxBytes = std::size_t{8} << 20U;
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

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Of a line without its comment.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  const auto skip = [&] {
    while (at < line.size() && is_blank(line[at])) ++at;
  };
  for (skip(); at < line.size(); skip()) {
    const std::size_t begin = at;
    while (at < line.size() && !is_blank(line[at]) && line[at] != ',' && line[at] != ';') ++at;
    fields.push_back(line.substr(begin, at - begin));
    skip();
    if (at < line.size() && (line[at] == ',' || line[at] == ';')) ++at;
  }
  return fields;
}

// The same in every locale.
std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

// For a message.
std::string shown(std::string_view field) {
  constexpr std::size_t kWidth = 30;
  std::string text(field.substr(0, kWidth));
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return field.size() > kWidth ? text + "..." : text;
}

class PointReader {
 public:
  PointReader(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  std::vector<TablePoint> run() {
    refuse_other_files();
    while (!text_.empty()) {
      ++line_;
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      const std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      read_line(fields_of(line.substr(0, line.find('#'))));
    }
    if (points_.size() >= kMinTablePoints) close();
    if (points_.size() < kMinTablePoints) {
      throw InputError(fmt::format("{}: a table of {} point{}; it needs at least {} in a period",
                                   source_, points_.size(), points_.size() == 1 ? "" : "s",
                                   kMinTablePoints));
    }
    return std::move(points_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", source_, line_, message));
  }

  void refuse_other_files() {
    if (text_.size() > kMaxBytes) {
      throw InputError(fmt::format("{}: too large for a table; at most {} bytes are possible",
                                   source_, kMaxBytes));
    }
    if (text_.find('\0') != std::string_view::npos) {
      throw InputError(fmt::format("{}: not a text file; a table is two columns of text", source_));
    }
    // The mark with which some programs begin a text in UTF-8.
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  }

  void read_line(const std::vector<std::string_view>& fields) {
    if (fields.empty()) return;
    const bool is_header = !has_content_ && !number_in(fields[0]);
    has_content_ = true;
    if (is_header) {
      read_header(fields[0]);
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
      fail(
          fmt::format("'{}' is neither a number nor what a first column is called: 'phase' (in "
                      "radians), 'share' (of the period) or 'degree'",
                      shown(field)));
    }
    unit_ = *known;
  }

  double number(std::string_view field) const {
    const std::optional<double> value = number_in(field);
    if (!value) {
      fail(fmt::format("'{}' is not a number; write it as 0.5 or 5e-1", shown(field)));
    }
    if (!std::isfinite(*value) || std::fabs(*value) > kLargest) {
      fail(fmt::format("'{}' is out of range; finite numbers up to {:.0e} are possible",
                       shown(field), kLargest));
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
    points_.push_back({phase, value});
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

  std::string_view text_;
  const std::string& source_;
  std::size_t line_ = 0;
  bool has_content_ = false;
  std::size_t jumps_ = 0;
  Unit unit_ = kUnits[0];
  std::vector<TablePoint> points_;
};

std::string file_text(const std::string& path) {
  if (!has_regular_file(path, "a table")) {
    throw InputError(fmt::format("{}: there is no such file", path));
  }
  std::ifstream in(path, std::ios::binary);
  // One byte more tells that there are too many.
  std::string text(kMaxBytes + 1, '\0');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || !in.is_open()) throw InputError(fmt::format("{}: cannot be read", path));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

std::vector<TablePoint> parse_table(std::string_view text, const std::string& source) {
  return PointReader(text, source).run();
}

std::string table_text(const std::vector<TablePoint>& points) {
  std::string text;
  for (const TablePoint& point : points) text += fmt::format("{} {}\n", point.phase, point.value);
  return text;
}

TablePoints tables_beside(const std::string& model_file) {
  return [folder = std::filesystem::path(model_file).parent_path()](const std::string& name) {
    const std::string path = (folder / name).string();
    return parse_table(file_text(path), path);
  };
}

}  // namespace gearsweep
