#pragma once

/// The ways from one thread to another that are compared. Each copies a value
/// in by `publish` and out by `take`, which returns whether there was a value
/// that had not been taken.

#include <mutex>

#include <boost/lockfree/spsc_queue.hpp>

#include <glissade/realtime/spsc_ring.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::bench {

/// Of the queues: more than the two threads of the bench ever have on the way.
inline constexpr std::size_t kQueueCapacity = 16;

template <typename Value>
class TripleBufferHandoff {
 public:
  static constexpr const char* kSubject = "glissade";
  void publish(const Value& value) { buffer_.publish(value); }
  bool take(Value& value) {
    if (!buffer_.update()) return false;
    value = buffer_.value();
    return true;
  }

 private:
  realtime::TripleBuffer<Value> buffer_;
};

template <typename Value>
class RingHandoff {
 public:
  static constexpr const char* kSubject = "glissade-ring";
  void publish(const Value& value) { ring_.push(value); }
  bool take(Value& value) { return ring_.pop(value); }

 private:
  realtime::SpscRing<Value> ring_{kQueueCapacity};
};

template <typename Value>
class MutexHandoff {
 public:
  static constexpr const char* kSubject = "mutex";
  void publish(const Value& value) {
    const std::lock_guard lock(mutex_);
    value_ = value;
    is_fresh_ = true;
  }
  bool take(Value& value) {
    const std::lock_guard lock(mutex_);
    if (!is_fresh_) return false;
    value = value_;
    is_fresh_ = false;
    return true;
  }

 private:
  std::mutex mutex_;
  Value value_{};
  bool is_fresh_ = false;
};

template <typename Value>
class BoostHandoff {
 public:
  static constexpr const char* kSubject = "boost-spsc";
  void publish(const Value& value) { queue_.push(value); }
  bool take(Value& value) { return queue_.pop(value); }

 private:
  boost::lockfree::spsc_queue<Value, boost::lockfree::capacity<kQueueCapacity>> queue_;
};

}  // namespace glissade::bench
