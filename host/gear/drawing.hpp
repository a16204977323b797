// The drawing of a gear pair, with what was measured of it: a value, wherever it comes from.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expression/periodic_table.hpp"
#include "gear/drawing_keys.hpp"
#include "model/error.hpp"

namespace gearsweep {

// What is wrong with a drawing, as a message without its place, and the key that it is about, which
// the drawing may lack.
class DrawingError : public InputError {
 public:
  DrawingError(const GearKey& key, const std::string& message)
      : InputError(message), key_(key.name) {}
  std::string_view key() const { return key_; }

 private:
  std::string_view key_;
};

// What was measured, in the unit of scale 1 of its key.
struct Measured {
  std::string source;  // what messages call it: the name of its file
  // A mesh_curve has them as PeriodicTable wants them; a path_curve from 0, where contact begins,
  // to 1, rising.
  std::vector<TablePoint> points;
  std::vector<double> teeth;  // of a tooth_list, in the order in which they enter
};

// Has some of the keys of drawing_keys.hpp. Numbers are in the units of the keys.
class GearDrawing {
 public:
  // name: what messages call it, "[gear]".
  explicit GearDrawing(std::string name) : name_(std::move(name)) {}

  // A number, which stands for all that the key takes. Those of teeth must be two. This and the
  // next throw DrawingError for a number out of the key's range, or another count than it has.
  void set_number(const GearKey& key, double value);
  void set_numbers(const GearKey& key, std::vector<double> values);
  // One of the choices.
  void set_word(const GearKey& key, std::string word) { entries_[key.name].word = std::move(word); }
  void set_measured(const GearKey& key, Measured measured) {
    entries_[key.name].measured = std::move(measured);
  }
  // In place of what the key has, a number that differs from point to point: the one of this point.
  // A key of harmonics stands for the first. member: of a pair, the one that varies, 0 the pinion;
  // the other one stays, and is 0 where the drawing has none.
  void vary(const GearKey& key, double value, std::optional<std::size_t> member = std::nullopt);

  // What the key has is a guess.
  void set_estimated(const GearKey& key) { estimated_.insert(key.name); }

  const std::string& name() const { return name_; }
  bool is_estimated(const GearKey& key) const { return estimated_.contains(key.name); }
  bool has(const GearKey& key) const { return entries_.contains(key.name); }
  bool varies(const GearKey& key) const;
  // Whether this one of a pair does, alone or with the other.
  bool varies(const GearKey& key, std::size_t member) const;
  // What the key had before it varied; where it had nothing, the first number that it was given
  // then. Throws DrawingError where there is none.
  double unvaried(const GearKey& key) const;
  std::optional<double> number(const GearKey& key) const;
  // Throws DrawingError where there is none, as list() does.
  double required(const GearKey& key) const;
  // All that the key takes.
  const std::vector<double>& list(const GearKey& key) const;
  // As many as there are, which may be none.
  std::vector<double> numbers(const GearKey& key) const;
  // Two zeros where there are none.
  std::vector<double> pair_or_zero(const GearKey& key) const;
  // The first of its choices where there is none.
  std::string choice(const GearKey& key) const;
  // nullptr where there is none.
  const Measured* measured(const GearKey& key) const;

 private:
  struct Entry {
    std::vector<double> numbers;
    std::string word;
    Measured measured;
    std::optional<double> unvaried;     // of a number that varies
    std::optional<std::size_t> member;  // of a pair, the only one that does
  };
  const Entry* find(const GearKey& key) const;

  std::string name_;
  std::map<std::string_view, Entry> entries_;
  std::set<std::string_view> estimated_;
};

}  // namespace gearsweep
