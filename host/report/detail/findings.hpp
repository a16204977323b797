// What a report is made of.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orders/order_map.hpp"
#include "report/report.hpp"
#include "result/hysteresis.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

// The study with overrides and zooms (read_study()).
Study changed(const Study& study, const std::vector<std::string>& overrides,
              const std::vector<std::string>& zooms = {});

// The load factor of one of several forces between teeth; empty where it names no load.
std::string load_factor_of(const Model& model, const ChannelInfo& force);

// The axis that changes the period of the forcing. Throws InputError when there is none.
std::size_t find_speed_axis(const Study& study);

struct ReportFindings {
  std::string name;  // of one of several studies, in words; empty where it is alone
  Study given;       // as it was
  Study study;       // the same, with the quantities of the report
  Study line;        // the same over the speed, its other axis at one value
  std::size_t speed = 0;
  std::optional<std::pair<std::string, double>> at;  // that axis and value; none: there is no other
  std::vector<std::string> quantities;               // those of the list below that the model has
  // The mesh that has the largest load factor at any speed: its force in words, "force of the
  // second mesh", and the maps below. A gear pair has one mesh, and no words.
  std::string mesh;
  std::string force;               // the largest force
  std::string load_factor;         // may be empty
  std::string iso_load_factor;     // the one that K_v is of: that of the model's load
  std::vector<std::string> apart;  // shares of time without contact, of each contact
  std::string vibration;  // standard deviation of the force; of a model without, the largest value
  // Of how many equal parts a quantity is shown, that of part 1; none: of one. And by how much of
  // their values these differ.
  std::map<std::string, int> alike;
  double unlike = 0.0;
  double jump = 1.0;  // static_jump() at the first of the speeds
  // What ranks the speeds: the largest force, where it is clearly more than that jump, which it is
  // at any speed; otherwise the vibration.
  std::string ranking;
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

  int count_of(const std::string& quantity) const {
    const auto found = alike.find(quantity);
    return found == alike.end() ? 1 : found->second;
  }
  bool is_si() const { return study.scales.known(); }
  std::string file(const std::string& stored) const { return (folder->path() / stored).string(); }
  // A map over both axes, in SI units where these are known.
  ResultMap map(const std::string& stored, const std::string& quantity) const;
  // The same over the speed alone, from "line.nc", "up.nc", "down.nc", "tolerances.nc".
  ResultMap over_speed(const std::string& stored, const std::string& quantity) const;
};

// One study, or two of which the second is compared with the first.
using Sides = std::vector<ReportFindings>;

// By which factor the force between the teeth rises at once where the stiffness jumps: the
// deflection, which cannot jump, is that of the static equilibrium. The largest at all break
// phases, at least 1; 1 of a model without such a force. A load factor begins with it at any speed.
double static_jump(const Model& model, const ModelSetting& setting);

// Nothing when stopped.
std::optional<ReportFindings> find_for_report(const Study& study, const ReportOptions& options);

}  // namespace gearsweep
