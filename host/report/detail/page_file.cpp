#include "report/detail/page_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "model/error.hpp"
#include "result/child_program.hpp"
#include "result/output_file.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPdf = ".pdf", kHtml = ".html";

// What Chromium is called by those who package it.
constexpr std::array<const char*, 5> kBrowsers = {"chromium", "chromium-browser", "google-chrome",
                                                  "google-chrome-stable", "chrome"};

// The first of them on the PATH.
std::optional<std::string> find_browser() {
  const char* const path = std::getenv("PATH");
  for (const char* name : kBrowsers) {
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::string program = folder.empty() ? name : folder + "/" + name;
      if (fs::is_regular_file(program) && access(program.c_str(), X_OK) == 0) return program;
    }
  }
  return std::nullopt;
}

std::string browser_for(const std::string& path) {
  if (const std::optional<std::string> browser = find_browser()) return *browser;
  throw InputError(fmt::format(
      "'{0}': a PDF is printed by Chromium or Chrome, and none is on the PATH; install it (Debian: "
      "chromium), or give -o {1}html and print that in any browser",
      path, path.substr(0, path.size() - kPdf.size() + 1)));
}

bool is_whole_pdf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  return content.starts_with("%PDF-") && content.find("%%EOF") != std::string::npos;
}

// Nothing of the user's browser is read or changed: its profile is a new folder.
void print_to_pdf(const std::string& browser, const std::string& html, const std::string& pdf) {
  constexpr double kLongest = 120.0;  // s; a page takes two
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "page.html").string();
  const std::string printed = (folder.path() / "page.pdf").string();
  write_file(page, html);
  std::vector<std::string> words = {browser,
                                    "--headless",
                                    "--disable-gpu",
                                    "--disable-extensions",
                                    "--no-first-run",
                                    "--no-pdf-header-footer",
                                    "--user-data-dir=" + (folder.path() / "profile").string(),
                                    "--print-to-pdf=" + printed,
                                    "file://" + page};
  // Chromium's sandbox refuses the administrator. The page is our own, and nothing in it runs.
  if (geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox");
  const ChildEnd end = run_child(words, {}, kLongest, browser);
  if (!end.is_in_time) {
    throw RunError(fmt::format("{} did not print the page within {} s", browser, kLongest));
  }
  if (!end.is_found || !end.is_well || !is_whole_pdf(printed)) {
    throw RunError(fmt::format("{} printed no PDF; it said: {}", browser,
                               end.said.empty() ? "nothing" : end.said));
  }
  OutputFile file(pdf);
  fs::copy_file(printed, file.temporary_path(), fs::copy_options::overwrite_existing);
  file.commit();
}

}  // namespace

void ensure_page_file(const std::string& path) {
  if (!path.ends_with(kHtml) && !path.ends_with(kPdf)) {
    throw InputError(
        fmt::format("cannot write a page to '{}': its name must end in .html or .pdf", path));
  }
  ensure_writable(path);
  if (path.ends_with(kPdf)) browser_for(path);
}

void write_page(const HtmlPage& page, const std::string& path) {
  ensure_page_file(path);
  if (path.ends_with(kPdf)) {
    print_to_pdf(browser_for(path), page.text(), path);
  } else {
    write_file(path, page.text());
  }
}

}  // namespace gearsweep
