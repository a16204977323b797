// What each fuzz target does with bytes that somebody else made. A target returns when the bytes
// were read or refused as they should be (InputError, RunError); whatever else it throws, and every
// crash, is a finding.
#pragma once

#include <string>

namespace gearsweep::testing {

// A study in TOML, after any number of lines "--set PATH=VALUE": reads it, plans it when it is
// small, and reads again what a result file would keep of it.
void read_hostile_study(const std::string& bytes);

// Edits of a good result file or file of traces (see hostile_result.cpp): every one of them is a
// sound NetCDF file, but maybe not one of ours. Reads, exports and draws all that is in it.
void read_hostile_result(const std::string& bytes);

}  // namespace gearsweep::testing
