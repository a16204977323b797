// A tape that is asked for many points of a study.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

#include "expression/tape.hpp"

namespace gearsweep {

// What most inputs decide is the same at all points and worked out once: a point's own inputs leave
// little to do. Threads share it.
class TapeOfStudy {
 public:
  TapeOfStudy() = default;
  // inputs: those that Tape::given would take of `tape` are its first ones, `common`, which are the
  // same at most points, then `own`.
  TapeOfStudy(Tape tape, std::vector<std::size_t> common, std::vector<std::size_t> own)
      : tape_(std::move(tape)), common_(std::move(common)), own_(std::move(own)) {}

  // The tape of the other inputs. numbers: what `common` and `own` are places in.
  Tape given(const std::vector<double>& numbers) const {
    return of_common(numbers_at(common_, numbers))->given(numbers_at(own_, numbers));
  }

 private:
  struct Last {
    std::mutex mutex;
    std::vector<double> numbers;
    std::shared_ptr<const Tape> tape;
  };

  static std::vector<double> numbers_at(const std::vector<std::size_t>& places,
                                        const std::vector<double>& numbers) {
    std::vector<double> at;
    at.reserve(places.size());
    for (const std::size_t place : places) at.push_back(numbers[place]);
    return at;
  }

  std::shared_ptr<const Tape> of_common(std::vector<double> numbers) const {
    const std::lock_guard lock(last_->mutex);
    if (!last_->tape || last_->numbers != numbers) {
      last_->tape = std::make_shared<const Tape>(tape_.given(numbers));
      last_->numbers = std::move(numbers);
    }
    return last_->tape;
  }

  Tape tape_;
  std::vector<std::size_t> common_, own_;
  std::shared_ptr<Last> last_ = std::make_shared<Last>();
};

}  // namespace gearsweep
