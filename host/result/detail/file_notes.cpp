#include "result/detail/file_notes.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <numbers>

#include "study/settings.hpp"

namespace gearsweep {
namespace {

// cm = 2 zeta varpi me, with varpi^2 = k0/me.
double unit_of_damping(const Study& study, const std::vector<std::string>& varied) {
  const int zeta = study.model->find_parameter("zeta");
  if (!study.scales.known() || zeta < 0) return 0.0;
  if (std::find(varied.begin(), varied.end(), "zeta") != varied.end()) return 0.0;
  const double ratio = study.setting.parameters[static_cast<std::size_t>(zeta)];
  return 2.0 * ratio * study.scales.k0 / study.scales.varpi;
}

bool have_one_unit(const std::vector<ChannelInfo>& channels) {
  return std::all_of(channels.begin(), channels.end(), [&](const ChannelInfo& channel) {
    return channel.unit == channels.front().unit;
  });
}

}  // namespace

FileNotes::FileNotes(const Study& study, const std::vector<std::string>& varied, NetcdfFile* file)
    : study_(study), file_(*file), damping_(unit_of_damping(study, varied)) {}

void FileNotes::put_provenance(const Provenance& provenance) {
  const auto put = [&](const char* name, const auto& value) {
    file_.put_attribute(NC_GLOBAL, name, value);
  };
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  put("title", study_.title);
  put("study", study_.toml);
  put("settings", resolved_settings(study_));
  put("gearsweep_version", provenance.version);
  put("source_hash", provenance.source_hash);
  put("command_line", provenance.command_line);
  put("created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now)));
  const Scales& scales = study_.scales;
  if (!scales.known()) return;
  put("scale_varpi_rad_per_s", scales.varpi);
  put("scale_b_n_m", scales.b_n);
  put("scale_k0_N_per_m", scales.k0);
  put("scale_force_N", scales.k0 * scales.b_n);
  put("scale_rpm_per_omega", scales.rpm_per_omega);
}

SiUnit FileNotes::si_of(const std::string& unit) const {
  if (!study_.scales.known()) return {1.0, "1"};
  if (unit == "cm" && damping_ > 0.0) return {damping_, "N s/m"};
  if (unit == "degree") return {std::numbers::pi / 180.0, "rad"};
  if (unit == "rad") return {1.0, "rad"};
  const SiUnit si = si_unit(unit, study_.scales);
  return si.scale > 0.0 ? si : SiUnit{1.0, "1"};
}

void FileNotes::describe(int variable, const std::string& unit, const std::string& meaning) {
  file_.put_attribute(variable, "units", unit.empty() ? "1" : unit);
  file_.put_attribute(variable, "long_name", meaning);
  const SiUnit si = si_of(unit);
  if (si.name == "1") return;
  file_.put_attribute(variable, "scale_to_SI", si.scale);
  file_.put_attribute(variable, "SI_units", si.name);
}

void FileNotes::describe(int variable, const std::vector<ChannelInfo>& channels,
                         const std::string& list, const std::string& meaning) {
  describe(variable, have_one_unit(channels) ? channels.front().unit : "see " + list + "_units",
           meaning);
  file_.put_attribute(variable, "coordinates",
                      fmt::format("{}", fmt::join(lists_of_channels(list), " ")));
}

void FileNotes::put_channels(const std::vector<ChannelInfo>& channels, const std::string& list,
                             int dimension) {
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
  put_texts(list + "_units", "unit of " + each, dimension, units);
  put_texts(list + "_long_name", "meaning of " + each, dimension, meanings);
  if (!study_.scales.known()) return;
  const int scale = file_.define_variable(list + "_scale_to_SI", NC_DOUBLE, {dimension});
  describe(scale, "see " + list + "_SI_units", "1 of the unit of " + each);
  file_.put(scale, {0}, {scales.size()}, scales);
  put_texts(list + "_SI_units", "unit of SI of " + each, dimension, si_units);
}

void FileNotes::put_texts(const std::string& variable, const std::string& meaning, int dimension,
                          const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  const int length = file_.define_dimension(variable + "_strlen", width);
  const int id = file_.define_variable(variable, NC_CHAR, {dimension, length});
  file_.put_attribute(id, "long_name", meaning);
  file_.put_attribute(id, "_Encoding", "utf-8");
  std::string all;
  for (std::string text : texts) {
    text.resize(width, '\0');
    all += text;
  }
  file_.put_text(id, {0, 0}, {texts.size(), width}, all);
}

std::vector<std::string> FileNotes::lists_of_channels(const std::string& list) const {
  std::vector<std::string> lists = {list + "_units", list + "_long_name"};
  if (study_.scales.known()) {
    lists.insert(lists.end(), {list + "_scale_to_SI", list + "_SI_units"});
  }
  return lists;
}

std::string time_unit(const Model& model) {
  const bool has_scales = std::any_of(
      model.states.begin(), model.states.end(),
      [](const ChannelInfo& state) { return state.unit.find("varpi") != std::string::npos; });
  return has_scales ? "1/varpi" : "1";
}

}  // namespace gearsweep
