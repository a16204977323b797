// Places: what they refuse, and which point they mean.
#include "point/place.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Pair;
using ::testing::StartsWith;

Study whole_study(const std::string& more = "") {
  return read_study(
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.8, 1.0]\n"
      "[[axes]]\nname = 'b'\nvalues = [0.5, 1.0]\n[observe]\nquantities = ['x1_rms']\n" +
          more,
      "test");
}

// What is said when a place of this origin is refused.
std::string refusal(const std::vector<NamedValue>& values, const std::string& origin) {
  Study study = whole_study();
  try {
    const Place place = find_place(study, values, origin);
    place_parameters(place, &study);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was taken";
}

TEST(Place, IsRefusedByTheNameOfItsOrigin) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::vector<NamedValue>, std::string>> cases = {
      {{{"omga", 0.7}}, "unknown parameter 'omga' of model 'gear5'; did you mean 'omega'?"},
      {{{"omega", -1.0}}, "omega = -1 is out of range"},
      {{{"omega", nan}}, "omega = nan is out of range"},
      {{{"x1", nan}}, "x1 = nan is not finite"},
  };
  for (const auto& [values, said] : cases) {
    EXPECT_THAT(refusal(values, ""), StartsWith(said));
    EXPECT_THAT(refusal(values, "--at"), StartsWith("--at: " + said));
  }
}

TEST(Place, HasAValueForEachAxis) {
  const std::vector<NamedValue> one = {{"omega", 0.7}};
  EXPECT_EQ(refusal(one, "--at"), "--at gives no value for the study's axis 'b': add b=0.5");
  EXPECT_EQ(refusal(one, ""), "there is no value for the study's axis 'b': add b=0.5");
  EXPECT_EQ(refusal({{"omega", 0.7}, {"b", 0.5}}, ""), "it was taken");
}

// A place is taken as it is, but along the axis that a study's points go on along.
TEST(Place, IsMovedToAPointOfAChainAlone) {
  const Study plain = whole_study();
  const Study chain = whole_study("[initial]\npolicy = 'forward'\nalong = 'omega'\n");
  const auto moved = [](const Study& study, double omega) {
    Place place = find_place(study, {{"omega", omega}, {"b", 0.6}, {"zeta", 0.03}}, "--at");
    const std::string told = move_to_chain(study, &place);
    return std::pair(label_of(*study.model, place), told);
  };
  EXPECT_THAT(moved(plain, 0.71), Pair("omega=0.71, b=0.6, zeta=0.03", ""));
  EXPECT_THAT(moved(plain, 1.2), Pair("omega=1.2, b=0.6, zeta=0.03", ""));
  EXPECT_THAT(moved(chain, 0.71), Pair("omega=0.8, b=0.6, zeta=0.03",
                                       StartsWith("--at: omega = 0.71 is taken for 0.8: ")));
  EXPECT_THAT(moved(chain, 0.8), Pair("omega=0.8, b=0.6, zeta=0.03", ""));
  Place beyond = find_place(chain, {{"omega", 1.2}}, "--at");
  try {
    move_to_chain(chain, &beyond);
    ADD_FAILURE() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--at: omega = 1.2 is beyond the axis, 0.6 .. 1");
  }
}

TEST(Place, KnowsTheNearestPointOfTheAxes) {
  const Study study = whole_study();
  const auto nearest = [&](double omega, double b) {
    return nearest_point(study, find_place(study, {{"omega", omega}, {"b", b}, {"mu", 0.1}}, ""));
  };
  EXPECT_EQ(nearest(0.71, 0.5), "omega=0.8,b=0.5");
  EXPECT_EQ(nearest(2.0, 0.6), "omega=1,b=0.5");
  EXPECT_EQ(nearest(0.8, 1.0), "");
}

// That of [gear] is the table's, though the axis stands in its place.
TEST(Place, OfAnAxisIsTheStudysOwnWithoutIt) {
  const Study study = read_study(
      "[model]\nname = 'gear5'\n[gear]\nteeth = [40, 40]\nmodule_mm = 3.0\n"
      "inertia_kg_mm2 = 2230.0\nmass_kg = 1.0\nbearing_stiffness_N_per_mm = 3e5\n"
      "bearing_damping_N_s_per_mm = 1.4\nmesh_damping_N_s_per_mm = 0.7\n"
      "mesh_stiffness_N_per_m = 2.174e8\nhalf_backlash_mm = 0.05\ntorque_N_m = 61.5\n"
      "transmission_error_um = 30.0\n[parameters]\nmu = 0.07\n"
      "[[axes]]\nname = 'torque_N_m'\nvalues = [10.0, 20.0]\n"
      "[[axes]]\nname = 'mu'\nvalues = [0.1, 0.2]\n[observe]\nquantities = ['x1_rms']\n",
      "test");
  EXPECT_EQ(own_value(study, study.axes[0]), 61.5);
  EXPECT_EQ(own_value(study, study.axes[1]), 0.07);
}

}  // namespace
}  // namespace gearsweep::testing
