// Order maps as pictures, and run-up beside run-down.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "orders/order_map.hpp"
#include "plot/picture_test.hpp"
#include "result/order_dataset.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::count_of;
using gearsweep::testing::kProvenance;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class PlotOrdersTest : public gearsweep::testing::PictureTest {
 protected:
  // Order 1 has the amplitude 1 and order 2 a thousandth of it; two of three modes are one.
  std::string orders_file(const std::string& gear = "") const {
    OrderMap map;
    map.study =
        read_study(gear + "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 6\n", "test");
    map.study.title = "a gear";
    map.channel = {"dmf", "k0 b_n", "a force"};
    map.orders = {0.0, 0.5, 1.0, 1.5, 2.0};
    for (const double omega : map.axis().values) {
      map.forcing.push_back(omega);
      map.mean.push_back(0.0);
      for (const double amplitude : {0.0, 0.0, 1.0, 0.0, 0.001}) map.amplitude.push_back(amplitude);
      map.modes.push_back({{0.7, 0.1}, {0.7, 0.1}, {1.2, 0.1}});
    }
    write_orders(map, in_folder("orders.nc"), kProvenance);
    return in_folder("orders.nc");
  }

  PlotRequest request(const std::string& quantity = "", const std::string& rays = "") const {
    return {.paths = {orders_file()}, .quantity = quantity, .rays = rays};
  }

  // Two runs over omega that part at its third and fourth value, in the directions asked for.
  std::string directed(const std::string& policy, bool is_high) const {
    SweepResult result = gearsweep::testing::example_result(7, 0);
    result.study.selection = select_quantities(*result.study.model, {"dmf_max"}, {});
    result.study.toml =
        "[model]\nname = 'gear5'\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 2.0\ncount = 7\n"
        "[initial]\npolicy = '" +
        policy +
        "'\nalong = 'omega'\n"
        "[observe]\nquantities = ['dmf_max']\n";
    const double between = is_high ? 3.0 : 1.0;
    result.values = {{1.0, 1.0, between, between, 3.0, 3.0, 3.0}};
    result.status.assign(7, 0);
    result.samples.clear();
    const std::string path = in_folder(policy + ".nc");
    write_result(result, path, kProvenance);
    return path;
  }
};

TEST_F(PlotOrdersTest, AFrequencyIsUprightUnlessOrdersAreAskedFor) {
  const std::string frequency = script_of(request());
  EXPECT_THAT(frequency,
              AllOf(HasSubstr("frequency ("), HasSubstr("amplitude of meshing force (dB")));
  const std::string order = script_of(request("order"));
  EXPECT_THAT(order, AllOf(HasSubstr("\"mesh order\""), Not(HasSubstr("frequency ("))));
  EXPECT_THAT(refusal([&] { plotted(request("orders")); }), HasSubstr("over 'frequency'"));
}

TEST_F(PlotOrdersTest, ColoursGo80DecibelsDownFromTheLargest) {
  EXPECT_THAT(script_of(request()), HasSubstr("set cbrange [-80:0]"));
}

TEST_F(PlotOrdersTest, EqualModesAreOneLineAndEachRayIsOne) {
  const std::string script = script_of(request("", "1,2,1/2"));
  EXPECT_EQ(count_of("linecolor rgb '#ffffff'", script), 2U);
  EXPECT_THAT(script, HasSubstr("\"1/2\" at"));
  EXPECT_THAT(script_of(request("", "none")), Not(HasSubstr("mesh orders")));
  for (const std::string rays : {"x", "1,-2", "1/0", "1,"}) {
    EXPECT_THAT(refusal([&] { plotted(request("", rays)); }), HasSubstr("--rays")) << rays;
  }
}

// The second pinion has 18 teeth on the shaft of a gear of 41: the model's own values.
TEST_F(PlotOrdersTest, ASecondMeshHasRaysOfItsOwn) {
  const std::string file = orders_file("[model]\nname = 'two_stages'\n");
  const std::vector<ExcitingMesh> meshes = read_orders(file).meshes;
  ASSERT_EQ(meshes.size(), 2U);
  EXPECT_EQ(meshes[0].name, "first");
  EXPECT_EQ(meshes[1].name, "second");
  EXPECT_NEAR(meshes[1].order, 18.0 / 41.0, 1e-12);
  const std::string script = script_of({.paths = {file}, .rays = "2,1:second,3/2:second"});
  EXPECT_THAT(script, AllOf(HasSubstr("orders of first"), HasSubstr("orders of second")));
  EXPECT_EQ(count_of("linecolor rgb '#d070ff'", script), 2U + 1U);  // the key's, too
  EXPECT_THAT(script_of({.paths = {file}, .quantity = "order"}), HasSubstr("mesh order of first"));
  EXPECT_THAT(refusal([&] { plotted({.paths = {file}, .rays = "1:third"}); }),
              HasSubstr("the meshes are first and second"));
  EXPECT_THAT(refusal([&] { plotted(request("", "1:second")); }), HasSubstr("of one mesh"));
}

TEST_F(PlotOrdersTest, OtherFilesAndOptionsAreRefused) {
  PlotRequest asked = request();
  asked.paths.push_back(asked.paths.front());
  EXPECT_THAT(refusal([&] { plotted(asked); }), HasSubstr("one file at a time"));
  asked = request();
  asked.at = {{"omega", 0.5}};
  EXPECT_THAT(refusal([&] { plotted(asked); }), HasSubstr("gearsweep orders"));
  asked = request();
  asked.style.has_units = asked.style.is_si = true;
  EXPECT_THAT(refusal([&] { plotted(asked); }), HasSubstr("[gear]"));
  EXPECT_THAT(refusal([&] {
                plotted({.paths = {write(gearsweep::testing::example_result())}, .rays = "1"});
              }),
              HasSubstr("--rays is for order maps"));
}

TEST_F(PlotOrdersTest, RunUpAndRunDownShowWhereTheyPart) {
  const std::string up = directed("forward", false), down = directed("backward", true);
  for (const bool is_first : {true, false}) {
    const std::vector<std::string> paths = is_first ? std::vector{up, down} : std::vector{down, up};
    const std::string script = script_of({.paths = paths, .quantity = "dmf_max"});
    // Steps of 0.2667: the run-up jumps behind the fourth value, the run-down before the third.
    EXPECT_THAT(script,
                AllOf(HasSubstr("\"run-up\""), HasSubstr("\"run-down\""),
                      HasSubstr("run-up jumps at 1.333"), HasSubstr("run-down jumps at 0.8")));
  }
  EXPECT_THAT(script_of({.paths = {up, up}, .quantity = "dmf_max"}), Not(HasSubstr("jumps")));
}

}  // namespace
}  // namespace gearsweep
