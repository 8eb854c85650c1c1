#pragma once

#include <chrono>
#include <thread>

namespace glissade::bridges {

/// Waits until `condition` holds, for at most `patience`; returns whether it did.
template <typename Condition>
bool eventually(Condition condition, std::chrono::milliseconds patience = std::chrono::seconds(20)) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace glissade::bridges
