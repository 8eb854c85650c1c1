#pragma once

/// The contacts of a hand with the part that it holds, over time.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/grasping/clasp.h>

namespace glissade::grasping {

/// The noise of a glove takes a segment off the held part by millimetres. Within such a distance, the segment counts as
/// touching. The distance is how far the joints of the glove have opened the last contact, and not where they take the
/// segment: a finger that nothing holds back, because its glove has no torques or they come late, may close through the
/// part and come out beyond it. Each flexion counts with the whole way of the contact point, because a finger that
/// closes on takes this point round in all directions; every other joint counts with the way along the contact's
/// normal. Not thread-safe.
class HeldContacts {
 public:
  /// The link with the number `palm` moves with the part. Values with the numbers `flexions` close the fingers where
  /// they grow.
  HeldContacts(std::shared_ptr<const KinematicChain> chain, std::size_t palm, std::span<const std::size_t> flexions);

  /// Forgets all, and takes the contacts of a hand that begins to hold a part. The arguments are those of `update`.
  void begin(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
             const Posture& visible);
  /// Takes the contacts of this moment, and finds those that go on. `body` is the number of the held part, which is at
  /// X_WV; `visible` and `target` are postures with the palm at the same place.
  void update(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
              const Posture& visible, const Posture& target);
  /// The contacts of this moment, and those that go on: their gap is how far the joints have opened them.
  std::span<const LinkContact> contacts() const { return contacts_; }
  /// The links that have left the part in the last call.
  std::span<const std::size_t> left() const { return left_; }

 private:
  // How far the last contact may be opened: up to kNear_m the segment goes on touching; in between it does not, but
  // does again if the finger comes back; from kAway_m on it has left. A target that goes aside by more than kAside_m
  // has left as well, unless the contact is closed by more than kWithin_m.
  static constexpr double kNear_m = 1.5e-3;
  static constexpr double kAway_m = 4e-3;
  static constexpr double kAside_m = 15e-3;
  static constexpr double kWithin_m = 2e-3;

  /// A contact that a link has had, which moves with the part.
  struct LastContact {
    LinkContact touch;
    Eigen::Vector3d p_L;  // on the link
    Eigen::Vector3d q_V;  // on the part
    Eigen::Vector3d n_V;
    std::vector<double> rates;  // m/rad, at which each flex value opens it
    double opened;              // m, by the flex values at the contact
  };

  std::vector<double> opening_rates(const LinkContact& touch) const;

  std::shared_ptr<const KinematicChain> chain_;
  std::size_t palm_;
  std::vector<std::size_t> flexions_;
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<Eigen::Isometry3d> X_WL_target_;
  std::vector<std::optional<LastContact>> last_;  // by link
  std::vector<LinkContact> contacts_;
  std::vector<std::size_t> left_;
};

}  // namespace glissade::grasping
