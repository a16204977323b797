#include "study/study_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "gear/drawing_keys.hpp"
#include "model/names.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

std::string quoted(const std::string& text) { return '"' + text + '"'; }

// "Numbers of teeth." of "numbers of teeth".
std::string sentence(std::string_view words) {
  std::string text(words);
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text + ".";
}

StudyKey whole(const std::string& name, std::size_t fallback, double min, double max,
               const std::string& meaning) {
  return {name, "whole number", fmt::format("{}", fallback), meaning, min, max};
}

StudyKey one_of(const std::string& name, const std::vector<std::string>& choices,
                const std::string& fallback, const std::string& meaning) {
  return {name, "string", fallback, meaning, 0.0, 0.0, choices};
}

StudyKey truth(const std::string& name, bool fallback, const std::string& meaning) {
  return {name, "true or false", fmt::format("{}", fallback), meaning};
}

StudyTable whole_study() {
  const std::string table = "table";
  return {
      "",
      "the study",
      "What stands before the first table.",
      {{"title", "string", "\"\"", "What the study is about; stands above pictures.", 0.0, 1000.0},
       {"model", table, "", "Which system, and its options."},
       {"parameters", table, "", "Values of parameters."},
       {"gear", table, "", "Dimensions of a gear pair, from which parameters follow."},
       {"axes", "one or two tables", "required",
        "What is swept; the first axis is x. A list of points may take the place of one."},
       {"points", table, "", "A list of points, instead of an axis or beside one."},
       {"sections", table, "", "Places at which motions are looked at, beside the model's own."},
       {"initial", table, "", "Where points start."},
       {"uncertain", table, "", "Parameters that are known within tolerances."},
       {"integrate", table, "", "How, and for how long, points are integrated."},
       {"observe", table, "", "What becomes a map."}}};
}

StudyTable model_table() {
  StudyKey option{"OPTION", "string", "the preset's",
                  "An option of the model, as formulation, backlash and stiffness of gear5: "
                  "'gearsweep model NAME' lists them with their choices."};
  option.is_pattern = true;
  return {"model",
          "[model]",
          "The preset's values come first, then those of [gear], then those of [parameters].",
          {{"name", "string", quoted(kDefaultModel), "The model: 'gearsweep model' lists them."},
           {"file", "string", "",
            "A model of your own instead: the file with its equations, beside the study."},
           {"text", "string", "", "The text of that file, where a result holds the study."},
           {"tables", "table", "",
            "The numbers of the files that its table() reads, where a result holds the study: a "
            "phase in radians and a value per line, by the file's name."},
           {"curves", "table", "",
            "The model's curves by name, each with the file of its points, beside the study: "
            "NAME = \"file.csv\", or NAME = { file = \"file.csv\", interpolation = \"cubic\" }."},
           {"preset", "string", "the model's first",
            "Values to start from: 'gearsweep model NAME' lists them."},
           option}};
}

StudyTable parameters_table() {
  StudyKey parameter{
      "PARAMETER", "number or expression", "the preset's",
      "A parameter of the model: 'gearsweep model NAME' lists them with unit, range "
      "and meaning. A text is an expression of other parameters, worked out at each "
      "point: k2 = \"1.1*k1\". Parameters that continue as NAME_2, NAME_3 may be "
      "given as a list: kappa = [0.1, 0.02]. A constant of the model's text that is a "
      "plain number may be given, too."};
  parameter.is_pattern = true;
  const StudyKey estimated{
      "estimated", "list of strings", "",
      "Those of the parameters above whose values are guesses: a report says so."};
  return {"parameters",
          "[parameters]",
          "An axis wins over a parameter of the same name.",
          {parameter, estimated}};
}

// In the order of KeyForm.
constexpr std::string_view kForms[] = {"number",
                                       "[pinion, gear]",
                                       "number or [pinion, gear]",
                                       "number or [pinion x, pinion y, gear x, gear y]",
                                       "number or list, harmonic by harmonic",
                                       "string",
                                       "file beside the study",
                                       "file with a number per tooth",
                                       "file over the path of contact"};

StudyTable sections_table() {
  StudyKey section{
      "SECTION", "table", "",
      "A name of your own, with when = \"v\", an expression that goes through 0 there, "
      "and direction = \"up\", as without it, or \"down\"; or with maximum_of = \"x\" "
      "or minimum_of = \"x\". Its quantities begin with its name: top_return_time."};
  section.is_pattern = true;
  return {"sections",
          "[sections]",
          "Places at which a motion is looked at where it comes through them.",
          {section}};
}

StudyTable gear_table() {
  StudyTable table{
      "gear",
      "[gear]",
      "A gear pair in the units of a drawing, for the model gear5; the unit is in the "
      "name of the key. 'gearsweep model --study STUDY' shows how each parameter "
      "comes about. A value in [parameters] wins over what follows from here. A model whose "
      "file has [drawings] takes these keys in [gear.NAME].",
      {}};
  for (const GearKey& key : kGearKeys) {
    table.keys.push_back({std::string(key.name),
                          std::string(kForms[static_cast<std::size_t>(key.form)]),
                          std::string(key.fallback), sentence(key.meaning), key.min, key.max,
                          split_words(std::string(key.choices))});
  }
  table.keys.push_back({"estimated", "list of strings", "",
                        "Those of the keys above whose values are guesses: a report says so."});
  table.keys.push_back({"tables", "table", "",
                        "The numbers of these files, by their names, where a result holds the "
                        "study."});
  return table;
}

StudyTable axes_table() {
  const std::string number = "number";
  return {
      "axes",
      "[[axes]]",
      "Each axis is a table of its own, [[axes]], with from, to and count, or with values.",
      {{"name", "string", "required",
        "A parameter of the model, a constant that is a plain number, or a state: then the initial "
        "value is swept. With a "
        "[gear] table also a key of it, in the unit of the drawing: torque_N_m."},
       {"from", number, "", "The first value, within the range of what is swept."},
       {"to", number, "from", "The last value; greater than from."},
       {"count", "whole number", "", "How many values.", 1.0, 1e6},
       one_of("scale", {"linear", "log"}, quoted("linear"), "How the values are spaced."),
       {"values", "list of numbers", "",
        "The values themselves, increasing; as many as count may be."}}};
}

StudyTable points_table() {
  return {
      "points",
      "[points]",
      "Points that lie on no grid, one result for each: parameters and initial states from "
      "columns. They are the axis 'point', numbered from 1; with [[axes]], each point has all "
      "values of the axis. Columns may be keys of [gear], too, in the unit of the drawing; with "
      "a column time_share, the share of time of each point, they are a load spectrum.",
      {{"file", "string", "",
        "A file beside the study: a line of names, then a line of numbers for each point, "
        "with commas, semicolons or blanks between."},
       {"names", "list of strings", "",
        "Where the study holds the numbers itself, or the result that it is from: the names."},
       {"numbers", "string", "", "The same: the lines of the points."},
       {"slope", "number", fmt::format("{}, of pitting", kUsualSlope),
        "Of a load spectrum, which has a column time_share: to which power Miner's rule takes "
        "a load.",
        1.0, 100.0}}};
}

StudyTable initial_table() {
  const Initial initial;
  std::vector<std::string> starts;
  for (const InitialPolicyInfo& info : initial_policies()) {
    starts.push_back(fmt::format("{}: {}", info.name, info.meaning));
  }
  return {"initial",
          "[initial]",
          "",
          {one_of("policy", policy_names(),
                  fmt::format("the preset's, otherwise {}; where state is given: {}",
                              quoted(info_of(initial.policy).name),
                              quoted(info_of(InitialPolicy::fixed).name)),
                  fmt::format("Where a point starts: {}.", fmt::join(starts, "; "))),
           {"state", "table", "the preset's, otherwise 0 for each state",
            fmt::format("Of policy {}: the initial value of each state, {{x1 = 0.2}}.",
                        info_of(InitialPolicy::fixed).name)},
           {"along", "string", "the first axis",
            fmt::format("Of policies {}: the axis to go along.",
                        fmt::join(policy_names(true), " and "))},
           whole("ensemble", initial.ensemble, 1, 4096,
                 "Trajectories of each point: the policy's start, and seeded random ones around "
                 "it."),
           whole("seed", initial.seed, 0, 1e9, "Of an ensemble: another seed, other starts."),
           {"spread", "number or table", "1.0",
            "Of an ensemble: how far the random starts reach to both sides, for all states or "
            "state by state, {x1 = 2.0, v1 = 1.0}.",
            0.0, kMaxState}}};
}

StudyTable uncertain_table() {
  StudyKey parameter{
      "PARAMETER", "table", "",
      "A parameter of the model, or a key of [gear], and its distribution: {distribution = "
      "\"normal\", mean = 0.05, std = 0.01} (mean: the parameter's own value; folded = true: what "
      "comes out below 0 loses its sign, as an amplitude does), \"uniform\" with "
      "from and to, \"triangular\" with from, mode and to, or values = [...] or file = "
      "\"loads.csv\", a number a line, of which each is as likely. With relative = true the "
      "numbers "
      "are factors of the point's own value, which an axis may give."};
  parameter.is_pattern = true;
  return {"uncertain",
          "[uncertain]",
          "Each point is integrated with many draws of these parameters, the same for all points. "
          "Beside the map of a quantity with the nominal parameters there are those of its mean, "
          "standard deviation and percentiles over the draws, and of the share of each class.",
          {whole("samples", kUsualSamples, 2, 1e5, "Draws of each point."),
           whole("seed", Uncertain().seed, 0, 1e9, "Another seed, other draws."),
           {"percentiles", "list of numbers", "[5, 50, 95]",
            "Which percentiles become maps, increasing.", 0.0, 100.0},
           one_of("start", {"own", "nominal"}, quoted("own"),
                  "Where a draw starts. own: as any point of the study; nominal: from where the "
                  "motion of the nominal parameters ends at its point. A draw that stays on that "
                  "motion's branch then settles sooner; where several motions are possible, it is "
                  "the nominal one that is followed."),
           truth("sobol", false,
                 "Sobol indices of each quantity: which share of its variance each parameter "
                 "makes, alone (first) and with all others (total). It takes samples times two "
                 "more than the number of uncertain parameters, trajectories. A study without axes "
                 "is that of its one point."),
           truth("keep", Uncertain().keep,
                 "Keep each quantity in each draw as well (QUANTITY_draws, along the dimension "
                 "draw), and what the parameters are there (uncertain_value)."),
           parameter}};
}

StudyTable integrate_table() {
  const Integrate integrate;
  return {
      "integrate",
      "[integrate]",
      "A period is that of the forcing: of gears, the mesh period, or as many of them as the "
      "parameter cycle says; then settle, record and warm_up are shorter by default. lanes, tile, "
      "local_size and "
      "round change how a study is computed and never what comes out.",
      {one_of("precision", {"fp32", "fp64"}, quoted(integrate.fp64 ? "fp64" : "fp32"),
              "Of all numbers on the device."),
       {"tolerance", "number", "1e-3",
        "A pilot run finds the longest step with which each map is right to this share of its "
        "range, at 99 % of its periodic points. Unless asked for, only where that pays; 0: none.",
        0.0, 0.1},
       {"exponent_tolerance", "number", "",
        "The same for maps of Lyapunov exponents and of what is made of them, which take the "
        "shortest steps; by default as tolerance.",
        kMinTolerance, 0.1},
       {"max_step", "number", "the model's, or what the study finds",
        "Instead of tolerance: the longest step, in the model's time.", kMinMaxStep, kMaxMaxStep},
       {"steps_per_period", "whole number", "", "Instead of tolerance: at least so many steps.",
        8.0, 4194304.0},
       whole("orbit_steps", integrate.orbit_steps, 1, kMaxOrbitSteps,
             "Steps on the periodic orbit that a point has stopped on, for one of the run: what is "
             "told of the orbit, exponents above all, is as right as shorter steps make it. A "
             "pilot run finds this, too."),
       {"diverged_above", "number or table", "the model's",
        "A state that goes beyond it has diverged: in the model's units, for all states or state "
        "by state, {p = 1e12}. A model that names none has diverged when a state is no number any "
        "more.",
        1.0 / kMaxState, kMaxState},
       truth("events", integrate.events, "Correct the steps in which teeth meet or part."),
       whole("settle", integrate.settle, 0, 1e8, "Periods before recording."),
       whole("record", integrate.record, 1, 1e7, "Periods recorded."),
       whole("warm_up", integrate.warm_up, 0, 1e8,
             "Last periods of settle that tangent vectors are turned in, for exponents."),
       whole("extend", integrate.extend, 1, 1024,
             "An undecided point goes on into windows of up to so many records."),
       one_of("stop", {"orbit", "never"}, quoted("orbit"),
              "orbit: a point that arrives on a periodic orbit stops there; never: it runs on to "
              "the end."),
       one_of("states", {"driving", "all"}, quoted("driving"),
              "driving: states that drive nothing that is looked at are left out; all: each is "
              "integrated."),
       one_of("engine", {"opencl", "reference"}, quoted("opencl"),
              "reference: a second opinion on the host, slow."),
       whole("lanes", integrate.lanes, 0, 16,
             "Points per work-item: 1, 2, 4, 8 or 16; 0: what suits the device."),
       whole("tile", integrate.tile, 0, 1e8, "Points per launch; 0: what suits the device."),
       whole("local_size", integrate.local_size, 0, 4096,
             "Work-items per work-group; 0: what suits the device."),
       whole("round", integrate.round, 0, 1e6, "Periods per launch; 0: what suits the device."),
       truth("contract", integrate.contract, "Allow fused multiply-add.")}};
}

StudyTable observe_table() {
  return {"observe",
          "[observe]",
          "",
          {{"quantities", "list of strings", "the first state's rms, and poincare on one axis",
            "What becomes a map: 'gearsweep model NAME' lists them. status is always there."},
           {"poincare", "list of strings", "the first state",
            "States sampled at phase 0 of each recorded period, for the quantity poincare."},
           {"section", "string", "phase 0",
            "A section of the model or the study, at which the quantity poincare is sampled "
            "instead: at the first so many returns as there are recorded periods. Of a model "
            "without forcing its first section, by which motion_class, period and cycle_time are "
            "judged."},
           {"period_tolerance", "number", "1e-6",
            "Two states at phase 0 are the same when they differ by no more than this, relative to "
            "the range of the motion. Without it 1e-4 in fp32.",
            1e-12, 0.1},
           {"orders", "list of numbers", "[1, 2, 3]",
            "Of which multiples of the mesh frequency amplitude and phase are asked for, by the "
            "quantities that end on order_amplitude and order_phase; fractions are allowed. At "
            "most 32.",
            1e-3, 1e3}}};
}

}  // namespace

const std::vector<StudyTable>& study_tables() {
  static const std::vector<StudyTable> kTables = {
      whole_study(),     model_table(),     parameters_table(), gear_table(),
      axes_table(),      points_table(),    sections_table(),   initial_table(),
      uncertain_table(), integrate_table(), observe_table()};
  return kTables;
}

const StudyTable& study_table(const std::string& name) {
  const auto found = std::find_if(study_tables().begin(), study_tables().end(),
                                  [&](const StudyTable& table) { return table.name == name; });
  if (found == study_tables().end()) throw std::logic_error("no table " + name);
  return *found;
}

const StudyKey* find_key(const StudyTable& table, const std::string& name) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(), [&](const StudyKey& key) {
    return key.name == name && !key.is_pattern;
  });
  return found == table.keys.end() ? nullptr : &*found;
}

std::vector<std::string> paths_of_key(const std::string& name,
                                      const std::vector<std::string>& options,
                                      const std::vector<std::string>& parameters) {
  std::vector<std::string> exact, longer;
  for (const StudyTable& table : study_tables()) {
    if (table.name.empty()) continue;
    std::vector<std::string> keys;
    for (const StudyKey& key : table.keys) {
      if (!key.is_pattern) keys.push_back(key.name);
    }
    if (table.name == "model") keys.insert(keys.end(), options.begin(), options.end());
    if (table.name == "parameters") keys.insert(keys.end(), parameters.begin(), parameters.end());
    const std::string before = table.name + (table.name == "axes" ? ".AXIS." : ".");
    if (std::ranges::find(keys, name) != keys.end()) exact.push_back(before + name);
    for (const std::string& key : longer_names(name, keys)) longer.push_back(before + key);
  }
  return exact.empty() ? longer : exact;
}

}  // namespace gearsweep
