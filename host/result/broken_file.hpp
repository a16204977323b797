// Damaged files, at which the HDF5 library may crash instead of saying so.
#pragma once

#include <string>

namespace gearsweep {

// Throws InputError when a NetCDF file cannot be read from beginning to end. A process of its own
// tries that, with bounds to its memory and time, so that nothing in the file can end this one;
// every other function that reads files trusts them. No other thread may be at a NetCDF file
// meanwhile. Refuses pipes, devices and folders, too; does nothing about other files that are no
// NetCDF files: whoever opens them refuses that. Throws
// RunError when no process can be started.
void ensure_not_broken(const std::string& path);

}  // namespace gearsweep
