#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

#include <glissade/bridges/opengloves_emulator.h>
#include <glissade/realtime/clock.h>

#include "opengloves/emulated_port.h"
#include "opengloves/line_codec.h"

namespace glissade::bridges {
namespace {

using std::chrono::nanoseconds;

double seconds(nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

class FirstOrderFinger final : public FingerModel {
 public:
  double advance(double wanted, double most, double dt_s) override {
    constexpr double kTimeConstant_s = 0.06;
    curl_ += (wanted - curl_) * (1.0 - std::exp(-dt_s / kTimeConstant_s));
    return curl_ = std::clamp(curl_, 0.0, std::clamp(most, 0.0, 1.0));
  }

 private:
  double curl_ = 0.0;
};

/// A hobby servo. It takes a new aim with each pulse, and turns at a limited speed.
class Servo {
 public:
  /// The largest curl that its string permits after `dt_s`.
  double advance(double aim, double dt_s) {
    constexpr double kPulse_s = 0.02;
    constexpr double kSpeed_per_s = 3.3;  // 60 degrees in 0.1 s
    since_pulse_s_ += dt_s;
    if (since_pulse_s_ >= kPulse_s) {
      since_pulse_s_ = 0.0;
      aim_ = aim;
    }
    return most_ = std::clamp(aim_, most_ - kSpeed_per_s * dt_s, most_ + kSpeed_per_s * dt_s);
  }

 private:
  double since_pulse_s_ = 0.0;
  double aim_ = 1.0;
  double most_ = 1.0;
};

EmulatorOptions checked(EmulatorOptions options) {
  constexpr double kFastest_Hz = 1000.0;
  if (!(options.rate_Hz >= 1.0 && options.rate_Hz <= kFastest_Hz))
    throw std::invalid_argument("emulated glove: the rate must lie between 1 and 1000 Hz");
  if (options.full_scale < 1 || options.full_scale > kLargestNumber)
    throw std::invalid_argument("emulated glove: the largest number must lie between 1 and 65535");
  if (!options.wearer) options.wearer = busy_wearer;
  return options;
}

}  // namespace

std::unique_ptr<FingerModel> first_order_finger() {
  return std::make_unique<FirstOrderFinger>();
}

FingerValues busy_wearer(nanoseconds time) {
  constexpr double kPeriod_s = 4.0;
  constexpr double kLag_s = 0.1;
  constexpr double kMost = 0.9;
  FingerValues curls{};
  for (std::size_t f = 0; f < kFingers; ++f) {
    const double phase = std::max(0.0, seconds(time) - kLag_s * static_cast<double>(f)) / kPeriod_s;
    curls[f] = kMost * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * phase));
  }
  return curls;
}

/// All but `state`, `port` and the plug belongs to the thread.
class OpenGlovesEmulator::Board {
 public:
  explicit Board(EmulatorOptions options)
      : options_(checked(std::move(options))),
        port_(options_.is_tcp ? EmulatedPort::tcp(options_.tcp_port) : EmulatedPort::terminal(options_.link)),
        random_(options_.seed),
        start_(clock_.now()) {
    for (auto& finger : fingers_)
      finger = options_.finger();
    port_.plug();
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested())
        turn();
    });
  }

  std::string port() const {
    const std::scoped_lock lock(mutex_);
    return port_.name();
  }
  EmulatedGlove state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
  }
  void set_plugged(bool is_plugged) {
    const std::scoped_lock lock(mutex_);
    is_plugged ? port_.plug() : port_.unplug();
  }

 private:
  void turn();
  void move_fingers(nanoseconds now);
  void hear(std::string_view bytes, nanoseconds now);
  void say_state(nanoseconds now);
  bool happens(double share) { return std::uniform_real_distribution<>()(random_) < share; }

  EmulatorOptions options_;
  mutable std::mutex mutex_;  // of everything below; the thread holds it only for a moment
  EmulatedPort port_;
  EmulatedGlove state_;
  std::mt19937_64 random_;
  realtime::SteadyClock clock_;
  nanoseconds start_;
  nanoseconds last_move_{start_};
  nanoseconds last_state_{start_};
  bool has_heard_ = true;
  LineCutter lines_;
  std::deque<std::pair<nanoseconds, FingerNumbers>> on_their_way_;  // limits, with the times of their arrival
  std::array<std::unique_ptr<FingerModel>, kFingers> fingers_;
  std::array<Servo, kFingers> servos_;
  std::jthread thread_;  // the last, so that it ends first
};

void OpenGlovesEmulator::Board::turn() {
  constexpr std::chrono::microseconds kPause{500};
  std::this_thread::sleep_for(kPause);
  const std::scoped_lock lock(mutex_);
  const std::string heard = port_.read();
  const nanoseconds now = clock_.now();
  hear(heard, now);
  move_fingers(now);
  say_state(now);
}

void OpenGlovesEmulator::Board::hear(std::string_view bytes, nanoseconds now) {
  if (options_.faults.echo) port_.write(bytes);
  lines_.take(bytes, [&](std::string_view line) {
    const std::optional<FingerNumbers> limits = decode_limits(options_.encoding, line);
    has_heard_ = true;
    if (limits) {
      ++state_.limit_lines;
      if (*limits != FingerNumbers{}) ++state_.stopping_lines;
      on_their_way_.emplace_back(now + options_.faults.delay, *limits);
    } else if (!line.empty()) {
      ++state_.other_lines;
    }
  });
  for (; !on_their_way_.empty() && on_their_way_.front().first <= now; on_their_way_.pop_front())
    state_.limits = on_their_way_.front().second;
}

void OpenGlovesEmulator::Board::move_fingers(nanoseconds now) {
  const double dt_s = seconds(now - std::exchange(last_move_, now));
  const FingerValues wanted = options_.wearer(now - start_);
  for (std::size_t f = 0; f < kFingers; ++f) {
    const double aim = 1.0 - static_cast<double>(state_.limits[f]) / kLargestLimit;
    state_.curls[f] = fingers_[f]->advance(wanted[f], servos_[f].advance(aim, dt_s), dt_s);
  }
}

void OpenGlovesEmulator::Board::say_state(nanoseconds now) {
  const nanoseconds since = now - last_state_;
  const bool may_speak = has_heard_ || since > options_.line_patience;
  if (!may_speak || seconds(since) < 1.0 / options_.rate_Hz) return;
  last_state_ = now;
  has_heard_ = false;
  FingerNumbers numbers{};
  for (std::size_t f = 0; f < kFingers; ++f)
    numbers[f] = static_cast<int>(std::lround(state_.curls[f] * options_.full_scale));
  std::string line = state_line(options_.encoding, numbers, options_.full_scale);
  if (happens(options_.faults.half_lines)) {
    const std::size_t first = random_() % line.size();
    line.erase(first, 1 + random_() % line.size());
  }
  if (happens(options_.faults.garbage)) {
    std::string garbage(1 + random_() % 40, '\0');
    std::generate(garbage.begin(), garbage.end(), [this] { return static_cast<char>(random_()); });
    line.insert(0, garbage);
  }
  port_.write(line);
}

OpenGlovesEmulator::OpenGlovesEmulator(EmulatorOptions options) : board_(std::make_unique<Board>(std::move(options))) {}

OpenGlovesEmulator::~OpenGlovesEmulator() = default;

std::string OpenGlovesEmulator::port() const {
  return board_->port();
}

EmulatedGlove OpenGlovesEmulator::state() const {
  return board_->state();
}

void OpenGlovesEmulator::unplug() {
  board_->set_plugged(false);
}

void OpenGlovesEmulator::plug() {
  board_->set_plugged(true);
}

}  // namespace glissade::bridges
