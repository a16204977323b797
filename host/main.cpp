#include <cstdio>
#include <cstdlib>

#include "cli/cli.hpp"
#include "cli/standard_streams.hpp"

int main(int argc, char** argv) {
  if (!gearsweep::open_standard_streams()) return EXIT_FAILURE;
  const int status = gearsweep::run_cli(argc, argv);
  if (status != 1) return status;
  // A NetCDF file that could not be written to its end crashes the HDF5 library on its way out.
  std::fflush(nullptr);
  std::_Exit(status);
}
