// Models as equations: what is read, and what is refused with its place.
#include "study/model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "study/refusal.hpp"
#include "study/study.hpp"
#include "support/pair_model.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ModelFile, HasItsNamesInOrder) {
  const auto model = read_model_text(pair_model(), "pair.toml");
  EXPECT_EQ(model->name, "pair");
  EXPECT_THAT(model->state_names(), ElementsAre("x", "v"));
  EXPECT_EQ(model->states[0].velocity, "v");
  EXPECT_EQ(model->states[1].velocity, "");
  EXPECT_EQ(model->parameters[0].name, "omega");
  EXPECT_EQ(model->parameters[9].name, "k_3");
  EXPECT_EQ(model->signals[0].unit, "k0 b_n");
  ASSERT_EQ(model->contacts.size(), 1U);
  EXPECT_EQ(model->contacts[0].name, "");
  EXPECT_FALSE(model->contacts[0].is_one_sided);
}

// States stand for themselves, and have no bounds, unless the model says otherwise.
TEST(ModelFile, SaysWhichStatesShareARangeAndWhatIsTooLarge) {
  const std::string plain =
      "[model]\nname = 'm'\n[states]\np = {}\nx = {}\ny = {}\n[parameters]\na = 1.0\n"
      "[equations]\np = 'a'\nx = 'a'\ny = 'a'\n[forcing]\nperiod = '1'\n";
  const auto read = [&](const std::string& what, const std::string& instead) {
    return read_model_text(replaced(plain, what, instead), "m.toml");
  };
  const auto alone = read("p = {}", "p = {}");
  EXPECT_THAT(alone->range_groups, ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(alone->diverged_above, ElementsAre(INFINITY, INFINITY, INFINITY));
  EXPECT_THAT(read("x = {}\ny = {}", "x = {group = 'g'}\ny = {group = 'g'}")->range_groups,
              ElementsAre(0U, 1U, 1U));
  EXPECT_THAT(read("'m'\n", "'m'\ndiverged_above = 1e9\n")->diverged_above,
              ElementsAre(1e9, 1e9, 1e9));
  EXPECT_THAT(read("'m'\n", "'m'\ndiverged_above = {x = 2.0}\n")->diverged_above,
              ElementsAre(INFINITY, 2.0, INFINITY));
  EXPECT_THAT(refusal_of_model(replaced(plain, "'m'\n", "'m'\ndiverged_above = {z = 2.0}\n")),
              HasSubstr("pair.toml:3: unknown key 'z' in diverged_above"));
  EXPECT_THAT(refusal_of_model(replaced(plain, "'m'\n", "'m'\ndiverged_above = 0\n")),
              HasSubstr("diverged_above = 0 is out of range"));
}

// Where a part of the text has a name, a reader knows it by that.
TEST(ModelFile, CallsWhatItTabulatesByTheNamesOfConstants) {
  const auto model = read_model_text(pair_model(), "pair.toml", std::set<std::string>{"omega"});
  EXPECT_THAT(model->phase_findings, ElementsAre("tabulated over the phase: drive",
                                                 "tabulated over the phase: stiffness"));
  EXPECT_THAT(model->kernel, HasSubstr("w1 = stiffness\n"));
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
      read_model_text(replaced(pair_model(), "k*cos(phase)", "k*cos(phase + Fm)"), "pair.toml",
                      std::set<std::string>{"k", "k_2", "k_3", "Fm", "Fte", "Fte_2", "Fte_3"});
  for (const ParameterInfo& parameter : model->parameters) {
    EXPECT_EQ(parameter.shapes_phase, parameter.name == "Fm") << parameter.name;
  }
}

// At a jump, the value of the side that is asked for.
TEST(ModelFile, HasBothSidesOfAJump) {
  const auto model = read_model_text(
      replaced(replaced(pair_model(), "k*cos(phase)", "k*if(phase < 2*pi*z, 1, -1)"),
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
      refusal_of_model(replaced(pair_model(), "2*z*v", "2*z*v*stifness")),
      AllOf(HasSubstr("pair.toml:24:33: unknown name 'stifness'; did you mean 'stiffness'?"),
            HasSubstr("- 2*z*v*stifness"), HasSubstr("^")));
  EXPECT_THAT(
      refusal_of_model(replaced(pair_model(), "f = \"backlash(x, b)\"", "f = \"backlash(f, b)\"")),
      HasSubstr("pair.toml:20:6: 'f' is defined by itself: f -> f"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "\nx = \"v\"", "")),
              HasSubstr("'x' has no equation"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "x = \"v\"", "x = \"v\"\ny = \"v\"")),
              HasSubstr("'y' is not a state"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "z = 0.05", "x = 0.05")),
              HasSubstr("'x' is defined twice"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "z = 0.05", "sin = 0.05")),
              HasSubstr("'sin' has a meaning of its own"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "2*pi/omega", "2*pi/v")),
              HasSubstr("the period may use parameters alone, not 'v'"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "min = 1e-4", "mni = 1e-4")),
              HasSubstr("unknown key 'mni'"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "[forcing]", "[forces]")),
              HasSubstr("unknown key 'forces'"));
  EXPECT_THAT(refusal_of_model(std::string(10 << 20, ' ')), HasSubstr("too large for a model"));
  EXPECT_THAT(refusal_of_model(replaced(pair_model(), "\"v\"\n", "\"v\"); system(\"\n")),
              HasSubstr("pair.toml:"));
}

// A state that counts within one turn jumps by a turn now and then: nothing may see that.
TEST(ModelFile, RefusesAnAngleWhoseTurnsAreTold) {
  const auto rotor = [](const std::string& torque) {
    return "[model]\nname = 'rotor'\n[states]\na = { angle = true }\nb = { angle = true }\nw = {}\n"
           "[parameters]\nomega = 1.0\ng = 0.3\n[equations]\na = 'w'\nb = '0.1*sin(b)'\nw = '-w "
           "+ " +
           torque + "'\n[forcing]\nperiod = '2*pi/omega'\n";
  };
  for (const std::string torque :
       {"a", "a - b", "sin(g*a)", "sin(0.5*a)", "if(a < 1, 1, 0)", "sin(a)*a", "tanh(a)"}) {
    EXPECT_THAT(
        refusal_of_model(rotor(torque)),
        AllOf(HasSubstr("'a' is an angle, which is counted within one turn, and the equation "
                        "of w tells its turns apart"),
              HasSubstr("sin(2*a - phase)")))
        << torque;
  }
  for (const std::string torque : {"sin(a)", "cos(2*a - b + phase)^2", "g*sin(a - b)", "tan(a)",
                                   "if(sin(a) < g, 1, 0)", "g*w"}) {
    EXPECT_EQ(refusal_of_model(rotor(torque)), "accepted") << torque;
  }
}

// The law of a spring, by name.
std::string with_option(const std::string& choices, const std::string& condition) {
  return replaced(replaced(pair_model(), "[constants]",
                           "[options]\nlaw = { choices = " + choices + " }\n[constants]"),
                  "stiffness*f\"", "if(" + condition + ", stiffness*f, f^3)\"");
}

TEST(ModelFile, HasOptionsByName) {
  const auto model =
      read_model_text(with_option("[\"linear\", \"cubic\"]", "law.linear"), "pair.toml");
  ASSERT_EQ(model->options.size(), 1U);
  EXPECT_EQ(model->options[0].name, "law");
  ModelSetting linear = model->default_setting(), cubic = linear;
  cubic.options[0] = 1;
  const auto force = [&](const ModelSetting& setting) {
    std::vector<double> row(model->phase_coefs.size()), x = {3.0, 0.0}, dx(2);
    model->phase_coefs_at(setting, 0.25, 0.25, row.data());
    model->prepare(setting)->rhs(row.data(), x.data(), dx.data());
    return dx[1];
  };
  // Two beyond the backlash: 2 K against 8, with K = 1 + k_2 at a quarter of the period.
  EXPECT_NEAR(force(linear) - force(cubic), 8.0 - 2.0 * 1.1, 1e-14);
}

TEST(ModelFile, RefusesOptionsThatSayTooLittle) {
  EXPECT_THAT(refusal_of_model(with_option("[\"linear\", \"cubic\"]", "law.cubik")),
              HasSubstr("unknown name 'law.cubik'; did you mean 'law.cubic'?"));
  EXPECT_THAT(refusal_of_model(with_option("[\"linear\"]", "law.linear")),
              HasSubstr("option 'law' needs from 2 to 64 different names as choices"));
  EXPECT_THAT(refusal_of_model(with_option("[\"a\", \"a\"]", "law.a")),
              HasSubstr("different names"));
  EXPECT_THAT(refusal_of_model(with_option("[\"a\", \"b c\"]", "law.a")),
              HasSubstr("different names"));
  EXPECT_THAT(refusal_of_model(with_option("[\"a\", \"b\"]", "law.a + 1 < 0")),
              HasSubstr("a condition stands where a number is needed"));
}

TEST(ModelFile, MayCallAParameterByAnotherNameInExpressions) {
  const std::string text =
      replaced(replaced(pair_model(), "z = 0.05", "phase = { as = \"z\", value = 0.05 }"),
               "[signals]", "[presets.damped]\nphase = 0.2\n[signals]");
  const auto model = read_model_text(text, "pair.toml");
  EXPECT_EQ(model->parameters[2].name, "phase");
  EXPECT_THAT(model->presets, ::testing::SizeIs(2));
  EXPECT_THAT(refusal_of_model(
                  replaced(pair_model(), "z = 0.05", "phase = { as = \"sin\", value = 0.05 }")),
              HasSubstr("'sin' has a meaning of its own"));
  EXPECT_THAT(
      refusal_of_model(replaced(pair_model(), "z = 0.05", "phase = { as = \"b\", value = 0.05 }")),
      HasSubstr("'b' is defined twice"));
}

// A term that is commented out must not break a study. What the term alone used is told, with what
// only that used: 'spare' is in no constant but 'part'.
TEST(ModelFile, TellsWhatIsUsedNowhere) {
  const auto study_with = [](const std::string& model, const std::string& axis) {
    return "[model]\nfile = 'pair.toml'\ntext = '''\n" + model + "'''\n[[axes]]\nname = '" + axis +
           "'\nvalues = [0.5, 1.0]\n";
  };
  const std::string text = replaced(replaced(pair_model(), "z = 0.05", "z = 0.05\nspare = 1.0"),
                                    "[equations]", "part = \"spare/2\"\n[equations]");
  const Study study = read_study(study_with(text, "omega"), "s.toml");
  EXPECT_THAT(study.notices,
              ElementsAre(HasSubstr("pair.toml:11: parameter 'spare' is used nowhere"),
                          HasSubstr("pair.toml:23: constant 'part' is used nowhere")));
  EXPECT_THAT(refusal(study_with(text, "spare")),
              HasSubstr("s.toml:36: nothing in model 'pair' depends on 'spare'"));
  const std::string used = replaced(text, "2*z*v", "2*z*part*v");
  EXPECT_THAT(read_study(study_with(used, "spare"), "s.toml").notices, ::testing::IsEmpty());
  // A constant may have the value of one that is used.
  const std::string same = replaced(pair_model(), "[equations]", "spare = \"b\"\n[equations]");
  EXPECT_THAT(read_study(study_with(same, "b"), "s.toml").notices,
              ElementsAre(HasSubstr("constant 'spare' is used nowhere")));
}

// The values of the file are a preset, too; the file may name it.
TEST(ModelFile, HasItsOwnValuesAsAPreset) {
  const auto names_after = [](const std::string& presets) {
    std::vector<std::string> names;
    const auto model =
        read_model_text(replaced(pair_model(), "[signals]", presets + "[signals]"), "pair.toml");
    for (const PresetInfo& preset : model->presets) names.push_back(preset.name);
    return names;
  };
  EXPECT_THAT(names_after(""), ElementsAre("default"));
  EXPECT_THAT(names_after("[presets.soft]\nk = 0.5\n"), ElementsAre("default", "soft"));
  EXPECT_THAT(names_after("[presets.own]\npolicy = \"fixed\"\n[presets.soft]\nk = 0.5\n"),
              ElementsAre("own", "soft"));
  EXPECT_THAT(refusal_of_model(
                  replaced(pair_model(), "[signals]", "[presets.a]\npolicy = \"fix\"\n[signals]")),
              HasSubstr("fixed"));
  EXPECT_THAT(
      refusal_of_model(replaced(pair_model(), "[signals]", "[presets.a]\nkk = 1.0\n[signals]")),
      HasSubstr("unknown key 'kk'"));
}

TEST(ModelFile, SaysWhatWasFoundInIt) {
  using ::testing::Contains;
  const auto findings = [](const std::string& force) {
    return read_model_text(replaced(pair_model(), "stiffness*f\"", force + "\""), "pair.toml")
        ->findings;
  };
  EXPECT_THAT(findings("stiffness*f"),
              AllOf(Contains(HasSubstr("second order")),
                    Contains("backlash: steps that cross its limits are corrected")));
  EXPECT_THAT(findings("stiffness*f^3"), Contains(HasSubstr("steps are not corrected")));
  EXPECT_THAT(findings("stiffness*f/sqrt(abs(f))"), Contains(HasSubstr("steps are not corrected")));
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
    const std::string text = replaced(
        replaced(pair_model(), "[equations]", constants + "[equations]"), "2*z*v", "2*z*v*c119");
    EXPECT_EQ(refusal_of_model(text), "accepted");
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
