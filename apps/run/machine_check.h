#pragma once

/// What a machine offers to a haptic loop: rights, scheduling, timers, power saving, network. Each finding says what it
/// means for haptics, and the command that mends it.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::apps {

enum class Verdict {
  kGood,
  kCanBeBetter,  ///< the loop works, with more jitter
  kBad,          ///< something will not work
  kUnknown,      ///< the machine does not tell
};

std::string_view name_of(Verdict verdict);

struct Finding {
  std::string name;  ///< such as "timer slack"
  Verdict verdict;
  std::string value;    ///< as found
  std::string meaning;  ///< for haptics
  std::string mend;     ///< a command, empty where there is nothing to mend
};

/// Looks at the machine; `root` is the folder that has /proc and /sys, another one for tests. The rights are those of
/// this process. Changes nothing.
std::vector<Finding> check_machine(const std::filesystem::path& root = "/");

/// The command that lets glove and server in two processes find each other on this machine.
inline constexpr const char* kMulticastMend =
    "sudo ip link set lo multicast on && sudo ip route add 239.0.0.0/8 dev lo";

/// What the system did not grant to a haptic loop, what this means, and the command that mends it, in one sentence;
/// empty if it granted everything.
std::string missing_rights(bool has_fifo, bool has_locked_memory);

}  // namespace glissade::apps
