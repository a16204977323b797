// What a report is made of.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orders/order_map.hpp"
#include "plot/plot.hpp"
#include "report/report.hpp"
#include "result/hysteresis.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

// The axis that changes the period of the forcing. Throws InputError when there is none.
std::size_t find_speed_axis(const Study& study);

struct ReportFindings {
  Study given;  // as it was
  Study study;  // the same, with the quantities of the report
  Study line;   // the same over the speed, its other axis at one value
  std::size_t speed = 0;
  std::optional<std::pair<std::string, double>> at;  // that axis and value; none: there is no other
  std::vector<std::string> quantities;               // those of the list below that the model has
  std::string force;                                 // the largest force
  std::string vibration;  // the quantity that ranks the speeds: of the force, where there is one
  // The same as `line` with the study's tolerances, of the force and the contact alone; nothing of
  // a study without.
  std::optional<Study> tolerances;
  // K_v at each speed of `line`, where the study has what it takes; then "factor.nc" is "line.nc"
  // with K_v in the place of the load factor.
  std::vector<double> dynamic_factors;
  OrderMap orders;
  bool has_directions = false;  // files of run-up and run-down
  std::string no_directions;    // why there are none
  std::unique_ptr<TemporaryFolder> folder = std::make_unique<TemporaryFolder>();

  bool is_si() const { return study.scales.known(); }
  std::string file(const std::string& name) const { return (folder->path() / name).string(); }
  // Of these quantities one that several sections speak of.
  static constexpr const char* kLoadFactor = "dynamic_load_factor";
  // A map over the speed, in SI units where these are known; from "line.nc", "up.nc", "down.nc",
  // "tolerances.nc".
  ResultMap over_speed(const std::string& name, const std::string& quantity) const;
  // An SVG of these files; legend: what several are called.
  std::string drawn(const std::string& picture, const std::vector<std::string>& files,
                    const std::string& quantity, bool is_cut,
                    const std::vector<std::string>& legend = {}) const;
};

// By which factor the force between the teeth rises at once where the stiffness jumps: the
// deflection, which cannot jump, is that of the static equilibrium. The largest at all break
// phases, at least 1; 1 of a model without such a force. A load factor begins with it at any speed.
double static_jump(const Model& model, const ModelSetting& setting);

// Nothing when stopped.
std::optional<ReportFindings> find_for_report(const Study& study, const ReportOptions& options);

}  // namespace gearsweep
