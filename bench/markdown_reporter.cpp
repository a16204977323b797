#include "markdown_reporter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

// Runs of one table.
std::string table_of(const std::vector<Run>& runs) {
  std::vector<Column> columns;
  const auto is_used = [&](const Column& column) {
    return std::any_of(runs.begin(), runs.end(), [&](const Run& run) {
      return run.counters.find(column.counter) != run.counters.end();
    });
  };
  std::copy_if(kColumns.begin(), kColumns.end(), std::back_inserter(columns), is_used);
  if (columns.empty()) return "";
  std::string text = fmt::format("| {} |", name_of(runs.front()).table);
  std::string rule = "| --- |";
  for (const Column& column : columns) {
    text += fmt::format(" {} |", column.heading);
    rule += " --- |";
  }
  text += '\n' + rule + '\n';
  for (const Run& run : runs) text += row_of(run, columns);
  return text + '\n';
}

}  // namespace

bool MarkdownReporter::ReportContext(const Context&) { return true; }

void MarkdownReporter::ReportRuns(const std::vector<Run>& runs) {
  runs_.insert(runs_.end(), runs.begin(), runs.end());
}

void MarkdownReporter::Finalize() { GetOutputStream() << markdown_tables(runs_); }

std::string markdown_tables(const std::vector<Run>& runs) {
  std::string text;
  for (auto first = runs.begin(); first != runs.end();) {
    const std::string table = name_of(*first).table;
    const auto end = std::find_if(first, runs.end(),
                                  [&](const Run& run) { return name_of(run).table != table; });
    text += table_of({first, end});
    first = end;
  }
  return text;
}

}  // namespace gearsweep::bench
