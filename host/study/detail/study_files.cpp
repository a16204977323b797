#include "study/detail/study_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "study/detail/number_lines.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {

StudyFiles::StudyFiles(std::string source, NamedFiles files)
    : source_(std::move(source)), files_(files) {}

std::string StudyFiles::path_of(const toml::node& node) const {
  const std::string& name = node.as_string()->get();
  if (files_ == NamedFiles::refused && !is_of_option(node)) {
    fail_at(node, fmt::format("this study names the file '{}', but the study of a result may name "
                              "none: what it needs of files is in the result. Name a file of your "
                              "own with --set",
                              shown_field(name)));
  }
  return (std::filesystem::path(source_).parent_path() / name).string();
}

bool StudyFiles::is_of_option(const toml::node& node) const {
  const toml::source_path_ptr& path = node.source().path;
  return path && *path != source_ && path->starts_with("--set ");
}

}  // namespace gearsweep
