// Order maps against amplitudes that are known in closed form, and what they refuse.
#include "orders/order_map.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>

#include "model/error.hpp"
#include "orders/spectrum.hpp"
#include "result/order_dataset.hpp"
#include "support/folder.hpp"

namespace gearsweep {
namespace {

using ::testing::HasSubstr;

// x'' + 2 z x' + x = 0.4 cos(phase) + e cos(3 phase): each order answers by itself.
std::string linear_study(const std::string& more = "") {
  return "[model]\ntext = '''\n[model]\nname = \"linear\"\n[states]\nx = {}\nv = {}\n"
         "[parameters]\nomega = { value = 1.0, min = 0.1, max = 9, unit = \"varpi\" }\nz = 0.05\n"
         "e = 0.1\n"
         "[equations]\nx = \"v\"\nv = \"0.4*cos(phase) + e*cos(3*phase) - 2*z*v - x\"\n"
         "[forcing]\nperiod = \"2*pi/omega\"\n"
         "[signals]\nforce = { expression = \"x + 2\", unit = \"1\", meaning = \"force\" }\n'''\n"
         "[[axes]]\nname = 'omega'\nvalues = [0.3, 0.7, 1.4]\n"
         "[[axes]]\nname = 'e'\nvalues = [0.2, 0.5]\n"
         "[integrate]\nsettle = 120\nrecord = 6\nmax_step = 0.02\ntolerance = 0\n"
         "[observe]\nquantities = ['x_rms']\n" +
         more;
}

double response(double omega) {
  return 1.0 / std::abs(std::complex<double>(1.0 - omega * omega, 0.1 * omega));
}

const OrderMap& linear_map() {
  static const OrderMap kMap = [] {
    const Study whole = read_study(linear_study(), "test");
    OrderRequest request;
    request.channel = "force";
    request.orders = 4.0;
    request.samples_per_period = 64;
    return *map_orders(whole, request, {});
  }();
  return kMap;
}

double amplitude_at(const OrderMap& map, std::size_t point, double order) {
  const auto bin = static_cast<std::size_t>(std::lround(order / map.orders[1]));
  return map.amplitude[point * map.orders.size() + bin];
}

TEST(OrderMap, HasTheAmplitudesOfALinearResponse) {
  const OrderMap& map = linear_map();
  ASSERT_EQ(map.axis().values.size(), 3U);
  EXPECT_EQ(map.orders.size(), 25U);  // 0 to 4 by 1/6
  for (std::size_t point = 0; point < 3; ++point) {
    const double omega = map.axis().values[point];
    EXPECT_NEAR(amplitude_at(map, point, 1.0), 0.4 * response(omega), 2e-5);
    EXPECT_NEAR(amplitude_at(map, point, 3.0), 0.1 * response(3.0 * omega), 2e-5);
    for (const double silent : {0.5, 2.0, 2.5, 4.0}) {
      EXPECT_LT(amplitude_at(map, point, silent), 2e-5) << silent;
    }
    EXPECT_NEAR(map.mean[point], 2.0, 2e-5);
  }
}

TEST(OrderMap, TakesTheOtherAxisFromTheStudyUnlessItIsPlaced) {
  const Study whole = read_study(linear_study(), "test");
  const auto e_of = [](const Study& study) { return study.setting.parameters[2]; };
  EXPECT_EQ(e_of(study_over(whole, "omega", {})), 0.1);
  EXPECT_EQ(e_of(study_over(whole, "omega", find_place(whole, {{"e", 0.3}}, "--at"))), 0.3);
}

TEST(OrderMap, KnowsTheFrequencyOfOrderOneAndTheNaturalOne) {
  const OrderMap& map = linear_map();
  for (std::size_t point = 0; point < 3; ++point) {
    EXPECT_NEAR(map.forcing[point], map.axis().values[point], 1e-12);
    ASSERT_EQ(map.modes[point].size(), 1U);
    EXPECT_NEAR(map.modes[point][0].frequency, 1.0, 1e-12);
  }
}

TEST(OrderMap, IsReadAsItWasWritten) {
  const testing::Folder folder;
  const OrderMap& map = linear_map();
  write_orders(map, folder / "orders.nc", {"command", "1.0", "hash"});
  EXPECT_TRUE(is_order_file(folder / "orders.nc"));
  const StoredOrders stored = read_orders(folder / "orders.nc");
  EXPECT_EQ(stored.axis.name, "omega");
  EXPECT_EQ(stored.channel.name, "force");
  EXPECT_EQ(stored.orders, map.orders);
  EXPECT_EQ(stored.amplitude, map.amplitude);
  try {
    ResultFile(folder / "orders.nc");
    ADD_FAILURE() << "an order map was taken for maps";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds an order map"));
  }
  ASSERT_EQ(stored.frequencies.size(), 1U);
  EXPECT_NEAR(stored.frequencies[0][2], 1.0, 1e-12);
}

// Hz of a gear: its mesh frequency is teeth times turns of the pinion in a second.
TEST(OrderMap, HasHertzThatAreTeethTimesTurnsInASecond) {
  constexpr double kTeeth = 40.0;
  const Scales scales = {17.0, 1e-5, 2e8, 17.0 * 30.0 / 3.14159265358979323846 / kTeeth};
  const double omega = 0.8;
  EXPECT_NEAR(hertz_per_unit(scales) * omega, kTeeth * scales.rpm_per_omega * omega / 60.0, 1e-12);
}

// The slow error of an eccentric pinion of z teeth, times the stiffness of mesh order n, makes
// lines at n +- 1/z.
TEST(OrderMap, AnEccentricPinionHasSidebandsBesideTheMeshOrders) {
  constexpr double kTeeth = 5.0;
  const auto map_with = [](const std::string& runout) {
    const Study study = read_study(
        "[model]\npreset = 'coarse'\nerror = 'series'\n[parameters]\nzp = 5\ncycle = 5\n"
        "e0 = [0.02]\nrunout_p = " +
            runout +
            "\n[[axes]]\nname = 'omega'\n"
            "values = [0.35, 0.5, 0.6]\n[integrate]\nsettle = 60\nrecord = 2\n"
            "max_step = 0.1\ntolerance = 0\n[observe]\nquantities = ['x1_rms']\n",
        "test");
    OrderRequest request;
    request.orders = 3.0;
    request.samples_per_period = 64;
    return *map_orders(study, request, {});
  };
  const OrderMap sound = map_with("0.0"), eccentric = map_with("0.2");
  for (std::size_t point = 0; point < 3; ++point) {
    for (const double mesh : {1.0, 2.0}) {
      for (const double side : {-1.0, 1.0}) {
        const double line = amplitude_at(eccentric, point, mesh + side / kTeeth);
        EXPECT_GT(line, 1e-3 * amplitude_at(eccentric, point, mesh)) << point << mesh << side;
        EXPECT_LT(amplitude_at(sound, point, mesh + side / kTeeth), 1e-6 * line);
        EXPECT_LT(amplitude_at(eccentric, point, mesh + 0.5 * side / kTeeth), 1e-6 * line);
        // While the teeth stay together the equations are linear, so no wave is squared.
        EXPECT_LT(amplitude_at(eccentric, point, mesh + 2.0 * side / kTeeth), 1e-6 * line);
      }
    }
  }
}

std::string orders_refusal(const std::string& more, const std::string& over,
                           const std::string& channel, double orders = 4.0,
                           const std::vector<NamedValue>& at = {}) {
  const Study whole = read_study(linear_study(more), "test");
  OrderRequest request;
  request.over = over;
  request.channel = channel;
  request.orders = orders;
  request.samples_per_period = 16;
  try {
    request.place = find_place(whole, at, "--at");
    map_orders(whole, request, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was taken";
}

TEST(OrderMap, SaysWhatWouldBeRight) {
  EXPECT_THAT(orders_refusal("", "omga", ""), HasSubstr("did you mean 'omega'?"));
  EXPECT_THAT(orders_refusal("", "", "forc"), HasSubstr("did you mean 'force'?"));
  EXPECT_THAT(orders_refusal("", "", "x", 9.0), HasSubstr("give 36 samples per period"));
  EXPECT_THAT(orders_refusal("", "omega", "x", 4.0, {{"omega", 0.5}}),
              HasSubstr("the map goes over 'omega'"));
  EXPECT_THAT(orders_refusal("", "omega", "x", 4.0, {{"x", 0.5}}), HasSubstr("[initial]"));
  EXPECT_THAT(orders_refusal("[initial]\npolicy = 'forward'\nalong = 'e'\n", "omega", "x"),
              HasSubstr("--set initial.along=omega"));
}

}  // namespace
}  // namespace gearsweep
