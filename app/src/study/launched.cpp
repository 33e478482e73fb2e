#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "wavebalance/app/study/messenger.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* library_name = "libwavebalance_mpi.so";

}  // namespace

int launched_processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* text = std::getenv(name)) return std::max(1, std::atoi(text));
  return 1;
}

std::unique_ptr<Messenger> launched_messenger() {
  const int processes = launched_processes();
  if (processes < 2) return nullptr;
  // Kept until the program ends: MPI does not start twice. Its plug-ins use its symbols.
  void* library = ::dlopen(library_name, RTLD_NOW | RTLD_GLOBAL);
  void* symbol = library == nullptr ? nullptr : ::dlsym(library, messenger_symbol);
  if (symbol == nullptr) {
    const char* found = ::dlerror();
    throw std::runtime_error("mpirun started " + std::to_string(processes) +
                             " processes, but the component mpi cannot be loaded (" +
                             (found == nullptr ? "" : found) +
                             "); it is built where Open MPI is installed (Debian: libopenmpi-dev)");
  }
  const char* reason = "";
  Messenger* messenger = reinterpret_cast<MessengerFactory>(symbol)(&reason);
  if (messenger == nullptr) throw std::runtime_error(std::string("MPI does not start: ") + reason);
  return std::unique_ptr<Messenger>(messenger);
}

}  // namespace wavebalance::app
