#pragma once

/// The wire to a glove with the firmware of LucidGloves, or one that speaks OpenGloves.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glissade/bridges/opengloves.h>
#include <glissade/bridges/wire.h>

namespace glissade::bridges {

struct OpenGlovesOptions {
  std::string port;  ///< "/dev/ttyUSB0", "tcp:HOST" or "tcp:HOST:PORT"
  std::array<SensorRange, kFingers> sensors{};
};

/// `LcmGloveHostOptions::patience_periods` for a bridge to such a glove. After the last command, the limits open within
/// 0.1 s, i.e. the patience, a period of the wire and the time of a line.
inline constexpr double kOpenGlovesPatience_periods = 3.0;

/// What passes over the wire, for people.
struct OpenGlovesTraffic {
  std::optional<OpenGlovesEncoding> encoding;  ///< none before the first state
  FingerValues curls{};
  std::array<int, kFingers> limits{};  ///< 0: free, 1000: the finger is to stay open
  std::uint64_t states = 0;            ///< since the wire was opened
  std::uint64_t refused = 0;           ///< lines that were no states
  bool is_free = true;                 ///< the last line that the port has taken leaves all fingers free
};

/// Finds the encoding by itself. Sends all five limits, once for each state, because the firmware reads no more. The
/// firmware keeps the last limits for ever. Therefore the constructor starts a second process (`ReleaseGuard`), which
/// releases the glove when this process is killed or hangs. While a command fades, all limits are open: a servo is slow
/// enough by itself, and a string that slackens pushes nobody.
class OpenGlovesWire final : public Wire {
 public:
  /// Throws what `SerialStream` and `ReleaseGuard` throw, and std::invalid_argument for a sensor whose range is empty
  /// or not finite.
  explicit OpenGlovesWire(OpenGlovesOptions options);
  /// Releases the glove.
  ~OpenGlovesWire() override;

  const devices::DeviceDescriptor& descriptor() const noexcept override;
  void open() override;
  bool read(devices::GloveState& state) override;
  void write(const devices::SafeCommand& command) override;
  void release() noexcept override;

  const OpenGlovesTraffic& traffic() const noexcept;

 private:
  struct Glove;

  std::unique_ptr<Glove> glove_;
};

}  // namespace glissade::bridges
