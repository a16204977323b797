#include "rexs/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "rexs/detail/json_document.hpp"
#include "rexs/detail/xml_document.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

void require_size(std::size_t bytes, const std::string& source) {
  if (bytes <= kMaxBytes) return;
  throw InputError(fmt::format("{}: too large for a gear unit; at most {} bytes are possible",
                               source, kMaxBytes));
}

void require_single_ids(const RexsDocument& document) {
  std::set<std::string_view> ids;
  for (const RexsComponent& component : document.components) {
    if (ids.insert(component.id).second) continue;
    throw InputError(fmt::format("{}: a second component has the id {}; each has its own",
                                 document.place(component.line), component.id));
  }
}

// The first few are told one by one.
void drop_open_references(RexsDocument* document) {
  constexpr std::size_t kTold = 5;
  std::set<std::string_view> ids;
  for (const RexsComponent& component : document->components) ids.insert(component.id);
  std::size_t open = 0;
  for (RexsRelation& relation : document->relations) {
    const auto is_open = [&](const RexsReference& reference) {
      if (ids.contains(reference.component)) return false;
      if (++open <= kTold) {
        document->notices.push_back(fmt::format(
            "{}: relation {} ({}) names component {}, which there is not",
            document->place(relation.line), relation.id, relation.type, reference.component));
      }
      return true;
    };
    std::erase_if(relation.references, is_open);
  }
  if (open > kTold) {
    document->notices.push_back(fmt::format("{}: {} more relations name what there is not",
                                            document->source, open - kTold));
  }
}

void require_known_version(RexsDocument* document) {
  if (document->version.starts_with("1.")) return;
  document->notices.push_back(
      fmt::format("{}: version '{}' of REXS; 1.0 to 1.7 are known, and it is read as one of them",
                  document->source, document->version));
}

}  // namespace

const RexsAttribute* RexsComponent::find(std::string_view attribute) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const RexsAttribute& one) { return one.id == attribute; });
  return found == attributes.end() ? nullptr : &*found;
}

std::string RexsComponent::label() const {
  return fmt::format("{} {}{}", type, id, name.empty() ? "" : fmt::format(" ({})", name));
}

std::string_view RexsRelation::of_role(std::string_view role) const {
  for (const RexsReference& reference : references) {
    if (reference.role == role) return reference.component;
  }
  return {};
}

bool RexsRelation::names(std::string_view component) const {
  return std::any_of(references.begin(), references.end(),
                     [&](const RexsReference& one) { return one.component == component; });
}

const RexsComponent* RexsDocument::find(std::string_view component) const {
  const auto found = std::find_if(components.begin(), components.end(),
                                  [&](const RexsComponent& one) { return one.id == component; });
  return found == components.end() ? nullptr : &*found;
}

std::string RexsDocument::place(int line) const {
  return line > 0 ? fmt::format("{}:{}", source, line) : source;
}

RexsDocument read_rexs(const std::string& bytes, const std::string& source) {
  require_size(bytes.size(), source);
  constexpr std::string_view kMark = "\xEF\xBB\xBF";  // of UTF-8
  const std::string text = bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
  if (text.starts_with("PK")) {
    throw InputError(fmt::format("{}: a ZIP archive; unpack it, and give the file in it", source));
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw InputError(fmt::format("{}: empty", source));
  RexsDocument document =
      text[first] == '{' ? read_json_document(text, source) : read_xml_document(text, source);
  require_single_ids(document);
  drop_open_references(&document);
  require_known_version(&document);
  return document;
}

RexsDocument read_rexs_file(const std::string& path) {
  if (!has_regular_file(path, "a gear unit")) {
    throw InputError(
        fmt::format("'{}' is not there; a file of REXS (.rexs, .rexsj) is needed", path));
  }
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  if (!in || size < 0) throw InputError(fmt::format("'{}' cannot be read", path));
  require_size(static_cast<std::size_t>(size), path);
  in.seekg(0);
  return read_rexs({std::istreambuf_iterator<char>(in), {}}, path);
}

}  // namespace gearsweep
