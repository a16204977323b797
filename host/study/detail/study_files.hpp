// The files that a study names.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "study/study.hpp"

namespace gearsweep {

// The only way from a key of a study to a file, so that a text that may name none opens none.
class StudyFiles {
 public:
  // source: the study's own file, or what messages call its text.
  StudyFiles(std::string source, NamedFiles files);

  // The path of the file that `node`, a string, names beside the study. Throws InputError where the
  // text may name none, unless the node is not of the text but of an option of the user's.
  std::string path_of(const toml::node& node) const;

 private:
  bool is_of_option(const toml::node& node) const;

  std::string source_;
  NamedFiles files_;
};

}  // namespace gearsweep
