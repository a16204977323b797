#include "plot/detail/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

// Lines "key = value" of TOML by their tables and keys.
std::map<std::string, std::string> settings_in(const std::string& toml) {
  std::map<std::string, std::string> settings;
  std::string table;
  for (const std::string& line : split(toml, '\n')) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with('[')) {
      table = line;
    } else if (equals != std::string::npos) {
      settings[table + line.substr(0, equals)] = line.substr(equals + 3);
    }
  }
  return settings;
}

}  // namespace

std::string setting_in(const std::string& toml, const std::string& table, const std::string& key) {
  std::map<std::string, std::string> settings = settings_in(toml);
  std::string value = settings["[" + table + "]" + key];
  std::erase_if(value, [](char letter) { return letter == '\'' || letter == '"'; });
  return value;
}

std::vector<std::string> differing_settings(const std::vector<std::string>& toml,
                                            const std::string& axis) {
  std::vector<std::map<std::string, std::string>> settings;
  for (const std::string& text : toml) settings.push_back(settings_in(text));
  std::vector<std::string> names(toml.size());
  std::size_t differing = 0;
  for (const auto& setting : settings.front()) {
    const std::string &key = setting.first, &value = setting.second;
    const bool tells = key.starts_with("[parameters]") || key.starts_with("[model]");
    const std::string name = key.substr(key.find(']') + 1);
    const bool same = std::all_of(settings.begin(), settings.end(), [&](const auto& other) {
      const auto found = other.find(key);
      return found != other.end() && found->second == value;
    });
    if (!tells || same || name == axis || name == "preset") continue;
    ++differing;
    for (std::size_t i = 0; i < toml.size(); ++i) {
      const auto found = settings[i].find(key);
      std::string own = found == settings[i].end() ? "" : found->second;
      std::erase(own, '\'');
      names[i] += fmt::format("{}{}={}", names[i].empty() ? "" : ", ", name, own);
    }
  }
  constexpr std::size_t kMost = 2;
  if (differing == 0 || differing > kMost) names.assign(toml.size(), "");
  return names;
}

std::vector<std::string> given_legend(const PlotStyle& style, std::size_t layers) {
  if (style.legend.size() != layers) {
    throw InputError(fmt::format("--legend: {} {} for {} curves; give one for each",
                                 style.legend.size(), style.legend.size() == 1 ? "name" : "names",
                                 layers));
  }
  std::vector<std::string> names;
  for (const std::string& name : style.legend) names.push_back(literal(name));
  return names;
}

}  // namespace gearsweep
