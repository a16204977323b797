// REXS in XML.
#pragma once

#include <string>

#include "rexs/document.hpp"

namespace gearsweep {

// As read_rexs() of a text in XML. Entities of its own would need a document type, which is
// refused; names may have a prefix.
RexsDocument read_xml_document(const std::string& text, const std::string& source);

}  // namespace gearsweep
