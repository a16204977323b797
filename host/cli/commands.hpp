// The commands, each added to the parser by its own file. A command runs when the parser calls it
// back and leaves its exit status in `status`. Private to this folder.
#pragma once

#include <CLI/CLI.hpp>

namespace gearsweep {

enum ExitStatus { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

void add_run_command(CLI::App* app, int* status);
void add_trace_command(CLI::App* app, int* status);
void add_reproduce_command(CLI::App* app, int* status);
void add_plot_command(CLI::App* app);
void add_export_command(CLI::App* app);
void add_floquet_command(CLI::App* app);
void add_devices_command(CLI::App* app);
void add_studies_command(CLI::App* app);
void add_model_command(CLI::App* app);
void add_verify_command(CLI::App* app, int* status);

}  // namespace gearsweep
