// The cluster by MPI. A call that fails ends the whole job with MPI's own message, so no call's
// result is looked at.
#define OMPI_SKIP_MPICXX
#define MPICH_SKIP_MPICXX
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <list>

#include "scheduler/cluster.hpp"

namespace gearsweep {
namespace {

class MpiCluster final : public Cluster {
 public:
  MpiCluster() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_rank(machine, &local_rank_);
    MPI_Comm_size(machine, &local_size_);
    MPI_Comm_free(&machine);
  }

  ~MpiCluster() override {
    // A message that nobody receives would keep its sender here.
    while (!sent_.empty()) receive();
    MPI_Request all_have_sent = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &all_have_sent);
    for (int is_done = 0; is_done == 0; MPI_Test(&all_have_sent, &is_done, MPI_STATUS_IGNORE)) {
      receive();
    }
    MPI_Finalize();
  }
  MpiCluster(const MpiCluster&) = delete;
  MpiCluster& operator=(const MpiCluster&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int local_rank() const override { return local_rank_; }
  int local_size() const override { return local_size_; }

  bool all_say(const std::string& text) override {
    auto length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::string of_rank_0 = text;
    of_rank_0.resize(static_cast<std::size_t>(length));
    MPI_Bcast(of_rank_0.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
    const int is_same = of_rank_0 == text ? 1 : 0;
    int all_are = 0;
    MPI_Allreduce(&is_same, &all_are, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return all_are != 0;
  }

  [[noreturn]] void abort() override {
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    std::abort();
  }

  void send(int to, int kind, std::vector<std::byte> bytes) override {
    forget_what_has_left();
    Sent& sent = sent_.emplace_back();
    sent.bytes = std::move(bytes);
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, kind,
              MPI_COMM_WORLD, &sent.request);
  }

  std::optional<ClusterMessage> receive() override {
    forget_what_has_left();
    int has_arrived = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_arrived, &status);
    if (has_arrived == 0) return std::nullopt;
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    ClusterMessage message = {status.MPI_SOURCE, status.MPI_TAG, {}};
    message.bytes.resize(static_cast<std::size_t>(count));
    MPI_Recv(message.bytes.data(), count, MPI_BYTE, message.from, message.kind, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    bytes_received_ += message.bytes.size();
    return message;
  }

  std::size_t bytes_received() const override { return bytes_received_; }

 private:
  struct Sent {
    std::vector<std::byte> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void forget_what_has_left() {
    sent_.remove_if([](Sent& sent) {
      int is_done = 0;
      MPI_Test(&sent.request, &is_done, MPI_STATUS_IGNORE);
      return is_done != 0;
    });
  }

  int rank_ = 0, size_ = 1, local_rank_ = 0, local_size_ = 1;
  std::list<Sent> sent_;
  std::size_t bytes_received_ = 0;
};

}  // namespace

std::unique_ptr<Cluster> Cluster::join() {
  // What the launchers of Open MPI, of MPICH and its kin, and Slurm with PMIx set.
  for (const char* variable :
       {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMI_RANK", "PMIX_RANK", "MPI_LOCALNRANKS"}) {
    if (std::getenv(variable) != nullptr) return std::make_unique<MpiCluster>();
  }
  return nullptr;
}

}  // namespace gearsweep
