// The points of a plan that are queries of an orbit map: each with values and a state of its own.
#pragma once

#include <string>
#include <vector>

#include "borders/orbit_map.hpp"
#include "plan/point_source.hpp"

namespace gearsweep {

class QueryPoints final : public PointSource {
 public:
  // parameters: whose values the queries have. The model must outlive it.
  QueryPoints(const Model& model, std::vector<std::size_t> parameters,
              std::vector<OrbitQuery> queries)
      : model_(model), parameters_(std::move(parameters)), queries_(std::move(queries)) {}

  std::size_t size() const override { return queries_.size(); }
  std::string key() const override { return "queries of an orbit map"; }
  const std::vector<std::size_t>& differing() const override { return parameters_; }
  void set(std::size_t point, ModelSetting* setting) const override {
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      setting->parameters[parameters_[i]] = queries_[point].values[i];
    }
    model_.derive(setting);
  }
  std::vector<double> start(std::size_t point) const override {
    const Eigen::VectorXd& state = queries_[point].state;
    return {state.begin(), state.end()};
  }

 private:
  const Model& model_;
  const std::vector<std::size_t> parameters_;
  const std::vector<OrbitQuery> queries_;
};

}  // namespace gearsweep
