// Puts the queries of several threads together to one batch, since a device takes about as long for
// many as for one.
#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>

#include "borders/orbit_map.hpp"

namespace gearsweep {

class JoinedOrbitMap final : public OrbitMap {
 public:
  // inner: which answers the batches, one at a time. It must outlive the map.
  explicit JoinedOrbitMap(OrbitMap* inner) : inner_(inner) {}

  // A thread that asks again and again. A batch begins when all members wait for an answer.
  class Member {
   public:
    explicit Member(JoinedOrbitMap* map);
    ~Member();
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

   private:
    JoinedOrbitMap* const map_;
  };

  // Called by a member.
  std::vector<std::optional<OrbitAnswer>> answer(const std::vector<OrbitQuery>& queries) override;

 private:
  struct Batch {
    std::vector<OrbitQuery> queries;
    std::vector<std::optional<OrbitAnswer>> answers;
    std::exception_ptr failure;
    bool is_done = false;
  };

  void run(std::unique_lock<std::mutex>* lock);

  OrbitMap* const inner_;
  std::mutex mutex_;
  std::condition_variable has_changed_;
  std::shared_ptr<Batch> next_ = std::make_shared<Batch>();
  std::size_t members_ = 0, waiting_ = 0;
};

}  // namespace gearsweep
