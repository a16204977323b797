#include "verify/detail/exact_answers.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include "study/builtin_models.hpp"

namespace gearsweep {

double gear5_exponent_sum(const ModelSetting& setting) {
  const Model& gear5 = *find_model("gear5");
  const auto p = [&](std::string_view name) {
    return setting.parameters[static_cast<std::size_t>(gear5.find_parameter(name))];
  };
  const auto formulation = static_cast<std::size_t>(gear5.find_option("formulation"));
  const auto chosen = static_cast<std::size_t>(setting.options[formulation]);
  const bool printed = gear5.options[formulation].choices[chosen] == "printed";
  // The arms of the friction in the torsional equation: with `consistent` approach and recess
  // cancel, with `printed` they change along the path of contact.
  double mean_g = 2.0;
  if (printed) {
    mean_g -= p("mu") * 2.0 * std::numbers::pi / p("zp") * p("eps") * p("eps") / 4.0;
  }
  const double bearings = p("m1") * (p("c1") + p("c2")) + p("m2") * (p("c3") + p("c4"));
  const double shafts = (printed ? -1.0 : 1.0) * 2.0 * (p("m1") + p("m2"));
  return -2.0 * p("zeta") * (mean_g + bearings + shafts);
}

LinearOscillator::State LinearOscillator::at(double t) const {
  // The forced motion is amplitude (a sin(omega t) - c cos(omega t)) / (a^2 + c^2).
  const double a = stiffness - omega * omega;
  const double c = damping * omega;
  const double share = amplitude / (a * a + c * c);
  const double sine = std::sin(omega * t), cosine = std::cos(omega * t);
  // The free motion takes up what the start differs from that.
  const double decay = 0.5 * damping;
  const double w = std::sqrt(stiffness - decay * decay);
  const double p = x + share * c;
  const double q = (v - share * a * omega + decay * p) / w;
  const double free = std::exp(-decay * t) * (p * std::cos(w * t) + q * std::sin(w * t));
  const double speed = std::exp(-decay * t) * w * (q * std::cos(w * t) - p * std::sin(w * t));
  return {share * (a * sine - c * cosine) + free,
          share * omega * (a * cosine + c * sine) + speed - decay * free};
}

}  // namespace gearsweep
