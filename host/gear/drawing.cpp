#include "gear/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gearsweep {
namespace {

void check_range(const GearKey& key, double value) {
  if (value >= key.min && value <= key.max) return;
  throw DrawingError(key, fmt::format("{} = {} is out of range; from {} to {} is allowed", key.name,
                                      value, key.min, key.max));
}

}  // namespace

void GearDrawing::set_number(const GearKey& key, double value) {
  check_range(key, value);
  const std::size_t count = key.can_vary() ? std::max<std::size_t>(key.count(), 1) : 1;
  entries_[key.name].numbers.assign(count, value);
}

void GearDrawing::set_numbers(const GearKey& key, std::vector<double> values) {
  for (const double value : values) check_range(key, value);
  if (key.form != KeyForm::harmonics && values.size() != key.count()) {
    throw DrawingError(
        key, fmt::format("{} has {} numbers; it needs one number or a list of {}{}", key.name,
                         values.size(), key.count(),
                         key.form == KeyForm::bearings
                             ? ": of the pinion across and along the line of action, of the gear "
                               "across and along it"
                             : ""));
  }
  entries_[key.name].numbers = std::move(values);
}

void GearDrawing::vary(const GearKey& key, double value, std::optional<std::size_t> member) {
  const bool varied = varies(key);
  std::vector<double> before = numbers(key);
  if (member) {
    check_range(key, value);
    if (before.empty() && key.fallback != "0") {
      throw DrawingError(
          key, fmt::format("one of {} varies, which {} does not have: give both", key.name, name_));
    }
    before.resize(key.count());
    std::vector<double> both = before;
    both[*member] = value;
    entries_[key.name].numbers = std::move(both);
  } else {
    set_number(key, value);
  }
  Entry& entry = entries_[key.name];
  if (!entry.unvaried) entry.unvaried = before.empty() ? value : before.front();
  entry.member = !varied || entry.member == member ? member : std::nullopt;
  if (key.form == KeyForm::harmonics && before.size() > 1) {
    entry.numbers.insert(entry.numbers.end(), before.begin() + 1, before.end());
  }
}

bool GearDrawing::varies(const GearKey& key) const {
  const Entry* entry = find(key);
  return entry != nullptr && entry->unvaried;
}

bool GearDrawing::varies(const GearKey& key, std::size_t member) const {
  return varies(key) && find(key)->member.value_or(member) == member;
}

double GearDrawing::unvaried(const GearKey& key) const {
  return varies(key) ? *find(key)->unvaried : required(key);
}

std::optional<double> GearDrawing::number(const GearKey& key) const {
  const Entry* entry = find(key);
  return entry == nullptr ? std::nullopt : std::optional(entry->numbers.front());
}

double GearDrawing::required(const GearKey& key) const { return list(key).front(); }

const std::vector<double>& GearDrawing::list(const GearKey& key) const {
  const Entry* entry = find(key);
  if (entry == nullptr) {
    throw DrawingError(key, fmt::format("{} needs '{}' ({})", name_, key.name, key.meaning));
  }
  return entry->numbers;
}

std::vector<double> GearDrawing::numbers(const GearKey& key) const {
  const Entry* entry = find(key);
  return entry == nullptr ? std::vector<double>() : entry->numbers;
}

std::vector<double> GearDrawing::pair_or_zero(const GearKey& key) const {
  return has(key) ? list(key) : std::vector<double>(2, 0.0);
}

std::string GearDrawing::choice(const GearKey& key) const {
  if (const Entry* entry = find(key)) return entry->word;
  return std::string(key.choices.substr(0, key.choices.find(' ')));
}

const Measured* GearDrawing::measured(const GearKey& key) const {
  const Entry* entry = find(key);
  return entry == nullptr ? nullptr : &entry->measured;
}

const GearDrawing::Entry* GearDrawing::find(const GearKey& key) const {
  const auto found = entries_.find(key.name);
  return found == entries_.end() ? nullptr : &found->second;
}

}  // namespace gearsweep
