#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace wavebalance::app {

/// A text from another process.
struct Message {
  int from = 0;
  std::string text;
};

/// Messages between the processes that solve one study, numbered from 0. Used by one thread of each process.
class Messenger {
 public:
  virtual ~Messenger() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Returns before the message has arrived. Messages between two processes keep their order.
  virtual void send(int to, std::string_view text) = 0;
  /// The next message that has arrived; does not wait for one.
  virtual std::optional<Message> receive() = 0;
  /// A process that does not answer any more: messages to it are dropped, and nothing waits for it at the
  /// end.
  virtual void give_up(int rank) = 0;
};

/// Factory that the component `mpi` exports as `messenger_symbol`. Null if MPI could not be started; `reason`
/// then explains it.
using MessengerFactory = Messenger* (*)(const char** reason);
inline constexpr const char* messenger_symbol = "wavebalance_mpi_messenger";

/// The number of processes that mpirun (Open MPI or one that sets PMI_SIZE) has started; 1 without it.
int launched_processes();

/// The messages of the processes that mpirun has started, by the component `mpi`, which is loaded now. Null
/// if there is one process. Throws std::runtime_error if the component is not installed or MPI does not
/// start.
std::unique_ptr<Messenger> launched_messenger();

}  // namespace wavebalance::app
