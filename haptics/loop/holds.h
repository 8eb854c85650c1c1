#pragma once

/// Who holds what: the hands, the parts in them, and where each part would be if nothing were in the way.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

#include "loop/contact_projection.h"

namespace glissade::haptics {

/// A hand at one tick.
struct HandPose {
  const Eigen::Isometry3d* X_WH = nullptr;  ///< null if there is no finite pose
  bool is_fading = false;                   ///< the hand's force fades: its pose may be old or wrong
};

/// A hand that takes hold of a part carries the part's ghost rigidly, beginning at the visible part, so that nothing
/// moves and no force jumps.
///
/// Several hands may hold one part: then the ghost is at the mean of the hands' ghosts, weighted by their stiffness,
/// and the spring of each hand acts. The contacts' force is shared in proportion to the stiffness, and each hand feels
/// the pull of the others. A hand that joins counts more and more within 200 ms. One whose pose is old counts less and
/// less within 50 ms; when it comes back, it takes hold anew. If a hand joins or lets go, the part keeps its target,
/// and the simulation lets the target approach the new ghost slowly.
///
/// Real-time safe. Not thread-safe.
class Holds {
 public:
  /// For so many parts, and the stiffness with which each hand holds each part.
  Holds(std::size_t parts, std::vector<std::array<contact::CouplingStiffness, contact::kMaxParts>> stiffness);

  /// In the next call of `update` in which the hand has a pose, it takes hold of the part, and lets go of any other.
  void grasp(std::size_t hand, std::size_t part) noexcept { hands_[hand].wanted = part; }
  /// In the next call of `update`, after all grasps, so that a part may pass from hand to hand. Forgets a grasp that
  /// still waits for a pose.
  void release(std::size_t hand) noexcept {
    hands_[hand].wanted.reset();
    hands_[hand].lets_go = true;
  }

  /// The tick for these hands, `dt` (seconds) after the last. The visible parts and their reference points are those of
  /// the newest set.
  void update(std::span<const HandPose> hands, const ContactSet& set, double dt) noexcept;

  /// The part that the hand holds.
  std::optional<std::size_t> part_of(std::size_t hand) const { return hands_[hand].part; }
  /// The ghost of the part as this hand alone would have it.
  const Eigen::Isometry3d& ghost_of_hand(std::size_t hand) const { return hands_[hand].X_WG; }
  /// The hand's share of the contacts' wrench, and the pull of the other hands on it, about the part's reference point.
  contact::Wrench on_hand(std::size_t hand, const contact::Wrench& contacts) const;
  contact::Wrench pull_on(std::size_t hand) const { return hands_[hand].pull; }
  /// Work (J) of the hand in the last tick against a wrench on it about the reference point of the part that it holds.
  double work_against(std::size_t hand, const contact::Wrench& wrench) const;
  /// The hand's share of the energy that the part's contacts supply.
  double supply_share(std::size_t hand) const { return hands_[hand].force_share; }

  std::span<const LedPart> led() const { return led_; }
  const GhostOfPart& ghost(std::size_t part) const { return parts_[part].ghost; }
  /// Metres that the ghost moved in the last tick; 0 where it was set anew.
  double ghost_motion(std::size_t part, double radius) const;

 private:
  struct Hand {
    std::optional<std::size_t> wanted;
    bool lets_go = false;
    std::optional<std::size_t> part;
    Eigen::Isometry3d X_HG = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    double weight = 1.0;   // where others hold the part too
    bool is_lost = false;  // has faded away while others held the part
    double force_share = 1.0;
    double torque_share = 1.0;
    contact::Wrench pull;
  };
  struct Part {
    GhostOfPart ghost;
    Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();
    Eigen::Isometry3d X_WG_before = Eigen::Isometry3d::Identity();
    std::int64_t hold_told = 0;                  // at the end of the last tick
    bool is_set_anew = false;                    // in the last tick
    std::optional<Eigen::Isometry3d> X_WT_kept;  // since a hand let go: the target, until the simulation has answered
    std::optional<Eigen::Isometry3d> X_GT_kept;
  };

  geometry::Displacement ghost_way(std::size_t part) const;
  std::size_t holders_of(std::size_t part) const noexcept;
  void take(Hand& hand, std::size_t part, const Eigen::Isometry3d& X_WH, const ContactSet& set) noexcept;
  void let_go(Hand& hand) noexcept;
  void keep_target(std::size_t part) noexcept;
  void weigh(Hand& hand, const HandPose& pose, double dt) noexcept;
  void combine(std::size_t part) noexcept;
  void aim(std::size_t part, const ContactSet& set) noexcept;

  std::vector<std::array<contact::CouplingStiffness, contact::kMaxParts>> stiffness_;
  std::vector<Hand> hands_;
  std::vector<Part> parts_;
  std::vector<LedPart> led_;
};

}  // namespace glissade::haptics
