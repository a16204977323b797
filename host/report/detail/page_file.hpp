// A page as a file: HTML, or PDF as a browser prints it.
#pragma once

#include <string>

#include "report/detail/html.hpp"

namespace gearsweep {

// Throws InputError when no page can be put there: its name ends in neither .html nor .pdf, the
// place will not do, or there is no browser that prints to PDF.
void ensure_page_file(const std::string& path);

// The file appears whole or not at all. Throws as ensure_page_file(), and RunError.
void write_page(const HtmlPage& page, const std::string& path);

}  // namespace gearsweep
