#include "result/detail/file_notes.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <numeric>

#include "model/exciting_meshes.hpp"
#include "result/detail/file_names.hpp"
#include "study/settings.hpp"

namespace gearsweep {
namespace {

// cm = 2 zeta varpi me, with varpi^2 = k0/me.
double unit_of_damping(const Study& study, const std::vector<std::string>& varied) {
  const std::optional<std::size_t> zeta = study.model->parameter_of(Role::mesh_damping);
  if (!study.scales.known() || !zeta) return 0.0;
  const std::string& name = study.model->parameters[*zeta].name;
  if (std::find(varied.begin(), varied.end(), name) != varied.end()) return 0.0;
  if (study.model->find_derived(*zeta) != nullptr && study.differs(*zeta)) return 0.0;
  return 2.0 * study.setting.parameters[*zeta] * study.scales.k0 / study.scales.varpi;
}

// How long a period is, where it is more than one of the mesh and the same at all points.
std::vector<Attribute> turns_of(const Study& study) {
  const Model& model = *study.model;
  const double periods = model.mesh_periods(study.setting);
  const bool varies = std::ranges::any_of(model.cycle_parameters, [&](std::size_t parameter) {
    return study.find_swept(false, parameter) != nullptr;
  });
  if (periods == 1.0 || varies) return {};
  std::vector<Attribute> notes = {{kMeshPeriods, periods}};
  const std::optional<std::size_t> teeth = model.parameter_of(Role::pinion_teeth);
  const std::optional<std::size_t> ratio = model.parameter_of(Role::teeth_ratio);
  if (!teeth || !ratio || study.differs(*teeth) || study.differs(*ratio)) return notes;
  const double pinion = study.setting.parameters[*teeth];
  const double gear = pinion * study.setting.parameters[*ratio];
  notes.push_back({"pinion_turns_per_period", periods / pinion});
  notes.push_back({"gear_turns_per_period", periods / gear});
  return notes;
}

// What is said of a second mesh whose frequency is the same share of the first one's at all points.
std::vector<Attribute> other_mesh_of(const Study& study) {
  const std::optional<std::size_t> order = study.model->parameter_of(Role::mesh_order);
  if (!order || study.differs(*order)) return {};
  const std::vector<ExcitingMesh> meshes = exciting_meshes(*study.model, study.setting);
  return {{kMeshOfPhase, meshes.front().name},
          {kOtherMesh, meshes.back().name},
          {kOtherMeshOrder, meshes.back().order}};
}

bool have_one_unit(const std::vector<ChannelInfo>& channels) {
  return std::all_of(channels.begin(), channels.end(), [&](const ChannelInfo& channel) {
    return channel.unit == channels.front().unit;
  });
}

}  // namespace

FileNotes::FileNotes(const Study& study, const std::vector<std::string>& varied)
    : study_(study), damping_(unit_of_damping(study, varied)) {}

std::vector<Attribute> FileNotes::provenance(const Provenance& provenance) const {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::vector<Attribute> notes = {
      {"title", study_.title},
      {"study", study_.brief_toml()},
      {"settings", resolved_settings(study_)},
      {"gearsweep_version", provenance.version},
      {"source_hash", provenance.source_hash},
      {"command_line", provenance.command_line},
      {"created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
  };
  if (!study_.accuracy.empty()) notes.push_back({"accuracy", study_.accuracy});
  for (Attribute& own : turns_of(study_)) notes.push_back(std::move(own));
  for (Attribute& own : other_mesh_of(study_)) notes.push_back(std::move(own));
  const Scales& scales = study_.scales;
  if (!scales.known()) return notes;
  notes.push_back({"scale_varpi_rad_per_s", scales.varpi});
  notes.push_back({"scale_b_n_m", scales.b_n});
  notes.push_back({"scale_k0_N_per_m", scales.k0});
  notes.push_back({"scale_force_N", scales.k0 * scales.b_n});
  notes.push_back({"scale_rpm_per_omega", scales.rpm_per_omega});
  const std::string& drawing = study_.model->unit_drawing;
  if (!drawing.empty()) notes.push_back({"scales_of_drawing", drawing});
  return notes;
}

SiUnit FileNotes::si_of(const std::string& unit) const {
  if (!study_.scales.known()) return {1.0, "1"};
  if (unit == "cm" && damping_ > 0.0) return {damping_, "N s/m"};
  if (unit == "degree") return {std::numbers::pi / 180.0, "rad"};
  if (unit == "rad") return {1.0, "rad"};
  const SiUnit si = si_unit(unit, study_.scales);
  return si.scale > 0.0 ? si : SiUnit{1.0, "1"};
}

std::vector<Attribute> FileNotes::describe(const std::string& unit,
                                           const std::string& meaning) const {
  std::vector<Attribute> notes = {{"units", unit.empty() ? "1" : unit}, {"long_name", meaning}};
  const SiUnit si = si_of(unit);
  if (si.name == "1") return notes;
  notes.push_back({"scale_to_SI", si.scale});
  notes.push_back({"SI_units", si.name});
  return notes;
}

std::vector<Attribute> FileNotes::describe(const std::vector<ChannelInfo>& channels,
                                           const std::string& list,
                                           const std::string& meaning) const {
  std::vector<Attribute> notes =
      describe(have_one_unit(channels) ? channels.front().unit : "see " + list + "_units", meaning);
  notes.push_back({"coordinates", fmt::format("{}", fmt::join(lists_of_channels(list), " "))});
  return notes;
}

void FileNotes::add_channels(const std::vector<ChannelInfo>& channels, const std::string& list,
                             const std::string& dimension, Dataset* out) const {
  std::vector<std::string> units, meanings, si_units;
  std::vector<double> scales;
  for (const ChannelInfo& channel : channels) {
    units.push_back(channel.unit);
    meanings.push_back(channel.meaning);
    const SiUnit si = si_of(channel.unit);
    scales.push_back(si.scale);
    si_units.push_back(si.name);
  }
  const std::string each = "each " + list;
  add_texts(list + "_units", "unit of " + each, dimension, units, out);
  add_texts(list + "_long_name", "meaning of " + each, dimension, meanings, out);
  if (!study_.scales.known()) return;
  out->variables.push_back(
      {.name = list + "_scale_to_SI",
       .stored = Stored::real,
       .dimensions = {dimension},
       .attributes = describe("see " + list + "_SI_units", "1 of the unit of " + each),
       .elements = scales});
  add_texts(list + "_SI_units", "unit of SI of " + each, dimension, si_units, out);
}

std::vector<std::string> FileNotes::lists_of_channels(const std::string& list) const {
  std::vector<std::string> lists = {list + "_units", list + "_long_name"};
  if (study_.scales.known()) {
    lists.insert(lists.end(), {list + "_scale_to_SI", list + "_SI_units"});
  }
  return lists;
}

void add_texts(const std::string& variable, const std::string& meaning,
               const std::string& dimension, const std::vector<std::string>& texts, Dataset* out) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string all;
  for (std::string text : texts) {
    text.resize(width, '\0');
    all += text;
  }
  const std::string letters = variable + "_strlen";
  out->dimensions.push_back({letters, width});
  out->variables.push_back({.name = variable,
                            .stored = Stored::letter,
                            .dimensions = {dimension, letters},
                            .attributes = {{"long_name", meaning}, {"_Encoding", "utf-8"}},
                            .elements = all});
}

void add_flags(const std::vector<std::string>& names, std::vector<Attribute>* attributes) {
  std::vector<signed char> codes(names.size());
  std::iota(codes.begin(), codes.end(), static_cast<signed char>(0));
  add_flags(codes, names, attributes);
}

void add_flags(const std::vector<signed char>& codes, const std::vector<std::string>& names,
               std::vector<Attribute>* attributes) {
  attributes->push_back({"flag_values", codes});
  attributes->push_back({"flag_meanings", fmt::format("{}", fmt::join(names, " "))});
}

std::string time_unit(const Model& model) {
  const bool has_scales = std::any_of(
      model.states.begin(), model.states.end(),
      [](const ChannelInfo& state) { return state.unit.find("varpi") != std::string::npos; });
  return has_scales ? "1/varpi" : "1";
}

}  // namespace gearsweep
