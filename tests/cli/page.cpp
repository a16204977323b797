#include "cli/page.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

#include "support/process.hpp"

namespace gearsweep::testing {
std::vector<std::string> matches_in(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

std::vector<std::string> Page::blocks_of(const std::string& language) const {
  std::vector<std::string> texts;
  for (const Block& block : blocks) {
    if (block.language == language) texts.push_back(block.text);
  }
  return texts;
}

std::vector<std::string> Page::links() const { return matches_in(prose, R"(\]\(([^)\s]+)\))"); }

std::vector<std::string> Page::code() const { return matches_in(prose, "`([^`]+)`"); }

std::vector<std::string> Page::anchors() const {
  std::vector<std::string> anchors;
  for (const std::string& heading : matches_in("\n" + prose, "\n#+ ([^\n]+)")) {
    std::string anchor;
    for (const char letter : heading) {
      const auto code = static_cast<unsigned char>(letter);
      if (std::isalnum(code) != 0 || letter == '-' || letter == '_') {
        anchor += static_cast<char>(std::tolower(code));
      } else if (letter == ' ') {
        anchor += '-';
      }
    }
    anchors.push_back(anchor);
  }
  return anchors;
}

Page read_page(const std::filesystem::path& path) {
  Page page = {.path = path, .text = read_all(path), .prose = {}, .blocks = {}};
  const std::regex marker("<!-- not run: (.+) -->");
  std::optional<std::string> reason;
  bool is_inside = false;
  std::size_t number = 0;
  std::istringstream lines(page.text);
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::smatch match;
    if (line.starts_with("```")) {
      if (!is_inside) page.blocks.push_back({line.substr(3), {}, reason, number});
      is_inside = !is_inside;
      reason.reset();
    } else if (is_inside) {
      page.blocks.back().text += line + "\n";
    } else {
      page.prose += line + "\n";
      if (std::regex_match(line, match, marker)) reason = match[1];
      // Another comment may follow; anything else separates the reason from the block.
      if (!line.starts_with("<!--")) reason.reset();
    }
  }
  return page;
}

std::vector<std::filesystem::path> all_pages() {
  const std::filesystem::path source = GEARSWEEP_SOURCE;
  std::vector<std::filesystem::path> pages = {source / "README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(source / "doc")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  std::sort(pages.begin() + 1, pages.end());
  return pages;
}

}  // namespace gearsweep::testing
