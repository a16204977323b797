// What a device is said to suit.
#include "opencl/device.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

// The variable of this process, until the test's end.
class Lanes {
 public:
  explicit Lanes(const char* value) {
    if (const char* before = std::getenv(kName)) before_ = before;
    setenv(kName, value, 1);
  }
  Lanes(const Lanes&) = delete;
  Lanes& operator=(const Lanes&) = delete;
  ~Lanes() { before_ ? setenv(kName, before_->c_str(), 1) : unsetenv(kName); }

 private:
  static constexpr const char* kName = "GEARSWEEP_LANES";
  std::optional<std::string> before_;
};

TEST(Device, HasTheLanesThatTheEnvironmentAsksFor) {
  const Lanes lanes("2");
  for (const DeviceInfo& device : list_devices()) {
    EXPECT_EQ(device.lanes_fp64, device.is_cpu ? 2U : 1U) << device.name;
  }
}

TEST(Device, RefusesLanesThatNoVectorHas) {
  for (const char* value : {"3", "0", "32", "-4", "4 ", "all"}) {
    const Lanes lanes(value);
    EXPECT_THROW(list_devices(), InputError) << value;
  }
}

}  // namespace
}  // namespace gearsweep::testing
