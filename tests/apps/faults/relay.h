#pragma once

/// A network with faults between a server and a glove: each has a multicast group of its own, and the relay carries
/// messages from one group to the other, as a rule says.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <queue>
#include <random>
#include <thread>
#include <vector>

#include <glissade/devices/lcm_bus.h>
#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>

namespace glissade::test_support {

inline constexpr const char* kServerUrl = "udpm://239.255.76.67:7667?ttl=0";
inline constexpr const char* kGloveUrl = "udpm://239.255.76.68:7668?ttl=0";

/// The current time of the clock by which messages and records of a glove are stamped.
std::chrono::nanoseconds monotonic_now();

class Relay {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// Sends a message on after a delay; a rule calls it as often as it likes.
  using Send = std::function<void(Bytes message, std::chrono::nanoseconds delay)>;

  /// What becomes of a message. `random` is for rules that need chance.
  using Rule = std::function<void(const Bytes& message, std::mt19937& random, const Send& send)>;

  /// Both directions have the rule `pass` at first.
  Relay();
  ~Relay();
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  /// Sets the rule for the states of the glove.
  void set_states(Rule rule);
  /// Sets the rule for the commands of the server.
  void set_commands(Rule rule);

  static void pass(const Bytes& message, std::mt19937& random, const Send& send);

  /// The force (N) of the last command that came; zero if the last state says that the glove reduced a command.
  double force() const;

  /// A rule that changes a field of each message of the type.
  template <typename Message>
  static Rule changed(std::function<void(Message&)> change) {
    return [change = std::move(change)](const Bytes& bytes, std::mt19937&, const Send& send) {
      Message message{};
      if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return;
      change(message);
      Bytes result(static_cast<std::size_t>(message.getEncodedSize()));
      message.encode(result.data(), 0, static_cast<int>(result.size()));
      send(std::move(result), std::chrono::nanoseconds(0));
    };
  }

 private:
  struct Delayed {
    std::chrono::nanoseconds due;
    bool is_state;
    Bytes message;
    bool operator>(const Delayed& other) const { return due > other.due; }
  };

  void take(bool is_state, std::span<const std::uint8_t> message);
  void send_what_is_due();

  devices::LcmBus server_;
  devices::LcmBus glove_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::mt19937 random_{7};
  Rule states_ = pass;
  Rule commands_ = pass;
  glissade::glove_state_t last_state_{};
  glissade::glove_command_t last_command_{};
  std::priority_queue<Delayed, std::vector<Delayed>, std::greater<>> delayed_;
  bool should_end_ = false;
  std::thread thread_;
  std::vector<std::unique_ptr<devices::LcmBus::Subscription>> subscriptions_;
};

}  // namespace glissade::test_support
