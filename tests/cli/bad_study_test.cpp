// Bad studies: a clear message that names the place, exit status 2, no file left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/good_study.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

struct BadStudy {
  std::string name;
  std::string from, to;               // what is replaced in the good study
  std::vector<std::string> messages;  // all must be in the message
};

void PrintTo(const BadStudy& study, std::ostream* out) { *out << study.name; }

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGoodStudy;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good study has no " + from);
  return text.replace(at, from.size(), to);
}

class BadStudyTest : public ::testing::TestWithParam<BadStudy> {};

TEST_P(BadStudyTest, IsRefusedWithPlaceAndAdvice) {
  const Folder folder;
  folder.write("study.toml", replaced(GetParam().from, GetParam().to));
  const Outcome outcome = gearsweep(folder, "run study.toml -o out.nc");
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  for (const std::string& message : GetParam().messages) {
    EXPECT_THAT(outcome.err, HasSubstr(message));
  }
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.files(), std::set<std::string>{"study.toml"});
}

INSTANTIATE_TEST_SUITE_P(
    All, BadStudyTest,
    ::testing::Values(
        BadStudy{"unknown_table",
                 "[integrate]",
                 "[integrat]",
                 {"study.toml:11:", "unknown key 'integrat'", "did you mean 'integrate'?"}},
        BadStudy{"unknown_key",
                 "settle = 1",
                 "setle = 1",
                 {"study.toml:12:", "unknown key 'setle' in [integrate]", "'settle'"}},
        BadStudy{"unknown_model",
                 "\"gear5\"",
                 "\"gear6\"",
                 {"study.toml:2:", "unknown model 'gear6'", "did you mean 'gear"}},
        BadStudy{"unknown_preset",
                 "\"coarse\"",
                 "\"corse\"",
                 {"study.toml:3:", "unknown preset 'corse'", "did you mean 'coarse'?"}},
        BadStudy{"unknown_parameter",
                 "mu = 0.05",
                 "omga = 0.05",
                 {"study.toml:5:", "unknown parameter 'omga' of model 'gear5'",
                  "did you mean 'omega'?"}},
        BadStudy{"unknown_axis",
                 "\"omega\"",
                 "\"omgea\"",
                 {"study.toml:7:", "axis 'omgea'", "did you mean 'omega'?"}},
        BadStudy{"unknown_quantity",
                 "\"x1_rms\"",
                 "\"x1_rsm\"",
                 {"study.toml:15:", "unknown quantity 'x1_rsm'", "did you mean 'x1_rms'?"}},
        BadStudy{"unknown_engine",
                 "record = 1",
                 "record = 1\nengine = \"cuda\"",
                 {"study.toml:14:", "unknown engine 'cuda'", "opencl, reference"}},
        BadStudy{"nan", "mu = 0.05", "mu = nan", {"study.toml:5:", "mu must be finite"}},
        BadStudy{"infinity", "to = 0.7", "to = inf", {"study.toml:9:", "to must be finite"}},
        BadStudy{"out_of_range",
                 "mu = 0.05",
                 "mu = -1",
                 {"study.toml:5:", "mu = -1 is out of range", "from 0 to 1"}},
        BadStudy{
            "not_a_number", "mu = 0.05", "mu = \"much\"", {"study.toml:5:", "unknown name 'much'"}},
        BadStudy{"largest_integer",
                 "settle = 1",
                 "settle = 9223372036854775807",
                 {"study.toml:12:", "settle = 9.223372036854776e+18 is out of range",
                  "from 0 to 100000000"}},
        BadStudy{"integer_between_numbers",
                 "mu = 0.05",
                 "mu = -9007199254740993",
                 {"study.toml:5:", "mu = -9007199254740992 is out of range", "from 0 to 1"}},
        BadStudy{"count_zero",
                 "count = 2",
                 "count = 0",
                 {"study.toml:10:", "axis 'omega' has count = 0; at least 1 is needed"}},
        BadStudy{"count_negative", "count = 2", "count = -5", {"study.toml:10:", "count = -5"}},
        BadStudy{"count_enormous",
                 "count = 2",
                 "count = 1000000000000",
                 {"study.toml:10:", "count = 1000000000000", "at most"}},
        BadStudy{"count_fraction",
                 "count = 2",
                 "count = 2.5",
                 {"study.toml:10:", "must be a whole number"}},
        BadStudy{"from_equals_to",
                 "to = 0.7",
                 "to = 0.6",
                 {"study.toml:6:", "goes from 0.6 to 0.6", "must be greater"}},
        BadStudy{"no_values",
                 "from = 0.6\nto = 0.7\ncount = 2",
                 "values = []",
                 {"study.toml:8:", "has no values"}},
        BadStudy{"log_from_zero",
                 "from = 0.6",
                 "scale = \"log\"\nfrom = 0",
                 {"study.toml:9:", "out of range"}},
        BadStudy{"axis_twice",
                 "[integrate]",
                 "[[axes]]\nname = \"omega\"\nvalues = [1.0]\n[integrate]",
                 {"study.toml:11:", "axis 'omega' is given twice"}},
        BadStudy{"too_many_steps", "from = 0.6", "from = 0.0001", {"steps", "integrate.max_step"}},
        BadStudy{"both_step_keys",
                 "record = 1",
                 "record = 1\nmax_step = 0.1\nsteps_per_period = 64",
                 {"study.toml:15:", "not both"}},
        BadStudy{"bad_toml", "mu = 0.05", "mu = = 0.05", {"study.toml:5:", "not valid TOML"}}),
    [](const auto& study) { return study.param.name; });

}  // namespace
}  // namespace gearsweep::testing
