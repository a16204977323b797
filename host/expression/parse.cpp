#include "expression/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "model/names.hpp"

namespace gearsweep {
namespace {

// A model that a person can read is far below these.
constexpr std::size_t kMaxDepth = 256;
constexpr std::size_t kMaxNodes = 4000;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Parser {
 public:
  Parser(std::string_view text, const ExpressionNames& names, ExpressionGraph* graph)
      : text_(text), names_(names), graph_(graph) {}

  NodeId run() {
    const NodeId result = expression();
    skip_spaces();
    if (at_ < text_.size()) fail(at_, fmt::format("'{}' is not expected here", text_[at_]));
    return number_at(0, result);
  }

 private:
  // What is nested counts up to where it is left.
  class Level {
   public:
    explicit Level(Parser* parser) : parser_(parser) {
      if (++parser_->depth_ <= kMaxDepth) return;
      --parser_->depth_;
      parser_->fail(parser_->at_, fmt::format("nested more than {} deep", kMaxDepth));
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --parser_->depth_; }

   private:
    Parser* parser_;
  };

  [[noreturn]] void fail(std::size_t position, const std::string& message) const {
    throw ExpressionError(position, message);
  }

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

  void skip_spaces() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r')) {
      ++at_;
    }
  }
  std::size_t here() {
    skip_spaces();
    return at_;
  }
  bool take(std::string_view token) {
    skip_spaces();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  // A word as a whole: not the beginning of a name.
  bool take_word(std::string_view word) {
    skip_spaces();
    if (!text_.substr(at_).starts_with(word)) return false;
    const std::size_t end = at_ + word.size();
    if (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) return false;
    at_ = end;
    return true;
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
    while (take_word(word)) {
      condition_at(start, left);
      const std::size_t place = here();
      left = make(start, operation, {left, condition_at(place, part())});
    }
    return left;
  }

  NodeId negation() {
    if (!take_word("not")) return comparison();
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

  bool take_times() {
    skip_spaces();
    return !text_.substr(at_).starts_with("**") && take("*");
  }

  NodeId product() {
    const std::size_t start = here();
    NodeId left = with_sign();
    while (true) {
      const bool is_times = take_times();
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
    if (at_ == text_.size()) {
      fail(at_, text_.empty() ? "the expression is empty" : "the expression ends too early");
    }
    const char c = text_[at_];
    if (is_digit(c) || c == '.') return literal();
    if (is_letter(c)) return named();
    if (!take("(")) fail(start, fmt::format("'{}' is not expected here", c));
    const NodeId inner = expression();
    if (!take(")")) fail(here(), "')' is missing");
    return inner;
  }

  NodeId literal() {
    double value = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range) fail(at_, "the number is too large or too small");
    if (error != std::errc() || !std::isfinite(value)) fail(at_, "this is no number");
    const std::size_t after = at_ + static_cast<std::size_t>(end - begin);
    if (after < text_.size() && (is_letter(text_[after]) || text_[after] == '.')) {
      fail(after,
           fmt::format("'{}' follows a number; a product is written with '*'", text_[after]));
    }
    at_ = after;
    return graph_->number(value);
  }

  NodeId named() {
    const std::size_t start = at_;
    const auto goes_on = [this](std::size_t at) {
      return at < text_.size() && (is_letter(text_[at]) || is_digit(text_[at]));
    };
    while (goes_on(at_)) ++at_;
    if (at_ < text_.size() && text_[at_] == '.' && goes_on(at_ + 1)) ++at_;  // option.choice
    while (goes_on(at_)) ++at_;
    const std::string name(text_.substr(start, at_ - start));
    if (take("(")) return called(start, name);
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

  std::vector<std::string> known_names() const {
    std::vector<std::string> known = names_.known();
    known.emplace_back("pi");
    return known;
  }

  // Between quotes of either kind; there is no way to write such a quote within.
  std::string quoted() {
    const std::size_t start = here();
    const char quote = start < text_.size() ? text_[start] : ' ';
    if (quote != '"' && quote != '\'') {
      fail(start, "the name of a file must stand here, in quotes: table(\"file.csv\", phase)");
    }
    const std::size_t end = text_.find(quote, start + 1);
    if (end == std::string_view::npos) fail(start, "the name of a file has no quote at its end");
    const std::string_view name = text_.substr(start + 1, end - start - 1);
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    if (name.empty() || std::ranges::any_of(name, is_control)) {
      fail(start, "this cannot be the name of a file");
    }
    at_ = end + 1;
    return std::string(name);
  }

  // What stands in the parentheses of table().
  NodeId table(std::size_t start) {
    TableCall call;
    call.file_at = here();
    call.file = quoted();
    if (!take(",")) fail(here(), "',' and the phase are missing: table(\"file.csv\", phase)");
    call.argument_at = here();
    call.argument = number_at(call.argument_at, expression());
    if (take(",")) {
      if (take_word("cubic")) {
        call.interpolation = Interpolation::cubic;
      } else if (!take_word("linear")) {
        fail(here(), "a table is read as 'linear' or 'cubic'");
      }
    }
    if (!take(")")) fail(here(), "')' is missing");
    if (!names_.table) fail(call.file_at, "there are no tables here");
    return checked(start, graph_->table(names_.table(call), call.argument, call.argument));
  }

  NodeId called(std::size_t start, const std::string& name) {
    if (name == "table") return table(start);
    const auto info = std::ranges::find(functions(), name, &FunctionInfo::name);
    const bool is_clamp = name == "clamp";
    const bool is_step = name == "step";
    if (info == functions().end() && !is_clamp && !is_step) {
      std::vector<std::string> known = {"clamp", "step", "table"};
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
    if (arguments.size() != wanted) {
      fail(start, fmt::format("{}() takes {} argument{}, not {}", name, wanted,
                              wanted == 1 ? "" : "s", arguments.size()));
    }
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

  const std::string_view text_;
  const ExpressionNames& names_;
  ExpressionGraph* graph_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace

NodeId parse_expression(std::string_view text, const ExpressionNames& names,
                        ExpressionGraph* graph) {
  return Parser(text, names, graph).run();
}

std::string with_caret(std::string_view text, std::size_t position) {
  constexpr std::size_t kBefore = 60, kWidth = 90;
  position = std::min(position, text.size());
  const std::size_t newline =
      position == 0 ? std::string_view::npos : text.rfind('\n', position - 1);
  const std::size_t line = newline == std::string_view::npos ? 0 : newline + 1;
  const std::size_t begin = std::max(line, position > kBefore ? position - kBefore : 0);
  const std::size_t end = std::min({text.find('\n', position), text.size(), begin + kWidth});
  std::string shown(text.substr(begin, end - begin));
  std::ranges::replace(shown, '\t', ' ');
  // A character of several bytes takes one column.
  const auto columns =
      std::count_if(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(position - begin),
                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return fmt::format("  {}\n  {}^", shown, std::string(static_cast<std::size_t>(columns), ' '));
}

}  // namespace gearsweep
