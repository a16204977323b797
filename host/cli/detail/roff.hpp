// Text as man takes it.
#pragma once

#include <string>

namespace gearsweep {

// Text that roff takes as it is.
std::string roff_plain(const std::string& text);
std::string roff_bold(const std::string& text);
std::string roff_italic(const std::string& text);

// Paragraphs as help shows them: lines that are indented stay as they are, others are filled.
std::string roff_paragraphs(const std::string& text);

// A heading with what is below it.
std::string roff_section(const std::string& title, const std::string& text);

// A tagged paragraph: both are roff already.
std::string roff_item(const std::string& tag, const std::string& text);

}  // namespace gearsweep
