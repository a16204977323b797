#include "borders/search_record.hpp"

#include <fmt/format.h>

#include <exception>

#include "borders/border_search.hpp"
#include "borders/curve_numbers.hpp"
#include "journal/notes.hpp"
#include "model/checksum.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kStageParts = std::size_t{1} << 40U;

std::size_t number_of(SearchPart part) {
  return static_cast<std::size_t>(part.stage) * kStageParts + part.number;
}

std::string checksum_of(const PeriodPixels& pixels) {
  Checksum checksum;
  for (const std::vector<double>* values :
       {&pixels.axes[0], &pixels.axes[1], &pixels.period, &pixels.contact}) {
    checksum.add(values->size());
    checksum.add(std::as_bytes(std::span(*values)));
  }
  return fmt::format("{:016x}", checksum.value());
}

}  // namespace

Identity identity_of(const Study& study, const BorderRequest& request) {
  return {{notes::kStudy, study.toml},
          {"program", version() + " " + source_hash()},
          {notes::kStep, fmt::format("{}", study.integrate.max_step)},
          {notes::kSearch,
           fmt::format("steps {}, borders of {} pairs", request.steps, request.min_edges)},
          {"checksum of the map", checksum_of(request.pixels)}};
}

SearchRecord::SearchRecord(const Identity& identity, const SweepOptions& options,
                           std::string device)
    : device_(std::move(device)) {
  if (options.journal_path.empty()) return;
  journal_ = std::make_unique<Journal>(options.journal_path, identity);
  journal_->keep(options.notes);
  parts_ = journal_->finished_tiles();
}

SearchRecord::~SearchRecord() {
  try {
    if (journal_ && journal_->finished_tiles() == 0) journal_->remove();
  } catch (const std::exception&) {  // an empty journal may stay
    return;
  }
}

bool SearchRecord::has(SearchPart part) const {
  return journal_ && journal_->find(number_of(part)).has_value();
}

std::vector<double> SearchRecord::numbers(SearchPart part,
                                          const std::function<std::vector<double>()>& find) {
  if (!journal_) return find();
  if (std::optional<TileResult> kept = journal_->find(number_of(part))) return kept->outputs;
  TileResult result;
  result.outputs = find();
  result.device = device_;
  journal_->store(number_of(part), result);
  return result.outputs;
}

std::vector<BorderCurve> SearchRecord::curves(
    SearchPart part, const std::function<std::vector<BorderCurve>()>& find) {
  if (!journal_) return find();
  return curves_of(numbers(part, [&] { return numbers_of(find()); }));
}

}  // namespace gearsweep
