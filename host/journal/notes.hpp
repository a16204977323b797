// Names of what a journal keeps beside a sweep's finished tiles.
#pragma once

#include <cstddef>
#include <string>

namespace gearsweep {

namespace notes {
inline constexpr const char* kCommand = "command";  // that continues it
inline constexpr const char* kPoints = "points";
inline constexpr const char* kTilePoints = "points of a tile";
inline constexpr const char* kShard = "shard";
inline constexpr const char* kStudy = "study";
inline constexpr const char* kStep = "step";
inline constexpr const char* kOrbitSteps = "steps on an orbit for one";
// What a search for curves in a map was asked for.
inline constexpr const char* kSearch = "search for curves";
// The devices and drivers of all that have computed for it.
inline constexpr const char* kDevice = "device";
inline constexpr const char* kDriver = "driver";
inline constexpr const char* kBuildOptions = "build options";
inline constexpr const char* kPilot = "pilot";
}  // namespace notes

// Throw InputError, for a damaged journal, when the note is no number that can be.
std::size_t read_count(const std::string& note, std::size_t min = 0);
double read_step(const std::string& note);

}  // namespace gearsweep
