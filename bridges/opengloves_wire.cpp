#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/bridges/opengloves_wire.h>
#include <glissade/bridges/release_guard.h>
#include <glissade/bridges/serial_stream.h>
#include <glissade/realtime/clock.h>

#include "hand/finger_curls.h"
#include "opengloves/curl_limits.h"
#include "opengloves/line_codec.h"

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Boards need up to two seconds to start when a program opens their port.
constexpr milliseconds kSilence{3000};
/// The firmware may wait for a line for up to a second before it sends the next state, and a line may be lost.
constexpr milliseconds kReminder{50};

static_assert(kFreeLimit == 0, "numbers of limits are free by default");

OpenGlovesOptions checked(OpenGlovesOptions options) {
  for (const SensorRange& sensor : options.sensors) {
    if (std::isfinite(sensor.open) && std::isfinite(sensor.closed) && sensor.open != sensor.closed) continue;
    throw std::invalid_argument(
        "OpenGloves: a sensor must give other numbers for a closed finger than for an open one");
  }
  return options;
}

constexpr int kReleaseLines = 3;

/// The first line break ends a line that was cut. Twice, because a line may be lost.
std::string release_lines(OpenGlovesEncoding encoding) {
  const std::string line = limit_line(encoding, FingerNumbers{});
  return "\n" + line + line;
}

}  // namespace

struct OpenGlovesWire::Glove {
  explicit Glove(OpenGlovesOptions wanted)
      : options(checked(std::move(wanted))),
        stream(options.port, kOpenGlovesBaudRate, kOpenGlovesTcpPort),
        period(nanoseconds(std::llround(1e9 / descriptor.update_rate))) {}

  void take(const GloveLine& line, devices::GloveState& state);
  FingerNumbers limits_of(const devices::SafeCommand& command) const;
  void protect();
  [[noreturn]] void say_silence() const;

  OpenGlovesOptions options;
  devices::DeviceDescriptor descriptor = opengloves_descriptor();
  SerialStream stream;
  ReleaseGuard guard;
  nanoseconds period;
  realtime::SteadyClock clock;
  GloveDecoder decoder;
  OpenGlovesTraffic traffic;
  nanoseconds last_state{0};
  nanoseconds last_sent{0};
  bool is_answer_due = false;
  int extra_lines = 0;  ///< sent beside the answers; the firmware reads one line for each state
  std::optional<OpenGlovesEncoding> last_encoding;  ///< also after the wire was closed
  bool has_grabbed = false;                         ///< the glove tells when the hand closes
};

OpenGlovesWire::OpenGlovesWire(OpenGlovesOptions options) : glove_(std::make_unique<Glove>(std::move(options))) {}

OpenGlovesWire::~OpenGlovesWire() {
  release();
}

const devices::DeviceDescriptor& OpenGlovesWire::descriptor() const noexcept {
  return glove_->descriptor;
}

const OpenGlovesTraffic& OpenGlovesWire::traffic() const noexcept {
  return glove_->traffic;
}

void OpenGlovesWire::open() {
  glove_->guard.disarm();  // it had the port until now, if a release had failed
  glove_->stream.open();
  glove_->decoder = {};
  const bool is_free = glove_->traffic.is_free;
  glove_->traffic = {};
  glove_->traffic.is_free = is_free;
  glove_->extra_lines = 0;
  if (glove_->last_encoding) {
    glove_->stream.write(release_lines(*glove_->last_encoding));
    glove_->extra_lines = kReleaseLines;
  }
  glove_->last_state = glove_->clock.now();
}

bool OpenGlovesWire::read(devices::GloveState& state) {
  const nanoseconds end = glove_->clock.now() + glove_->period;
  std::optional<GloveLine> newest;
  for (nanoseconds now = glove_->clock.now(); !newest && now < end; now = glove_->clock.now())
    newest = glove_->decoder.take(glove_->stream.read(end - now));
  glove_->traffic.refused = glove_->decoder.refused();
  if (newest) glove_->take(*newest, state);
  if (!newest && glove_->clock.now() - glove_->last_state > kSilence) glove_->say_silence();
  return newest.has_value();
}

void OpenGlovesWire::Glove::take(const GloveLine& line, devices::GloveState& state) {
  last_state = clock.now();
  if (traffic.encoding != line.encoding) {
    traffic.encoding = last_encoding = line.encoding;
    protect();
  }
  traffic.states = decoder.states();
  for (std::size_t f = 0; f < kFingers; ++f)
    traffic.curls[f] = curl_of(line.flexion[f], options.sensors[f]);
  is_answer_due = true;
  state.time = last_state;
  state.joint_angles = angles_of(traffic.curls);
  // A glove without this gesture never tells, and its hand stays closed.
  has_grabbed = has_grabbed || line.grab;
  const bool is_closed = state.grip % 2 != 0;
  if (has_grabbed && is_closed != line.grab) ++state.grip;
}

FingerNumbers OpenGlovesWire::Glove::limits_of(const devices::SafeCommand& command) const {
  if (command.reasons().is_fading()) return {};
  return limit_numbers(curl_limits(command.values().joint_limits, traffic.curls, descriptor.max_joint_torque),
                       traffic.curls);
}

void OpenGlovesWire::Glove::protect() {
  guard.arm(stream.descriptor(), release_lines(*traffic.encoding));
}

void OpenGlovesWire::Glove::say_silence() const {
  const std::string port = stream.name();
  const std::string after = " for " + std::to_string(kSilence / milliseconds(1000)) + " s";
  if (decoder.states() > 0) throw WireError(port + ": the glove has said nothing" + after);
  if (decoder.bytes() == 0)
    throw WireError(port + ": the port is open, but nothing arrives" + after +
                    "; is the glove on, and is this its port?");
  throw WireError(port + ": bytes arrive, but no line of an OpenGloves glove; is this its port, with " +
                  std::to_string(kOpenGlovesBaudRate) + " baud and encoding 'alpha' or 'legacy' in the firmware?");
}

void OpenGlovesWire::write(const devices::SafeCommand& command) {
  const nanoseconds now = glove_->clock.now();
  const bool is_reminder_due = now - glove_->last_sent > kReminder;
  if (!glove_->traffic.encoding) {
    // What the glove does not understand might move its servos. It ignores an empty line.
    if (is_reminder_due) glove_->stream.write("\n");
    if (is_reminder_due) glove_->last_sent = now;
    return;
  }
  glove_->guard.renew();
  const FingerNumbers limits = glove_->limits_of(command);
  bool is_freer = false;
  for (std::size_t f = 0; f < kFingers; ++f)
    is_freer = is_freer || limits[f] < glove_->traffic.limits[f];
  const bool is_answer = std::exchange(glove_->is_answer_due, false);
  if (is_freer && !is_answer) ++glove_->extra_lines;
  if (is_answer && !is_freer && glove_->extra_lines > 0) {
    --glove_->extra_lines;  // the firmware still has an earlier line to read
    return;
  }
  if (!is_answer && !is_freer && !is_reminder_due) return;
  glove_->traffic.is_free = limits == FingerNumbers{};
  glove_->stream.write(limit_line(*glove_->traffic.encoding, limits));
  glove_->traffic.limits = limits;
  glove_->last_sent = now;
}

void OpenGlovesWire::release() noexcept {
  try {
    if (glove_->stream.is_open() && glove_->last_encoding) {
      glove_->stream.write(release_lines(*glove_->last_encoding));
      glove_->traffic.is_free = true;
    }
  } catch (const std::exception&) {  // then the second process tries
  }
  if (glove_->traffic.is_free) glove_->guard.disarm();
  glove_->stream.close();
  glove_->traffic.encoding.reset();
  glove_->traffic.limits = {};
}

}  // namespace glissade::bridges
