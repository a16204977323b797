// Tables and jumps of the phase in models that are given as text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <regex>
#include <set>

#include "model/error.hpp"
#include "study/model_file.hpp"
#include "study/refusal.hpp"
#include "study/study.hpp"
#include "study/table_file.hpp"
#include "support/folder.hpp"
#include "support/pair_model.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// What the tables of these tests hold, by file.
std::vector<TablePoint> table_points(const std::string& file) {
  if (file == "saw.csv") return parse_table("1 1\n1 -1\n4 0\n", file);
  if (file != "mesh.csv") throw InputError(file + ":7: wrong");
  return parse_table("0 0\n1 1\n3 -1\n", file);
}

std::string with_table(const std::string& table) {
  return replaced(pair_model(), "k*cos(phase)", "k*" + table);
}

std::shared_ptr<const Model> table_model(const std::string& table,
                                         const std::set<std::string>& swept = {}) {
  return read_model_text(with_table(table), "pair.toml", swept, table_points);
}

// That of the model's teeth, at a moment.
double stiffness_at(const Model& model, const ModelSetting& setting, double psi, double inside) {
  std::vector<double> row(model.phase_coefs.size()), direction(2), x(2);
  model.phase_coefs_at(setting, psi, inside, row.data());
  model.prepare(setting)->force_direction(0, row.data(), x.data(), direction.data());
  return -direction[1];
}

TEST(ModelTables, ReadsATable) {
  const auto model = table_model("table('mesh.csv', 2*phase)");
  const auto plain = table_model("(1 - abs(2*phase - 1))");
  const double psi = 0.1;  // 2 phase is below 3
  EXPECT_NEAR(stiffness_at(*model, model->default_setting(), psi, psi),
              stiffness_at(*plain, plain->default_setting(), psi, psi), 1e-14);
  // 2 phase = 0, 1, 3 in each turn: a corner each.
  std::vector<double> corners = model->break_phases(model->default_setting());
  std::ranges::sort(corners);
  const double one = 0.25 / std::numbers::pi;
  const auto near = [](double phase) { return ::testing::DoubleNear(phase, 1e-15); };
  EXPECT_THAT(corners, ElementsAre(0.0, near(one), near(3.0 * one), near(0.5), near(0.5 + one),
                                   near(0.5 + 3.0 * one)));
}

std::string without_comments(const std::string& kernel) {
  return std::regex_replace(kernel, std::regex("//[^\n]*"), "");
}

// A comment of the kernel has the name of a table: none ends it.
TEST(ModelTables, TakesNoTextOfATableIntoItsKernel) {
  // As TOML writes it: what joins lines in C. A new line is refused.
  const std::string name = R"(evil */ ?\u003F/ \\)";
  const std::string text = replaced(pair_model(), "2*z*v", "2*z*v*table('" + name + "', phase)");
  const auto model = read_model_text(
      text, "pair.toml", std::set<std::string>{"omega"}, [](const std::string& file) {
        EXPECT_TRUE(file.ends_with('\\'));
        return std::vector<TablePoint>{{0.0, 1.0}, {1.0, 0.5}, {3.0, 1.0}};
      });
  EXPECT_NE(model->kernel.find("evil"), std::string::npos);
  EXPECT_EQ(without_comments(model->kernel).find("evil"), std::string::npos);
  EXPECT_EQ(model->kernel.find('\\', model->kernel.find("ModelPoint")), std::string::npos);
}

// As cos(phase + shift) is; also at a fixed place, since no device has the table.
TEST(ModelTables, TabulatesATable) {
  const std::set<std::string> all = {"omega", "Fm", "k", "k_2", "k_3", "Fte", "Fte_2", "Fte_3"};
  for (const std::string place : {"phase + Fm", "Fm"}) {
    const auto model = table_model("table('mesh.csv', " + place + ", cubic)", all);
    for (const ParameterInfo& parameter : model->parameters) {
      EXPECT_EQ(parameter.shapes_phase, parameter.name == "Fm") << parameter.name;
    }
    EXPECT_EQ(without_comments(model->kernel).find("table"), std::string::npos);
  }
}

TEST(ModelTables, EndsStepsWhereATableJumps) {
  for (const std::string table :
       {"table('saw.csv', phase)", "table(\\\"saw.csv\\\", phase, cubic)"}) {
    const auto model = table_model(table);
    const ModelSetting setting = model->default_setting();
    const double jump = 0.5 / std::numbers::pi;
    EXPECT_THAT(
        model->break_phases(setting),
        ::testing::AllOf(::testing::Contains(0.0), ::testing::Contains(::testing::DoubleEq(jump))));
    const double after = stiffness_at(*model, setting, jump, jump + 0.01);
    const double before = stiffness_at(*model, setting, jump, jump - 0.01);
    EXPECT_NEAR(after - before, 2.0 * setting.parameters[7], 1e-14);
  }
}

// Read at a phase that a parameter moves, too.
TEST(ModelTables, FollowsTheJumpsOfATable) {
  const auto model = table_model("table('saw.csv', phase + z, cubic)", {"z"});
  EXPECT_TRUE(model->parameters[2].shapes_phase);
  ModelSetting setting = model->default_setting();
  for (const double z : {0.0, 0.25, 0.5}) {
    setting.parameters[2] = z;
    const double jump = 0.5 * (1.0 - z) / std::numbers::pi;
    EXPECT_THAT(model->break_phases(setting), ElementsAre(0.0, ::testing::DoubleNear(jump, 1e-15)));
    const double after = stiffness_at(*model, setting, jump, jump + 0.01);
    const double before = stiffness_at(*model, setting, jump, jump - 0.01);
    EXPECT_NEAR(after - before, 2.0 * setting.parameters[7], 1e-14) << z;
  }
}

std::shared_ptr<const Model> pair_with(const std::string& wave, const std::string& jumps = "") {
  const std::string period = "period = \"2*pi/omega\"";
  return read_model_text(replaced(replaced(pair_model(), "k*cos(phase)", "k*" + wave), period,
                                  period + (jumps.empty() ? "" : "\njumps = [" + jumps + "]")),
                         "pair.toml");
}

// The list of a file is a promise: what holds of it is told.
TEST(ModelTables, SaysWhereItsListOfJumpsIsWrong) {
  const auto notices = [](const std::string& jumps) {
    const auto model = pair_with("sign(sin(phase) - z)*abs(cos(phase))", jumps);
    return model->notices(model->default_setting());
  };
  EXPECT_THAT(notices(""), ::testing::IsEmpty());
  EXPECT_THAT(notices("\"asin(z)\", \"pi - asin(z)\""), ::testing::IsEmpty());
  EXPECT_THAT(notices("\"asin(z)\", \"pi - asin(z)\", \"pi/2\", 0"), ::testing::IsEmpty());
  EXPECT_THAT(notices("\"asin(z)\""),
              ElementsAre("pair.toml: the equations jump at phase 3.09157, which [forcing] jumps "
                          "does not list; steps end there, too"));
  // Where a coefficient is 0 on both sides, rounding is no jump.
  const auto corner = pair_with("if(phase < pi, sin(phase), 0) + sign(phase - 1)", "1");
  EXPECT_THAT(corner->notices(corner->default_setting()), ::testing::IsEmpty());
  EXPECT_THAT(
      notices("\"asin(z)\", \"pi - asin(z)\", 2, \"2 + z\""),
      ElementsAre("pair.toml: [forcing] jumps lists phases 2, 2.05, where no equation jumps"));
}

// The side of a jump is no name that a user could take.
TEST(ModelTables, HasBothSidesWithAnyName) {
  for (const std::string name : {"z", "inside", "scale", "penetration0"}) {
    std::string text = replaced(pair_model(), "k*cos(phase)", "k*if(phase < 2*pi*z, 1, -1)");
    text = std::regex_replace(text, std::regex("\\bz\\b"), name);
    const auto model = read_model_text(text, "pair.toml");
    const ModelSetting setting = model->default_setting();
    EXPECT_NEAR(
        stiffness_at(*model, setting, 0.05, 0.06) - stiffness_at(*model, setting, 0.05, 0.04), 0.4,
        1e-14)
        << name;
  }
}

// What is no function of the phase of one period is meant as one of time.
TEST(ModelTables, RefusesWavesThatBreakOff) {
  const auto wrong = [](const std::string& wave, double z = 0.05) {
    const auto model = pair_with(wave);
    ModelSetting setting = model->default_setting();
    setting.parameters[2] = z;
    return model->check(setting);
  };
  EXPECT_THAT(wrong("sin(0.7*phase)"),
              HasSubstr("sin(0.7*phase) has 0.7 waves in a period of the forcing and breaks off"));
  EXPECT_THAT(wrong("sin(phase/2)"), HasSubstr("has 0.5 waves"));
  EXPECT_THAT(wrong("(1 + 0.2*cos(1.5*phase + z))*sin(phase)"), HasSubstr("has 1.5 waves"));
  EXPECT_THAT(wrong("cos(z*phase)", 1.3), HasSubstr("has 1.3 waves"));
  EXPECT_THAT(wrong("if(phase < 1 or phase > 4, cos(0.3*phase), 0)"), HasSubstr("has 0.3 waves"));
  EXPECT_THAT(wrong("if(phase < 1, sin(0.5*phase), 0)*sin(0.7*phase) + sin(0.7*phase)"),
              HasSubstr("sin(0.7*phase) has 0.7 waves"));
  for (const std::string wave :
       {"sin(3*phase)", "cos(phase/2)^2", "abs(sin(phase/2))", "sin(phase/2)*cos(phase/2)",
        "tan(phase/2)", "phase/(2*pi)", "if(phase < 1, sin(pi*phase), 0)", "cos(z*phase)",
        "if(phase > 1 and phase < 2, cos(0.3*phase), 0)", "exp(-phase)",
        "if(phase < 1, sin(0.7*phase), 0) + if(phase > 5, cos(0.3*phase), 0)",
        "cos(2*pi/5*floor(5*phase/(2*pi)))", "sin(phase + 0.3*sin(2*phase))"}) {
    EXPECT_EQ(wrong(wave, 2.0), "") << wave;
  }
}

TEST(ModelTables, RefusesATableWithThePlace) {
  const auto refusal = [](const std::string& text) {
    try {
      read_model_text(text, "pair.toml", {}, table_points);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal(with_table("table('mesh.csv', phase + x)")),
              AllOf(HasSubstr("a table may be read at a phase alone, not at a state 'x'\n"),
                    HasSubstr("pair.toml:19:38: "), HasSubstr("^")));
  EXPECT_THAT(refusal(with_table("table('mesh.csv', f)")), HasSubstr("not at a state 'x'"));
  EXPECT_THAT(refusal(with_table("table('other.csv', phase)")),
              HasSubstr("pair.toml:19:26: other.csv:7: wrong\n"));
  EXPECT_THAT(refusal(replaced(pair_model(), "2*pi/omega", "table('mesh.csv', 1)")),
              HasSubstr("the period may use parameters alone, not a table"));
  EXPECT_THAT(refusal(replaced(pair_model(), "\"b + Fm\"", "\"table('mesh.csv', Fm)\"")),
              HasSubstr("a start may use parameters alone, not a table"));
  EXPECT_THAT(refusal(replaced(pair_model(), "z = 0.05", "table = 0.05")),
              HasSubstr("'table' has a meaning of its own"));
  EXPECT_THAT(refusal_of_model(with_table("table('mesh.csv', phase)")),
              HasSubstr("no tables here"));
  std::string sum = "0";
  for (int i = 0; i < 17; ++i) sum += " + table('m" + std::to_string(i) + ".csv', phase)";
  const auto any = [](const std::string& file) { return parse_table("0 0\n1 1\n", file); };
  EXPECT_THAT([&] { read_model_text(with_table("(" + sum + ")"), "pair.toml", {}, any); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("a model reads at most 16 tables")));
}

// The name alone would be that of any file.
TEST(ModelTables, WhatIsWrongInItIsToldWithTheStudyThatNamesIt) {
  const Folder folder;
  std::filesystem::create_directory(folder / "sub");
  const std::string source = (folder / "sub/s.toml").string();
  for (const std::string more : {"[states]\n", "[parameters]\nb = 1\nb = 2\n"}) {
    folder.write("sub/pair.toml", pair_model() + more);
    EXPECT_THAT(
        [&] {
          read_study("[model]\nfile = 'pair.toml'\n[[axes]]\nname = 'omega'\nvalues = [0.5]\n",
                     source);
        },
        ::testing::ThrowsMessage<InputError>(
            AllOf(HasSubstr(source + ":2: pair.toml:"), HasSubstr("cannot redefine"))));
  }
}

// The study of a file has the numbers of its tables, and needs no file any more.
TEST(ModelTables, TakesItsTablesIntoTheStudy) {
  const std::string text =
      "[model]\nfile = 'sub/pair.toml'\n[[axes]]\nname = 'omega'\nvalues = [0.5]\n";
  const std::string table = "sub/mesh \"1\".csv";
  Study study;
  {
    const Folder folder;
    std::filesystem::create_directory(folder / "sub");
    folder.write("sub/pair.toml",
                 replaced(with_table("table('mesh \"1\".csv', phase)"),
                          "stiffness = \"1 - k*table('mesh \"1\".csv', phase)",
                          "stiffness = \"1 - k*table('mesh \\\"1\\\".csv', phase)"));
    folder.write(table, "degree,k\n0,0.1\n90,1\n360,0.1\n");
    study = read_study(text, (folder / "s.toml").string());
    EXPECT_THAT(
        [&] { read_study(text + "[model.tables]\n'a' = ''\n", (folder / "s.toml").string()); },
        ::testing::ThrowsMessage<InputError>(HasSubstr("tables belong to a model's text")));
    folder.write(table, "degree,k\n0,0.1\n90,x\n360,0.1\n");
    EXPECT_THAT([&] { read_study(text, (folder / "s.toml").string()); },
                ::testing::ThrowsMessage<InputError>(AllOf(
                    HasSubstr("sub/pair.toml:19:"), HasSubstr("csv:3: 'x' is not a number"))));
  }
  EXPECT_THAT(study.toml, HasSubstr("1.5707963267948966 1"));
  const Study again = read_study(study.toml, "again");
  EXPECT_EQ(again.toml, study.toml);
  for (int i = 0; i < 1000; ++i) {
    const double psi = i / 1000.0;
    EXPECT_EQ(stiffness_at(*again.model, again.setting, psi, psi),
              stiffness_at(*study.model, study.setting, psi, psi));
  }
}

TEST(ModelTables, RefusesHostileTablesOfAStudy) {
  const auto refusal_with = [](const std::string& tables) {
    return refusal("[model]\ntext = '''\n" + with_table("table(\\\"mesh.csv\\\", phase)") +
                   "'''\n" + tables + "[[axes]]\nname = 'omega'\nvalues = [0.5]\n");
  };
  const std::string good = "[model.tables]\n'mesh.csv' = \"0 1\\n1 2\"\n";
  EXPECT_EQ(refusal_with(good), "");
  EXPECT_THAT(refusal_with(""), HasSubstr("'mesh.csv' is not in [model.tables] of the study"));
  EXPECT_THAT(refusal_with("[model.tables]\n'mesh.csv' = 3\n"),
              HasSubstr("a table must be a string of numbers"));
  EXPECT_THAT(refusal_with("tables = 3\n"), HasSubstr("'tables' must be a table"));
  EXPECT_THAT(refusal_with(good + "'other.csv' = '0 1'\n"),
              HasSubstr("'other.csv' is read by no expression of the model"));
  EXPECT_THAT(refusal_with("[model.tables]\n'mesh.csv' = \"0 1\\n1 nan\"\n"),
              HasSubstr("'mesh.csv' in [model.tables]:2: 'nan' is out of range"));
  EXPECT_THAT(refusal_with("[model.tables]\n'mesh.csv' = \"0 1\\u0000\"\n"),
              HasSubstr("'mesh.csv' in [model.tables]: not a text file"));
  EXPECT_THAT(refusal("[model]\nname = 'gear5'\n" + good + "[[axes]]\nname = 'omega'\n"),
              HasSubstr("tables belong to the text of a model of your own"));
}

}  // namespace
}  // namespace gearsweep::testing
