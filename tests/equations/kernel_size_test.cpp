// A kernel that no device compiler should be given.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/error.hpp"
#include "study/model_file.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string stops_multiplied(int count) {
  std::string product = "x";
  for (int i = 0; i < count; ++i) product += fmt::format("*stop(x, {:.1f})", 0.1 * i);
  return "[model]\nname = 'm'\n[states]\nx = {}\nv = {}\n[equations]\nx = 'v'\nv = '-x - 1e-9*" +
         product + "'\n[forcing]\nperiod = 'a'\n[parameters]\na = 1.0\n";
}

TEST(KernelSize, IsLimitedAndTheExpressionIsNamed) {
  EXPECT_NO_THROW(read_model_text(stops_multiplied(20), "m.toml"));
  try {
    read_model_text(stops_multiplied(160), "m.toml");
    FAIL() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("m.toml:8:"), HasSubstr("the equation of 'v'"),
                                    HasSubstr("4 MB"), HasSubstr("-x - 1e-9*x*stop(")));
  }
}

}  // namespace
}  // namespace gearsweep::testing
