#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include <glissade/grasping/finger_forces.h>

namespace glissade::grasping {
namespace {

using std::chrono::nanoseconds;

constexpr double kFullTorque_rad = 0.8 * std::numbers::pi / 180.0;
constexpr double kShortArm_m = 2e-3;
constexpr nanoseconds kFullForce = std::chrono::milliseconds(20);
constexpr nanoseconds kForceless = std::chrono::milliseconds(100);

double seconds(nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
}

/// From 1 smoothly down to 0.
double share_at(nanoseconds age) noexcept {
  const double t = std::clamp(seconds(age - kFullForce) / seconds(kForceless - kFullForce), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

const KinematicChain& checked_hand(const std::shared_ptr<const KinematicChain>& chain) {
  if (chain == nullptr) throw std::invalid_argument("the forces on fingers need a chain, not a null pointer");
  if (chain->values().size() > devices::kGloveJoints)
    throw std::invalid_argument("the chain has more flex values than a glove has joints");
  return *chain;
}

}  // namespace

double finger_stiffness(const devices::DeviceDescriptor& device, nanoseconds period, nanoseconds link_delay) noexcept {
  const double wanted = device.max_joint_torque / kFullTorque_rad;
  if (device.joint_damping <= 0.0) return wanted;
  const double lag = 0.5 * std::max(seconds(period), 1.0 / device.update_rate) + seconds(device.delay + link_delay);
  return std::min(wanted, device.joint_damping / lag);
}

FingerForces::FingerForces(std::shared_ptr<const KinematicChain> chain, const devices::DeviceDescriptor& device,
                           nanoseconds period)
    : chain_(std::move(chain)),
      device_(device),
      period_(period),
      stiffness_(finger_stiffness(device, period, nanoseconds(0))),
      X_WL_(checked_hand(chain_).links().size()) {
  devices::validate(device_);
  haptics::validate_tick_period(period_);
}

void FingerForces::set_link_delay(nanoseconds delay) noexcept {
  stiffness_ = finger_stiffness(device_, period_, delay);
}

const devices::JointValues& FingerForces::update(const devices::JointValues& angles, const Posture& visible,
                                                 std::span<const LinkContact> contacts,
                                                 nanoseconds age_of_contacts) noexcept {
  torques_.fill(0.0);
  const bool is_finite = std::all_of(angles.begin(), angles.end(), [](double angle) { return std::isfinite(angle); });
  if (contacts.empty() || !is_finite) return torques_;
  const std::span<const FlexValue> values = chain_->values();
  for (std::size_t v = 0; v < values.size(); ++v)
    lags_[v] = std::clamp(angles[v], values[v].lower, values[v].upper) - visible.values[v];
  chain_->poses(visible.X_WR, visible.values, X_WL_);
  depths_.fill(0.0);
  for (const LinkContact& contact : contacts)
    press(contact);
  const double share = share_at(age_of_contacts);
  for (std::size_t v = 0; v < values.size(); ++v) {
    const bool is_absent = device_.joint_lower[v] == 0.0 && device_.joint_upper[v] == 0.0;
    if (depths_[v] == 0.0 || is_absent) continue;
    torques_[v] = -std::copysign(share * std::min(stiffness_ * depths_[v], device_.max_joint_torque), lags_[v]);
  }
  return torques_;
}

/// The contact's row of the Jacobian.
void FingerForces::find_rates(const LinkContact& contact) noexcept {
  rates_.fill(0.0);
  const std::span<const ChainLink> links = chain_->links();
  for (std::optional<std::size_t> l = contact.link; l; l = links[*l].parent) {
    if (links[*l].terms.empty()) continue;
    const Eigen::Vector3d axis_W = X_WL_[*l].linear() * links[*l].axis_J;
    const double per_rad = contact.contact.n_W.dot(axis_W.cross(contact.contact.p_W - X_WL_[*l].translation()));
    for (const JointTerm& term : links[*l].terms)
      rates_[term.value] += term.factor * per_rad;
  }
}

/// How far each joint would have to go back, alone, to leave the contact; but never farther than to the visible hand.
void FingerForces::press(const LinkContact& contact) noexcept {
  find_rates(contact);
  double depth = -std::max(0.0, contact.contact.gap - contact.contact.margin);
  const std::size_t count = chain_->values().size();
  for (std::size_t v = 0; v < count; ++v)
    depth -= rates_[v] * lags_[v];
  if (depth <= 0.0) return;
  for (std::size_t v = 0; v < count; ++v) {
    const double arm = lags_[v] > 0.0 ? -rates_[v] : rates_[v];  // positive where the lag closes the gap
    if (arm <= 0.0) continue;
    const double back = std::min(std::abs(lags_[v]), depth / arm);
    depths_[v] = std::max(depths_[v], std::min(1.0, arm / kShortArm_m) * back);
  }
}

}  // namespace glissade::grasping
