// The commands, each added to the parser by its own file. A command runs when the parser calls it
// back and leaves its exit status in `status`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/run_request.hpp"

namespace gearsweep {

enum ExitStatus { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

// Each exit status and what it means, for help and manual.
inline std::vector<std::pair<int, std::string>> exit_meanings() {
  return {{kDone, "done"},
          {kFailed, "failed while running, or a check of verify fails"},
          {kWrongInput, "the input was wrong"},
          {kInterrupted, "interrupted"}};
}

void add_run_command(CLI::App* app, const Run& run, SignalWatch* signals, int* status);
void add_merge_command(CLI::App* app, int* status);
void add_slurm_command(CLI::App* app);
void add_status_command(CLI::App* app);
void add_trace_command(CLI::App* app);
void add_explore_command(CLI::App* app, SignalWatch* signals, int* status);
void add_orders_command(CLI::App* app, SignalWatch* signals, int* status);
void add_report_command(CLI::App* app, SignalWatch* signals, int* status);
void add_tolerance_command(CLI::App* app, SignalWatch* signals, int* status);
void add_curves_command(CLI::App* app, SignalWatch* signals, int* status);
void add_reproduce_command(CLI::App* app, SignalWatch* signals, int* status);
void add_plot_command(CLI::App* app);
void add_export_command(CLI::App* app);
void add_top_command(CLI::App* app);
void add_floquet_command(CLI::App* app);
void add_devices_command(CLI::App* app);
void add_kernels_command(CLI::App* app);
void add_studies_command(CLI::App* app);
void add_model_command(CLI::App* app);
void add_gear_command(CLI::App* app);
void add_verify_command(CLI::App* app, SignalWatch* signals, int* status);
void add_bench_command(CLI::App* app, SignalWatch* signals, int* status);
void add_completion_command(CLI::App* app);
void add_manual_command(CLI::App* app);
void add_help_command(CLI::App* app);

}  // namespace gearsweep
