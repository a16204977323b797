// The processes that an MPI launcher (mpirun, srun) started together, and messages between them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gearsweep {

struct ClusterMessage {
  int from = 0;  // rank
  int kind = 0;
  std::vector<std::byte> bytes;
};

// Used from one thread. MPI ends all processes when one of them dies or MPI itself fails.
class Cluster {
 public:
  // Nothing when this process was started on its own, or the program was built without MPI.
  static std::unique_ptr<Cluster> join();
  // Waits until all have left; what has not been received is lost.
  virtual ~Cluster() = default;

  virtual int rank() const = 0;  // 0: the one that plans and writes
  virtual int size() const = 0;
  // This process among those of its machine.
  virtual int local_rank() const = 0;
  virtual int local_size() const = 0;
  // Whether all processes call it with the same text.
  virtual bool all_say(const std::string& text) = 0;
  // Ends all processes at once, with exit status 1.
  [[noreturn]] virtual void abort() = 0;
  // Does not wait for the receiver.
  virtual void send(int to, int kind, std::vector<std::byte> bytes) = 0;
  // A message that has arrived, if any.
  virtual std::optional<ClusterMessage> receive() = 0;
  virtual std::size_t bytes_received() const = 0;
};

}  // namespace gearsweep
