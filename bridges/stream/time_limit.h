#pragma once

/// A time limit for what the system offers without one.

#include <chrono>
#include <future>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

namespace glissade::bridges {

/// The result of `task`; no value if the task takes longer than `patience`. The task runs in a thread of its own, which
/// then goes on, so it must own all that it uses.
template <typename Task>
std::optional<std::invoke_result_t<Task>> within(std::chrono::nanoseconds patience, Task task) {
  std::packaged_task<std::invoke_result_t<Task>()> packaged(std::move(task));
  std::future<std::invoke_result_t<Task>> result = packaged.get_future();
  std::thread(std::move(packaged)).detach();
  if (result.wait_for(patience) != std::future_status::ready) return std::nullopt;
  return result.get();
}

}  // namespace glissade::bridges
