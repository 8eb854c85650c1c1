#pragma once

/// The objects of the C interface by their handles. A handle is a number that is never used again, so a handle that is
/// null, freed or of another kind is found out.

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace glissade::c {

inline std::uint64_t next_id() noexcept {
  static std::atomic<std::uint64_t> newest{0};
  return ++newest;
}

/// Thread-safe. Calls that only look objects up do not wait for each other.
template <typename Object>
class Handles {
 public:
  /// `noun` is the kind of object, for messages.
  explicit Handles(const char* noun) : noun_(noun) {}

  std::uint64_t add(std::shared_ptr<Object> object) {
    const std::uint64_t id = next_id();
    const std::unique_lock lock(mutex_);
    objects_.emplace(id, std::move(object));
    return id;
  }

  /// Keeps the object alive for the duration of a call, even if another thread frees it.
  std::shared_ptr<Object> find(std::uint64_t id) const {
    const std::shared_lock lock(mutex_);
    const auto found = objects_.find(id);
    if (found == objects_.end()) throw std::invalid_argument(unknown(id));
    return found->second;
  }

  std::shared_ptr<Object> remove(std::uint64_t id) {
    const std::unique_lock lock(mutex_);
    const auto found = objects_.find(id);
    if (found == objects_.end()) throw std::invalid_argument(unknown(id));
    std::shared_ptr<Object> object = std::move(found->second);
    objects_.erase(found);
    return object;
  }

 private:
  std::string unknown(std::uint64_t id) const {
    if (id == 0) return std::string("the handle of the ") + noun_ + " is null";
    return std::string("there is no ") + noun_ + " with the handle " + std::to_string(id) +
           ": it was freed, or the handle is of another kind";
  }

  const char* noun_;
  mutable std::shared_mutex mutex_;
  std::map<std::uint64_t, std::shared_ptr<Object>> objects_;
};

}  // namespace glissade::c
