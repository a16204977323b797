#include "borders/joined_orbit_map.hpp"

#include <utility>

namespace gearsweep {

JoinedOrbitMap::Member::Member(JoinedOrbitMap* map) : map_(map) {
  const std::lock_guard lock(map_->mutex_);
  ++map_->members_;
}

JoinedOrbitMap::Member::~Member() {
  const std::lock_guard lock(map_->mutex_);
  --map_->members_;
  map_->has_changed_.notify_all();  // the others may all wait now
}

std::vector<std::optional<OrbitAnswer>> JoinedOrbitMap::answer(
    const std::vector<OrbitQuery>& queries) {
  std::unique_lock lock(mutex_);
  const std::shared_ptr<Batch> batch = next_;
  const auto first = static_cast<std::ptrdiff_t>(batch->queries.size());
  batch->queries.insert(batch->queries.end(), queries.begin(), queries.end());
  ++waiting_;
  while (!batch->is_done) {
    if (batch == next_ && waiting_ >= members_) {
      run(&lock);
    } else {
      has_changed_.wait(lock);
    }
  }
  if (batch->failure) std::rethrow_exception(batch->failure);
  const auto begin = batch->answers.begin() + first;
  return {begin, begin + static_cast<std::ptrdiff_t>(queries.size())};
}

void JoinedOrbitMap::run(std::unique_lock<std::mutex>* lock) {
  const std::shared_ptr<Batch> batch = std::exchange(next_, std::make_shared<Batch>());
  waiting_ = 0;
  lock->unlock();
  try {
    batch->answers = inner_->answer(batch->queries);
  } catch (...) {
    batch->failure = std::current_exception();
  }
  lock->lock();
  batch->is_done = true;
  has_changed_.notify_all();
}

}  // namespace gearsweep
