// Lines of a study that is written for somebody.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "gear/drawing_keys.hpp"
#include "study/gear_text.hpp"

namespace gearsweep {

// A comment of lines of up to 100 letters; of several lines each by itself.
std::string comment(std::string text);
std::string comments(std::string_view lines);

// To two digits.
double rounded(double value);

inline constexpr double kEstimatedWidth = 10.0;  // of the face, in modules
inline constexpr double kEstimatedLoad = 100.0;  // N for each mm of it

// Whether a model takes a key.
using TakesKey = std::function<bool(const GearKey&)>;

// Adds what a study of such a model needs and the keys do not have, and takes out what it does not
// take.
void add_estimates(const TakesKey& takes, GearText* text);

// The table [NAME], "gear" or "gear.first", with every key that the model takes.
std::string drawing_table(const std::string& name, const TakesKey& takes, const GearText& text);

// The axis over the speed, from a twentieth of it up to the resonance of the teeth, a pitch-line
// velocity of 50 m/s, or what the fastest load case takes. name: "pinion_speed_rpm_first".
std::string speed_axis(const std::string& name, const GearText& text, double rpm_per_omega,
                       int count);

// The loads as a list of points. suffix: of the drawing, "_first".
std::string spectrum_table(const std::string& suffix, const GearText& text);

}  // namespace gearsweep
