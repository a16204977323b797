// What a model is said to offer is what a study of it may ask for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

bool is_accepted(const Model& model, const std::string& quantity) {
  const std::string text =
      "[model]\nname = '" + model.name + "'\n[[axes]]\nname = '" + model.states.front().name +
      "'\nvalues = [0.0]\n[initial]\nensemble = 2\n[observe]\nquantities = ['" + quantity + "']\n";
  try {
    read_study(text, "s.toml");
  } catch (const InputError&) {
    return false;
  }
  return true;
}

std::set<std::string> offered(const Model& model) {
  std::set<std::string> names;
  for (const Quantity& quantity : offered_quantities(model)) names.insert(quantity.name);
  return names;
}

TEST(Quantities, AModelOffersExactlyWhatAStudyOfItMayAskFor) {
  std::set<std::string> all;
  for (const Model& model : models()) all.merge(offered(model));
  ASSERT_THAT(all, ::testing::IsSupersetOf({"attractor", "attractor_count", "contact_class"}));
  for (const Model& model : models()) {
    const std::set<std::string> names = offered(model);
    for (const std::string& name : all) {
      EXPECT_EQ(is_accepted(model, name), names.count(name) == 1) << model.name << " " << name;
    }
  }
}

TEST(Quantities, OneOfAChannelBearsItsName) {
  for (const Quantity& quantity : offered_quantities(*find_model("gear5"))) {
    if (!quantity.channel.empty()) {
      EXPECT_EQ(quantity.name.rfind(quantity.channel + "_", 0), 0U) << quantity.name;
    }
  }
}

// A spectrum has an output for each state, and is told of once.
TEST(Quantities, AnOutputIsFoundByItsRoleBesideOneOfEveryState) {
  const Model& model = *find_model("gear5");
  const Selection spectrum = select_quantities(model, {"lyapunov_spectrum"}, {});
  EXPECT_EQ(spectrum.output_of(OutputRole::exponents), 0U);
  for (const OutputRole role : {OutputRole::settled, OutputRole::motion, OutputRole::peak}) {
    EXPECT_FALSE(spectrum.output_of(role));
  }
  const Selection both = select_quantities(model, {"lyapunov_spectrum", "settled"}, {});
  EXPECT_EQ(both.output_of(OutputRole::settled), model.states.size());
}

}  // namespace
}  // namespace gearsweep
