// Whether a page is well-formed.
#pragma once

#include <regex>
#include <stack>
#include <string>

namespace gearsweep {

// What is wrong with a text as XML, as far as elements go; empty if nothing.
inline std::string malformed(const std::string& xml) {
  static const std::regex kTag("<(/?)([A-Za-z0-9]+)((?: [A-Za-z:-]+=\"[^\"<]*\")*) ?(/?)>");
  std::stack<std::string> open;
  std::size_t at = xml.find("<html");
  while ((at = xml.find('<', at)) != std::string::npos) {
    // The bytes of a picture are more than a regular expression takes.
    const std::size_t end = xml.find('>', at);
    std::string tag = xml.substr(at, end - at + 1);
    const std::size_t bytes = tag.find("base64,");
    if (bytes != std::string::npos) tag.erase(bytes, tag.find('"', bytes) - bytes);
    std::smatch parts;
    if (!std::regex_match(tag, parts, kTag)) return "no tag: " + tag;
    if (parts[1] == "/") {
      if (open.empty() || open.top() != parts[2]) return "nothing to close: " + tag;
      open.pop();
    } else if (parts[4] != "/") {
      open.push(parts[2]);
    }
    at = end;
  }
  return open.empty() ? "" : "not closed: " + open.top();
}

}  // namespace gearsweep
