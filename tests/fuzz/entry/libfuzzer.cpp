// libFuzzer's door to one target, GEARSWEEP_FUZZ_TARGET.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/targets.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gearsweep::testing::GEARSWEEP_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
