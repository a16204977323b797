// What a model is said to offer is what a study of it may ask for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/model_file.hpp"
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
  // A study that does not ask for them has none.
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

template <class Act>
std::string told(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of(const Model& model, const std::string& quantity) {
  return told([&] { select_quantities(model, {quantity}, {}); });
}

// gear1 with other names. load, force: what the file says beside them.
std::string model_with_roles(const std::string& load, const std::string& force) {
  return "[model]\nname = 'own'\n[states]\nx = {}\nv = {}\n[parameters]\n"
         "F1 = { value = 0.2, meaning = 'stiffness of a spring' }\n"
         "push = { value = 1.0" +
         load +
         " }\n[equations]\nx = 'v'\n"
         "v = 'push - 0.1*v - F1*backlash(x, 1)'\n[forcing]\nperiod = 1\n[signals]\n"
         "dmf = 'v'\nteeth = { expression = 'F1*backlash(x, 1)'" +
         force + " }\n";
}

// A parameter F1 and a signal dmf may be anything.
TEST(Quantities, TheLoadAndTheForceAreWhatTheModelSays) {
  const std::string load = ", role = 'load'", force = ", role = 'mesh_force'";
  const auto model = [](const std::string& text) { return read_model_text(text, "own.toml"); };
  const auto none = model(model_with_roles("", ""));
  EXPECT_FALSE(offered(*none).contains("dynamic_load_factor"));
  EXPECT_EQ(none->contact_force(), nullptr);
  EXPECT_THAT(refusal_of(*none, "dynamic_load_factor"),
              ::testing::AllOf(::testing::HasSubstr("role = \"load\""),
                               ::testing::HasSubstr("role = \"mesh_force\"")));
  EXPECT_THAT(refusal_of(*model(model_with_roles("", force)), "dynamic_load_factor"),
              ::testing::Not(::testing::HasSubstr("mesh_force")));
  const auto both = model(model_with_roles(load, force));
  EXPECT_EQ(both->contact_force()->name, "teeth");
  const Selection factor = select_quantities(*both, {"dynamic_load_factor"}, {});
  EXPECT_EQ(factor.quantities[0].divided_by, 1U);
  EXPECT_EQ(factor.observers[0].part, "teeth");

  const auto refused = [&](const std::string& of_load, const std::string& of_force) {
    return told([&] { model(model_with_roles(of_load, of_force)); });
  };
  EXPECT_THAT(refused(", role = 'laod'", ""), ::testing::HasSubstr("did you mean 'load'?"));
  EXPECT_THAT(refused(force, ""), ::testing::HasSubstr("unknown role 'mesh_force'"));
  EXPECT_THAT(refused(load + " }\npull = { value = 1.0" + load, ""),
              ::testing::AllOf(::testing::HasSubstr("own.toml:9"),
                               ::testing::HasSubstr("one parameter of the role 'load'")));
}

// Each mesh of a train of gears has its own.
TEST(Quantities, SeveralForcesHaveALoadFactorEach) {
  const Model& idler = *find_model("idler");
  EXPECT_TRUE(offered(idler).contains("dmf1_dynamic_load_factor"));
  const Selection second = select_quantities(idler, {"dmf2_dynamic_load_factor"}, {});
  EXPECT_EQ(second.observers[0].part, "dmf2");
  EXPECT_THAT(refusal_of(idler, "dynamic_load_factor"),
              ::testing::HasSubstr("dmf1_dynamic_load_factor"));
}

// A train of gears does not carry one load in all of its meshes.
TEST(Quantities, OfSeveralForcesEachNamesItsOwnLoad) {
  const auto train = [](const std::string& first, const std::string& second) {
    return read_model_text(
        "[model]\nname = 'train'\n[states]\nx = {}\n[parameters]\n"
        "F = { value = 1.0, role = 'load' }\nG = 2.0\n[equations]\nx = 'F + G - x'\n"
        "[forcing]\nperiod = 1\n[signals]\n"
        "dmf1 = { expression = 'x', role = 'mesh_force'" +
            first + " }\n" + "dmf2 = { expression = '2*x', role = 'mesh_force'" + second + " }\n",
        "train.toml");
  };
  const auto both = train(", load = 'F'", ", load = 'G'");
  const auto factor_of = [&](const std::string& force) {
    return select_quantities(*both, {force + "_dynamic_load_factor"}, {}).quantities[0].divided_by;
  };
  EXPECT_EQ(factor_of("dmf1"), 0U);
  EXPECT_EQ(factor_of("dmf2"), 1U);

  const auto one = train(", load = 'F'", "");
  EXPECT_TRUE(offered(*one).contains("dmf1_dynamic_load_factor"));
  EXPECT_FALSE(offered(*one).contains("dmf2_dynamic_load_factor"));
  EXPECT_THAT(refusal_of(*one, "dmf2_dynamic_load_factor"),
              ::testing::HasSubstr("load = \"NAME\""));
  EXPECT_THAT(told([&] { train(", load = 'H'", ""); }),
              ::testing::AllOf(::testing::HasSubstr("train.toml:13"),
                               ::testing::HasSubstr("a parameter of the model, not 'H'")));
}

TEST(Quantities, AStateOrSignalMayNotTakeTheNameOfAnother) {
  const auto model = read_model_text(
      "[model]\nname = 'own'\n[states]\nx = {}\n[parameters]\na = 1.0\n[equations]\nx = "
      "'-a*x'\n[forcing]\nperiod = 1\n"
      "[signals]\nsection = '2*x'\nlyapunov = '3*x'\n",
      "own.toml");
  for (const std::string name : {"section_max", "lyapunov_max"}) {
    EXPECT_THAT(refusal_of(*model, name), ::testing::HasSubstr("two quantities"));
  }
  EXPECT_EQ(select_quantities(*model, {"section_mean"}, {}).observers[0].part, "section");
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
