#include "reproduce/detail/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/version.hpp"
#include "result/result_file.hpp"
#include "result/trace_file.hpp"
#include "study/builtin_studies.hpp"
#include "sweep/trace_run.hpp"

namespace gearsweep {
namespace {

constexpr double kLargeForce = 0.6;  // beyond it, figures 7 and 10 have jumped
constexpr std::size_t kMaxJumps = 12;

constexpr std::size_t kWholeSixths = 96;  // periods, so that sixths of the mesh order are lines
constexpr std::size_t kSamples = 256;     // per period, for spectra

// A run was stopped: unwinds to run_figures().
struct Stopped {};

class Runs {
 public:
  explicit Runs(const ReproduceOptions& options) : options_(options) {
    measured_.preset = options.preset;
    measured_.overrides = options.overrides;
  }

  MeasuredFigures all() {
    for (const std::string& name : figure_names()) {
      measured_.maps.emplace(name, sweep(name, study_of(name)));
    }
    for (const char* figure : {"fig5", "fig6"}) {
      measured_.traces[figure] = trace(figure, kWholeSixths, 0);
      trace(fmt::format("{}-even", figure), kWholeSixths, 0, kSamples);
    }
    measured_.traces["fig8"] = trace("fig8", 100, 0);
    measured_.traces["fig8-late"] = trace("fig8-late", 100, 1500);
    measured_.traces["fig11"] = trace("fig11", 8, 0);
    find_jumps("fig7");
    find_jumps("fig10");
    for (const char* direction : {"forward", "backward"}) {
      const std::string name = fmt::format("fig9-{}", direction);
      measured_.maps.emplace(
          name, sweep(name, study_of("fig9", {fmt::format("initial.policy={}", direction),
                                              fmt::format("title={}", direction),
                                              "integrate.settle=300"})));
    }
    for (const char* law : {"constant", "dynamic"}) {
      const std::string name = fmt::format("omega-b-{}", law);
      measured_.maps.emplace(name, sweep(name, map_study(law)));
    }
    step("energy of both formulations");
    measured_.drift_consistent = energy_drift("consistent");
    measured_.drift_printed = energy_drift("printed");
    return std::move(measured_);
  }

 private:
  void step(const std::string& what) const {
    if (options_.on_step) options_.on_step(what);
  }

  // The last override of a key counts.
  Study study_of(const std::string& figure, const std::vector<std::string>& overrides = {}) const {
    const std::string name = fmt::format("{}/{}", options_.preset, figure);
    std::vector<std::string> all = options_.overrides;
    all.insert(all.end(), overrides.begin(), overrides.end());
    return read_study(builtin_studies().at(name + ".toml"), name, all);
  }

  std::string path_of(const std::string& name) const {
    return options_.folder + "/" + name + ".nc";
  }
  Provenance provenance() const {
    std::string call = fmt::format("gearsweep reproduce --preset {}", options_.preset);
    for (const std::string& assignment : options_.overrides) call += " --set " + assignment;
    return {call, version(), source_hash()};
  }

  SweepResult compute(const Study& study) const {
    std::optional<SweepResult> result = run_sweep(study, options_.sweep_options());
    if (!result) throw Stopped();
    return *std::move(result);
  }

  SweepResult sweep(const std::string& name, const Study& study) const {
    step(fmt::format("{}: {} points", name, study.points()));
    SweepResult result = compute(study);
    write_result(result, path_of(name), provenance());
    return result;
  }

  // Each point of a figure of one axis; what stands after a hyphen in the name only tells two
  // traces of one figure apart.
  std::vector<Trace> trace(const std::string& name, std::size_t record, std::size_t settle,
                           std::size_t samples_per_period = 0) {
    const std::string figure = name.substr(0, name.find('-'));
    std::vector<std::string> overrides = {fmt::format("integrate.record={}", record)};
    if (settle > 0) overrides.push_back(fmt::format("integrate.settle={}", settle));
    const Study whole = study_of(figure, overrides);
    step(fmt::format("{}: time histories", name));
    std::vector<Trace> traces;
    std::vector<std::string> labels;
    const Axis& axis = whole.axes.front();
    for (const double value : axis.values) {
      Study point = whole;
      point.axes.front().values = {value};
      const std::optional<Trace> found =
          run_trace(point, samples_per_period, options_.sweep_options());
      if (!found) throw Stopped();
      traces.push_back(*found);
      labels.push_back(fmt::format("{}={}", axis.name, value));
    }
    write_traces(traces, labels, {axis.name}, whole, path_of(name + "-trace"), provenance());
    // Also each alone: motions of different size do not share a phase portrait well.
    for (std::size_t i = 0; i < traces.size(); ++i) {
      write_traces({traces[i]}, {labels[i]}, {axis.name}, whole,
                   path_of(fmt::format("{}-trace-{}", name, i + 1)), provenance());
    }
    return traces;
  }

  // How many attractors there are on both sides of each passage of the force through a large value
  // (of the first kMostJumps), and the basins at the first of them.
  void find_jumps(const std::string& figure) {
    const MapCurve force(measured_.maps.at(figure), "dmf_max");
    std::vector<MeasuredFigures::Jump> jumps;
    std::set<double> values;
    for (std::size_t i = 1; i < force.size() && jumps.size() < kMaxJumps; ++i) {
      if ((force[i] > kLargeForce) == (force[i - 1] > kLargeForce)) continue;
      jumps.push_back({force.x(i - 1), force.x(i), 0, 0});
      values.insert({force.x(i - 1), force.x(i)});
    }
    if (jumps.empty()) return;
    step(fmt::format("{}: attractors at {} jumps", figure, jumps.size()));
    Study study =
        study_of(figure, {"initial.ensemble=16", "integrate.settle=4000", "integrate.record=200",
                          "integrate.stop=orbit", "observe.quantities=[\"attractor_count\"]"});
    study.axes.front().values.assign(values.begin(), values.end());
    const SweepResult result = compute(study);
    const MapCurve count(result, "attractor_count");
    for (MeasuredFigures::Jump& jump : jumps) {
      jump.count_below = static_cast<std::size_t>(count[count.nearest(jump.below)]);
      jump.count_above = static_cast<std::size_t>(count[count.nearest(jump.above)]);
    }
    const MeasuredFigures::Jump& first = jumps.front();
    find_basins(figure, "below", first.below, first.count_below);
    find_basins(figure, "above", first.above, first.count_above);
    measured_.jumps.emplace(figure, std::move(jumps));
  }

  void find_basins(const std::string& figure, const char* side, double b, std::size_t counted) {
    const SweepResult basins =
        sweep(fmt::format("{}-basins-{}", figure, side), basin_study(figure, b));
    measured_.basins.push_back({figure, b, basins.attractors.size(), counted});
  }

  // Which attractor each initial x1 and v1 leads to, the rest at zero.
  Study basin_study(const std::string& figure, double b) const {
    return read_study(
        fmt::format("title = \"Basins at b = {:.4f}, {} backlash\"\n[model]\npreset = \"{}\"\n"
                    "backlash = \"{}\"\n[parameters]\nomega = 0.5\nb = {}\n"
                    "[[axes]]\nname = \"x1\"\nfrom = -2.0\nto = 2.5\ncount = 61\n"
                    "[[axes]]\nname = \"v1\"\nfrom = -1.2\nto = 1.2\ncount = 41\n"
                    "[initial]\npolicy = \"fixed\"\n[integrate]\nsettle = 2000\nrecord = 100\n"
                    "[observe]\nperiod_tolerance = 1e-4\nquantities = [\"attractor\"]\n",
                    b, law_of(figure), options_.preset, law_of(figure), b),
        "basins", options_.overrides);
  }

  static const char* law_of(const std::string& figure) {
    return figure == "fig10" ? "dynamic" : "constant";
  }

  Study map_study(const std::string& law) const {
    return read_study(
        fmt::format("title = \"Exponents and periods over omega and b, {0} backlash\"\n"
                    "[model]\npreset = \"{1}\"\nbacklash = \"{0}\"\n"
                    "[[axes]]\nname = \"omega\"\nfrom = 0.3\nto = 1.5\ncount = 121\n"
                    "[[axes]]\nname = \"b\"\nfrom = 0.3\nto = 1.3\ncount = 81\n"
                    "[integrate]\nsettle = 4000\nrecord = 100\nextend = 1\n"
                    "[observe]\nperiod_tolerance = 1e-4\n"
                    "quantities = [\"lyapunov_max\", \"period\", \"x1_rms\"]\n",
                    law, options_.preset),
        "omega-b", options_.overrides);
  }

  // Undamped, unforced, frictionless, with mesh stiffness 1 and no backlash, from a state away from
  // rest: largest relative change of (v1^2 + sum v^2/m + k x^2 + D^2)/2 over three periods.
  double energy_drift(const std::string& formulation) const {
    const SweepResult result = compute(read_study(
        fmt::format(
            "[model]\nstiffness = \"fourier\"\nformulation = \"{}\"\n[parameters]\n"
            "kappa = 0.0\nzeta = 0.0\nmu = 0.0\nF1 = 0.0\ne0 = 0.0\n[[axes]]\nname = \"b\"\n"
            "values = [0.0]\n[initial]\npolicy = \"fixed\"\nstate = {{x1 = 0.3, x3 = -0.1, "
            "x5 = 0.15, v1 = 0.4}}\n[integrate]\nsettle = 0\nrecord = 3\n"
            "steps_per_period = 2048\n[observe]\nquantities = [\"poincare\"]\n"
            "poincare = [\"x1\", \"x2\", \"x3\", \"x4\", \"x5\", \"v1\", \"v2\", \"v3\", "
            "\"v4\", \"v5\"]\n",
            formulation),
        "energy"));
    const ModelSetting& setting = result.study.setting;
    const Model& model = *result.study.model;
    const auto parameter = [&](const char* name) {
      return setting.parameters[static_cast<std::size_t>(model.find_parameter(name))];
    };
    const bool printed = formulation == "printed";
    const auto energy = [&](const std::vector<double>& x) {
      const double deflection = printed ? x[0] + x[2] - x[4] : x[0] - x[2] + x[4];
      double sum = x[5] * x[5] + deflection * deflection;
      for (std::size_t i = 1; i < 5; ++i) {
        const double mass = parameter(i < 3 ? "m1" : "m2");
        sum += x[i + 5] * x[i + 5] / mass + parameter("k1") * x[i] * x[i];
      }
      return 0.5 * sum;
    };
    const double start = energy({0.3, 0.0, -0.1, 0.0, 0.15, 0.4, 0.0, 0.0, 0.0, 0.0});
    double drift = 0.0;
    for (std::size_t period = 0; period < 3; ++period) {
      std::vector<double> x;
      for (std::size_t state = 0; state < 10; ++state) {
        x.push_back(result.samples[state * 3 + period]);
      }
      drift = std::max(drift, std::abs(energy(x) / start - 1.0));
    }
    return drift;
  }

  const ReproduceOptions& options_;
  MeasuredFigures measured_;
};

}  // namespace

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> kNames = {"fig4",  "fig4-friction", "fig5", "fig6",
                                                  "fig7",  "fig8",          "fig9", "fig9-dynamic",
                                                  "fig10", "fig11"};
  return kNames;
}

std::optional<MeasuredFigures> run_figures(const ReproduceOptions& options) {
  try {
    return Runs(options).all();
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace gearsweep
