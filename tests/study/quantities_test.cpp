// What a model is said to offer is what a study of it may ask for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

// As [observe] of a study of the model asks for it, without the time that reading a study takes.
bool is_accepted(const Model& model, const std::string& quantity) {
  try {
    select_quantities(model, {quantity}, {model.states.front().name});
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

// A model is asked for one in eight of the names that others have: a refusal looks for a name to
// suggest, which takes long.
TEST(Quantities, AModelOffersExactlyWhatAStudyOfItMayAskFor) {
  constexpr std::size_t kOneIn = 8;
  std::set<std::string> all;
  for (const Model& model : models()) all.merge(offered(model));
  ASSERT_THAT(all, ::testing::IsSupersetOf({"attractor", "attractor_count", "contact_class"}));
  std::size_t asked = 0;
  for (const Model& model : models()) {
    const std::set<std::string> names = offered(model);
    for (const std::string& name : all) {
      ++asked;
      if (names.count(name) == 0 && asked % kOneIn != 0) continue;
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

Study with_orders(const std::string& orders) {
  return read_study("[[axes]]\nname = 'omega'\nvalues = [0.5]\n[observe]\norders = " + orders +
                        "\nquantities = ['dmf_order_amplitude', 'x1_rms', 'dmf_order_phase']\n",
                    "s.toml");
}

// Amplitudes of all orders, then phases, from one observer; what comes after them has its place.
TEST(Quantities, OrdersHaveANumberForEachThatTheStudyNames) {
  const Selection selection = with_orders("[0.5, 2]").selection;
  EXPECT_EQ(selection.orders, (std::vector<double>{0.5, 2.0}));
  EXPECT_EQ(selection.quantities[0].width, 2U);
  EXPECT_EQ(selection.quantities[2].output, 2U);
  EXPECT_EQ(selection.quantities[1].output, 5U);  // after the mean
  EXPECT_EQ(with_orders("7").selection.orders, std::vector<double>{7.0});
  // Of a study that does not ask for them there are none.
  const Selection without = select_quantities(*find_model("gear5"), {"x1_rms"}, {}, {1.0, 2.0});
  EXPECT_TRUE(without.orders.empty());
}

TEST(Quantities, OrdersThatAreNoneAreRefused) {
  std::string many = "[1";
  for (int i = 2; i <= 33; ++i) many += ", " + std::to_string(i);
  for (const auto& [orders, said] :
       std::vector<std::pair<std::string, std::string>>{{"[]", "from 1 to 32"},
                                                        {many + "]", "from 1 to 32"},
                                                        {"[0]", "orders"},
                                                        {"[-1]", "orders"},
                                                        {"[1, 2, 1]", "lists 1 twice"},
                                                        {"['a']", "orders"}}) {
    try {
      with_orders(orders);
      ADD_FAILURE() << orders;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  ::testing::AllOf(::testing::HasSubstr("s.toml:5"), ::testing::HasSubstr(said)))
          << orders;
    }
  }
}

// A model of one mesh has a load; speeds are in the unit of the deflection's rate.
TEST(Quantities, LoadFactorsAndImpactsAreOfModelsThatHaveThem) {
  EXPECT_TRUE(offered(*find_model("gear1")).contains("dynamic_load_factor"));
  EXPECT_FALSE(offered(*find_model("duffing")).contains("dynamic_load_factor"));
  EXPECT_TRUE(offered(*find_model("idler")).contains("first_contact_impacts_drive"));
  for (const Quantity& quantity : offered_quantities(*find_model("gear5"))) {
    if (quantity.name == "contact_impacts_speed") {
      EXPECT_EQ(quantity.unit, "b_n varpi");
    }
    if (quantity.name == "contact_impacts_depth") {
      EXPECT_EQ(quantity.unit, "b_n");
    }
    if (quantity.name == "contact_losses") {
      EXPECT_EQ(quantity.unit, "1");
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
