#pragma once

/// Random hands on random parts, and an account of what they get that shares nothing with the observers.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>

#include "poses.h"

namespace glissade::haptics {

/// One to four hands wander with one to four parts over a floor, which may rise and sink, and press the parts together.
/// Gloves of 100 Hz to 1 kHz are in the server's process or behind links; descriptors may be untrue, and states,
/// commands and answers stay away for a while. In the last part of a world all is well, and the hands press into the
/// floor and rest.
class LedgerWorld {
 public:
  static constexpr int kPressing = 8000;  // ms: from then on they press
  static constexpr int kTicks = 12'000;

  explicit LedgerWorld(std::uint64_t seed) : random_(seed) {
    const std::size_t hands = 1 + random_() % 4;
    const std::size_t parts = 1 + random_() % 4;
    is_linked_ = random_() % 2 == 0;
    has_mover_ = random_() % 2 == 0;
    parts_.assign(parts, {Eigen::Vector3d::Zero(), 0.05, {std::pow(10.0, 2.0 + 1.6 * uniform()), 1.0}});
    for (std::size_t h = 0; h < hands; ++h) {
      hands_.push_back(std::make_unique<Hand>(*this));
      hold(h, random_() % parts);
    }
    start_server();
  }

  /// What a hand gets in a millisecond.
  struct Felt {
    bool is_new = false;  ///< a command of the device has just begun
    double force = 0.0;
    double change = 0.0;  ///< of the force
    double share = 1.0;   ///< of what contacts and other hands demand within the limits of the device
    bool turns = false;   ///< the force steps up and down
    int rests_since = 0;  ///< ms: when the hand was last faster than 30 mm/s
  };

  void step() {
    ++ms_;
    if (ms_ <= kPressing) disturb();
    for (const std::unique_ptr<Hand>& hand : hands_)
      move(*hand);
    serve();
  }

  int ms() const { return ms_; }
  std::size_t hands() const { return hands_.size(); }
  const Felt& felt(std::size_t hand) const { return hands_[hand]->felt; }
  int period_ms(std::size_t hand) const { return hands_[hand]->period_ms; }

  /// Work (J) of forces and torques on all hands, less what the floor can have given by rising.
  double got() const { return got_ - of_mover_; }
  /// docs/safety.md, promise 9: for each glove 0.1 J, 1 J and 0.3 W; and 0.1 W where contacts were withheld.
  double allowance() const { return static_cast<double>(hands_.size()) * (1.1 + 0.4e-3 * ms_); }

 private:
  using Time = std::chrono::nanoseconds;

  struct Hand {
    explicit Hand(LedgerWorld& world)
        : is_true(world.random_() % 3 != 0),
          period_ms(kPeriods_ms[world.random_() % kPeriods_ms.size()]),
          one_way(world.is_linked_ ? world.random_() % 12 : 0),
          parameters(world.wearer()),
          device(world.descriptor(parameters, is_true, period_ms)),
          glove(world.script(), parameters),
          envelope(device, 6.0) {}

    static constexpr std::array kPeriods_ms{1, 1, 1, 2, 5, 10};

    bool is_true;         // the descriptor tells the damping of the device
    int period_ms;        // of the device
    std::size_t one_way;  // ms, of the link
    devices::SimulatedGloveParameters parameters;
    devices::DeviceDescriptor device;
    devices::SimulatedGlove glove;
    devices::SafetyEnvelope envelope;  // at the glove's end of a link
    std::deque<devices::GloveState> states;
    std::deque<devices::GloveCommand> commands;
    devices::GloveCommand newest;
    devices::SafeCommand given;
    std::optional<devices::GloveState> seen;
    HandTick tick;
    std::size_t part = 0;
    int silent_until = 0;    // ms, without commands
    int unseen_until = 0;    // without states
    int disabled_until = 0;  // without the enable switch
    Felt felt;
    double step = 0.0;  // N, of the force
  };

  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  devices::SimulatedGloveParameters wearer() {
    devices::SimulatedGloveParameters parameters;
    parameters.mass = 0.1 + 2.9 * uniform() * uniform();
    parameters.arm_damping = 5.0 * uniform();
    parameters.wearer_stiffness = 100.0 + 500.0 * uniform();
    parameters.wearer_damping = std::min(5.0 + 40.0 * uniform(), 400.0 * parameters.mass);
    return parameters;
  }

  devices::DeviceDescriptor descriptor(const devices::SimulatedGloveParameters& parameters, bool is_true,
                                       int period_ms) {
    devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    device.update_rate = 1000.0 / period_ms;
    device.damping = std::max(0.01, parameters.arm_damping);
    if (!is_true) device.damping *= std::pow(10.0, uniform());
    if (random_() % 3 == 0) device.max_force = 3.0 + 17.0 * uniform();
    if (random_() % 4 == 0) device.max_power = 1.0 + 10.0 * uniform();
    if (random_() % 4 == 0) device.max_force_rate = std::pow(10.0, 2.5 + uniform());
    if (random_() % 4 == 0) device.max_mean_force = (0.05 + 0.25 * uniform()) * device.max_force;
    return device;
  }

  /// A hand that wanders by some centimetres, and presses at last.
  geometry::PoseTrajectory script() {
    std::vector<geometry::TimedPose> rows;
    const auto somewhere = [this](double low, double high) {
      const Eigen::Vector3d p(0.1 * uniform() - 0.05, 0.1 * uniform() - 0.05, low + (high - low) * uniform());
      const double angle = has_mover_ ? 0.0 : 0.6 * uniform();
      return test_support::pose(p, test_support::turn(angle, p + Eigen::Vector3d(0.0, 0.0, 0.1)));
    };
    for (int ms = 0; ms < kPressing; ms += 50 + static_cast<int>(random_() % 600))
      rows.push_back({std::chrono::milliseconds(ms), ms == 0 ? test_support::at(0.0) : somewhere(-0.05, 0.03)});
    const Eigen::Isometry3d pressing = somewhere(-0.06, -0.04);
    rows.push_back({std::chrono::milliseconds(kPressing + 300), pressing});
    rows.push_back({std::chrono::milliseconds(kTicks), pressing});
    return geometry::PoseTrajectory(rows);
  }

  void hold(std::size_t hand, std::size_t part) {
    hands_[hand]->part = part;
    if (kernel_) kernel_->grasp(hand, part);
  }

  void start_server() {
    std::vector<KernelHand> hands;
    for (const std::unique_ptr<Hand>& hand : hands_)
      hands.push_back({hand->device, hand->part});
    kernel_ = std::make_unique<HapticKernel>(parts_, hands);
    ++servers_;
    session_ = random_() % 2 == 0 ? 0 : servers_;
    sequences_ = static_cast<std::int64_t>(random_() % 2 * 1'000'000);
  }

  void disturb() {
    Hand& hand = *hands_[random_() % hands_.size()];
    switch (random_() % 3000) {
      case 0:
        hand.silent_until = ms_ + 10 + static_cast<int>(random_() % 400);
        break;
      case 1:
        hand.unseen_until = ms_ + 5 + static_cast<int>(random_() % 200);
        break;
      case 2:
        hand.disabled_until = ms_ + 5 + static_cast<int>(random_() % 200);
        break;
      case 3:
        if (random_() % 2 == 0) break;
        halted_until_ = ms_ + 30 + static_cast<int>(random_() % 300);
        break;
      case 4:  // the server ends, and after the lease another takes over; gloves in its process have new envelopes then
        if (!is_linked_) break;
        start_server();
        for (const std::unique_ptr<Hand>& each : hands_) {
          each->commands.clear();
          each->silent_until = ms_ + 600;
        }
        break;
      case 5:
      case 6:
        hold(random_() % hands_.size(), random_() % parts_.size());
        break;
      default:
        break;
    }
    if (has_mover_ && random_() % 300 == 0) floor_speed_ = 0.1 * uniform() - 0.05 - 0.5 * floor_;
  }

  /// A millisecond of the glove: the hand moves under the given command. Once a period, the glove measures and takes
  /// the newest one.
  void move(Hand& hand) {
    const Eigen::Isometry3d before = hand.glove.state().X_WH;
    devices::GloveState state = hand.glove.step(kTickPeriod, hand.given);
    const Eigen::Isometry3d& after = state.X_WH;
    const Eigen::AngleAxisd turn(after.linear() * before.linear().transpose());
    const devices::GloveCommand& acted = hand.given.values();
    got_ += acted.f_H_W.dot(after.translation() - before.translation()) + acted.t_H_W.dot(turn.angle() * turn.axis());
    if (is_due(hand)) measure(hand, state);
    if (hand.states.empty() || hand.states.front().time > std::chrono::milliseconds(ms_) - one_way(hand)) return;
    if (ms_ >= hand.unseen_until) hand.seen = hand.states.front();
    hand.states.pop_front();
  }

  bool is_due(const Hand& hand) const { return ms_ % hand.period_ms == 0; }
  static Time one_way(const Hand& hand) { return std::chrono::milliseconds(hand.one_way); }

  void measure(Hand& hand, devices::GloveState state) {
    state.is_enabled = ms_ >= hand.disabled_until;
    if (is_linked_) {
      while (hand.commands.size() > hand.one_way) {
        hand.newest = hand.commands.front();
        hand.commands.pop_front();
      }
      hand.given = hand.envelope.limit(hand.newest, state, Time(std::chrono::milliseconds(ms_)));
      state.link_delay = hand.envelope.link_delay();
      state.taken = hand.given.taken();
      state.energy = hand.given.energy();
    }
    hand.states.push_back(state);
  }

  void serve() {
    if (ms_ > kPressing) floor_speed_ = 0.0;
    floor_ += 1e-3 * floor_speed_;
    const Time now = std::chrono::milliseconds(ms_);
    if (ms_ >= halted_until_) answer(now);
    std::array<const devices::GloveState*, hands::kMaxHands> states{};
    for (std::size_t h = 0; h < hands_.size(); ++h)
      states[h] = hands_[h]->seen ? &*hands_[h]->seen : nullptr;
    const HapticTick tick = kernel_->tick({states.data(), hands_.size()}, set_, now);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      set_.parts[p].hold = tick.ghosts.parts[p].hold;
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      Hand& hand = *hands_[h];
      hand.tick = tick.hands[h];
      if (is_linked_) {
        hand.commands.push_back(hand.tick.command.values());
        hand.commands.back().session = session_;
        hand.commands.back().sequence += sequences_;
        if (ms_ < hand.silent_until) hand.commands.back() = hand.newest;
      } else if (is_due(hand)) {
        hand.given = hand.tick.command;
      }
      feel(hand);
    }
  }

  /// Parts lie beside each other along x, 20 mm apart at first, and 10 mm above the floor.
  void answer(Time now) {
    ++set_.sequence;
    set_.time = now;
    set_.row_count = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      ContactRow floor{{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero(), floor_ - 0.01}}};
      floor.part = static_cast<std::int32_t>(p);
      floor.approach = floor_speed_;
      set_.row_array[static_cast<std::size_t>(set_.row_count++)] = floor;
      if (p == 0) continue;
      ContactRow beside{{{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero(), -0.02}}};
      beside.part = static_cast<std::int32_t>(p);
      beside.other = static_cast<std::int32_t>(p) - 1;
      set_.row_array[static_cast<std::size_t>(set_.row_count++)] = beside;
    }
  }

  void feel(Hand& hand) {
    const devices::GloveCommand& given = hand.given.values();
    const Eigen::Vector3d wanted = hand.tick.contacts.f + hand.tick.pull.f;
    const double norm = wanted.norm();
    const devices::DeviceDescriptor& limits = hand.envelope.descriptor();
    const double mean = limits.max_mean_force > 0.0 ? 0.9 * limits.max_mean_force : limits.max_force;
    const double most = std::min({norm, mean, limits.max_force});
    const double force = given.f_H_W.norm();
    hand.felt.is_new = is_due(hand);
    if (hand.felt.is_new) {
      const double step = force - hand.felt.force;
      hand.felt.turns = step * hand.step < -0.5;
      hand.step = step;
      hand.felt.change = std::abs(step);
    }
    hand.felt.force = force;
    if (hand.glove.state().v_WH.norm() > 0.03) hand.felt.rests_since = ms_;
    hand.felt.share = most > 0.0 ? given.f_H_W.dot(wanted) / (norm * most) : 1.0;
    const double exerted = norm > 0.0 ? std::clamp(given.f_H_W.dot(wanted) / (norm * norm), 0.0, 1.0) : 0.0;
    of_mover_ += exerted * std::max(0.0, hand.tick.contacts.f.z() * 1e-3 * floor_speed_);
  }

  std::mt19937_64 random_;
  bool is_linked_ = false;
  bool has_mover_ = false;
  int ms_ = 0;
  std::vector<KernelPart> parts_;
  std::vector<std::unique_ptr<Hand>> hands_;
  std::unique_ptr<HapticKernel> kernel_;
  ContactSet set_;
  int halted_until_ = 0;
  int servers_ = 0;
  std::int64_t session_ = 0;
  std::int64_t sequences_ = 0;  // from which the server counts
  double floor_ = 0.0;
  double floor_speed_ = 0.0;
  double got_ = 0.0;
  double of_mover_ = 0.0;
};

}  // namespace glissade::haptics
