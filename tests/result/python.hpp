// Other programs' opinion on the files: Python with xarray and NumPy.
#pragma once

#include <cstdio>
#include <fstream>
#include <string>

namespace gearsweep::testing {

struct Spoken {
  int status;
  std::string text;
};

inline Spoken run_command(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  Spoken spoken = {-1, {}};
  for (int letter = fgetc(pipe); letter != EOF; letter = fgetc(pipe)) {
    spoken.text += static_cast<char>(letter);
  }
  spoken.status = pclose(pipe);
  return spoken;
}

// Runs a script with one argument, a file, beside which the script is written. The interpreter is
// the first that has xarray and `module`, for which it looks in `folder`, too: the one on the PATH
// may be another than the system's.
inline Spoken run_python(const std::string& script, const std::string& file,
                         const std::string& module = "netCDF4", const std::string& folder = "") {
  const std::string path = file + ".py";
  std::ofstream(path) << script;
  for (std::string python : {"python3", "/usr/bin/python3"}) {
    if (!folder.empty()) python = "PYTHONPATH='" + folder + "' " + python;
    if (run_command(python + " -c 'import xarray, netCDF4, " + module + "'").status != 0) continue;
    return run_command(python + " '" + path + "' '" + file + "'");
  }
  return {-1, "no python3 has xarray, netCDF4 and " + module +
                  "; install python3-xarray and python3-netcdf4"};
}

}  // namespace gearsweep::testing
