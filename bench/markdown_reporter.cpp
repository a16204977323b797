#include "markdown_reporter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <ostream>
#include <string>
#include <utility>

namespace gearsweep::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

struct Column {
  const char* counter;
  const char* heading;
  const char* form;  // of fmt
  double unit;       // what the number is divided by
};
constexpr std::array kColumns = {
    Column{"points/s", "points/s", "{:.3g} k", 1e3},
    Column{"steps/s", "steps/s", "{:.0f} M", 1e6},
    Column{"flop/s", "GFLOP/s", "{:.0f}", 1e9},
    Column{"peak_flop/s", "FMA peak", "{:.0f}", 1e9},
    Column{"peak_share", "share of peak", "{:.0f} %", 0.01},
    Column{"times_states", "time / states alone", "{:.2f}", 1.0},
    Column{"vs_one_lane", "x one lane", "{:.1f}", 1.0},
    Column{"vs_odeint", "x odeint `runge_kutta4`", "{:.1f}", 1.0},
    Column{"vs_classic", "x `..._classic`", "{:.1f}", 1.0},
    Column{"vs_odeint_simd", "x `runge_kutta4`, SIMD", "{:.2f}", 1.0},
    Column{"vs_classic_simd", "x `..._classic`, SIMD", "{:.2f}", 1.0},
    Column{"wall_s", "seconds", "{:.3g}", 1.0},
    Column{"computing_share", "in tiles", "{:.0f} %", 0.01},
    Column{"busy_share", "cores busy", "{:.0f} %", 0.01},
    Column{"vs_one_core", "x one core", "{:.2f}", 1.0},
    Column{"vs_never", "to the end / seconds", "{:.2f}", 1.0},
    Column{"peak_bytes", "peak memory", "{:.0f} MB", 1e6},
    Column{"bytes/point", "bytes per point", "{:.0f}", 1.0},
};

struct Name {
  std::string table, row;
};

// The modifiers that Google Benchmark appends say nothing to a reader.
Name name_of(const Run& run) {
  const std::string& name = run.run_name.function_name;
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return {name, name};
  return {name.substr(0, slash), name.substr(slash + 1)};
}

std::string row_of(const Run& run, const std::vector<Column>& columns) {
  std::string row = fmt::format("| {} |", name_of(run).row);
  for (const Column& column : columns) {
    const auto found = run.counters.find(column.counter);
    if (run.error_occurred && &column == columns.data()) {
      row += fmt::format(" {} |", run.error_message);
    } else if (found == run.counters.end()) {
      row += " |";
    } else {
      row += ' ' + fmt::format(fmt::runtime(column.form), found->second.value / column.unit) + " |";
    }
  }
  return row + '\n';
}

std::string speed_of(const Run& run) {
  const auto number = [&](const char* counter) { return run.counters.at(counter).value; };
  return fmt::format("{:.0f}, {:.0f}, {:.0f} %", number("steps/s") / 1e6, number("flop/s") / 1e9,
                     number("peak_share") * 100.0);
}

std::string heading_of(const std::string& first, const std::vector<std::string>& others) {
  std::string text = fmt::format("| {} |", first);
  std::string rule = "| --- |";
  for (const std::string& other : others) {
    text += fmt::format(" {} |", other);
    rule += " --- |";
  }
  return text + '\n' + rule + '\n';
}

// Runs of one table, a row each.
std::string table_of(const std::vector<Run>& runs) {
  std::vector<Column> columns;
  const auto is_used = [&](const Column& column) {
    return std::any_of(runs.begin(), runs.end(), [&](const Run& run) {
      return run.counters.find(column.counter) != run.counters.end();
    });
  };
  std::copy_if(kColumns.begin(), kColumns.end(), std::back_inserter(columns), is_used);
  if (columns.empty()) return "";
  std::vector<std::string> headings;
  for (const Column& column : columns) headings.emplace_back(column.heading);
  std::string text = heading_of(name_of(runs.front()).table, headings);
  for (const Run& run : runs) text += row_of(run, columns);
  return text + '\n';
}

// Runs of one table that form a matrix: the last part of their names makes the columns.
std::string matrix_of(const std::vector<Run>& runs) {
  std::vector<std::string> rows, columns;
  std::map<std::pair<std::string, std::string>, std::string> cells;
  const auto note = [](const std::string& name, std::vector<std::string>* names) {
    if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
  };
  for (const Run& run : runs) {
    const std::string name = name_of(run).row;
    const std::size_t slash = name.rfind('/');
    const std::string row = name.substr(0, slash), column = name.substr(slash + 1);
    note(row, &rows);
    note(column, &columns);
    cells[{row, column}] = run.error_occurred ? run.error_message : speed_of(run);
  }
  std::string text = heading_of("M steps/s, GFLOP/s, share of peak", columns);
  for (const std::string& row : rows) {
    text += fmt::format("| {} |", row);
    for (const std::string& column : columns) text += fmt::format(" {} |", cells[{row, column}]);
    text += '\n';
  }
  return text + '\n';
}

}  // namespace

bool MarkdownReporter::ReportContext(const Context&) { return true; }

void MarkdownReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (!table_.empty() && name_of(run).table != name_of(table_.front()).table) Finalize();
    table_.push_back(run);
    GetErrorStream() << run.run_name.function_name << ": "
                     << (run.error_occurred ? run.error_message : "done") << std::endl;
  }
}

void MarkdownReporter::Finalize() {
  if (table_.empty()) return;
  const bool is_matrix = name_of(table_.front()).table == "matrix";
  GetOutputStream() << (is_matrix ? matrix_of(table_) : table_of(table_)) << std::flush;
  table_.clear();
}

}  // namespace gearsweep::bench
