// What a search for borders has finished, kept in a journal beside its result: the same search goes
// on from there.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "borders/border_curve.hpp"
#include "journal/journal.hpp"

namespace gearsweep {

struct BorderRequest;  // borders/border_search.hpp
struct Study;
struct SweepOptions;

// Parts of a search that are kept one by one: a curve that was followed from a pair of pixels, or
// what a whole stage has found.
enum class SearchStage { rounds, breakings, stops, reasons, lost, contacts, accuracy };
struct SearchPart {
  SearchStage stage = SearchStage::rounds;
  std::size_t number = 0;
};

// What decides the curves of a search.
Identity identity_of(const Study& study, const BorderRequest& request);

// Threads may share one.
class SearchRecord {
 public:
  // Takes from `options` journal_path (empty: nothing is kept) and notes. device: that computes.
  // Throws as Journal does.
  SearchRecord(const Identity& identity, const SweepOptions& options, std::string device);
  // Leaves no journal of a search that has finished nothing.
  ~SearchRecord();
  SearchRecord(const SearchRecord&) = delete;
  SearchRecord& operator=(const SearchRecord&) = delete;

  // How many parts were finished when it was opened.
  std::size_t parts() const { return parts_; }
  bool has(SearchPart part) const;
  // What is kept of a part, or else what `find` gives, which is kept from then on. Throws
  // InputError where the journal is damaged.
  std::vector<double> numbers(SearchPart part, const std::function<std::vector<double>()>& find);
  std::vector<BorderCurve> curves(SearchPart part,
                                  const std::function<std::vector<BorderCurve>()>& find);

 private:
  std::unique_ptr<Journal> journal_;
  const std::string device_;
  std::size_t parts_ = 0;
};

}  // namespace gearsweep
