#include "expression/tape.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <unordered_map>

#include "expression/scratch.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kBlock = 16;  // inputs that are worked out together
using Block = std::array<double, kBlock>;

// Loops of their own for what a compiler makes vectors of.
void apply_to_block(Operation operation, const Block& a, const Block& b, const Block& c,
                    Block* out) {
  const auto each = [&](auto function) {
    for (std::size_t i = 0; i < kBlock; ++i) (*out)[i] = function(i);
  };
  switch (operation) {
    case Operation::add:
      return each([&](std::size_t i) { return a[i] + b[i]; });
    case Operation::subtract:
      return each([&](std::size_t i) { return a[i] - b[i]; });
    case Operation::multiply:
      return each([&](std::size_t i) { return a[i] * b[i]; });
    case Operation::divide:
      return each([&](std::size_t i) { return a[i] / b[i]; });
    case Operation::less:
      return each([&](std::size_t i) { return a[i] < b[i] ? 1.0 : 0.0; });
    case Operation::less_or_equal:
      return each([&](std::size_t i) { return a[i] <= b[i] ? 1.0 : 0.0; });
    case Operation::conjunction:
      return each([&](std::size_t i) { return a[i] != 0.0 && b[i] != 0.0 ? 1.0 : 0.0; });
    case Operation::select:
      return each([&](std::size_t i) { return a[i] != 0.0 ? b[i] : c[i]; });
    default:
      return each([&](std::size_t i) { return apply(operation, a[i], b[i], c[i]); });
  }
}

// What has become of the places of a tape: known numbers, or what stands where now. Earlier places
// are known before later ones.
class Places {
 public:
  explicit Places(std::size_t size) : stands_for_(size), values_(size), are_known_(size) {
    for (std::size_t i = 0; i < size; ++i) stands_for_[i] = i;
  }

  bool is_known(std::size_t place) const { return are_known_[stands_for_[place]]; }
  bool is(std::size_t place, double value) const {
    return is_known(place) && this->value(place) == value;
  }
  double value(std::size_t place) const { return values_[stands_for_[place]]; }
  std::size_t now(std::size_t place) const { return stands_for_[place]; }

  void set(std::size_t place, double value) {
    values_[place] = value;
    are_known_[place] = true;
  }
  void replace(std::size_t place, std::size_t by) { stands_for_[place] = stands_for_[by]; }

 private:
  std::vector<std::size_t> stands_for_;
  std::vector<double> values_;
  std::vector<bool> are_known_;
};

// Whether the place is simpler than its operation says, as a graph's nodes are
// (ExpressionGraph::make).
bool simplify(Operation operation, std::size_t a, std::size_t b, std::size_t c, std::size_t place,
              Places* places) {
  const auto by = [&](std::size_t other) {
    places->replace(place, other);
    return true;
  };
  switch (operation) {
    case Operation::select:
      return places->is_known(a) && by(places->value(a) != 0.0 ? b : c);
    case Operation::multiply:
      if (places->is(a, 0.0) || places->is(b, 0.0)) {
        places->set(place, 0.0);
        return true;
      }
      return (places->is(a, 1.0) && by(b)) || (places->is(b, 1.0) && by(a));
    case Operation::add:
      return (places->is(a, 0.0) && by(b)) || (places->is(b, 0.0) && by(a));
    case Operation::subtract:
      return places->is(b, 0.0) && by(a);
    default:
      return false;
  }
}

}  // namespace

Tape::Tape(const ExpressionGraph& graph, const std::vector<NodeId>& inputs,
           const std::vector<NodeId>& outputs)
    : inputs_(inputs.size()) {
  std::unordered_map<NodeId, std::size_t> places;
  for (std::size_t i = 0; i < inputs.size(); ++i) places.emplace(inputs[i], i);
  // What lies below an input is not needed.
  std::vector<NodeId> needed, open = outputs;
  std::vector<bool> is_needed(graph.size());
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (is_needed[id] || places.contains(id)) continue;
    is_needed[id] = true;
    needed.push_back(id);
    for (const NodeId argument : graph[id].arguments) open.push_back(argument);
  }
  std::ranges::sort(needed);
  for (const NodeId id : needed) {
    if (!graph.is_number(id)) continue;
    places.emplace(id, inputs_ + numbers_.size());
    numbers_.push_back(graph[id].number);
  }
  for (const NodeId id : needed) {
    if (graph.is_number(id)) continue;
    const Node& node = graph[id];
    if (node.operation == Operation::symbol) {
      throw std::logic_error("nothing gives '" + node.symbol + "'");
    }
    const auto place = [&](std::size_t i) {
      return i < node.arguments.size() ? places.at(node.arguments[i]) : 0;
    };
    steps_.push_back({node.operation, place(0), place(1), place(2)});
    if (node.operation == Operation::table) {
      steps_.back().c = tables_.size();
      tables_.push_back(node.table);
    }
    places.emplace(id, inputs_ + numbers_.size() + steps_.size() - 1);
  }
  for (const NodeId id : outputs) outputs_.push_back(places.at(id));
}

Tape Tape::given(const std::vector<double>& first) const {
  const std::size_t first_step = inputs_ + numbers_.size();
  Places places(first_step + steps_.size());
  for (std::size_t i = 0; i < first.size(); ++i) places.set(i, first[i]);
  for (std::size_t i = 0; i < numbers_.size(); ++i) places.set(inputs_ + i, numbers_[i]);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const auto [operation, a, b, c] = steps_[i];
    const std::size_t place = first_step + i;
    if (simplify(operation, a, b, c, place, &places)) continue;
    const std::array arguments = {a, b, c};
    const bool is_known = std::all_of(arguments.begin(), arguments.begin() + arity(operation),
                                      [&](std::size_t at) { return places.is_known(at); });
    if (!is_known) continue;
    const double at_a = places.value(a), at_b = places.value(b);
    places.set(place, operation == Operation::table
                          ? tables_[c]->at(at_a, at_b)
                          : apply(operation, at_a, at_b, places.value(c)));
  }

  std::vector<bool> is_needed(first_step + steps_.size());
  for (const std::size_t output : outputs_) is_needed[places.now(output)] = true;
  for (std::size_t i = steps_.size(); i-- > 0;) {
    if (!is_needed[first_step + i] || places.is_known(first_step + i)) continue;
    const std::array arguments = {steps_[i].a, steps_[i].b, steps_[i].c};
    for (std::size_t k = 0; k < arity(steps_[i].operation); ++k) {
      is_needed[places.now(arguments[k])] = true;
    }
  }

  Tape rest;
  rest.inputs_ = inputs_ - first.size();
  rest.tables_ = tables_;
  std::vector<std::size_t> moved(is_needed.size());
  for (std::size_t i = first.size(); i < inputs_; ++i) moved[i] = i - first.size();
  for (std::size_t i = 0; i < is_needed.size(); ++i) {
    if (!is_needed[i] || !places.is_known(i)) continue;
    moved[i] = rest.inputs_ + rest.numbers_.size();
    rest.numbers_.push_back(places.value(i));
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::size_t place = first_step + i;
    if (!is_needed[place] || places.is_known(place)) continue;
    const std::size_t count = arity(steps_[i].operation);
    const auto now = [&](std::size_t at, std::size_t k) {
      return k < count ? moved[places.now(at)] : 0;
    };
    Step step = {steps_[i].operation, now(steps_[i].a, 0), now(steps_[i].b, 1),
                 now(steps_[i].c, 2)};
    if (step.operation == Operation::table) step.c = steps_[i].c;
    moved[place] = rest.inputs_ + rest.numbers_.size() + rest.steps_.size();
    rest.steps_.push_back(step);
  }
  for (const std::size_t output : outputs_) rest.outputs_.push_back(moved[places.now(output)]);
  return rest;
}

void Tape::run(const double* inputs, double* outputs) const {
  Scratch scratch(inputs_ + numbers_.size() + steps_.size());
  double* const values = scratch.data();
  std::copy_n(inputs, inputs_, values);
  double* next = std::ranges::copy(numbers_, values + inputs_).out;
  for (const Step& step : steps_) {
    *next++ = step.operation == Operation::table
                  ? tables_[step.c]->at(values[step.a], values[step.b])
                  : apply(step.operation, values[step.a], values[step.b], values[step.c]);
  }
  for (const std::size_t place : outputs_) *outputs++ = values[place];
}

void Tape::run_many(std::size_t count, const double* inputs, double* outputs) const {
  const std::size_t first_step = inputs_ + numbers_.size();
  std::vector<Block> values(first_step + steps_.size());
  for (std::size_t i = 0; i < numbers_.size(); ++i) values[inputs_ + i].fill(numbers_[i]);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    // The rest of a block that is not full repeats its last input.
    for (std::size_t k = 0; k < inputs_; ++k) {
      for (std::size_t i = 0; i < kBlock; ++i) {
        values[k][i] = inputs[k * count + begin + std::min(i, size - 1)];
      }
    }
    Block* next = values.data() + first_step;
    for (const Step& step : steps_) {
      const Block &a = values[step.a], &b = values[step.b];
      if (step.operation == Operation::table) {
        for (std::size_t i = 0; i < kBlock; ++i) (*next)[i] = tables_[step.c]->at(a[i], b[i]);
      } else {
        apply_to_block(step.operation, a, b, values[step.c], next);
      }
      ++next;
    }
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      std::copy_n(values[outputs_[k]].data(), size, outputs + k * count + begin);
    }
  }
}

double Tape::run(const std::vector<double>& inputs) const {
  double output = 0.0;
  run(inputs.data(), &output);
  return output;
}

std::vector<double> Tape::run_all(const std::vector<double>& inputs) const {
  std::vector<double> outputs(outputs_.size());
  run(inputs.data(), outputs.data());
  return outputs;
}

}  // namespace gearsweep
