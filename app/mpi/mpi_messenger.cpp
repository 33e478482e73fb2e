// The messages of a study by MPI. The command loads this library where mpirun has started it, so that it runs
// without MPI everywhere else.
#include <mpi.h>

#include <list>
#include <set>
#include <string>

#include "wavebalance/app/study/messenger.hpp"

namespace {

using namespace wavebalance::app;

class MpiMessenger : public Messenger {
 public:
  MpiMessenger() {
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  /// Waits for messages under way and for the other processes. Where one was given up, which would be waited
  /// for without end, MPI is left as it is.
  ~MpiMessenger() override {
    if (!given_up_.empty()) return;
    for (Sending& one : sendings_) MPI_Wait(&one.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }
  MpiMessenger(const MpiMessenger&) = delete;
  MpiMessenger& operator=(const MpiMessenger&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, std::string_view text) override {
    forget_sent();
    if (given_up_.contains(to)) return;
    Sending& one = sendings_.emplace_back(Sending{std::string(text), to, MPI_REQUEST_NULL});
    MPI_Isend(one.text.data(), static_cast<int>(one.text.size()), MPI_CHAR, to, 0, MPI_COMM_WORLD,
              &one.request);
  }

  std::optional<Message> receive() override {
    forget_sent();
    int arrived = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &arrived, &status) != MPI_SUCCESS || arrived == 0)
      return std::nullopt;
    int length = 0;
    MPI_Get_count(&status, MPI_CHAR, &length);
    Message message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(length), '\0')};
    if (MPI_Recv(message.text.data(), length, MPI_CHAR, message.from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE) !=
        MPI_SUCCESS)
      return std::nullopt;
    return message;
  }

  void give_up(int rank) override { given_up_.insert(rank); }

 private:
  struct Sending {
    std::string text;  // until it is sent
    int to;
    MPI_Request request;
  };

  void forget_sent() {
    std::erase_if(sendings_, [&](Sending& one) {
      if (given_up_.contains(one.to)) return false;  // MPI may still read its text
      int sent = 0;
      return MPI_Test(&one.request, &sent, MPI_STATUS_IGNORE) == MPI_SUCCESS && sent != 0;
    });
  }

  int rank_ = 0, size_ = 1;
  std::list<Sending> sendings_;
  std::set<int> given_up_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) Messenger* wavebalance_mpi_messenger(const char** reason) {
  int given = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS) {
    *reason = "MPI_Init_thread failed";
    return nullptr;
  }
  if (given < MPI_THREAD_FUNNELED) {
    *reason = "this MPI cannot be used beside threads";
    return nullptr;
  }
  return new MpiMessenger;
}
