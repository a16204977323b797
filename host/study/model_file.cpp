#include "study/model_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "equations/definition.hpp"
#include "expression/expression.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/regular_file.hpp"
#include "study/detail/toml_access.hpp"
#include "study/nesting.hpp"

namespace gearsweep {
namespace {

constexpr double kLargest = 1e12;  // of a parameter that names no range
constexpr double kMaxMaxStep = 1e6;
constexpr std::size_t kMaxBytes = 256 * 1024;
constexpr std::size_t kMaxNames = 64;  // states; parameters may be more
constexpr std::size_t kMaxLetters = 40;

// Words of C and OpenCL C, and of the grammar.
const std::set<std::string, std::less<>>& reserved_words() {
  static const std::set<std::string, std::less<>> kWords = {
      "auto",    "bool",      "break",    "case",     "char",     "const",  "continue", "default",
      "do",      "double",    "else",     "enum",     "extern",   "float",  "for",      "global",
      "goto",    "half",      "if",       "inline",   "int",      "kernel", "local",    "long",
      "private", "real",      "register", "restrict", "return",   "scalar", "short",    "signed",
      "sizeof",  "static",    "struct",   "switch",   "typedef",  "uchar",  "uint",     "ulong",
      "union",   "unsigned",  "ushort",   "void",     "volatile", "while",  "mask",     "constant",
      "and",     "or",        "not",      "phase",    "pi",       "status", "step",     "clamp",
      "stop",    "deflection"};
  return kWords;
}

bool is_name(const std::string& text) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !text.empty() && is_letter(text.front()) && text.front() != '_' &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

class ModelReader {
 public:
  ModelReader(const toml::table& root, std::string text, std::string source)
      : root_(root), source_(std::move(source)) {
    definition_.text = std::move(text);
  }

  ModelDefinition run() {
    TableReader reader(&root_, "the model's file");
    read_model(required(&reader, "model"));
    read_states(required(&reader, "states"));
    read_parameters(reader.table("parameters"));
    read_constants(reader.table("constants"));
    read_equations(required(&reader, "equations"));
    read_forcing(required(&reader, "forcing"));
    read_signals(reader.table("signals"));
    read_presets(reader.table("presets"));
    reader.refuse_unknown();
    return std::move(definition_);
  }

 private:
  struct Entry {
    std::string name;
    const toml::key* key;
    const toml::node* node;
  };

  const toml::table* required(TableReader* reader, const std::string& name) const {
    const toml::table* table = reader->table(name);
    if (table == nullptr) {
      throw InputError(fmt::format("{}: the model has no [{}]", source_, name));
    }
    return table;
  }

  // In the order of the file.
  static std::vector<Entry> entries_of(const toml::table* table) {
    std::vector<Entry> entries;
    if (table == nullptr) return entries;
    for (const auto& [key, node] : *table) {
      entries.push_back({std::string(key.str()), &key, &node});
    }
    const auto place = [](const Entry& entry) {
      const toml::source_position begin = entry.key->source().begin;
      return std::pair(begin.line, begin.column);
    };
    std::ranges::sort(entries, {}, place);
    return entries;
  }

  // A new name of something that expressions may use.
  void take_name(const Entry& entry) {
    if (!is_name(entry.name) || entry.name.size() > kMaxLetters) {
      fail_at(*entry.node, fmt::format("'{}' cannot be a name; a name has up to {} letters, digits "
                                       "and _, and begins with a letter",
                                       entry.name, kMaxLetters));
    }
    const auto function = std::ranges::find(functions(), entry.name, &FunctionInfo::name);
    if (function != functions().end() || reserved_words().contains(entry.name)) {
      fail_at(*entry.node,
              fmt::format("'{}' has a meaning of its own; take another name", entry.name));
    }
    if (!names_.insert(entry.name).second) {
      fail_at(*entry.node, fmt::format("'{}' is defined twice", entry.name));
    }
  }

  ExpressionText expression_of(const toml::node& node, const std::string& what) const {
    if (node.is_number()) {
      std::ostringstream text;
      text << toml::node_view<const toml::node>(node);
      return place_text(text.str(), node, 0);
    }
    if (!node.is_string()) {
      fail_at(node, fmt::format("{} must be an expression in quotes", what));
    }
    return place_text(node.as_string()->get(), node, 1);
  }
  static ExpressionText place_text(const std::string& text, const toml::node& node,
                                   std::size_t quote) {
    const toml::source_region& region = node.source();
    return {.text = text,
            .file = region.path ? *region.path : std::string("model"),
            .line = region.begin.line,
            .column = region.begin.column + quote};
  }

  // The table of an entry, or nullptr where something shorter stands for it.
  static const toml::table& table_of(const Entry& entry, const std::string& form) {
    if (!entry.node->is_table()) {
      fail_at(*entry.node,
              fmt::format("'{}' must be a table: {} = {{ {} }}", entry.name, entry.name, form));
    }
    return *entry.node->as_table();
  }

  void read_model(const toml::table* table) {
    TableReader reader(table, "[model]");
    definition_.name = reader.text("name", "");
    if (!is_name(definition_.name) || definition_.name.size() > kMaxLetters) {
      fail_at(*table, fmt::format("[model] needs a name of up to {} letters, digits and _: "
                                  "name = \"impact\"",
                                  kMaxLetters));
    }
    definition_.summary = reader.text("summary", "");
    const std::string source = reader.text("source", "");
    if (!source.empty()) {
      definition_.summary += fmt::format("{}({})", definition_.summary.empty() ? "" : " ", source);
    }
    definition_.max_step = reader.number("max_step", definition_.max_step, 1e-9, kMaxMaxStep);
    reader.refuse_unknown();
  }

  void read_states(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      take_name(entry);
      const toml::table& row = table_of(entry, "unit = \"1\", meaning = \"position\"");
      TableReader reader(&row, fmt::format("state '{}'", entry.name));
      definition_.states.push_back(
          {entry.name, reader.text("unit", "1"), reader.text("meaning", entry.name)});
      const toml::node* start = reader.find("start");
      definition_.start.push_back(start == nullptr ? ExpressionText{"0", source_, 0, 0}
                                                   : expression_of(*start, "start"));
      const toml::node* angle = reader.find("angle");
      if (angle != nullptr && !angle->is_boolean()) fail_at(*angle, "angle must be true or false");
      definition_.are_angles.push_back(angle != nullptr && angle->as_boolean()->get());
      reader.refuse_unknown();
    }
    if (definition_.states.empty() || definition_.states.size() > kMaxNames) {
      fail_at(*table, fmt::format("a model has 1 to {} states, not {}", kMaxNames,
                                  definition_.states.size()));
    }
  }

  void read_parameters(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      take_name(entry);
      ParameterInfo info;
      info.name = entry.name;
      if (entry.node->is_number()) {
        info.unit = "1";
        info.default_value = read_number(*entry.node, entry.name, -kLargest, kLargest);
        info.min = -kLargest;
        info.max = kLargest;
        info.meaning = entry.name;
      } else {
        const toml::table& row = table_of(entry, "value = 1.0, min = 0.0, max = 10.0");
        TableReader reader(&row, fmt::format("parameter '{}'", entry.name));
        info.unit = reader.text("unit", "1");
        info.min = reader.number("min", -kLargest, -kLargest, kLargest);
        info.max = reader.number("max", kLargest, info.min, kLargest);
        if (reader.find("value") == nullptr) {
          fail_at(row, fmt::format("parameter '{}' has no value", entry.name));
        }
        info.default_value = reader.number("value", 0.0, info.min, info.max);
        info.meaning = reader.text("meaning", entry.name);
        reader.refuse_unknown();
      }
      definition_.parameters.push_back(std::move(info));
    }
    if (definition_.parameters.empty()) {
      throw InputError(
          fmt::format("{}: the model has no [parameters]: nothing could be swept", source_));
    }
  }

  void read_constants(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      take_name(entry);
      definition_.constants.push_back({entry.name, expression_of(*entry.node, entry.name)});
    }
  }

  void read_equations(const toml::table* table) {
    std::vector<std::string> states;
    for (const ChannelInfo& state : definition_.states) {
      states.push_back(state.name);
      const toml::node* node = table->get(state.name);
      if (node == nullptr) {
        fail_at(*table, fmt::format("state '{}' has no equation", state.name));
      }
      definition_.equations.push_back(
          expression_of(*node, fmt::format("the derivative of {}", state.name)));
    }
    for (const Entry& entry : entries_of(table)) {
      if (std::ranges::find(states, entry.name) != states.end()) continue;
      fail_at(*entry.node,
              fmt::format("'{}' is not a state{}", entry.name, suggest_name(entry.name, states)));
    }
  }

  void read_forcing(const toml::table* table) {
    TableReader reader(table, "[forcing]");
    const toml::node* period = reader.find("period");
    if (period == nullptr) {
      fail_at(*table,
              "[forcing] needs the period: period = \"2*pi/omega\" (of a model without "
              "forcing the time from section to section)");
    }
    definition_.period = expression_of(*period, "period");
    if (const toml::node* jumps = reader.find("jumps")) {
      if (!jumps->is_array()) {
        fail_at(*jumps, "jumps must be a list of phases in radians: jumps = [\"2*pi*duty\"]");
      }
      for (const toml::node& jump : *jumps->as_array()) {
        definition_.jumps.push_back(expression_of(jump, "a jump"));
      }
    }
    reader.refuse_unknown();
  }

  void read_signals(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      take_name(entry);
      ChannelInfo info{entry.name, "1", entry.name};
      if (entry.node->is_string()) {
        definition_.signal_values.push_back(expression_of(*entry.node, entry.name));
      } else {
        const toml::table& row = table_of(entry, "expression = \"k*x\", unit = \"1\"");
        TableReader reader(&row, fmt::format("signal '{}'", entry.name));
        const toml::node* value = reader.find("expression");
        if (value == nullptr) {
          fail_at(row, fmt::format("signal '{}' has no expression", entry.name));
        }
        definition_.signal_values.push_back(expression_of(*value, entry.name));
        info.unit = reader.text("unit", "1");
        info.meaning = reader.text("meaning", entry.name);
        reader.refuse_unknown();
      }
      definition_.signals.push_back(std::move(info));
    }
  }

  void read_presets(const toml::table* table) {
    definition_.presets.push_back({"default", "the values of the model's file", ""});
    for (const Entry& entry : entries_of(table)) {
      const toml::table& row = table_of(entry, "k = 1.0");
      std::string meaning, assignments;
      for (const auto& [key, node] : row) {
        const std::string name(key.str());
        if (name == "meaning") {
          TableReader reader(&row, "[presets]");
          meaning = reader.text("meaning", "");
          continue;
        }
        const auto known = std::ranges::find(definition_.parameters, name, &ParameterInfo::name);
        if (known == definition_.parameters.end()) {
          std::vector<std::string> names = {"meaning"};
          for (const ParameterInfo& info : definition_.parameters) names.push_back(info.name);
          fail_at(node, fmt::format("unknown parameter '{}' in preset '{}'{}", name, entry.name,
                                    suggest_name(name, names)));
        }
        assignments +=
            fmt::format("{} = {}\n", name, read_toml_number(node, name, known->min, known->max));
      }
      definition_.presets.push_back({entry.name, meaning, assignments});
    }
  }

  // As TOML, where a number without point is an integer.
  static std::string read_toml_number(const toml::node& node, const std::string& name, double min,
                                      double max) {
    const std::string text = fmt::format("{}", read_number(node, name, min, max));
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  }

  const toml::table& root_;
  const std::string source_;
  ModelDefinition definition_;
  std::set<std::string> names_;
};

}  // namespace

std::string model_file_text(const std::string& path) {
  if (!has_regular_file(path, "a model")) {
    throw InputError(fmt::format("{}: there is no such file", path));
  }
  std::ifstream in(path, std::ios::binary);
  // One byte more tells that there are too many.
  std::string text(kMaxBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read", path));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::shared_ptr<const Model> read_model_text(const std::string& text, const std::string& source,
                                             const std::set<std::string>& swept) {
  if (text.size() > kMaxBytes) {
    throw InputError(
        fmt::format("{}: too large for a model; at most {} bytes are possible", source, kMaxBytes));
  }
  if (text.find('\0') != std::string::npos) {
    throw InputError(fmt::format("{}: not a text file; a model is TOML text", source));
  }
  refuse_deep_keys(text, source);
  try {
    const toml::table root = toml::parse(text, source);
    ModelDefinition definition = ModelReader(root, text, source).run();
    definition.swept = swept;
    return std::make_shared<const Model>(make_model(definition));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", source, error.source().begin.line,
                                 error.description()));
  }
}

}  // namespace gearsweep
