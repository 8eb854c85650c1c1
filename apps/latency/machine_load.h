#pragma once

/// Work that keeps a machine busy while something else is measured.

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace glissade::apps {

/// As many threads of ordinary priority as there are processors, which compute with numbers that do not fit into the
/// caches of a core, from construction to destruction.
class MachineLoad {
 public:
  MachineLoad();
  ~MachineLoad();
  MachineLoad(const MachineLoad&) = delete;
  MachineLoad& operator=(const MachineLoad&) = delete;

 private:
  std::atomic<bool> should_end_{false};
  std::vector<std::thread> threads_;
};

/// What the load of this machine is, in words.
std::string machine_load_text();

}  // namespace glissade::apps
