#include <algorithm>
#include <cmath>

#include <glissade/base/byte_order.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/viewer/view_frame.h>

namespace glissade::viewer {

namespace {

constexpr std::size_t kMissedOffset = 2 * sizeof(double) + 4 * sizeof(float);

class Bytes {
 public:
  void add_double(double number) { base::append_number(bytes_, number); }
  template <typename Number>
  void add(Number number) {
    base::append_number(bytes_, static_cast<float>(number));
  }
  void add(const Eigen::Vector3d& v) {
    for (const double number : v)
      add(number);
  }
  void add(const Eigen::Vector3f& v) {
    for (const float number : v)
      add(number);
  }
  void add(const Eigen::Isometry3d& X) {
    add(Eigen::Vector3d(X.translation()));
    const Eigen::Quaterniond q(X.linear());
    for (const double number : {q.w(), q.x(), q.y(), q.z()})
      add(number);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

double milliseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

double microseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

double greatest(const hands::JointValues& torques) {
  double most = 0.0;
  for (const double torque : torques)
    most = std::max(most, std::abs(torque));
  return most;
}

void add_part(const devices::HapticPartState& part, const Eigen::Isometry3d& X_OW, Bytes& frame) {
  frame.add(X_OW * part.X_WG);
  frame.add(X_OW * part.X_WV);
  const geometry::Displacement lag = part.lag();
  frame.add(lag.v.norm());
  frame.add(lag.w.norm());
  frame.add(static_cast<std::int32_t>(part.state));
  frame.add(part.contact_count);
}

void add_hand(const devices::HapticHandState& hand, double greatest_force_N, Bytes& frame) {
  frame.add(hand.part);
  frame.add(hand.force_W);
  frame.add(hand.torque_V_W);
  frame.add(greatest_force_N);
  frame.add(hand.contact_share);
  frame.add(hand.are_contacts_unsolved ? 1 : 0);
  frame.add(devices::to_bits(hand.reasons));
  frame.add(devices::to_bits(hand.glove_reasons));
  frame.add(devices::energy_left(hand));
  frame.add(static_cast<std::int32_t>(hand.visible.activity));
  frame.add(static_cast<std::int32_t>(hand.visible.grasp));
  frame.add(static_cast<std::int32_t>(hand.visible.form));
  frame.add(hand.visible.touching);  // below 2^24, so that single precision has it exactly
  frame.add(static_cast<std::int32_t>(grasping::grasp_of(hand.visible).lack()));
  frame.add(greatest(hand.joint_torques));
}

void add_contact(const devices::HapticContact& contact, Bytes& frame) {
  frame.add(contact.part);
  frame.add(contact.p_V);
  frame.add(contact.n_W);
}

void add_patch(const devices::HapticPatch& patch, Bytes& frame) {
  frame.add(patch.part);
  frame.add(patch.contact_count);
  frame.add(patch.p_V);
  frame.add(patch.n_W);
  frame.add(patch.extent);
}

}  // namespace

FrameMaker::FrameMaker(const ViewScene& scene) : X_OW_(Eigen::Translation3d(-scene.p_WO())) {
  for (const ViewHand& hand : scene.hands)
    models_.push_back(hand.model);
}

void FrameMaker::add(const devices::HapticState& state) {
  newest_ = state;
  has_news_ = true;
  age_ms_ = std::max(age_ms_, milliseconds(state.contact_set_age));
  lateness_us_ = std::max(lateness_us_, microseconds(state.lateness));
  duration_us_ = std::max(duration_us_, microseconds(state.last_duration));
  for (std::size_t h = 0; h < forces_N_.size(); ++h)
    forces_N_[h] = std::max(forces_N_[h], state.hands[h].force_W.norm());
}

std::string FrameMaker::make() {
  const auto part_count = static_cast<std::size_t>(newest_.part_count);
  const auto hand_count = static_cast<std::size_t>(newest_.hand_count);
  const auto contact_count = static_cast<std::size_t>(newest_.contact_count);
  const auto patch_count = static_cast<std::size_t>(newest_.patch_count);
  Bytes frame;
  frame.add_double(std::chrono::duration<double>(newest_.time).count());
  frame.add_double(static_cast<double>(newest_.sequence));
  frame.add(newest_.is_contact_set_late ? 1 : 0);
  frame.add(age_ms_);
  frame.add(lateness_us_);
  frame.add(duration_us_);
  frame.add(0);
  frame.add(part_count);
  frame.add(hand_count);
  frame.add(contact_count);
  frame.add(patch_count);
  frame.add(newest_.patches_left_out);
  for (std::size_t p = 0; p < part_count; ++p)
    add_part(newest_.parts[p], X_OW_, frame);
  for (std::size_t h = 0; h < hand_count; ++h) {
    add_hand(newest_.hands[h], forces_N_[h], frame);
    const hands::VisibleHand& visible = newest_.hands[h].visible;
    links_.resize(h < models_.size() && models_[h] && is_present(visible.activity) ? models_[h]->chain.links().size()
                                                                                   : 0);
    if (!links_.empty()) models_[h]->chain.poses(X_OW_ * visible.X_WH, visible.angles, links_);
    frame.add(links_.size());
    for (const Eigen::Isometry3d& X_OL : links_)
      frame.add(X_OL);
  }
  for (std::size_t c = 0; c < contact_count; ++c)
    add_contact(newest_.contacts[c], frame);
  for (std::size_t p = 0; p < patch_count; ++p)
    add_patch(newest_.patches[p], frame);
  has_news_ = false;
  age_ms_ = lateness_us_ = duration_us_ = 0.0;
  forces_N_.fill(0.0);
  return frame.take();
}

void append_frame(std::string& frames, const std::string& frame) {
  base::append_number(frames, static_cast<std::uint32_t>(frame.size()));
  frames += frame;
}

void set_missed(std::string& frame, std::uint64_t missed) {
  std::string bytes;
  base::append_number(bytes, static_cast<float>(missed));
  frame.replace(kMissedOffset, bytes.size(), bytes);
}

}  // namespace glissade::viewer
