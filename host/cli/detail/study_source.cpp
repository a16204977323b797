#include "cli/detail/study_source.hpp"

#include "cli/standard_streams.hpp"

namespace gearsweep {

Study load_study(const std::string& name_or_path, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& zooms) {
  const Study study = find_study(name_or_path, overrides, zooms);
  tell_notices(study);
  return study;
}

void tell_notices(const Study& study) {
  for (const std::string& notice : study.notices) tell("gearsweep: warning: {}\n", notice);
}

}  // namespace gearsweep
