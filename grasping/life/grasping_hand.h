#pragma once

/// One hand of a simulation: its clasp, its grasp, and how it moves with the part that it holds.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>

#include "life/held_contacts.h"
#include "life/link_speeds.h"
#include "life/steady_fingers.h"

namespace glissade::grasping {

/// The palm P and a held part are one rigid body. Not thread-safe.
class GraspingHand {
 public:
  /// How deep the target of a segment may lie in a loose part before the part yields.
  static constexpr double kResistance_m = 1e-3;

  GraspingHand(std::shared_ptr<const HandModel> model, const std::vector<contact::Obstacle>& fixed,
               std::vector<std::shared_ptr<const contact::SlidingPart>> parts, const ClaspRules& rules);

  const std::shared_ptr<const HandModel>& model() const { return model_; }
  const Clasp& clasp() const { return clasp_; }
  Clasp& clasp() { return clasp_; }
  const Grasp& grasp() const { return analysis_.grasp(); }
  std::optional<std::size_t> part() const { return part_; }

  /// The pose of a segment for each of the hand's bodies: the riders of the sliding simulation.
  std::span<const Eigen::Isometry3d> segments();

  /// Takes the target of a call, `milliseconds` after the last one; none while the tracking is lost. The fingers of a
  /// hand that holds a part follow it smoothly.
  void aim(const std::optional<Posture>& target, double milliseconds);
  bool is_lost() const { return !target_; }
  /// Whether the hand is somewhere: not before it has begun, nor after `vanish` until it begins anew.
  bool is_present() const { return clasp_.state() == ClaspState::kClasping; }
  /// A hand that is lost and holds nothing is nowhere, and grasps nothing.
  void vanish();
  /// Whether the hand has been found again and still presses on a part: what has been missed is no push.
  bool is_late() const { return is_late_; }

  /// Metres a millisecond: the speed of a link of the tracked hand.
  double speed_of(std::size_t link) const { return speeds_.of(link); }

  /// Takes hold of the part at X_WV; only a hand that is present can.
  void take(std::size_t part, const Eigen::Isometry3d& X_WV);
  void let_go();
  /// Whether the hand let go of this part only a moment ago.
  bool has_just_left(std::size_t part) const { return part == left_ && since_left_ms_ < kPause_ms; }
  /// Where the target of this hand has the held part; none while the tracking is lost.
  std::optional<Eigen::Isometry3d> ghost();

  /// Moves the hand: with the held part, which is now at X_WV, or towards its target.
  void follow(const Eigen::Isometry3d& X_WV);
  void advance();
  /// Whether the contacts of this moment hold the body: before the analysis says so, they must last.
  bool closes_round(std::int32_t body) const { return now_.grasp().holds() && now_.grasp().object == body; }
  /// The contacts of the clasp. Those with a held part go on while the segment is only just off it.
  std::span<const LinkContact> contacts() const;
  /// Looks at the contacts. The held part, if there is one, is at X_WV.
  void analyze(double milliseconds, const Eigen::Vector3d& up_W, const Eigen::Isometry3d& X_WV);

 private:
  static constexpr double kPause_ms = 200.0;  // before the hand takes hold of the same part again

  /// The palm in the root's frame, for these flex values.
  Eigen::Isometry3d palm(std::span<const double> values);

  std::shared_ptr<const HandModel> model_;
  std::vector<std::size_t> links_;  // with meshes
  std::int32_t first_part_;         // the number of its body
  Clasp clasp_;
  GraspAnalysis analysis_;
  GraspAnalysis now_;  // of this moment alone
  SteadyFingers fingers_;
  HeldContacts held_;
  LinkSpeeds speeds_;
  std::optional<Posture> target_;
  bool is_late_ = false;
  std::optional<std::size_t> part_;
  std::optional<std::size_t> left_;  // the part that the hand held last
  double since_left_ms_ = 0.0;
  Eigen::Isometry3d X_PV_ = Eigen::Isometry3d::Identity();
  Posture posture_;  // scratch memory
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<Eigen::Isometry3d> X_WB_;
};

/// A hand for each model, among these bodies. Throws std::invalid_argument for a null model, and as `Clasp` does.
std::vector<GraspingHand> make_hands(const std::vector<std::shared_ptr<const HandModel>>& models,
                                     const std::vector<contact::Obstacle>& fixed,
                                     const std::vector<contact::HeldPart>& parts, const ClaspRules& rules);

}  // namespace glissade::grasping
