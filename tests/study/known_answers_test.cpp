// The known answers of a model's file: what is read, and what is refused with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/model_file.hpp"
#include "support/pair_model.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

const std::string kAnswer =
    "[presets.spur]\n[presets.light]\nFm = 0.05\n[[answers]]\nquantity = \"section_max\"\n"
    "at = { preset = \"light\", omega = \"1/sqrt(4)\", b = 2, x = -1.5 }\nsettle = 7\n"
    "max_step = 0.01\nstop = \"never\"\nstarts = 5\nvalue = [1.5, \"3*pi\"]\ntolerance = 1e-6\n"
    "source = \"by hand\"\n";

std::string refusal_of(const std::string& what, const std::string& instead) {
  try {
    read_model_text(replaced(pair_model() + kAnswer, what, instead), "pair.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(KnownAnswers, AreReadAsValues) {
  EXPECT_THAT(read_model_text(pair_model(), "pair.toml")->answers, IsEmpty());
  const auto model = read_model_text(pair_model() + kAnswer, "pair.toml");
  ASSERT_EQ(model->answers.size(), 1U);
  const KnownAnswer& answer = model->answers.front();
  EXPECT_EQ(answer.quantity, "section_max");
  EXPECT_THAT(answer.values, ElementsAre(1.5, 3.0 * std::numbers::pi));
  EXPECT_EQ(answer.tolerance, 1e-6);
  EXPECT_EQ(answer.source, "by hand");
  EXPECT_THAT(answer.choices, ElementsAre(Pair("preset", "light")));
  EXPECT_THAT(answer.at, ElementsAre(Pair("omega", 0.5), Pair("b", 2.0), Pair("x", -1.5)));
  EXPECT_THAT(answer.integrate,
              ElementsAre(Pair("max_step", "0.01"), Pair("settle", "7"), Pair("stop", "'never'")));
  EXPECT_EQ(answer.starts, 5U);
}

TEST(KnownAnswers, AreRefusedWithLineAndWhatIsRight) {
  struct Wrong {
    const char *what, *instead, *message;
  };
  for (const Wrong& wrong : std::vector<Wrong>{
           {"[[answers]]", "[answers]", "pair.toml:32: answers must be tables, each under"},
           {"quantity = \"section_max\"", "", "32: an answer needs its quantity: quantity = "},
           {"section_max", "section_mx", "33: unknown quantity 'section_mx' of model 'pair'; did"},
           {"section_max", "poincare", "33: 'poincare' is no number of one motion"},
           {"section_max", "status", "33: 'status' is no number of one motion"},
           {"section_max", "attractor", "33: 'attractor' is no number of one motion"},
           {"section_max", "x_max", "39: x_max has 1 to 1 values, not 2"},
           {"[1.5, \"3*pi\"]", "[]", "39: section_max has 1 to 2 values, not 0"},
           {"value = [1.5, \"3*pi\"]", "", "32: an answer needs its value: value = 1.25"},
           {"3*pi", "2*omega", "39:18: unknown name 'omega'; known: pi\n  2*omega\n    ^"},
           {"3*pi", "1/0", "39:16: this comes to inf"},
           {"3*pi", "2 < pi", "39:16: a condition stands where a number is needed"},
           {"tolerance = 1e-6", "", "32: an answer needs its tolerance: tolerance = 1e-6, in the"},
           {"tolerance = 1e-6", "tolerance = -1e-6", "40: tolerance = -1e-06 is out of range"},
           {"source = \"by hand\"", "", "32: an answer needs its source: source = "},
           {"source = \"by hand\"", "source = \"\"", "32: an answer needs its source: source = "},
           {"source", "sorce", "41: unknown key 'sorce' in an answer; did you mean 'source'?"},
           {"\"light\"", "\"ligt\"", "34: unknown preset 'ligt'; did you mean 'light'?"},
           {"omega = \"1", "omga = \"1", "34: unknown key 'omga' in at; did you mean 'omega'?"},
           {"1/sqrt(4)", "1/sqrt(a)", "unknown name 'a'; known: pi"},
           {"b = 2", "b = -2", "34: b = -2 is out of range; from 0 to"},
           {", omega = \"1/sqrt(4)\", b = 2, x = -1.5 }", "}",
            "34: a place names a number: at = {"},
           {"x = -1.5 }", "z = 0.1 }", "38: the starts differ in the first state that `at` names"},
           {"at = {", "art = {", "34: unknown key 'art' in an answer; did you mean 'at'?"},
           {"at = { preset = \"light\", omega = \"1/sqrt(4)\", b = 2, x = -1.5 }", "",
            "32: an answer needs its place: at = {"},
           {"settle = 7", "settle = 7.5", "35: settle must be a whole number"},
           {"settle = 7", "record = 0", "35: record = 0 is out of range; from 1 to"},
           {"max_step = 0.01", "max_step = 0", "36: max_step = 0 is out of range"},
           {"\"never\"", "\"nevr\"", "37: unknown stop 'nevr'; did you mean 'never'?"},
           {"settle = 7", "engine = \"reference\"", "35: unknown key 'engine' in an answer"},
           {"starts = 5", "starts = 0", "38: starts = 0 is out of range; from 1 to"}}) {
    EXPECT_THAT(refusal_of(wrong.what, wrong.instead), HasSubstr(wrong.message)) << wrong.instead;
  }
}

}  // namespace
}  // namespace gearsweep::testing
