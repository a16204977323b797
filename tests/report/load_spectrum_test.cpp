// The report of a load spectrum: the answer over all loads, and each of them.
#include <gmock/gmock.h>

#include "model/error.hpp"
#include "report/report.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"

namespace gearsweep {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Without shafts, an error and changing stiffness nothing moves: the factor of each load is 1.
Study still_spectrum() {
  return read_study(
      "title = 'still'\n[model]\nname = 'gear1'\n[parameters]\nFte = [0, 0, 0]\nk = [0, 0, "
      "0]\n[points]\n"
      "names = ['Fm', 'omega', 'time_share']\n"
      "numbers = '''\n0.1, 0.8, 0.75\n0.2, 0.8, 0.25\n'''\nslope = 2\n"
      "[integrate]\nsettle = 20\nrecord = 4\n",
      "test");
}

TEST(Report, OfALoadSpectrumHasTheAnswerOverAllLoads) {
  const testing::Folder folder;
  ASSERT_TRUE(write_report({{still_spectrum(), ""}}, folder / "r.html", ReportOptions()));
  const std::string html = testing::read_all(folder / "r.html");
  EXPECT_THAT(html, HasSubstr("is 1 times the load on average over the time"));
  EXPECT_THAT(html, HasSubstr("stay in contact under all loads"));
  // sqrt(0.75 0.1^2 + 0.25 0.2^2), which is of the loads and of the forces alike.
  EXPECT_THAT(html, HasSubstr("A load of 0.1323"));
  EXPECT_THAT(html, HasSubstr("of the largest forces under them it is 0.1323"));
  // 0.25 0.04 of 0.0175.
  EXPECT_THAT(html, HasSubstr("Load 2 does 57 % of that damage"));
  EXPECT_THAT(html, Not(HasSubstr("Worst speeds")));
}

// Twice the loads do the same by the same factors.
TEST(Report, OfTwoLoadSpectraHasTheAnswersOfBoth) {
  const Study twice = read_study(still_spectrum().toml, "test",
                                 {"points.numbers=0.2, 0.8, 0.75\n0.4, 0.8, 0.25\n"});
  const testing::Folder folder;
  ASSERT_TRUE(write_report({{still_spectrum(), "one"}, {twice, "twice"}}, folder / "r.html",
                           ReportOptions()));
  const std::string html = testing::read_all(folder / "r.html");
  EXPECT_THAT(html, HasSubstr("one: The largest force"));
  EXPECT_THAT(html, HasSubstr("twice: The largest force"));
  EXPECT_THAT(html, HasSubstr("A load of 0.1323"));
  EXPECT_THAT(html, HasSubstr("A load of 0.2646"));
}

TEST(Report, OfASpectrumAndASpeedIsRefused) {
  const Study speed = read_study(
      "[model]\nname = 'gear1'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1\ncount = 3\n", "test");
  EXPECT_THROW(ensure_report({{still_spectrum(), "one"}, {speed, "other"}}, "r.html"), InputError);
}

}  // namespace
}  // namespace gearsweep
