#include "result/study_source.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/regular_file.hpp"
#include "result/broken_file.hpp"
#include "result/result_file.hpp"
#include "study/builtin_studies.hpp"
#include "study/draft.hpp"

namespace gearsweep {
namespace {

constexpr std::uintmax_t kMaxStudyBytes = std::uintmax_t{16} << 20U;

std::string read_text(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error && bytes > kMaxStudyBytes) {
    throw InputError(fmt::format("{}: too large for a study; a study is a short TOML text", path));
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InputError(fmt::format("{}: cannot be read", path));
  return text.str();
}

// A file of results, which is whole.
bool is_result(const std::string& path) {
  if (!has_regular_file(path, "a study")) return false;
  ensure_not_broken(path);
  return is_netcdf(path);
}

// The text of a file of TOML or of a built-in study.
std::string text_of_study(const std::string& name_or_path) {
  if (has_regular_file(name_or_path, "a study")) return read_text(name_or_path);
  const bool is_builtin = builtin_studies().count(name_or_path + ".toml") > 0;
  if (!is_builtin && name_or_path.find_first_of("./") != std::string::npos) {
    throw InputError(fmt::format("{}: there is no such file", name_or_path));
  }
  return builtin_study_text(name_or_path);
}

}  // namespace

std::vector<std::string> builtin_study_names() {
  std::vector<std::string> names;
  for (const auto& [file, text] : builtin_studies()) {
    names.push_back(std::filesystem::path(file).replace_extension().string());
  }
  return names;
}

const std::string& builtin_study_text(const std::string& name) {
  const auto found = builtin_studies().find(name + ".toml");
  if (found == builtin_studies().end()) {
    throw InputError(fmt::format("there is no built-in study '{}'{}", name,
                                 suggest_name(name, builtin_study_names())));
  }
  return found->second;
}

Study read_result_study(const std::string& path, const std::vector<std::string>& overrides,
                        const std::vector<std::string>& zooms) {
  return read_study(read_study_text(path), path, overrides, zooms, read_point_table(path),
                    NamedFiles::refused);
}

Study find_study(const std::string& name_or_path, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& zooms) {
  if (is_result(name_or_path)) return read_result_study(name_or_path, overrides, zooms);
  return read_study(text_of_study(name_or_path), name_or_path, overrides, zooms);
}

Study find_draft(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  if (is_result(name_or_path)) return read_result_study(name_or_path, overrides);
  const std::string text = text_of_study(name_or_path);
  std::vector<std::string> all = overrides;
  if (("\n" + text).find("\n[model]") == std::string::npos) {
    all.emplace(all.begin(), "model.name=gear5");
  }
  return read_draft(text, name_or_path, all);
}

}  // namespace gearsweep
