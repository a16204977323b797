#include "distribute/make_engine.hpp"

#include "opencl/opencl_engine.hpp"
#include "reference/reference_engine.hpp"

namespace gearsweep {

std::unique_ptr<Engine> make_engine(const Study& study, std::optional<DeviceChoice> choice) {
  if (study.integrate.engine == EngineKind::reference) return make_reference_engine();
  return make_opencl_engine(study, choice);
}

}  // namespace gearsweep
