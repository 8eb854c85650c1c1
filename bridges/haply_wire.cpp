#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include <glissade/bridges/haply_wire.h>
#include <glissade/devices/glove_model.h>
#include <glissade/realtime/clock.h>

#include "haply/arm_choice.h"
#include "haply/client_message.h"
#include "haply/service_message.h"
#include "haply/smooth_turn.h"
#include "haply/web_socket.h"

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kForInventory{1000};
/// The service answers within a millisecond.
constexpr milliseconds kLongestPause{500};

devices::DeviceDescriptor inverse3_at(const Eigen::Isometry3d& X_WD) {
  // A tip is nowhere farther from the mounting plate than the diagonal of Haply's workspace, 0.51 by 0.46 by 0.23 m.
  constexpr double kReach_m = 0.75;
  devices::DeviceDescriptor descriptor = devices::descriptor_of(devices::read_glove_model(kInverse3Preset));
  descriptor.workspace_radius = X_WD.translation().norm() + kReach_m;
  return descriptor;
}

}  // namespace

struct HaplyWire::Link {
  explicit Link(HaplyOptions wanted)
      : options(std::move(wanted)),
        descriptor(inverse3_at(options.X_WD)),
        period(std::llround(1e9 / descriptor.update_rate)),
        socket(parse_service_address(options.service)) {}

  [[noreturn]] void fail(const std::string& what) const { throw WireError(socket.name() + ": " + what); }
  void meet(const std::string& text);
  void send(const Eigen::Vector3d& f_H_W, bool is_first);
  bool take(const std::string& text, devices::GloveState& state);
  void take(const HaplyArm& arm, const HaplyHandle* handle, devices::GloveState& state);

  HaplyOptions options;
  devices::DeviceDescriptor descriptor;
  nanoseconds period;
  realtime::SteadyClock clock;
  WebSocket socket;
  HaplyTraffic traffic;
  ForceKey force_key = ForceKey::kValues;
  nanoseconds sent{0};  ///< when the last message was sent
  nanoseconds due{0};   ///< when the next one is to be sent
  bool is_answered = true;
  nanoseconds last_state{0};
  SmoothTurn turn;           // of the handle, in the axes of the device
  bool has_buttons = false;  ///< a VerseGrip was there: without it, the hand stays closed
};

HaplyWire::HaplyWire(HaplyOptions options) : link_(std::make_unique<Link>(std::move(options))) {}

HaplyWire::~HaplyWire() {
  release();
}

const devices::DeviceDescriptor& HaplyWire::descriptor() const noexcept {
  return link_->descriptor;
}

const HaplyTraffic& HaplyWire::traffic() const noexcept {
  return link_->traffic;
}

void HaplyWire::open() {
  link_->socket.open();
  const std::optional<std::string> text = link_->socket.receive(kForInventory);
  if (!text) link_->fail("it accepts a connection, but says nothing");
  try {
    link_->meet(*text);
  } catch (const WireError& error) {
    link_->fail(error.what());
  } catch (const std::invalid_argument& error) {
    link_->fail(std::string("its first message is none of Haply's Inverse Service from version 3.1 on: ") +
                error.what());
  }
  constexpr bool kIsFirst = true;
  link_->send(Eigen::Vector3d::Zero(), kIsFirst);
  link_->last_state = link_->clock.now();
}

/// The first message of the service says what there is.
void HaplyWire::Link::meet(const std::string& text) {
  traffic = {};
  turn = {};
  const ServiceMessage inventory = decode_service_message(text);
  force_key = inventory.force_key;
  const HaplyArm& arm = chosen_arm(inventory, options.arm);
  chosen_handle(inventory, options.handle);
  if (const std::string trouble = trouble_of(arm); !trouble.empty()) throw WireError(trouble);
  traffic.arm = arm.id;
}

void HaplyWire::Link::send(const Eigen::Vector3d& f_H_W, bool is_first) {
  ClientMessage message{.force_key = force_key, .arm = traffic.arm, .f_C_D = options.X_WD.linear().transpose() * f_H_W};
  if (is_first && force_key == ForceKey::kVector) message.damping_N_s_per_m = 0.0;
  sent = clock.now();
  due = sent - due > period ? sent + period : due + period;  // late threads do not slow the rate
  is_answered = false;
  socket.send(encode_client_message(message));
  traffic.f_H_W = f_H_W;
}

bool HaplyWire::read(devices::GloveState& state) {
  Link& link = *link_;
  const nanoseconds time_left = link.due - link.clock.now();
  if (link.is_answered) {
    std::this_thread::sleep_for(time_left);
    return false;
  }
  const nanoseconds patience = std::max(time_left, link.period / 2);
  const std::optional<std::string> text = link.socket.receive(patience);
  link.is_answered = text.has_value();
  if (text && link.take(*text, state)) return true;
  if (link.clock.now() - link.last_state > kLongestPause) {
    if (link.traffic.last_refusal.empty()) link.fail("it answers no more");
    link.fail("its messages are no states: " + link.traffic.last_refusal);
  }
  return false;
}

bool HaplyWire::Link::take(const std::string& text, devices::GloveState& state) {
  ServiceMessage message;
  try {
    message = decode_service_message(text);
  } catch (const std::invalid_argument& error) {
    ++traffic.refused;
    traffic.last_refusal = error.what();
    return false;
  }
  traffic.last_refusal.clear();
  try {
    const HaplyArm& arm = chosen_arm(message, traffic.arm);
    if (const std::string trouble = trouble_of(arm); !trouble.empty()) throw WireError(trouble);
    take(arm, chosen_handle(message, options.handle), state);
  } catch (const WireError& error) {
    fail(error.what());
  }
  ++traffic.states;
  return true;
}

void HaplyWire::Link::take(const HaplyArm& arm, const HaplyHandle* handle, devices::GloveState& state) {
  const double dt_s = std::chrono::duration<double>(sent - state.time).count();
  last_state = clock.now();
  // Measured when the service read the message that it answers, which was not before it was sent.
  state.time = sent;
  if (handle != nullptr && handle->R_DG) turn.advance(*handle->R_DG, traffic.states > 0 ? dt_s : 0.0);
  const Eigen::Matrix3d& R_WD = options.X_WD.linear();
  state.X_WH.translation() = options.X_WD * arm.p_DC;
  state.X_WH.linear() = R_WD * turn.orientation().toRotationMatrix();
  state.v_WH = R_WD * arm.v_DC;
  state.w_WH = R_WD * turn.rate();
  has_buttons = has_buttons || handle != nullptr;
  const bool is_closed = !has_buttons || (handle != nullptr && handle->is_pressed);
  if ((state.grip % 2 == 1) != is_closed) ++state.grip;
  traffic.handle = handle != nullptr ? std::optional(handle->id) : std::nullopt;
  traffic.exerted_H_W.reset();
  if (arm.f_C_D) traffic.exerted_H_W = R_WD * *arm.f_C_D;
}

void HaplyWire::write(const devices::SafeCommand& command) {
  Link& link = *link_;
  // Without an answer, another message would wait behind the first one. The service lets go of the hand meanwhile.
  if (!link.is_answered || link.clock.now() < link.due) return;
  constexpr bool kIsFirst = false;
  link.send(command.values().f_H_W, kIsFirst);
}

void HaplyWire::release() noexcept {
  Link& link = *link_;
  if (!link.socket.is_open()) return;
  try {
    constexpr bool kIsFirst = false;
    if (!link.traffic.arm.empty()) link.send(Eigen::Vector3d::Zero(), kIsFirst);
  } catch (const std::exception&) {  // then the service lets go, because no messages come
  }
  link.socket.close();
}

}  // namespace glissade::bridges
