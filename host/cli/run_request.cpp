#include "cli/run_request.hpp"

#include "cli/detail/study_source.hpp"

namespace gearsweep {

Study requested_study(const RunRequest& request) {
  return load_study(request.study, request.overrides, request.zooms);
}

}  // namespace gearsweep
