// How gear5's mesh acts at a phase, read from its signals.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/settings.hpp"

namespace gearsweep::testing {

// Sums over the pairs in contact: of their stiffness; of their sliding directions times arms and
// stiffness, or arms alone; of the directions times stiffness, or alone. Then the errors beside the
// first sine, and minus their second derivative.
struct Mesh {
  double stiffness, lever, lever_damping, slide, slide_damping, error, excitation;

  double part(const std::string& name) const {
    const std::array<std::pair<const char*, double>, 7> parts = {{{"stiffness", stiffness},
                                                                  {"lever", lever},
                                                                  {"lever_damping", lever_damping},
                                                                  {"slide", slide},
                                                                  {"slide_damping", slide_damping},
                                                                  {"error", error},
                                                                  {"excitation", excitation}}};
    for (const auto& [known, value] : parts) {
      if (name == known) return value;
    }
    throw std::logic_error("no part " + name);
  }
};

class MeshReader {
 public:
  MeshReader(const Model& model, ModelSetting setting) : model_(model) {
    const auto value = [&](const char* name) -> double& {
      return setting.parameters[parameter_index(model, name)];
    };
    value("mu") = 1.0;
    value("zeta") = 0.5;
    value("e0") = 0.0;
    value("F1") = 0.0;
    value("omega") = 1.0;
    point_ = model.prepare(setting);
    row_at_ = model.phase_rows(setting);
    pressed_.resize(model.states.size());
    sliding_ = pressed_;
    resting_ = pressed_;
    pressed_[state_index(model, "x1")] = value("b") + 1.0;  // f = 1, D' = 0
    sliding_[state_index(model, "v1")] = 1.0;               // f = 0, D' = 1
  }

  Mesh at(double psi, double inside) const {
    std::vector<double> row(model_.phase_coefs.size());
    row_at_(psi, inside, row.data());
    return of(row.data());
  }
  // row: of the model's coefficients.
  Mesh of(const double* row) const {
    const auto signal = [&](const std::vector<double>& x, const char* name) {
      std::vector<double> signals(model_.signals.size());
      point_->signals(row, x.data(), signals.data());
      return signals[signal_index(model_, name)];
    };
    std::vector<double> slope(model_.states.size());
    point_->rhs(row, resting_.data(), slope.data());
    return {signal(pressed_, "mesh_stiffness"), signal(pressed_, "friction_lever"),
            signal(sliding_, "friction_lever"), signal(pressed_, "friction"),
            signal(sliding_, "friction"),       signal(resting_, "dte"),
            slope[state_index(model_, "v1")]};
  }

 private:
  const Model& model_;
  std::unique_ptr<PreparedPoint> point_;
  Model::PhaseRow row_at_;
  std::vector<double> pressed_, sliding_, resting_;
};

inline Mesh mesh_at(const Model& model, const ModelSetting& setting, double psi, double inside) {
  return MeshReader(model, setting).at(psi, inside);
}

}  // namespace gearsweep::testing
