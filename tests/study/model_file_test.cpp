// Models as equations: what is read, and what is refused with its place.
#include "study/model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/study.hpp"
#include "support/pair_model.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string with(std::string text, const std::string& what, const std::string& instead) {
  text.replace(text.find(what), what.size(), instead);
  return text;
}

std::string refusal_of(const std::string& text) {
  try {
    read_model_text(text, "pair.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ModelFile, HasItsNamesInOrder) {
  const auto model = read_model_text(pair_model(), "pair.toml");
  EXPECT_EQ(model->name, "pair");
  EXPECT_THAT(model->state_names(), ElementsAre("x", "v"));
  EXPECT_EQ(model->parameters[0].name, "omega");
  EXPECT_EQ(model->parameters[9].name, "k_3");
  EXPECT_EQ(model->signals[0].unit, "k0 b_n");
  ASSERT_EQ(model->contacts.size(), 1U);
  EXPECT_EQ(model->contacts[0].name, "");
  EXPECT_FALSE(model->contacts[0].is_one_sided);
}

// What differs from point to point is parted from the phase, where it can be.
TEST(ModelFile, TabulatesWhatIsTheSameForAllPoints) {
  const auto shaping = [](const std::set<std::string>& swept) {
    const auto model = read_model_text(pair_model(), "pair.toml", swept);
    std::set<std::string> names;
    for (const ParameterInfo& parameter : model->parameters) {
      if (parameter.shapes_phase) names.insert(parameter.name);
    }
    return std::pair(names, model->phase_coefs.size());
  };
  const std::set<std::string> all = {"omega", "b",     "z", "Fm",  "Fte",
                                     "Fte_2", "Fte_3", "k", "k_2", "k_3"};
  EXPECT_EQ(shaping(all), std::pair(std::set<std::string>(), std::size_t{3}));
  const std::set<std::string> shapes = {"Fte", "Fte_2", "Fte_3", "k", "k_2", "k_3"};
  EXPECT_EQ(shaping({"omega"}), std::pair(shapes, std::size_t{2}));
}

TEST(ModelFile, TabulatesWhatCannotBeTakenApart) {
  const auto model =
      read_model_text(with(pair_model(), "k*cos(phase)", "k*cos(phase + Fm)"), "pair.toml",
                      std::set<std::string>{"k", "k_2", "k_3", "Fm", "Fte", "Fte_2", "Fte_3"});
  for (const ParameterInfo& parameter : model->parameters) {
    EXPECT_EQ(parameter.shapes_phase, parameter.name == "Fm") << parameter.name;
  }
}

// At a jump, the value of the side that is asked for.
TEST(ModelFile, HasBothSidesOfAJump) {
  const auto model = read_model_text(
      with(with(pair_model(), "k*cos(phase)", "k*if(phase < 2*pi*z, 1, -1)"),
           "period = \"2*pi/omega\"", "period = \"2*pi/omega\"\njumps = [\"2*pi*z\"]"),
      "pair.toml");
  const ModelSetting setting = model->default_setting();
  EXPECT_THAT(model->break_phases(setting), ElementsAre(0.0, ::testing::DoubleEq(0.05)));
  const auto point = model->prepare(setting);
  const auto stiffness = [&](double inside) {
    std::vector<double> row(model->phase_coefs.size()), direction(2), x(2);
    model->phase_coefs_at(setting, 0.05, inside, row.data());
    point->force_direction(0, row.data(), x.data(), direction.data());
    return -direction[1];
  };
  EXPECT_NEAR(stiffness(0.06) - stiffness(0.04), 0.4, 1e-14);
}

TEST(ModelFile, IsRefusedWithThePlace) {
  EXPECT_THAT(
      refusal_of(with(pair_model(), "2*z*v", "2*z*v*stifness")),
      AllOf(HasSubstr("pair.toml:24:33: unknown name 'stifness'; did you mean 'stiffness'?"),
            HasSubstr("- 2*z*v*stifness"), HasSubstr("^")));
  EXPECT_THAT(refusal_of(with(pair_model(), "f = \"backlash(x, b)\"", "f = \"backlash(f, b)\"")),
              HasSubstr("pair.toml:20:6: 'f' is defined by itself: f -> f"));
  EXPECT_THAT(refusal_of(with(pair_model(), "[equations]", "spare = \"b\"\n[equations]")),
              HasSubstr("'spare' is used nowhere"));
  EXPECT_THAT(refusal_of(with(pair_model(), "\nx = \"v\"", "")), HasSubstr("'x' has no equation"));
  EXPECT_THAT(refusal_of(with(pair_model(), "x = \"v\"", "x = \"v\"\ny = \"v\"")),
              HasSubstr("'y' is not a state"));
  EXPECT_THAT(refusal_of(with(pair_model(), "z = 0.05", "x = 0.05")),
              HasSubstr("'x' is defined twice"));
  EXPECT_THAT(refusal_of(with(pair_model(), "z = 0.05", "sin = 0.05")),
              HasSubstr("'sin' has a meaning of its own"));
  EXPECT_THAT(refusal_of(with(pair_model(), "2*pi/omega", "2*pi/v")),
              HasSubstr("the period may use parameters alone, not 'v'"));
  EXPECT_THAT(refusal_of(with(pair_model(), "min = 1e-4", "mni = 1e-4")),
              HasSubstr("unknown key 'mni'"));
  EXPECT_THAT(refusal_of(with(pair_model(), "[forcing]", "[forces]")), HasSubstr("no [forcing]"));
  EXPECT_THAT(refusal_of(std::string(10 << 20, ' ')), HasSubstr("too large for a model"));
  EXPECT_THAT(refusal_of(with(pair_model(), "\"v\"\n", "\"v\"); system(\"\n")),
              HasSubstr("pair.toml:"));
}

// A part that is used twice stays one part, however often that is done.
TEST(ModelFile, TakesNoLongerForPartsOfParts) {
  for (const std::string part : {"phase*k", "x", "k", "sin(phase)"}) {
    std::string constants = "c0 = \"" + part + "\"\n";
    for (int i = 1; i < 120; ++i) {
      const std::string before = "c" + std::to_string(i - 1);
      const std::string joined = i % 2 == 0 ? before + " + " + before : before + "*" + before;
      constants += "c" + std::to_string(i) + " = \"if(v > 0, " + joined + ", " + before + ")\"\n";
    }
    const std::string text =
        with(with(pair_model(), "[equations]", constants + "[equations]"), "2*z*v", "2*z*v*c119");
    EXPECT_EQ(refusal_of(text), "accepted");
  }
}

// A result file holds the study, and so the model.
TEST(ModelFile, BecomesAPartOfTheStudy) {
  const std::string text = "[model]\nfile = 'elsewhere.toml'\ntext = '''\n" + pair_model() +
                           "'''\n[[axes]]\nname = 'omega'\nvalues = [0.5]\n";
  const Study study = read_study(text, "s.toml");
  EXPECT_EQ(study.model->name, "pair");
  EXPECT_EQ(read_study(study.toml, "again").model->text, study.model->text);
  EXPECT_THAT(
      [] {
        read_study("[model]\nfile = 'missing.toml'\n[[axes]]\nname = 'x'\nvalues = [0.5]\n", "s");
      },
      ::testing::ThrowsMessage<InputError>(
          AllOf(HasSubstr("s:2: "), HasSubstr("missing.toml: there is no such file"))));
}

}  // namespace
}  // namespace gearsweep::testing
