#include "rexs/detail/json_document.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "rexs/detail/line_numbers.hpp"
#include "rexs/detail/values.hpp"

namespace gearsweep {
namespace {

using Json = nlohmann::json;

// What has no value there, as no object has one.
const Json& member(const Json& object, const char* name) {
  static const Json kNone;
  if (!object.is_object()) return kNone;
  const auto found = object.find(name);
  return found == object.end() ? kNone : *found;
}

// A text as it stands, a number as JSON writes it; otherwise empty.
std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() || value.is_boolean() ? value.dump() : "";
}

class JsonReader {
 public:
  JsonReader(const std::string& text, const std::string& source) : source_(source) {
    const auto limit = [&](int depth, Json::parse_event_t, Json&) {
      if (depth <= kDeepestRexs) return true;
      throw InputError(fmt::format("{}: nested deeper than {}", source, kDeepestRexs));
    };
    try {
      json_ = Json::parse(text, limit);
    } catch (const Json::parse_error& error) {
      throw InputError(fmt::format("{}:{}: neither JSON nor XML can be read here: {}", source,
                                   LineNumbers(text).at(error.byte > 0 ? error.byte - 1 : 0),
                                   error.what()));
    } catch (const Json::exception& error) {
      throw InputError(fmt::format("{}: {}", source, error.what()));
    }
  }

  RexsDocument run() {
    const Json& model = member(json_, "model");
    if (!model.is_object()) {
      throw InputError(fmt::format("{}: no REXS; its files have an object \"model\"", source_));
    }
    out_.source = source_;
    out_.version = text_of(member(model, "version"));
    out_.application = fmt::format("{} {}", text_of(member(model, "applicationId")),
                                   text_of(member(model, "applicationVersion")));
    for (const Json& one : list_of(model, "relations")) read_relation(one);
    out_.components = components_of(model);
    read_spectrum(member(model, "load_spectrum"));
    for (const Json& spectrum : list_of(model, "load_spectra")) read_spectrum(spectrum);
    return std::move(out_);
  }

 private:
  // Throws InputError where it is something else than a list.
  const Json& list_of(const Json& object, const char* name) const {
    static const Json kEmpty = Json::array();
    const Json& list = member(object, name);
    if (list.is_null()) return kEmpty;
    if (!list.is_array()) throw InputError(fmt::format("{}: \"{}\" is no list", source_, name));
    return list;
  }

  void read_relation(const Json& json) {
    RexsRelation relation = {text_of(member(json, "id")), text_of(member(json, "type")), {}, 0};
    for (const Json& ref : list_of(json, "refs")) {
      relation.references.push_back({text_of(member(ref, "id")), text_of(member(ref, "role"))});
    }
    out_.relations.push_back(std::move(relation));
  }

  std::vector<RexsComponent> components_of(const Json& owner) const {
    std::vector<RexsComponent> components;
    for (const Json& json : list_of(owner, "components")) {
      RexsComponent component = {text_of(member(json, "id")),
                                 text_of(member(json, "type")),
                                 text_of(member(json, "name")),
                                 {},
                                 0};
      if (component.id.empty()) {
        throw InputError(fmt::format("{}: a component without an id", source_));
      }
      for (const Json& one : list_of(json, "attributes")) {
        component.attributes.push_back(attribute_of(one, component));
      }
      components.push_back(std::move(component));
    }
    return components;
  }

  // Its value stands under the name of its type: "floating_point": 4.5.
  RexsAttribute attribute_of(const Json& json, const RexsComponent& owner) const {
    RexsAttribute attribute = {
        text_of(member(json, "id")), text_of(member(json, "unit")), "", {}, 0};
    if (!json.is_object()) return attribute;
    for (const auto& [type, value] : json.items()) {
      if (type == "id" || type == "unit") continue;
      attribute.text = std::string(trimmed(text_of(value)));
      if (value.is_object()) {
        const std::string code = text_of(member(value, "code"));
        const auto numbers = decoded_numbers(code, text_of(member(value, "value")));
        if (!numbers) {
          throw InputError(fmt::format("{}: {} of {} is no list of code '{}' in base64", source_,
                                       attribute.id, owner.label(), code));
        }
        attribute.numbers = *numbers;
      } else if (!add_numbers(value, &attribute.numbers)) {
        attribute.numbers.clear();
        if (value.is_array()) attribute.text = words_of(value);
      }
    }
    return attribute;
  }

  // The words of a list, with blanks between.
  static std::string words_of(const Json& list) {
    std::string words;
    for (const Json& one : list) {
      if (!words.empty()) words += ' ';
      words += trimmed(text_of(one));
    }
    return words;
  }

  // Whether all of it is numbers. Lists are not deep here.
  static bool add_numbers(const Json& value, std::vector<double>* numbers) {
    if (value.is_array()) {
      for (const Json& one : value) {
        if (!add_numbers(one, numbers)) return false;
      }
      return true;
    }
    const std::optional<double> number = rexs_number(text_of(value));
    if (number) numbers->push_back(*number);
    return number.has_value();
  }

  void read_spectrum(const Json& spectrum) {
    for (const Json& one : list_of(spectrum, "load_cases")) {
      out_.load_cases.push_back({text_of(member(one, "id")), components_of(one)});
    }
  }

  const std::string& source_;
  Json json_;
  RexsDocument out_;
};

}  // namespace

RexsDocument read_json_document(const std::string& text, const std::string& source) {
  return JsonReader(text, source).run();
}

}  // namespace gearsweep
