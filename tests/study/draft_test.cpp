// A draft is a study that may lack its axes; and the text of a study is pleasant to read.
#include "study/draft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/error.hpp"
#include "study/refusal.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::refusal;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(Draft, NeedsNoAxes) {
  const Study draft = read_draft("[parameters]\nmu = 0.1\n", "draft");
  EXPECT_THAT(draft.axes, SizeIs(0));
  EXPECT_EQ(read_draft(draft.toml, "again").toml, draft.toml);
  EXPECT_THAT(refusal(draft.toml), HasSubstr("the study has no axes"));
}

TEST(Draft, WithAxesIsTheStudy) {
  const std::string text = "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7]\n";
  EXPECT_EQ(read_draft(text, "draft").toml, read_study(text, "study").toml);
}

TEST(Draft, MayNameTheAxisOfItsChainBeforehand) {
  const Study draft = read_draft("[initial]\npolicy = 'forward'\nalong = 'omega'\n", "draft");
  const std::string axis = "axes=[{name = 'omega', values = [0.5, 0.7]}]";
  EXPECT_EQ(read_draft(draft.toml, "draft", {axis}).initial.along, 0U);
  EXPECT_THROW(read_draft(draft.toml, "draft", {"axes=[{name = 'b', values = [0.5, 0.7]}]"}),
               InputError);
}

TEST(Draft, IsRefusedWhereAStudyIs) {
  EXPECT_THROW(read_draft("[parameters]\nnu = 0.1\n", "draft"), InputError);
  EXPECT_THROW(read_draft("axes = 3\n", "draft"), InputError);
  EXPECT_THROW(read_draft("", "draft"), InputError);
}

TEST(StudyText, HasTablesInTheOrderOfTheManual) {
  const Study study =
      read_study("title = 'Order'\n[observe]\nquantities = ['x1_rms']\n[model]\n", "s",
                 {"axes=[{count = 3, to = 2, name = 'omega', from = 1}]",
                  "initial={state = {x1 = 0.5}, policy = 'fixed'}", "model.backlash=dynamic",
                  "model.name=gear5"});
  EXPECT_EQ(study.toml,
            "title = 'Order'\n\n"
            "[model]\nname = 'gear5'\nbacklash = 'dynamic'\n\n"
            "[[axes]]\nname = 'omega'\nfrom = 1\nto = 2\ncount = 3\n\n"
            "[initial]\npolicy = 'fixed'\n\n[initial.state]\nx1 = 0.5\n\n"
            "[observe]\nquantities = [ 'x1_rms' ]\n");
}

TEST(StudyText, KeepsEachLetter) {
  for (const char* const text :
       {"\\n\\nlines", "three ''' quotes", "'''\\nin lines", "ends\\nwith '", "a \\\" and a '",
        "\\r\\n", "\\u007F and \\u0001", "C:\\\\u", "\\tü", ""}) {
    const Study study = read_draft(std::string("title = \"") + text + "\"\n[model]\n", "s");
    const Study again = read_draft(study.toml, "again");
    EXPECT_EQ(again.title, study.title) << study.toml;
    EXPECT_EQ(again.toml, study.toml);
  }
}

TEST(StudyText, LongListsStandInLines) {
  std::string values;
  for (int i = 1; i <= 100; ++i) values += (i > 1 ? ", " : "") + std::to_string(i);
  const Study study = read_study("[[axes]]\nname = 'omega'\nvalues = [" + values + "]\n", "s");
  EXPECT_THAT(study.toml, AllOf(HasSubstr("values = [\n    1, 2, 3,"), HasSubstr("99, 100\n]\n")));
  for (std::size_t begin = 0; begin < study.toml.size();) {
    const std::size_t end = study.toml.find('\n', begin);
    EXPECT_LE(end - begin, 100U);
    begin = end + 1;
  }
  EXPECT_EQ(read_study(study.toml, "again").axes[0].values, study.axes[0].values);
}

TEST(StudyText, ALongAssignmentIsShortInMessages) {
  std::string values = "nan";
  for (int i = 0; i < 1000; ++i) values += ", 0.12345";
  const std::string text = "[[axes]]\nname = 'omega'\nvalues = [0.5]\n";
  try {
    read_study(text, "s", {"axes.omega.values=[" + values + "]"});
    FAIL() << "nan is no value";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("--set axes.omega.values=[nan"), HasSubstr("...: "),
                                    HasSubstr("must be finite")));
    EXPECT_LE(std::string(error.what()).size(), 300U);
  }
}

}  // namespace
}  // namespace gearsweep
