// The files that [gear] names: measured curves over a mesh period, and errors tooth by tooth.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "expression/periodic_table.hpp"
#include "study/detail/gear_keys.hpp"
#include "study/detail/study_files.hpp"

namespace gearsweep {

// The numbers of the files become [gear.tables], so that the study needs no other file any more.
// Throws InputError with the place.
void take_in_gear_files(const StudyFiles& files, toml::table* root);

// A curve over a mesh period, whose phase is in radians, as its file has the values.
struct MeasuredCurve {
  std::shared_ptr<const PeriodicTable> table;
  double mean = 0.0;
};

// Nothing where the table has no such key. Throws InputError at the key.
std::optional<MeasuredCurve> measured_curve(GearReader& in, const GearKey& key,
                                            Interpolation interpolation);

// One number per tooth, in the order in which they enter; nothing where the table has no such key.
std::optional<std::vector<double>> errors_of_teeth(GearReader& in, const GearKey& key,
                                                   double teeth);

// A curve over the path of contact, as points from its entry, 0, to its exit, 1; nothing where the
// table has no such key.
std::optional<std::vector<TablePoint>> curve_over_path(GearReader& in, const GearKey& key);

// The curve there: straight between its points, level before the first and behind the last.
double value_over_path(const std::vector<TablePoint>& points, double place);

// A line amplitude sin(order angle + phase) of the series of a curve.
struct Harmonic {
  double amplitude = 0.0, phase = 0.0;  // rad
};

// Of a function of an angle, the first so many; the mean is left out.
std::vector<Harmonic> harmonics_of(const std::function<double(double)>& value, std::size_t count);

}  // namespace gearsweep
