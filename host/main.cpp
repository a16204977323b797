#include <cstdio>
#include <cstdlib>

#include "cli/cli.hpp"

int main(int argc, char** argv) {
  const int status = gearsweep::run_cli(argc, argv);
  if (status != 1) return status;
  // A NetCDF file that could not be written to its end crashes the HDF5 library on its way out.
  std::fflush(nullptr);
  std::_Exit(status);
}
