#include "result/detail/spectrum_numbers.hpp"

#include <optional>

#include "result/load_spectrum.hpp"

namespace gearsweep {

SpectrumNumbers numbers_of_spectrum(const SweepResult& result, const FileNotes& notes,
                                    const std::vector<std::string>& dimensions) {
  const Study& study = result.study;
  const SpectrumAnswers answers = spectrum_answers(result);
  SpectrumNumbers numbers;
  const auto add = [&](const std::string& name, double value) {
    numbers.attributes.push_back({"spectrum_" + name, value});
  };
  add("slope", study.spectrum->slope);
  if (answers.parting_share) add("parting_share", *answers.parting_share);
  for (const SpectrumForce& force : answers.forces) {
    const std::string before =
        answers.forces.size() == 1 ? "" : force.factor.substr(0, force.factor.find('_') + 1);
    add(force.factor + "_mean", force.mean_factor);
    add(force.factor + "_max", force.max_factor);
    add(before + "equivalent_load", force.equivalent_load);
    add(before + "equivalent_force", force.equivalent_force);
    if (const std::optional<double> torque = torque_per_load(study, force)) {
      add(before + "equivalent_torque_N_m", *torque * force.equivalent_load);
      add(before + "equivalent_force_torque_N_m", *torque * force.equivalent_force);
    }
    numbers.maps.push_back(
        {.name = before + "damage_share",
         .stored = Stored::real,
         .dimensions = dimensions,
         .attributes = notes.describe("1", "share of the damage that the load does"),
         .elements = force.damage});
  }
  return numbers;
}

}  // namespace gearsweep
