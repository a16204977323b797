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

// A request to the explorer: the line of its query (x=omega&set=mu%3D0.1), then its body. Makes the
// scene, the cells and the study that it asks for, and computes none.
void read_hostile_request(const std::string& bytes);

// A gear unit in REXS, XML or JSON: reads it and makes the studies of its first stages.
void read_hostile_rexs(const std::string& bytes);

}  // namespace gearsweep::testing
