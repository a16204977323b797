#include "result/orbit_dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <complex>
#include <functional>
#include <numeric>
#include <stdexcept>

#include "orbits/returns.hpp"
#include "result/detail/file_notes.hpp"

namespace gearsweep {
namespace {

constexpr const char* kContentOfOrbits = "orbits of gearsweep";

using Orbits = std::vector<const Orbit*>;
using Names = std::vector<std::string>;

std::vector<std::string> varied_parameters(const OrbitFindings& findings) {
  if (!findings.range) return {};
  return {findings.study.model->parameters[findings.range->parameter].name};
}

// Puts the dataset together, variable by variable.
class OrbitDescription {
 public:
  explicit OrbitDescription(const OrbitFindings& findings)
      : findings_(findings),
        study_(findings.study),
        model_(*findings.study.model),
        line_(orbits_of(findings)),
        bifurcations_(bifurcations_of(findings)),
        kind_(findings.orbit.kind),
        spectrum_(kind_ == OrbitKind::equilibrium ? "eigenvalue" : "multiplier"),
        notes_(findings.study, varied_parameters(findings)) {
    bifurcation_branch_.resize(bifurcations_.size(), 0.0);
    orbit_branch_.resize(line_.orbits.size(), 0.0);
    for (std::size_t i = 0; i < findings.leaving.size(); ++i) append_leaving(i);
  }

  Dataset make(const Provenance& provenance) {
    add_notes(provenance);
    add_states();
    add_count(spectrum_, static_cast<std::size_t>(findings_.orbit.multipliers.size()));
    Names along;
    if (findings_.range) {
      along = {"orbit"};
      add_count("orbit", line_.orbits.size());
    }
    for (const std::size_t parameter : findings_.placed) add_parameter(parameter, along);
    Orbits orbits;
    for (const BranchOrbit& member : line_.orbits) orbits.push_back(&member.orbit);
    add_orbits("", along, orbits);
    add_errors();
    if (findings_.range) add_bifurcations();
    if (findings_.generations > 0) add_leaving();
    out_.attributes.push_back({"coordinates", fmt::format("{}", fmt::join(coordinates_, " "))});
    return std::move(out_);
  }

 private:
  // The orbits and bifurcations of a branch that leaves others, after those of the ones before it.
  void append_leaving(std::size_t i) {
    const LeavingBranch& leaving = findings_.leaving[i];
    const auto number = static_cast<double>(i + 1);
    const std::vector<BranchOrbit> orbits = orbits_of(findings_, leaving);
    line_.orbits.insert(line_.orbits.end(), orbits.begin(), orbits.end());
    orbit_branch_.resize(line_.orbits.size(), number);
    origins_.push_back(number_of_origin(leaving));
    const std::vector<LocatedBifurcation> own = bifurcations_of(leaving.branches);
    bifurcations_.insert(bifurcations_.end(), own.begin(), own.end());
    bifurcation_branch_.resize(bifurcations_.size(), number);
  }

  // From 1 on. Its parent stands before it.
  double number_of_origin(const LeavingBranch& leaving) const {
    const LocatedBifurcation& origin = leaving.origin;
    for (std::size_t i = 0; i < bifurcations_.size(); ++i) {
      const LocatedBifurcation& one = bifurcations_[i];
      if (bifurcation_branch_[i] == static_cast<double>(leaving.parent) &&
          one.kind == origin.kind && one.parameter == origin.parameter &&
          one.orbit.state == origin.orbit.state) {
        return static_cast<double>(i + 1);
      }
    }
    throw std::logic_error("a branch leaves no bifurcation");
  }

  void add_notes(const Provenance& provenance) {
    out_.attributes = {{"content", kContentOfOrbits}};
    for (Attribute& own : notes_.provenance(provenance)) out_.attributes.push_back(std::move(own));
    out_.attributes.push_back({"kind", name_of(kind_)});
    if (kind_ == OrbitKind::forced) {
      out_.attributes.push_back({"forcing_period", findings_.forcing_period});
    }
    if (const std::optional<Nearest> nearest = nearest_bifurcation(findings_.orbit)) {
      out_.attributes.push_back({"nearest_bifurcation", name_of(*nearest)});
      out_.attributes.push_back({"nearest_margin", nearest->margin});
    }
    if (!findings_.range) return;
    Names ended;
    for (const Branch& branch : findings_.branches) ended.push_back(branch.ended);
    out_.attributes.push_back({"along", model_.parameters[findings_.range->parameter].name});
    out_.attributes.push_back({"start_orbit", static_cast<double>(line_.start + 1)});
    out_.attributes.push_back({"ended", fmt::format("{}", fmt::join(ended, "; "))});
  }

  void add(const std::string& name, Stored stored, const Names& dimensions,
           std::vector<Attribute> attributes, std::vector<double> numbers) {
    out_.variables.push_back({.name = name,
                              .stored = stored,
                              .dimensions = dimensions,
                              .attributes = std::move(attributes),
                              .elements = std::move(numbers)});
  }

  void add_count(const std::string& name, std::size_t size) {
    out_.dimensions.push_back({name, size});
    std::vector<double> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 1.0);
    add(name, Stored::integer, {name}, notes_.describe("", "number of the " + name), numbers);
  }

  void add_states() {
    out_.dimensions.push_back({"state", model_.states.size()});
    add_texts("state", "state of the model", "state", model_.state_names(), &out_);
    notes_.add_channels(model_.states, "state", "state", &out_);
  }

  // A parameter with the name of something else here gives way.
  std::string name_here(const std::string& parameter) const {
    const Names own = {"orbit",       "bifurcation",      "multiplier",       "state",
                       "period",      "stable",           "section",          "multiplier_real",
                       "grazing",     "multiplier_error", "section_error",    "multiplier_imag",
                       "eigenvalue",  "eigenvalue_real",  "eigenvalue_imag",  "eigenvalue_error",
                       "cycle_time",  "cycle_time_error", "multiplier_along", "branch",
                       "orbit_branch"};
    const bool is_taken = std::find(own.begin(), own.end(), parameter) != own.end() ||
                          parameter.starts_with("state_") ||
                          parameter.starts_with("bifurcation_") || parameter.starts_with("branch_");
    return is_taken ? "parameter_" + parameter : parameter;
  }

  // Whether it is what the orbit is followed along, or derived from that.
  bool changes_along(std::size_t parameter) const {
    const std::size_t followed = findings_.range->parameter;
    const DerivedParameter* const derived = model_.find_derived(parameter);
    return parameter == followed ||
           (derived != nullptr &&
            std::ranges::find(derived->from, followed) != derived->from.end());
  }

  void add_parameter(std::size_t parameter, const Names& along) {
    const ParameterInfo& info = model_.parameters[parameter];
    const bool is_followed = findings_.range && changes_along(parameter);
    std::vector<double> values = {study_.setting.parameters[parameter]};
    if (is_followed) {
      values.clear();
      ModelSetting setting = study_.setting;
      for (const BranchOrbit& member : line_.orbits) {
        setting.parameters[findings_.range->parameter] = member.parameter;
        model_.derive(&setting);
        values.push_back(setting.parameters[parameter]);
      }
    }
    add(name_here(info.name), Stored::real, is_followed ? along : Names{},
        notes_.describe(info.unit, info.meaning), std::move(values));
    coordinates_.push_back(name_here(info.name));
  }

  // What an orbit has, of each of these.
  void add_orbits(const std::string& prefix, const Names& along, const Orbits& orbits) {
    const auto each = [&](const std::function<void(const Orbit&, std::vector<double>*)>& append) {
      std::vector<double> numbers;
      for (const Orbit* orbit : orbits) append(*orbit, &numbers);
      return numbers;
    };
    if (kind_ != OrbitKind::equilibrium) {
      add(prefix + "period", Stored::integer, along, notes_.describe("1", period_meaning()),
          each([](const Orbit& orbit, auto* out) {
            out->push_back(static_cast<double>(orbit.period));
          }));
    }
    add(prefix + "stable", Stored::byte, along, notes_.describe("", stable_meaning()),
        each([](const Orbit& orbit, auto* out) { out->push_back(orbit.stable() ? 1.0 : 0.0); }));
    Names of_states = along, of_multipliers = along;
    of_states.emplace_back("state");
    of_multipliers.push_back(spectrum_);
    const std::string where = kind_ == OrbitKind::forced  ? "state of the orbit at phase 0"
                              : kind_ == OrbitKind::cycle ? "a state of the cycle"
                                                          : "the equilibrium";
    add(prefix + "section", Stored::real, of_states, notes_.describe(model_.states, "state", where),
        each([](const Orbit& orbit, auto* out) {
          out->insert(out->end(), orbit.state.begin(), orbit.state.end());
        }));

    add(prefix + spectrum_ + "_real", Stored::real, of_multipliers,
        notes_.describe("1", "real part of the " + spectrum_ + "s"),
        each([](const Orbit& orbit, auto* out) {
          for (const std::complex<double>& m : orbit.multipliers) out->push_back(m.real());
        }));
    add(prefix + spectrum_ + "_imag", Stored::real, of_multipliers,
        notes_.describe("1", "imaginary part of the " + spectrum_ + "s"),
        each([](const Orbit& orbit, auto* out) {
          for (const std::complex<double>& m : orbit.multipliers) out->push_back(m.imag());
        }));
    if (kind_ != OrbitKind::cycle) return;
    add(prefix + "cycle_time", Stored::real, along,
        notes_.describe("1", "dimensionless time of a turn of the cycle"),
        each([](const Orbit& orbit, auto* out) { out->push_back(orbit.duration); }));
    add(prefix + "multiplier_along", Stored::real, along,
        notes_.describe("1", "multiplier along the cycle, which is 1 but for the steps' error"),
        each([](const Orbit& orbit, auto* out) { out->push_back(orbit.along.value_or(1.0)); }));
  }

  std::string period_meaning() const {
    if (kind_ == OrbitKind::forced) return "period of the orbit in forcing periods";
    return "returns to " + place_of_returns(model_) + " in a turn of the cycle";
  }
  std::string stable_meaning() const {
    return kind_ == OrbitKind::equilibrium ? "whether no eigenvalue has a positive real part"
                                           : "whether no multiplier lies outside the unit circle";
  }

  void add_errors() {
    const OrbitError& error = findings_.error;
    const std::string of_start = findings_.range ? " of the orbit at the start" : "";
    add("section_error", Stored::real, {"state"},
        notes_.describe(model_.states, "state", "error of each state" + of_start + " at most"),
        {error.state.begin(), error.state.end()});
    add(spectrum_ + "_error", Stored::real, {spectrum_},
        notes_.describe("1",
                        "error of each part of the " + spectrum_ + "s" + of_start + " at most"),
        {error.multipliers.begin(), error.multipliers.end()});
    if (kind_ == OrbitKind::cycle) {
      add("cycle_time_error", Stored::real, {},
          notes_.describe("", "error of the time of a turn" + of_start + " at most"),
          {error.duration});
    }
    add("grazing", Stored::byte, {},
        notes_.describe("", "whether the motion" + of_start + " grazes a limit of the backlash"),
        {error.grazing() ? 1.0 : 0.0});
  }

  void add_bifurcations() {
    const std::vector<LocatedBifurcation>& all = bifurcations_;
    const ParameterInfo& followed = model_.parameters[findings_.range->parameter];
    const Names along = {"bifurcation"};
    add_count("bifurcation", all.size());
    Names kinds;
    Orbits orbits;
    for (const LocatedBifurcation& one : all) {
      kinds.push_back(name_of(one.kind, kind_));
      orbits.push_back(&one.orbit);
    }
    add_texts("bifurcation_kind", "what happens there", "bifurcation", kinds, &out_);
    const auto add_each = [&](const std::string& name, Stored stored, const std::string& unit,
                              const std::string& meaning, const auto& value) {
      std::vector<double> numbers;
      for (const LocatedBifurcation& one : all) numbers.push_back(value(one));
      add("bifurcation_" + name, stored, along, notes_.describe(unit, meaning), numbers);
    };
    add_each("value", Stored::real, followed.unit, followed.meaning,
             [](const LocatedBifurcation& one) { return one.parameter; });
    add_each("error", Stored::real, followed.unit, "error of the value at most",
             [](const LocatedBifurcation& one) { return one.error; });
    add_each("grazing", Stored::byte, "", "whether the motion grazes a limit of the backlash",
             [](const LocatedBifurcation& one) { return one.grazing ? 1.0 : 0.0; });
    add_each("born_of", Stored::integer, "1",
             "period of the orbits that the branch was born of there; 0: it was not",
             [](const LocatedBifurcation& one) { return static_cast<double>(one.born_of); });
    add_orbits("bifurcation_", along, orbits);
  }

  void add_leaving() {
    const std::string first = "; 0: the first branch";
    add("orbit_branch", Stored::integer, {"orbit"},
        notes_.describe("1", "the branch that the orbit is on" + first), orbit_branch_);
    add("bifurcation_branch", Stored::integer, {"bifurcation"},
        notes_.describe("1", "the branch that the bifurcation is on" + first), bifurcation_branch_);
    add_count("branch", findings_.leaving.size());
    std::vector<double> parents, periods, counts;
    Names ended;
    for (std::size_t i = 0; i < findings_.leaving.size(); ++i) {
      const LeavingBranch& leaving = findings_.leaving[i];
      parents.push_back(static_cast<double>(leaving.parent));
      periods.push_back(static_cast<double>(leaving.period));
      counts.push_back(
          static_cast<double>(std::ranges::count(orbit_branch_, static_cast<double>(i + 1))));
      Names ways;
      for (const Branch& branch : leaving.branches) ways.push_back(branch.ended);
      ended.push_back(ways.empty() ? "no orbit is found beside the bifurcation"
                                   : fmt::format("{}", fmt::join(ways, "; ")));
    }
    add("branch_leaves", Stored::integer, {"branch"},
        notes_.describe("1", "the branch that it leaves" + first), parents);
    add("branch_origin", Stored::integer, {"branch"},
        notes_.describe("1", "number of the bifurcation at which it leaves"), origins_);
    if (kind_ != OrbitKind::equilibrium) {
      add("branch_period", Stored::integer, {"branch"}, notes_.describe("1", period_meaning()),
          periods);
    }
    add("branch_orbits", Stored::integer, {"branch"},
        notes_.describe("1", "how many orbits the branch has"), counts);
    add_texts("branch_ended", "how each way of the branch ended", "branch", ended, &out_);
  }

  const OrbitFindings& findings_;
  const Study& study_;
  const Model& model_;
  // Of the first branch, then of all that leave it, and the number of the branch that each is on.
  OrbitLine line_;
  std::vector<LocatedBifurcation> bifurcations_;
  std::vector<double> orbit_branch_, bifurcation_branch_;
  std::vector<double> origins_;  // of the branches that leave, the number of the bifurcation
  const OrbitKind kind_;
  const std::string spectrum_;  // the name of one of the numbers that decide the stability
  const FileNotes notes_;
  Names coordinates_;
  Dataset out_;
};

}  // namespace

Dataset dataset_of(const OrbitFindings& findings, const Provenance& provenance) {
  return OrbitDescription(findings).make(provenance);
}

}  // namespace gearsweep
