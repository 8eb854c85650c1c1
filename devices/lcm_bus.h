#pragma once

/// A connection to LCM (Lightweight Communications and Marshalling), for any number of senders and receivers. The URL
/// of the connection selects the transport.
///
/// `memq://` connects only senders and receivers that share one LcmBus, and therefore one process. `udpm://` connects
/// processes and hosts by UDP multicast. With `ttl=0`, as in `udpm://239.255.76.67:7667?ttl=0`, messages stay on this
/// machine, and the bus receives only messages of this machine. With a greater ttl, the bus receives only messages that
/// arrive on the interface to which this machine routes the multicast group. Other LCM programs (`lcm-logger`,
/// `lcm-spy`) can join. The bus accepts only messages that arrive in one packet, and drops fragments.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/base/export.h>

namespace glissade::devices {

/// A secret that all programs on an address share. With a key, each message carries a code of 32 bytes (keyed BLAKE2b
/// of channel and message), and messages without the right code are dropped. Nothing is encrypted. An attacker can
/// resend a recorded message, but sessions, sequences and ages limit the effect. LCM programs without the key see
/// messages that are 32 bytes longer than their type.
struct LcmKey {
  std::array<std::uint8_t, 32> bytes{};
};

/// Reads a key: one line of 64 hexadecimal digits, as printed by `openssl rand -hex 32`. Throws std::invalid_argument,
/// naming the file, in these cases: the file cannot be read; its format is wrong; or its permissions let a user other
/// than the owner read or write it.
GLISSADE_EXPORT LcmKey read_lcm_key(const std::string& path);

/// Sends and receives raw messages by channel. The first subscription starts one receive thread for all subscribers.
/// The receive thread inherits the scheduling policy of the thread that subscribes first. Channel names are 1 to 15
/// characters of A–Z, 0–9 and `_`.
///
/// Thread-safety: any number of threads may subscribe and publish at once. All functions may block and allocate, so do
/// not call them in a real-time thread.
class GLISSADE_EXPORT LcmBus {
 public:
  /// The function that receives messages. The receive thread calls it with one message at a time. The bytes are valid
  /// only during the call. Exceptions that the function throws are ignored. A handler must neither subscribe nor end a
  /// subscription.
  using Handler = std::function<void(std::span<const std::uint8_t> message)>;

  /// A subscription. The destructor ends the subscription. After the destructor has returned, the handler does not run.
  /// The bus must outlive the subscription.
  class Subscription;

  /// Throws std::invalid_argument, naming the URL, when the URL is not a correct memq or udpm address, or when this
  /// machine cannot send to this address.
  explicit LcmBus(const std::string& url, const std::optional<LcmKey>& key = {});
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;
  /// Stops receiving at once. Messages not yet passed to a handler are lost.
  ~LcmBus();

  const std::string& url() const noexcept;

  /// Calls `handler` for every message on `channel`, until the returned subscription is destroyed. Throws
  /// std::invalid_argument in these cases: the channel's name is not allowed; the handler is empty; or the bus cannot
  /// receive from its URL.
  [[nodiscard]] std::unique_ptr<Subscription> subscribe(const std::string& channel, Handler handler);

  /// Sends `message`. Returns false when the operating system does not accept the message. Over memq, a message on a
  /// channel without subscribers is lost. Throws std::invalid_argument when the channel's name is not allowed.
  bool publish(const std::string& channel, std::span<const std::uint8_t> message);

  /// Number of packets dropped so far. A packet is dropped if it came from another machine or interface, if it is a
  /// fragment or no LCM message, or if it has no valid code for the bus's key. Any thread.
  std::uint64_t refused_packets() const noexcept;

 private:
  class Connection;
  std::unique_ptr<Connection> connection_;
};

class GLISSADE_EXPORT LcmBus::Subscription {
 public:
  Subscription(Connection& connection, std::string channel, std::int64_t id);
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  ~Subscription();

 private:
  Connection& connection_;
  std::string channel_;
  std::int64_t id_;
};

/// The field that caused a message to be rejected.
struct RefusedField {
  std::string_view name{};       ///< as in the message's type, or in `DeviceDescriptor`; empty: no field
  int index = -1;                ///< index in the array; −1: the field is no array
  double value = 0.0;            ///< value of the field in the message
  std::optional<double> wanted;  ///< the only value that is allowed, if there is only one
  bool is_norm = false;          ///< whether `value` is the norm of the array
};

/// Numbers of messages that one receiver has accepted, rejected (by reason) and missed so far.
struct LinkStatistics {
  std::uint64_t accepted = 0;
  std::uint64_t wrong_size = 0;       ///< messages whose size is not that of the expected type
  std::uint64_t undecodable = 0;      ///< messages of the right size, but of another type
  std::uint64_t wrong_version = 0;    ///< messages with another version of the message format
  std::uint64_t not_finite = 0;       ///< messages with a number that is NaN or infinite
  std::uint64_t out_of_range = 0;     ///< messages with an implausibly large number or a non-unit quaternion
  std::uint64_t other_receiver = 0;   ///< messages for another device
  std::uint64_t other_sender = 0;     ///< messages of a sender that does not hold the lease
  std::uint64_t out_of_sequence = 0;  ///< messages whose sequence number does not rise, or rises too fast
  std::uint64_t lost = 0;             ///< numbers missing between accepted messages; refused messages count here too
  RefusedField first_wrong_size{};    ///< the field in the first message that was rejected for this reason
  RefusedField first_wrong_version{};
  RefusedField first_not_finite{};
  RefusedField first_out_of_range{};

  std::uint64_t rejected() const noexcept {
    return wrong_size + undecodable + wrong_version + not_finite + out_of_range + other_receiver + other_sender +
           out_of_sequence;
  }
};

/// The defects in the contents of rejected messages, each with the field of the first one, such as "a number is not
/// finite: position_WH_m[1] is nan".
GLISSADE_EXPORT std::vector<std::string> refusals_of(const LinkStatistics& link);

}  // namespace glissade::devices
