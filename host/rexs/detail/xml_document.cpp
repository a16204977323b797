#include "rexs/detail/xml_document.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <string_view>

#include "model/error.hpp"
#include "rexs/detail/line_numbers.hpp"
#include "rexs/detail/values.hpp"

namespace gearsweep {
namespace {

// Without the prefix of a namespace.
std::string_view name_of(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class XmlReader {
 public:
  XmlReader(const std::string& text, const std::string& source) : lines_(text), source_(source) {
    const pugi::xml_parse_result parsed =
        xml_.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype);
    // Places are those of the text as it was parsed, which is UTF-8.
    has_lines_ = parsed.encoding == pugi::encoding_utf8;
    if (parsed.status == pugi::status_ok) return;
    const std::size_t place = parsed.offset > 0 ? static_cast<std::size_t>(parsed.offset) : 0;
    throw InputError(fmt::format("{}{}: neither XML nor JSON can be read here: {}", source,
                                 has_lines_ ? fmt::format(":{}", lines_.at(place)) : "",
                                 parsed.description()));
  }

  RexsDocument run() {
    out_.source = source_;
    refuse_depth();
    const pugi::xml_node model = only_model();
    out_.version = model.attribute("version").value();
    out_.application = fmt::format("{} {}", model.attribute("applicationId").value(),
                                   model.attribute("applicationVersion").value());
    for (const pugi::xml_node& part : model) {
      const std::string_view name = name_of(part);
      if (name == "relations") read_relations(part);
      if (name == "components") out_.components = components_of(part);
      if (name == "load_spectrum" || name == "load_spectra") read_spectrum(part);
    }
    return std::move(out_);
  }

 private:
  int line_of(const pugi::xml_node& node) const {
    const std::ptrdiff_t place = node.offset_debug();
    return has_lines_ && place >= 0 ? lines_.at(static_cast<std::size_t>(place)) : 0;
  }

  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& message) const {
    const int line = line_of(node);
    throw InputError(line > 0 ? fmt::format("{}:{}: {}", source_, line, message)
                              : fmt::format("{}: {}", source_, message));
  }

  void refuse_depth() const {
    struct Walker : pugi::xml_tree_walker {
      pugi::xml_node deepest, type;
      bool for_each(pugi::xml_node& node) override {
        if (depth() > kDeepestRexs) deepest = node;
        if (node.type() == pugi::node_doctype) type = node;
        return !deepest && !type;
      }
    } walker;
    pugi::xml_node root = xml_;
    root.traverse(walker);
    if (walker.type) fail(walker.type, "a document type (<!DOCTYPE>) is refused; REXS has none");
    if (walker.deepest) fail(walker.deepest, fmt::format("nested deeper than {}", kDeepestRexs));
  }

  pugi::xml_node only_model() const {
    const pugi::xml_node root = xml_.document_element();
    if (name_of(root) != "model") {
      fail(root,
           fmt::format("<{}> is no REXS; its files begin with <model version=...>", root.name()));
    }
    return root;
  }

  void read_relations(const pugi::xml_node& list) {
    for (const pugi::xml_node& node : list) {
      if (name_of(node) != "relation") continue;
      RexsRelation relation = {
          node.attribute("id").value(), node.attribute("type").value(), {}, line_of(node)};
      for (const pugi::xml_node& ref : node) {
        if (name_of(ref) != "ref") continue;
        relation.references.push_back(
            {std::string(trimmed(ref.attribute("id").value())), ref.attribute("role").value()});
      }
      out_.relations.push_back(std::move(relation));
    }
  }

  std::vector<RexsComponent> components_of(const pugi::xml_node& list) const {
    std::vector<RexsComponent> components;
    for (const pugi::xml_node& node : list) {
      if (name_of(node) != "component") continue;
      RexsComponent component = {std::string(trimmed(node.attribute("id").value())),
                                 node.attribute("type").value(),
                                 node.attribute("name").value(),
                                 {},
                                 line_of(node)};
      if (component.id.empty()) fail(node, "a component without an id");
      for (const pugi::xml_node& one : node) {
        if (name_of(one) == "attribute") component.attributes.push_back(attribute_of(one));
      }
      components.push_back(std::move(component));
    }
    return components;
  }

  RexsAttribute attribute_of(const pugi::xml_node& node) const {
    RexsAttribute attribute = {node.attribute("id").value(),
                               std::string(trimmed(node.attribute("unit").value())),
                               std::string(trimmed(node.text().get())),
                               {},
                               line_of(node)};
    for (const pugi::xml_node& child : node) {
      const std::string_view name = name_of(child);
      if (name != "array" && name != "matrix" && name != "array_of_arrays") continue;
      attribute.text.clear();
      attribute.numbers = numbers_of(child);
      if (attribute.numbers.empty()) attribute.text = words_of(child);
      return attribute;
    }
    if (const std::optional<double> number = rexs_number(attribute.text)) {
      attribute.numbers = {*number};
    }
    return attribute;
  }

  // The words of a list, with blanks between.
  static std::string words_of(const pugi::xml_node& list) {
    std::string words;
    for (const pugi::xml_node& cell : list) {
      if (name_of(cell) != "c") continue;
      if (!words.empty()) words += ' ';
      words += trimmed(cell.text().get());
    }
    return words;
  }

  // Empty where one of them is no number.
  std::vector<double> numbers_of(const pugi::xml_node& list) const {
    const std::string_view code = list.attribute("code").value();
    if (!code.empty()) {
      const auto numbers = decoded_numbers(code, list.text().get());
      if (!numbers) fail(list, fmt::format("no list of code '{}' in base64", code));
      return *numbers;
    }
    std::vector<double> numbers;
    const auto add = [&](const pugi::xml_node& cell) {
      const std::optional<double> number = rexs_number(cell.text().get());
      if (number) numbers.push_back(*number);
      return number.has_value();
    };
    for (const pugi::xml_node& row : list) {
      if (name_of(row) == "c" && !add(row)) return {};
      if (name_of(row) != "r") continue;
      for (const pugi::xml_node& cell : row) {
        if (name_of(cell) == "c" && !add(cell)) return {};
      }
    }
    return numbers;
  }

  // Several spectra are read as one.
  void read_spectrum(const pugi::xml_node& spectrum) {
    for (const pugi::xml_node& part : spectrum) {
      if (name_of(part) == "load_spectrum") read_spectrum(part);
      if (name_of(part) != "load_case") continue;
      RexsLoadCase load_case = {part.attribute("id").value(), components_of(part)};
      for (const pugi::xml_node& inner : part) {
        if (name_of(inner) == "components") load_case.components = components_of(inner);
      }
      out_.load_cases.push_back(std::move(load_case));
    }
  }

  LineNumbers lines_;
  const std::string& source_;
  pugi::xml_document xml_;
  bool has_lines_ = false;
  RexsDocument out_;
};

}  // namespace

RexsDocument read_xml_document(const std::string& text, const std::string& source) {
  return XmlReader(text, source).run();
}

}  // namespace gearsweep
