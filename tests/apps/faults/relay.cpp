#include "relay.h"

#include <utility>

#include <Eigen/Core>

namespace glissade::test_support {

using std::chrono::nanoseconds;

nanoseconds monotonic_now() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

Relay::Relay() : server_(kServerUrl), glove_(kGloveUrl) {
  thread_ = std::thread([this] { send_what_is_due(); });
  subscriptions_.push_back(
      glove_.subscribe("GLOVE_INFO", [this](auto message) { server_.publish("GLOVE_INFO", message); }));
  subscriptions_.push_back(glove_.subscribe("GLOVE_STATE", [this](auto message) { take(true, message); }));
  subscriptions_.push_back(server_.subscribe("GLOVE_COMMAND", [this](auto message) { take(false, message); }));
}

Relay::~Relay() {
  subscriptions_.clear();
  {
    const std::lock_guard lock(mutex_);
    should_end_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Relay::set_states(Rule rule) {
  const std::lock_guard lock(mutex_);
  states_ = std::move(rule);
}

void Relay::set_commands(Rule rule) {
  const std::lock_guard lock(mutex_);
  commands_ = std::move(rule);
}

void Relay::pass(const Bytes& message, std::mt19937& /*random*/, const Send& send) {
  send(message, nanoseconds(0));
}

double Relay::force() const {
  const std::lock_guard lock(mutex_);
  return last_state_.reasons == 0 ? Eigen::Map<const Eigen::Vector3d>(last_command_.force_H_W_N).norm() : 0.0;
}

void Relay::take(bool is_state, std::span<const std::uint8_t> message) {
  const std::lock_guard lock(mutex_);
  const nanoseconds now = monotonic_now();
  const int size = static_cast<int>(message.size());
  if (is_state) {
    last_state_.decode(message.data(), 0, size);
  } else {
    last_command_.decode(message.data(), 0, size);
  }
  const Rule& rule = is_state ? states_ : commands_;
  rule(Bytes(message.begin(), message.end()), random_, [&](Bytes result, nanoseconds delay) {
    delayed_.push({now + delay, is_state, std::move(result)});
  });
  changed_.notify_all();
}

void Relay::send_what_is_due() {
  std::unique_lock lock(mutex_);
  while (!should_end_) {
    if (delayed_.empty()) {
      changed_.wait(lock);
      continue;
    }
    const nanoseconds wait = delayed_.top().due - monotonic_now();
    if (wait > nanoseconds(0)) {
      changed_.wait_for(lock, wait);
      continue;
    }
    const Delayed next = delayed_.top();
    delayed_.pop();
    lock.unlock();
    (next.is_state ? server_ : glove_).publish(next.is_state ? "GLOVE_STATE" : "GLOVE_COMMAND", next.message);
    lock.lock();
  }
}

}  // namespace glissade::test_support
