// Which files the text of a study may open, and what a refusal says of their content.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gear/drawing_keys.hpp"
#include "model/error.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kAxes = "[[axes]]\nname = 'omega'\nvalues = [0.5]\n";
// Unlike anything that is computed, and like a file of accounts.
const std::string kSecret = "keeper:x:0:0:keeper:/keeper:/bin/sh\nguest:x:1:1:guest:/:/bin/false\n";

// A study whose text names the file by each key that does.
std::vector<std::string> studies_naming(const std::string& file) {
  std::vector<std::string> studies = {
      fmt::format("[model]\nfile = '{}'\n", file) + kAxes,
      fmt::format("[points]\nfile = '{}'\n", file),
      kAxes + fmt::format("[uncertain]\nmu = {{file = '{}'}}\n", file),
  };
  for (const GearKey& key : kGearKeys) {
    if (key.is_measured())
      studies.push_back(kAxes + fmt::format("[gear]\n{} = '{}'\n", key.name, file));
  }
  return studies;
}

std::string refusal_of(const std::string& text, const std::string& source, NamedFiles files,
                       const std::vector<std::string>& overrides = {}) {
  try {
    read_study(text, source, overrides, {}, {}, files);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StudyFiles, TheStudyOfAResultOpensNone) {
  const Folder folder;
  folder.write("secret", kSecret);
  const std::string source = (folder / "map.nc").string();
  for (const std::string& file : {(folder / "secret").string(), std::string("secret")}) {
    for (const std::string& text : studies_naming(file)) {
      EXPECT_THAT(refusal_of(text, source, NamedFiles::refused),
                  AllOf(HasSubstr("map.nc:"), HasSubstr("the study of a result may name none")))
          << text;
    }
  }
  // Whether there is such a file is not told either.
  for (const std::string& text : studies_naming("/nowhere/at/all")) {
    EXPECT_THAT(refusal_of(text, source, NamedFiles::refused),
                HasSubstr("the study of a result may name none"));
  }
}

TEST(StudyFiles, TheUserMayGiveOneToTheStudyOfAResult) {
  const Folder folder;
  folder.write("points.csv", "mu\n0.1\n");
  const std::string source = (folder / "map.nc").string();
  EXPECT_EQ(refusal_of("[points]\nnames = ['mu']\nnumbers = '0.2'\n", source, NamedFiles::refused,
                       {"points.file=points.csv"}),
            "accepted");
}

// What every study has taken in from files names none any more.
TEST(StudyFiles, WhatAStudyHasOfFilesTravelsInIt) {
  const Folder folder;
  folder.write("points.csv", "mu\n0.1\n");
  folder.write("loads.csv", "0.1\n0.2\n");
  for (const std::string text :
       {"[points]\nfile = 'points.csv'\n",
        "[[axes]]\nname = 'omega'\nvalues = [0.5]\n[uncertain]\nF1 = {file = 'loads.csv'}\n"}) {
    const Study study = read_study(text, (folder / "s.toml").string());
    EXPECT_EQ(refusal_of(study.toml, "elsewhere", NamedFiles::refused), "accepted");
  }
}

// A file of something else that is named by mistake, or by somebody else's study.
TEST(StudyFiles, AMessageQuotesNoMoreThanACell) {
  const Folder folder;
  folder.write("secret", kSecret);
  for (const std::string& text : studies_naming("secret")) {
    EXPECT_THAT(refusal_of(text, (folder / "s.toml").string(), NamedFiles::allowed),
                AllOf(HasSubstr("s.toml:"), Not(HasSubstr("/bin/sh")), Not(HasSubstr("guest"))))
        << text;
  }
}

}  // namespace
}  // namespace gearsweep::testing
