#include "expression/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "expression/detail/cursor.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

// A model that a person can read is far below these.
constexpr std::size_t kMaxDepth = 256;
constexpr std::size_t kMaxNodes = 16000;
constexpr double kMaxTerms = 1000.0;  // of all sums of a text
constexpr const char* kSumForm = "a sum is written sum(i, 1, 3, term)";

class Parser {
 public:
  Parser(std::string_view text, const ExpressionNames& names, ExpressionGraph* graph)
      : cursor_(text), names_(names), graph_(graph) {}

  NodeId run() {
    const NodeId result = expression();
    if (const char c = cursor_.next(); c != '\0') {
      fail(here(), fmt::format("'{}' is not expected here", c));
    }
    return number_at(0, result);
  }

 private:
  // What is nested counts up to where it is left.
  class Level {
   public:
    explicit Level(Parser* parser) : parser_(parser) {
      const std::size_t max = parser_->names_.max_depth;
      if (++parser_->depth_ <= max) return;
      --parser_->depth_;
      parser_->fail(parser_->here(), fmt::format("nested more than {} deep", max));
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --parser_->depth_; }

   private:
    Parser* parser_;
  };

  NodeId make(std::size_t position, Operation operation, const std::vector<NodeId>& arguments) {
    return checked(position, graph_->as_written(operation, arguments));
  }
  NodeId checked(std::size_t position, NodeId id) const {
    if ((*graph_)[id].depth > kMaxDepth) {
      fail(position, fmt::format("more than {} operations follow one from another; give parts of "
                                 "it names, in [constants]",
                                 kMaxDepth));
    }
    if (graph_->size() > kMaxNodes) {
      fail(position, fmt::format("the model has more than {} operations", kMaxNodes));
    }
    return id;
  }

  NodeId number_at(std::size_t position, NodeId id) const {
    if (is_condition((*graph_)[id].operation)) {
      fail(position,
           "a condition stands where a number is needed; if(condition, yes, no) makes one of it");
    }
    return id;
  }
  NodeId condition_at(std::size_t position, NodeId id) const {
    if (!is_condition((*graph_)[id].operation)) {
      fail(position, "a number stands where a condition is needed, such as x < 0");
    }
    return id;
  }

  std::size_t here() { return cursor_.here(); }
  bool take(std::string_view token) { return cursor_.take(token); }
  [[noreturn]] static void fail(std::size_t position, const std::string& message) {
    throw ExpressionError(position, message);
  }

  NodeId expression() {
    return chain("or", Operation::disjunction, [this] { return conjunction(); });
  }
  NodeId conjunction() {
    return chain("and", Operation::conjunction, [this] { return negation(); });
  }
  template <class Part>
  NodeId chain(std::string_view word, Operation operation, const Part& part) {
    const std::size_t start = here();
    NodeId left = part();
    while (cursor_.take_word(word)) {
      condition_at(start, left);
      const std::size_t place = here();
      left = make(start, operation, {left, condition_at(place, part())});
    }
    return left;
  }

  NodeId negation() {
    if (!cursor_.take_word("not")) return comparison();
    const Level level(this);
    const std::size_t place = here();
    return make(place, Operation::negation, {condition_at(place, negation())});
  }

  NodeId comparison() {
    const std::size_t start = here();
    const NodeId left = sum();
    const std::size_t place = here();
    // The longer ones first.
    const bool is_at_most = take("<="), is_at_least = !is_at_most && take(">=");
    const bool is_equal = !is_at_most && !is_at_least && take("==");
    const bool is_less = !is_at_most && !is_at_least && !is_equal && take("<");
    const bool is_more = !is_at_most && !is_at_least && !is_equal && !is_less && take(">");
    if (!is_at_most && !is_at_least && !is_equal && !is_less && !is_more) return left;
    number_at(start, left);
    const std::size_t behind = here();
    const NodeId right = number_at(behind, sum());
    if (is_equal) return make(place, Operation::equal, {left, right});
    const Operation operation = is_less || is_more ? Operation::less : Operation::less_or_equal;
    if (is_less || is_at_most) return make(place, operation, {left, right});
    return make(place, operation, {right, left});
  }

  NodeId sum() {
    const std::size_t start = here();
    NodeId left = product();
    while (true) {
      const bool is_plus = take("+");
      if (!is_plus && !take("-")) return left;
      number_at(start, left);
      const std::size_t place = here();
      const NodeId right = number_at(place, product());
      left = make(place, is_plus ? Operation::add : Operation::subtract, {left, right});
    }
  }

  NodeId product() {
    const std::size_t start = here();
    NodeId left = with_sign();
    while (true) {
      const bool is_times = cursor_.take_times();
      if (!is_times && !take("/")) return left;
      number_at(start, left);
      const std::size_t place = here();
      const NodeId right = number_at(place, with_sign());
      left = make(place, is_times ? Operation::multiply : Operation::divide, {left, right});
    }
  }

  NodeId with_sign() {
    const Level level(this);
    const bool is_minus = take("-");
    if (!is_minus && !take("+")) return power();
    const std::size_t place = here();
    const NodeId of = number_at(place, with_sign());
    return is_minus ? make(place, Operation::negate, {of}) : of;
  }

  NodeId power() {
    const std::size_t start = here();
    const NodeId base = primary();
    if (!take("^") && !take("**")) return base;
    number_at(start, base);
    const std::size_t place = here();
    return make(place, Operation::power, {base, number_at(place, with_sign())});
  }

  NodeId primary() {
    const std::size_t start = here();
    const char c = cursor_.next();
    if (c == '\0') {
      fail(start,
           cursor_.is_text_empty() ? "the expression is empty" : "the expression ends too early");
    }
    if ((c >= '0' && c <= '9') || c == '.') return graph_->number(cursor_.take_number());
    if (const std::string name = cursor_.take_name(true); !name.empty()) return named(start, name);
    if (!take("(")) fail(start, fmt::format("'{}' is not expected here", c));
    const NodeId inner = expression();
    if (!take(")")) fail(here(), "')' is missing");
    return inner;
  }

  NodeId named(std::size_t start, const std::string& name) {
    if (take("(")) return called(start, name);
    if (const std::optional<NodeId> index = index_named(name)) return *index;
    if (take("[")) return entry(start, name);
    if (name == "pi") return graph_->number(std::numbers::pi);
    if (const std::optional<NodeId> known = names_.find(name)) return *known;
    if (name == "table") fail(start, "'table' is a function: table(\"file.csv\", phase)");
    if (std::ranges::find(functions(), name, &FunctionInfo::name) != functions().end()) {
      fail(start, fmt::format("'{}' is a function: {}(...)", name, name));
    }
    const bool is_time = name == "t" || name == "time";
    fail(start, fmt::format("unknown name '{}'{}", name,
                            is_time ? "; the forcing is written with its phase, as in cos(phase), "
                                      "which goes from 0 to 2 pi in each period"
                                    : suggest_name(name, known_names())));
  }

  std::optional<NodeId> index_named(const std::string& name) const {
    const auto found = std::find_if(indices_.rbegin(), indices_.rend(),
                                    [&](const auto& index) { return index.first == name; });
    if (found == indices_.rend()) return std::nullopt;
    return graph_->number(found->second);
  }

  // What stands in the brackets of a list's entry.
  NodeId entry(std::size_t start, const std::string& list) {
    const std::size_t place = here();
    const double index = whole_number(place, expression());
    if (!take("]")) fail(here(), "']' is missing");
    const std::string name = fmt::format("{}_{}", list, index);
    if (const std::optional<NodeId> known = names_.find(name)) return *known;
    if (const auto plain = index == 1.0 ? names_.find(list) : std::nullopt) return *plain;
    fail(start, fmt::format("there is no '{}[{}]'; the first entry of a list is [1]", list, index));
  }

  // The value of what is made of numbers alone.
  double whole_number(std::size_t position, NodeId id) {
    const double value = value_of(id);
    if (std::isfinite(value) && value == std::floor(value)) return value;
    fail(position, "a whole number must stand here, made of numbers and indices of sums alone");
  }
  // Each part once: what is called twice with one argument shares its nodes.
  double value_of(NodeId id) {
    const auto known = values_.find(id);
    if (known != values_.end()) return known->second;
    return values_[id] = value_of((*graph_)[id]);
  }
  double value_of(const Node& node) {
    if (node.operation == Operation::number) return node.number;
    if (node.operation == Operation::symbol || node.operation == Operation::table) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const auto argument = [&](std::size_t i) {
      return i < node.arguments.size() ? value_of(node.arguments[i]) : 0.0;
    };
    return apply(node.operation, argument(0), argument(1), argument(2));
  }

  // What stands in the parentheses of sum(index, first, last, term).
  NodeId sum_of_terms(std::size_t start) {
    const std::size_t place = here();
    const std::string index = cursor_.take_name(false);
    if (index.empty() || !take(",")) fail(place, kSumForm);
    const std::size_t first_at = here();
    const double first = whole_number(first_at, expression());
    if (!take(",")) fail(here(), kSumForm);
    const std::size_t last_at = here();
    const double last = whole_number(last_at, expression());
    if (!take(",")) fail(here(), kSumForm);
    const std::size_t term_at = here();
    NodeId total = graph_->number(0.0);
    // A sum without terms is read all the same.
    for (double i = first; i <= std::max(first, last); i += 1.0) {
      if (++terms_ > kMaxTerms) {
        fail(start, fmt::format("sums have at most {} terms in an expression", kMaxTerms));
      }
      cursor_.go_to(term_at);
      indices_.emplace_back(index, i);
      const NodeId term = number_at(term_at, expression());
      indices_.pop_back();
      if (i > last) continue;
      total = i == first ? term : make(start, Operation::add, {total, term});
    }
    if (!take(")")) fail(here(), "')' is missing");
    return total;
  }

  NodeId called_own(std::size_t start, const std::string& name, std::size_t wanted) {
    const std::vector<NodeId> arguments = numbers_in_parentheses();
    refuse_other_count(start, name, wanted, arguments.size());
    return checked(start, names_.call(name, arguments));
  }
  std::vector<NodeId> numbers_in_parentheses() {
    std::vector<NodeId> arguments;
    do {
      const std::size_t place = here();
      arguments.push_back(number_at(place, expression()));
    } while (take(","));
    if (!take(")")) fail(here(), "')' or ',' is missing");
    return arguments;
  }
  void refuse_other_count(std::size_t start, const std::string& name, std::size_t wanted,
                          std::size_t count) const {
    if (count == wanted) return;
    fail(start, fmt::format("{}() takes {} argument{}, not {}", name, wanted,
                            wanted == 1 ? "" : "s", count));
  }

  std::vector<std::string> known_names() const {
    std::vector<std::string> known = names_.known();
    known.emplace_back("pi");
    return known;
  }

  // What stands in the parentheses of table().
  NodeId table(std::size_t start) {
    TableCall call;
    call.file_at = here();
    call.file = cursor_.take_file();
    if (!take(",")) fail(here(), "',' and the phase are missing: table(\"file.csv\", phase)");
    call.argument_at = here();
    call.argument = number_at(call.argument_at, expression());
    if (take(",")) {
      if (cursor_.take_word("cubic")) {
        call.interpolation = Interpolation::cubic;
      } else if (!cursor_.take_word("linear")) {
        fail(here(), "a table is read as 'linear' or 'cubic'");
      }
    }
    if (!take(")")) fail(here(), "')' is missing");
    if (!names_.table) fail(call.file_at, "there are no tables here");
    return checked(start, graph_->table(names_.table(call), call.argument, call.argument));
  }

  // What stands in its parentheses.
  NodeId curve(std::size_t start, const std::string& name) {
    const std::size_t place = here();
    const std::vector<NodeId> arguments = numbers_in_parentheses();
    refuse_other_count(start, name, 1, arguments.size());
    return checked(start, names_.curve(name, arguments.front(), place));
  }

  NodeId called(std::size_t start, const std::string& name) {
    if (name == "table") return table(start);
    if (name == "sum") return sum_of_terms(start);
    if (names_.is_curve && names_.is_curve(name)) return curve(start, name);
    if (const auto own = names_.arguments_of ? names_.arguments_of(name) : std::nullopt) {
      return called_own(start, name, *own);
    }
    const auto info = std::ranges::find(functions(), name, &FunctionInfo::name);
    const bool is_clamp = name == "clamp";
    const bool is_step = name == "step";
    if (info == functions().end() && !is_clamp && !is_step) {
      std::vector<std::string> known = {"clamp", "step", "sum", "table"};
      if (names_.known_functions) {
        std::ranges::copy(names_.known_functions(), std::back_inserter(known));
      }
      for (const FunctionInfo& function : functions()) known.emplace_back(function.name);
      fail(start, fmt::format("unknown function '{}'{}", name, suggest_name(name, known)));
    }
    const std::size_t wanted = is_clamp ? 3 : is_step ? 1 : info->arguments;
    const bool is_select = !is_clamp && !is_step && info->operation == Operation::select;
    std::vector<NodeId> arguments;
    do {
      const std::size_t place = here();
      const NodeId argument = expression();
      arguments.push_back(is_select && arguments.empty() ? condition_at(place, argument)
                                                         : number_at(place, argument));
    } while (take(","));
    if (!take(")")) fail(here(), "')' or ',' is missing");
    refuse_other_count(start, name, wanted, arguments.size());
    if (is_clamp) {
      const NodeId least = make(start, Operation::max, {arguments[0], arguments[1]});
      return make(start, Operation::min, {least, arguments[2]});
    }
    if (is_step) {
      const NodeId is_negative = make(start, Operation::less, {arguments[0], graph_->number(0.0)});
      return make(start, Operation::select,
                  {is_negative, graph_->number(0.0), graph_->number(1.0)});
    }
    return make(start, info->operation, arguments);
  }

  Cursor cursor_;
  const ExpressionNames& names_;
  ExpressionGraph* graph_;
  std::size_t depth_ = 0;
  double terms_ = 0.0;                                   // of sums, so far
  std::map<NodeId, double> values_;                      // of parts of indices
  std::vector<std::pair<std::string, double>> indices_;  // of the sums around, outermost first
};

}  // namespace

NodeId parse_expression(std::string_view text, const ExpressionNames& names,
                        ExpressionGraph* graph) {
  return Parser(text, names, graph).run();
}

}  // namespace gearsweep
