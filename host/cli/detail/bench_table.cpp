#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "cli/detail/bench_report.hpp"
#include "cli/detail/text_table.hpp"
#include "measure/samples.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

// Three digits: "2.31", "23.1", "231".
std::string three_digits(double value) {
  const int before = value >= 1.0 ? static_cast<int>(std::floor(std::log10(value))) + 1 : 1;
  return fmt::format("{:.{}f}", value, std::max(0, 3 - before));
}

// "322 M"
std::string with_prefix(double value) {
  constexpr std::array kPrefixes = {"", "k", "M", "G", "T", "P"};
  constexpr double kNext = 999.5;
  std::size_t prefix = 0;
  for (; value >= kNext && prefix + 1 < kPrefixes.size(); ++prefix) value /= 1e3;
  return fmt::format("{} {}", three_digits(value), kPrefixes.at(prefix));
}

// "106 GFLOP/s", but "259 M steps/s".
std::string rate_of(double value, const std::string& unit) {
  const std::string number = with_prefix(value);
  return number + (unit == "FLOP/s" || number.ends_with(' ') ? unit : " " + unit);
}

// What is said of a benchmark: its rate, or the time of a start.
std::string median_of(const BenchmarkRow& row) {
  const double rate = median(row.rates());
  if (row.item.name == "start") return fmt::format("{} s", three_digits(1.0 / rate));
  return rate_of(rate, row.item.unit);
}

std::string spread_of(const BenchmarkRow& row) {
  if (row.repetitions.size() < 2) return "one run";
  return fmt::format("{:.1f} %", 100.0 * spread(row.rates()));
}

// The share of the peak, or of the time in kernels. is_whole: with the rate that it belongs to.
std::string remarks_of(const BenchmarkRow& row, bool is_whole) {
  const auto remark = [&](const char* share, const char* of, const char* figure, const char* unit) {
    const std::string text = fmt::format("{:.0f} % {}", 100.0 * median(row.figures(share)), of);
    return is_whole ? fmt::format("{}, {}", rate_of(median(row.figures(figure)), unit), text)
                    : text;
  };
  if (!row.figures("peak_share").empty()) {
    return remark("peak_share", "of the peak", "flop/s", "FLOP/s");
  }
  if (!row.figures("kernel_share").empty()) {
    return remark("kernel_share", "in kernels", "steps/s", "steps/s");
  }
  return "";
}

std::vector<std::string> cells_of(const BenchedDevice& device, const std::string& name,
                                  bool is_alone) {
  const auto row = std::find_if(device.rows.begin(), device.rows.end(),
                                [&](const BenchmarkRow& one) { return one.name == name; });
  if (row == device.rows.end()) return {"", "", ""};
  if (row->repetitions.empty()) return {row->failed ? "failed" : "skipped", "", ""};
  return {median_of(*row), spread_of(*row), remarks_of(*row, is_alone)};
}

// The names of all devices' kernels, in the order of the first that has them.
std::vector<std::string> names_of(const std::vector<BenchedDevice>& devices) {
  std::vector<std::string> names;
  for (const BenchedDevice& device : devices) {
    for (const BenchmarkRow& row : device.rows) {
      if (std::find(names.begin(), names.end(), row.name) == names.end()) names.push_back(row.name);
    }
  }
  return names;
}

std::string table_of(const std::vector<BenchedDevice>& devices) {
  TextTable table;
  std::vector<std::string> heading = {"benchmark"};
  for (const BenchedDevice& device : devices) {
    heading.insert(heading.end(), {fmt::format("device {}", device.number), "spread", ""});
  }
  table.add(heading);
  for (const std::string& name : names_of(devices)) {
    std::vector<std::string> row = {name};
    for (const BenchedDevice& device : devices) {
      const std::vector<std::string> cells = cells_of(device, name, devices.size() == 1);
      row.insert(row.end(), cells.begin(), cells.end());
    }
    table.add(row);
  }
  return table.text(0);
}

// Why rows have no numbers, each reason once.
std::string reasons_of(const std::vector<BenchedDevice>& devices) {
  std::string text;
  for (const BenchedDevice& device : devices) {
    std::vector<std::string> reasons;
    for (const BenchmarkRow& row : device.rows) {
      if (row.reason.empty()) continue;
      const std::string line = fmt::format("device {}, {}: {}\n", device.number,
                                           row.failed ? "failed" : "skipped", row.reason);
      if (std::find(reasons.begin(), reasons.end(), line) == reasons.end()) reasons.push_back(line);
    }
    text += fmt::format("{}", fmt::join(reasons, ""));
  }
  return text;
}

// How kernels were built, for each precision; other numbers of lanes say so in their names.
std::string options_of(const std::vector<BenchedDevice>& devices) {
  std::string text;
  for (const BenchedDevice& device : devices) {
    std::set<std::string> options;
    for (const BenchmarkRow& row : device.rows) {
      const bool has_lanes = row.name.find("/lanes:") != std::string::npos;
      if (!row.build_options.empty() && !has_lanes) options.insert(row.build_options);
    }
    for (const std::string& one : options) {
      text += fmt::format("device {}: built with {}\n", device.number, one);
    }
  }
  return text;
}

}  // namespace

std::string bench_table(const Machine& machine, const std::vector<BenchedDevice>& devices) {
  std::string text = fmt::format("gearsweep {} on {}, {} cores, load average {:.2f}\n", version(),
                                 machine.host_name, machine.cores, machine.load);
  for (const BenchedDevice& device : devices) {
    text += fmt::format("device {}: {} ({}, driver {}), {} compute units\n", device.number,
                        device.info.name, device.info.platform, device.info.driver,
                        device.info.compute_units);
  }
  return text + "\n" + table_of(devices) + "\n" + reasons_of(devices) + options_of(devices);
}

}  // namespace gearsweep
