// gearsweep model: what a model offers, and the values that a preset or a study gives it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/detail/answer_list.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/named_model.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/detail/text_table.hpp"
#include "cli/standard_streams.hpp"
#include "result/json_text.hpp"
#include "study/builtin_models.hpp"
#include "study/toml_text.hpp"

namespace gearsweep {
namespace {

struct ModelArguments {
  std::string name, preset, study;
  bool as_json = false, as_text = false, as_kernel = false, of_answers = false;
};

// The model with a preset's values. A study needs an axis; one of an initial state changes none of
// the parameters. model_key: "name = 'gear5'".
Study study_of_preset(const std::string& model_key, const Model& model, const std::string& preset) {
  std::string text = fmt::format("[model]\n{}\n", model_key);
  if (!preset.empty()) text += fmt::format("preset = {}\n", toml_quoted(preset));
  text += fmt::format("[[axes]]\nname = '{}'\nvalues = [0.0]\n", model.states.front().name);
  const Study study = read_study(text, "--preset");
  tell_notices(study);
  return study;
}

Study study_of(const ModelArguments& arguments) {
  if (!arguments.study.empty()) return load_study(arguments.study, {});
  const NamedModel named = named_model(arguments.name);
  return study_of_preset(named.key, *named.model, arguments.preset);
}

// What a parameter or signal means, and what it is to the tool.
template <class Info>
std::string meaning_of(const Info& info) {
  const std::string role = name_of(info.role);
  return role.empty() ? info.meaning : fmt::format("{} (role {})", info.meaning, role);
}

// Where a parameter's value comes from; swept and uncertain ones say so.
std::string origin_of(const Study& study, std::size_t parameter) {
  const Swept* swept = study.find_on_axes(parameter);
  if (const DerivedParameter* derived = study.model->find_derived(parameter)) {
    return fmt::format("= {}, {}{}", derived->expression, study.parameter_origins[parameter],
                       study.differs(parameter) ? ", at each point" : "");
  }
  if (swept == nullptr) {
    const bool is_uncertain = study.find_swept(false, parameter) != nullptr;
    return study.parameter_origins[parameter] + (is_uncertain ? ", [uncertain]" : "");
  }
  const auto [min, max] = std::ranges::minmax(swept->values);
  return fmt::format("axis, {} .. {}, {} values", min, max, swept->values.size());
}

void print_models(bool of_answers) {
  if (of_answers) {
    std::vector<const Model*> all;
    for (const Model& model : models()) all.push_back(&model);
    answer("{}", answer_list(all));
    return;
  }
  TextTable rows;
  for (const Model& model : models()) rows.add({model.name, model.summary});
  answer("{}'gearsweep model NAME' shows one in full\n", rows.text(0));
}

void print_parameters(const Study& study) {
  const Model& model = *study.model;
  answer("\nparameters (value, unit, allowed range, meaning; origin)\n");
  TextTable parameters;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    parameters.add({info.name, fmt::format("{:.10g}", study.setting.parameters[i]), info.unit,
                    fmt::format("{:g} .. {:g}", info.min, info.max),
                    fmt::format("{}; {}", meaning_of(info), origin_of(study, i))});
  }
  answer("{}\noptions\n", parameters.text());
  TextTable options;
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const OptionInfo& option = model.options[i];
    const auto chosen = static_cast<std::size_t>(study.setting.options[i]);
    options.add({option.name, option.choices[chosen],
                 fmt::format("of {}: {}; {}", fmt::join(option.choices, ", "), option.meaning,
                             study.option_origins[i])});
  }
  answer("{}", options.text());
  TextTable constants;
  bool has_some = false;
  for (const ConstantInfo& constant : model.constants) {
    if (!constant.number) continue;
    constants.add({constant.name, fmt::format("{:.10g}", *constant.number)});
    has_some = true;
  }
  if (!has_some) return;
  answer("\nconstants that a study may give or sweep as parameters\n{}", constants.text());
}

// What decides for a state when its motion recurs, and when it has left for good.
std::string judged_by(const Model& model, std::size_t state) {
  std::vector<std::string> others;
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    const bool shares = i != state && model.range_groups[i] == model.range_groups[state];
    if (shares) others.push_back(model.states[i].name);
  }
  std::string text;
  if (!others.empty()) text += fmt::format("; shares a range with {}", fmt::join(others, ", "));
  const double bound = model.diverged_above[state];
  if (std::isfinite(bound)) text += fmt::format("; diverged above {:g}", bound);
  return text;
}

void print_channels(const Model& model) {
  TextTable states, signals;
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    const ChannelInfo& info = model.states[i];
    states.add({info.name, info.unit, meaning_of(info) + judged_by(model, i)});
  }
  for (const ChannelInfo& info : model.signals) {
    if (!info.is_hidden) signals.add({info.name, info.unit, meaning_of(info)});
  }
  answer("\nstates\n{}\nsignals\n{}", states.text(), signals.text());
}

// Quantities that every channel has are listed once, by their suffix.
void print_quantities(const Model& model) {
  answer("\nquantities\n");
  TextTable rows;
  const std::string& first = model.states.front().name;
  const std::string of_first = model.states.front().meaning + ": ";
  for (const Quantity& quantity : offered_quantities(model)) {
    std::string name = quantity.name, meaning = quantity.meaning;
    if (!quantity.channel.empty()) {
      if (quantity.channel != first) continue;
      name = "CHANNEL" + name.substr(first.size());
      meaning = meaning.substr(of_first.size());
    }
    if (!quantity.flags.empty()) meaning += fmt::format(" ({})", fmt::join(quantity.flags, ", "));
    rows.add({name, meaning});
  }
  answer("{}CHANNEL is a state or a signal, as in {}_rms\n", rows.text(), first);
}

// Where a point starts that no axis moves: of states, what the policy gives them.
std::vector<double> start_of(const Study& study) {
  if (study.initial.policy == InitialPolicy::fixed) return study.initial.state;
  return study.model->equilibrium(study.setting);
}

std::string describe_start(const Study& study) {
  const InitialPolicyInfo& policy = info_of(study.initial.policy);
  std::vector<std::string> states;
  const std::vector<double> start = start_of(study);
  for (std::size_t i = 0; i < start.size(); ++i) {
    states.push_back(fmt::format("{} = {:.10g}", study.model->states[i].name, start[i]));
  }
  return fmt::format("a point starts {} (policy {}): {}", policy.meaning, policy.name,
                     fmt::join(states, ", "));
}

void print_model(const Study& study) {
  const Model& model = *study.model;
  answer("{}: {}\npreset {}\n{}\n", model.name, model.summary, study.preset, describe_start(study));
  if (model.max_step > 0.0) {
    answer("its own step is {}; large studies find theirs\n", model.max_step);
  } else {
    answer("it names no max_step: each study finds its step\n");
  }
  print_parameters(study);
  if (!study.gear_notes.empty()) {
    answer("\nfrom the [gear] table\n");
    for (const std::string& note : study.gear_notes) answer("  {}\n", note);
  }
  if (study.scales.known()) {
    answer(
        "  {}one unit of omega is {:.6g} rpm of the pinion; b_n = {:.6g} um; k0 b_n = {:.6g} "
        "N; varpi = {:.6g} rad/s\n",
        model.unit_drawing.empty()
            ? ""
            : fmt::format("the units are those of '{}': ", model.unit_drawing),
        study.scales.rpm_per_omega, 1e6 * study.scales.b_n, study.scales.k0 * study.scales.b_n,
        study.scales.varpi);
  }
  print_channels(model);
  print_quantities(model);
  std::vector<std::string> findings = model.findings;
  findings.insert(findings.end(), model.phase_findings.begin(), model.phase_findings.end());
  if (!findings.empty()) answer("\nfound in its equations\n");
  for (const std::string& line : findings) answer("  {}\n", line);
  TextTable presets;
  for (const PresetInfo& preset : model.presets) presets.add({preset.name, preset.meaning});
  answer("\npresets\n{}", presets.text());
  if (!model.answers.empty()) {
    answer("\nknown answers: {} (--answers lists them, 'gearsweep verify --model' computes them)\n",
           model.answers.size());
  }
}

void print_model_as_json(const Study& study) {
  const Model& model = *study.model;
  nlohmann::json json = {
      {"name", model.name},
      {"preset", study.preset},
      {"max_step", model.max_step > 0.0 ? nlohmann::json(model.max_step) : nlohmann::json()}};
  json["start"] = {{"policy", info_of(study.initial.policy).name}, {"state", start_of(study)}};
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    json["parameters"].push_back({{"name", info.name},
                                  {"value", study.setting.parameters[i]},
                                  {"unit", info.unit},
                                  {"range", {info.min, info.max}},
                                  {"meaning", info.meaning},
                                  {"origin", origin_of(study, i)}});
  }
  for (const ConstantInfo& constant : model.constants) {
    if (constant.number) json["constants"][constant.name] = *constant.number;
  }
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const auto chosen = static_cast<std::size_t>(study.setting.options[i]);
    json["options"][model.options[i].name] = model.options[i].choices[chosen];
  }
  json["findings"] = model.findings;
  json["phase_findings"] = model.phase_findings;
  for (const ChannelInfo& info : model.states) json["states"].push_back(info.name);
  for (const ChannelInfo& info : model.signals) {
    if (!info.is_hidden) json["signals"].push_back(info.name);
  }
  for (const Quantity& quantity : offered_quantities(model)) {
    json["quantities"].push_back(quantity.name);
  }
  answer("{}", json_text(json));
}

}  // namespace

void add_model_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand(
      "model", "List the models, or show one: parameters, states, quantities, presets");
  const auto arguments = std::make_shared<ModelArguments>();
  command->add_option("name", arguments->name, "The model to show")->type_name(kModelValue);
  CLI::Option* preset =
      command->add_option("--preset", arguments->preset, "Show the values of this preset")
          ->type_name("PRESET");
  command
      ->add_option("--study", arguments->study,
                   "Show the values that this study gives, [gear] table included")
      ->type_name(kStudyValue)
      ->excludes(preset);
  CLI::Option* json = command->add_flag("--json", arguments->as_json, "For scripts");
  CLI::Option* text =
      command
          ->add_flag("--text", arguments->as_text, "Print the model's file, to start your own from")
          ->excludes(json);
  command
      ->add_flag("--kernel", arguments->as_kernel,
                 "Print the OpenCL C that is made of the model's equations")
      ->excludes(json)
      ->excludes(text);
  command
      ->add_flag("--answers", arguments->of_answers,
                 "Print the known answers of the model, or of all, as a table of Markdown")
      ->excludes(json)
      ->excludes(text);
  command->footer(
      "Examples:\n"
      "  gearsweep model\n"
      "  gearsweep model gear5 --preset consistent\n"
      "  gearsweep model gear1 --text > mine.toml     a file of equations, to change\n"
      "  gearsweep model mine.toml                    what it has, and what was found in it\n"
      "  gearsweep model mine.toml --kernel           what the device's compiler gets\n"
      "  gearsweep model --study mine.toml\n"
      "  gearsweep model --answers                    what published models must give");
  command->callback([arguments] {
    if (arguments->name.empty() && arguments->study.empty()) {
      print_models(arguments->of_answers);
      return;
    }
    const Study study = study_of(*arguments);
    if (arguments->of_answers) {
      answer("{}", answer_list({study.model}));
    } else if (arguments->as_text) {
      answer("{}", study.model->text);
    } else if (arguments->as_kernel) {
      answer("{}", study.model->kernel);
    } else if (arguments->as_json) {
      print_model_as_json(study);
    } else {
      print_model(study);
    }
  });
}

}  // namespace gearsweep
