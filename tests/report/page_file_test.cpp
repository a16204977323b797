// A page as a file: PDF where there is a browser that prints it, otherwise a message that helps.
#include "report/detail/page_file.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "model/error.hpp"
#include "result/child_program.hpp"
#include "support/folder.hpp"

namespace gearsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

// The PATH is that folder alone, until this is gone.
class OnlyPath {
 public:
  explicit OnlyPath(const std::string& folder) : before_(std::getenv("PATH")) {
    setenv("PATH", folder.c_str(), 1);
  }
  ~OnlyPath() { setenv("PATH", before_.c_str(), 1); }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::string before_;
};

// A program of this name that runs these lines of sh.
void make_program(const testing::Folder& folder, const std::string& name,
                  const std::string& lines) {
  std::ofstream(folder / name) << "#!/bin/sh\n" << lines;
  std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
}

HtmlPage small_page() {
  HtmlPage page("A page");
  page.answer("The answer.", {"More."});
  page.heading("Section");
  page.paragraph("Text.");
  return page;
}

TEST(PageFile, WithoutABrowserSaysWhatToDo) {
  const testing::Folder folder;
  const OnlyPath only(folder / "nothing");
  EXPECT_THAT([&] { write_page(small_page(), folder / "page.pdf"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("Chromium or Chrome"),
                                              HasSubstr("install it (Debian: chromium)"),
                                              HasSubstr("page.html and print that"))));
  EXPECT_TRUE(folder.files().empty());
  write_page(small_page(), folder / "page.html");
  EXPECT_THAT(testing::read_all(folder / "page.html"), StartsWith("<!DOCTYPE html>"));
}

TEST(PageFile, OfABrowserThatFailsIsAsBefore) {
  const testing::Folder folder, programs;
  make_program(programs, "chromium", "echo no display; exit 1\n");
  std::ofstream(folder / "page.pdf") << "before";
  const OnlyPath only(programs / "");
  EXPECT_THAT([&] { write_page(small_page(), folder / "page.pdf"); },
              ThrowsMessage<RunError>(HasSubstr("it said: no display")));
  EXPECT_EQ(testing::read_all(folder / "page.pdf"), "before");
  EXPECT_EQ(folder.files(), std::set<std::string>{"page.pdf"});
}

// Quotes and blanks in a name are no words of a shell.
TEST(PageFile, IsPrintedWhole) {
  const testing::Folder folder;
  try {
    ensure_page_file(folder / "it's $HOME.pdf");
  } catch (const InputError& error) {
    GTEST_SKIP() << error.what();
  }
  write_page(small_page(), folder / "it's $HOME.pdf");
  const std::string pdf = testing::read_all(folder / "it's $HOME.pdf");
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  EXPECT_EQ(folder.files(), std::set<std::string>{"it's $HOME.pdf"});
}

TEST(ChildProgram, IsKilledWithWhatItStarted) {
  const testing::Folder programs;
  make_program(programs, "slow", "sleep 60 &\necho begun\nsleep 60\n");
  const ChildEnd end = run_child({programs / "slow"}, {}, 0.5, "slow");
  EXPECT_FALSE(end.is_in_time);
  EXPECT_FALSE(end.is_well);
  EXPECT_EQ(end.said, "begun\n");  // read to its end, which the killed sleep would have kept open
}

TEST(ChildProgram, HasTheEnvironmentWithWhatIsChanged) {
  const testing::Folder programs;
  make_program(programs, "tell", "echo \"$CHANGED and $HOME\"\n");
  setenv("CHANGED", "before", 1);
  const ChildEnd end = run_child({programs / "tell"}, {"CHANGED=now"}, 0.0, "tell");
  unsetenv("CHANGED");
  EXPECT_TRUE(end.is_found && end.is_in_time && end.is_well);
  EXPECT_THAT(end.said, StartsWith("now and /"));
  EXPECT_FALSE(run_child({"no-such-program"}, {}, 0.0, "it").is_found);
}

}  // namespace
}  // namespace gearsweep
