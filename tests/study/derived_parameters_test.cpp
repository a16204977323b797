// What a model's file and a study may say of parameters that follow others, of constants and of
// lists in presets; and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "study/model_file.hpp"
#include "study/refusal.hpp"
#include "study/study.hpp"
#include "support/derived_model.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kWn = "[[axes]]\nname = 'wn'\nvalues = [1.0, 2.0]\n";
const std::string kStart = "[[axes]]\nname = 'x'\nvalues = [0.0]\n";
const std::string kZeta = "[[axes]]\nname = 'zeta'\nvalues = [0.1, 0.2]\n";

Study derived_study(const std::string& keys, const std::vector<std::string>& overrides = {}) {
  return read_study(study_of_text(derived_model(), keys), "s.toml", overrides);
}

double number_of_parameter(const Study& study, const std::string& name) {
  return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
}

// What is said of a model's file.
std::string model_refusal(const std::string& text) {
  try {
    read_model_text(text, "own.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DerivedParameters, AreDefaultsOfAModelsFile) {
  const auto model = read_model_text(derived_model(), "own.toml");
  const ModelSetting setting = model->default_setting();
  EXPECT_THAT(setting.parameters, ElementsAre(2.0, 1.0, 0.05, 0.3, 0.15, 0.1));
  ASSERT_EQ(model->derived.size(), 2U);
  const DerivedParameter& e = *model->find_derived(4);
  EXPECT_EQ(e.expression, "e[1]/2");
  EXPECT_EQ(e.place, "own.toml:10");
  EXPECT_THAT(e.from, ElementsAre(3U));
  EXPECT_THAT(model->unused, IsEmpty());
  EXPECT_THAT(model_refusal(with_instead(derived_model(), "0.5*wn", "50*wn")),
              HasSubstr("own.toml:8: omega = 50*wn comes to 100 with the values of the model's "
                        "file; it must be finite and from 0.01 to 10"));
  EXPECT_THAT(model_refusal(with_instead(derived_model(), "zeta = 0.05", "zeta = true")),
              HasSubstr("own.toml:9: 'zeta' must be a number, an expression"));
}

TEST(DerivedParameters, AreRefusedWithTheNameThatIsWrong) {
  const std::pair<std::string, std::string> mistakes[] = {
      {"wn = 'omega + 1'", "'omega' is defined by itself: omega -> wn -> omega"},
      {"zeta = 'zeta/2'", "'zeta' is defined by itself: zeta -> zeta"},
      {"zeta = '0.5*wm'", "s.toml:23:13: unknown name 'wm'; did you mean 'wn'?"},
      {"zeta = '0.5*x'", "s.toml:23:9: the parameter 'zeta' may use parameters alone, not 'x'"},
      {"zeta = 'sin(phase)'", "the parameter 'zeta' may use parameters alone, not 'phase'"},
      {"zeta = 'table(\"a.csv\", wn)'", "a parameter may use parameters alone, not a table"},
      {"zeta = 'wn <'", "s.toml:23:"},
      {"zeta = ''", "s.toml:23:"},
      {"zeta = true", "s.toml:23: zeta must be a number, or an expression of other parameters"},
      {"weight = 'wn'", "'weight' is a constant of model 'own' that an expression gives"},
      {"e = [0.1, 'e[3]', 'e[2]']", "is defined by itself"}};
  for (const auto& [given, message] : mistakes) {
    EXPECT_THAT(refusal(study_of_text(derived_model(), "[parameters]\n" + given + "\n" + kStart)),
                HasSubstr(message))
        << given;
  }
  EXPECT_THAT(refusal(study_of_text(derived_model(), kWn), {"parameters.zeta=0.5*wm"}),
              HasSubstr("--set parameters.zeta=0.5*wm: unknown name 'wm'; did you mean 'wn'?"));
}

// A point has no one nominal value, around which its draws could lie.
TEST(DerivedParameters, AreNotUncertainWhereAnAxisMovesThem) {
  const std::string draws = "[uncertain]\nomega = {distribution = 'normal', std = 0.01}\n";
  EXPECT_THAT(refusal(study_of_text(derived_model(), kWn + draws)),
              AllOf(HasSubstr("omega = 0.5*wn"), HasSubstr("follows 'wn', which an axis gives")));
  EXPECT_EQ(refusal(study_of_text(derived_model(), kZeta + draws)), "");
}

// With its expression omega depends on wn, and with a number nothing does.
TEST(DerivedParameters, DecideWhetherAnAxisChangesAnything) {
  const std::string model =
      with_instead(with_instead(derived_model(), "wn^2*x", "x"), "g/2 + wn", "g/2");
  EXPECT_EQ(refusal(study_of_text(model, kWn)), "");
  EXPECT_THAT(refusal(study_of_text(model, "[parameters]\nomega = 1\n" + kWn)),
              HasSubstr("nothing in model 'own' depends on 'wn'"));
  const Study study =
      read_study(study_of_text(model, "[parameters]\nomega = 1\n" + kZeta), "s.toml");
  EXPECT_THAT(study.notices, ElementsAre(HasSubstr("parameter 'wn' is used nowhere")));
}

TEST(DerivedParameters, AreInPresetsWithListsAndNumbers) {
  const std::string model = derived_model() +
                            "[presets.plain]\n[presets.fast]\nomega = '3*wn'\ne = [0.1, 0.02]\n"
                            "[presets.given]\nomega = 4.0\ne = [0.5, 'e[1]', 0.25]\n";
  const auto preset = [&](const std::string& name, const std::string& keys = "") {
    return read_study(
        "[model]\npreset = '" + name + "'\ntext = '''\n" + model + "'''\n" + keys + kZeta,
        "s.toml");
  };
  EXPECT_EQ(number_of_parameter(preset("plain"), "omega"), 1.0);
  const Study fast = preset("fast");
  EXPECT_EQ(number_of_parameter(fast, "omega"), 6.0);
  EXPECT_EQ(number_of_parameter(fast, "e"), 0.1);
  EXPECT_EQ(number_of_parameter(fast, "e_2"), 0.02);
  EXPECT_EQ(number_of_parameter(fast, "e_3"), 0.1);
  EXPECT_EQ(fast.parameter_origins[1], "preset fast");
  EXPECT_EQ(number_of_parameter(preset("given"), "omega"), 4.0);
  EXPECT_EQ(number_of_parameter(preset("given"), "e_2"), 0.5);
  EXPECT_EQ(number_of_parameter(preset("given", "[parameters]\nomega = '2*wn'\n"), "omega"), 4.0);
  EXPECT_EQ(number_of_parameter(preset("fast", "[parameters]\nwn = 3.0\n"), "omega"), 9.0);
}

TEST(DerivedParameters, OfPresetsAreCheckedWithTheModel) {
  const std::pair<std::string, std::string> mistakes[] = {
      {"omega = '3*wm'", "own.toml:20:12: unknown name 'wm'; did you mean 'wn'?"},
      {"wn = '2*omega'", "is defined by itself"},
      {"e = [1, 2, 3, 4]", "own.toml:20: parameter 'e' takes at most 3 numbers"},
      {"e = [1, 2]\ne_2 = 3", "e_2 is given twice"},
      {"omega = [1, 2]", "parameter 'omega' takes at most 1 numbers"},
      {"zeta = true", "own.toml:20: zeta must be a number"}};
  for (const auto& [given, message] : mistakes) {
    EXPECT_THAT(model_refusal(derived_model() + "[presets.one]\n" + given + "\n"),
                HasSubstr(message))
        << given;
  }
}

TEST(Constants, BecomeParametersWhereAStudyNamesThem) {
  const Study plain = derived_study(kZeta);
  EXPECT_EQ(plain.model->find_parameter("g"), -1);
  EXPECT_EQ(plain.model->constants.front().number, 9.75);
  EXPECT_FALSE(plain.model->constants.back().number);
  const Study axis = derived_study("[[axes]]\nname = 'g'\nvalues = [1.0, 2.0]\n");
  EXPECT_EQ(axis.axes[0].index, static_cast<std::size_t>(axis.model->find_parameter("g")));
  EXPECT_EQ(number_of_parameter(axis, "g"), 9.75);
  EXPECT_EQ(read_study(axis.toml, "again.toml").axes[0].index, axis.axes[0].index);
  const Study set = derived_study(kZeta, {"parameters.g=wn + 1"});
  EXPECT_EQ(number_of_parameter(set, "g"), 3.0);
  const Study uncertain =
      derived_study(kZeta + "[uncertain]\ng = {distribution = 'normal', std = 0.1}\n");
  EXPECT_EQ(uncertain.uncertain.parameters.size(), 1U);
  const Study points = derived_study("[points]\nnames = ['g']\nnumbers = '''\n1\n2\n'''\n");
  EXPECT_EQ(points.axes[0].columns[0].name, "g");
  EXPECT_THAT(refusal(study_of_text(derived_model(), "[[axes]]\nname = 'weight'\nvalues = [1]\n")),
              HasSubstr("'weight' is a constant of model 'own' that an expression gives"));
}

// In a list, and in quotes; not where the number decides what the equations are.
TEST(Constants, MayBeAnyPlainNumber) {
  const std::string model = with_instead(
      with_instead(derived_model(), "g = 9.75", "g = '9.75'\nc = [2.0, '3', 'wn']\nn = 3"),
      "sum(i, 1, 3,", "c[1]*c[2]*sum(i, 1, n,");
  const Study study = read_study(
      study_of_text(model, "[parameters]\nc = [5.0, 6.0]\n[[axes]]\nname = 'g'\nvalues = [1]\n"),
      "s.toml");
  EXPECT_EQ(number_of_parameter(study, "c"), 5.0);
  EXPECT_EQ(number_of_parameter(study, "c_2"), 6.0);
  EXPECT_EQ(number_of_parameter(study, "g"), 9.75);
  EXPECT_THAT(study.model->derived, ::testing::SizeIs(2));
  EXPECT_THAT(refusal(study_of_text(model, "[[axes]]\nname = 'n'\nvalues = [1]\n")),
              HasSubstr("a whole number must stand here"));
}

}  // namespace
}  // namespace gearsweep::testing
