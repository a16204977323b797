#include "equations/detail/check_message.hpp"

#include <fmt/format.h>

namespace gearsweep {

CheckMessage split_message(const std::string& message) {
  CheckMessage parts;
  std::size_t begin = 0;
  while (true) {
    const std::size_t open = message.find('{', begin), close = message.find('}', open);
    if (open == std::string::npos || close == std::string::npos) break;
    parts.texts.push_back(message.substr(begin, open - begin));
    parts.values.push_back(message.substr(open + 1, close - open - 1));
    begin = close + 1;
  }
  parts.texts.push_back(message.substr(begin));
  return parts;
}

std::string filled(const CheckMessage& message, const double* values) {
  std::string text = message.texts.front();
  for (std::size_t i = 0; i < message.values.size(); ++i) {
    text += fmt::format("{:.6g}{}", values[i], message.texts[i + 1]);
  }
  return text;
}

}  // namespace gearsweep
