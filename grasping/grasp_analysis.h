#pragma once

/// What kind of grasp the contacts of a hand make: the rules of the founding paper (§4), and the grasps that it names
/// without a rule. docs/grasps.md draws each of them.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include <glissade/grasping/clasp.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/hands/hand.h>

namespace glissade::grasping {

using hands::GraspForm;
using hands::GraspType;

/// Why nothing is grasped: what the segments that touch an object lack to hold it.
enum class GraspLack : std::uint8_t {
  kNothing,           ///< they hold it
  kTouch,             ///< nothing touches
  kFinger,            ///< the thumb touches, but neither palm nor fingers
  kThumbOrPalm,       ///< fingers touch, but neither thumb nor palm
  kSegmentFartherOut  ///< the palm touches, but no middle or outer segment
};

/// Number of values of `GraspLack`. The values run from 0 to kGraspLacks − 1.
inline constexpr std::int32_t kGraspLacks = 5;

/// What a grasp needs, such as "a grasp needs a finger as well, or the palm and a middle or outer segment"; empty for
/// `kNothing`.
std::string_view words_of(GraspLack lack);

struct Grasp {
  GraspType type = GraspType::kNone;
  GraspForm form = GraspForm::kNone;
  std::int32_t object = -1;   ///< number of the body, as `Contact::obstacle`; -1: nothing touches
  TouchingSegments segments;  ///< that touch this body

  /// Whether the object moves with the hand.
  bool holds() const {
    return type == GraspType::kPrecision || type == GraspType::kPower || form == GraspForm::kCigarette ||
           form == GraspForm::kGravity;
  }
  GraspLack lack() const;
};

/// The grasp of a hand with fingers as the haptic loop tells of it: without the object.
Grasp grasp_of(const hands::VisibleHand& hand);

/// A sentence without a stop, such as "power: the palm and the middle segment of the index touch".
std::string reason_of(const Grasp& grasp);

/// Follows the grasp over time. A segment counts as touching once it has touched in most of the last 40 ms or so, and
/// until it has hardly touched for 70 ms, so that the noise of sensors makes no grasp flicker. No grasp lasts longer
/// than that without contacts in `update`; of a hand that holds a part, `GraspSimulation` gives some of them while
/// noise may have taken them away. A segment may touch up to three bodies, each for itself. Of these bodies the one
/// counts whose grasp is the firmest: power, precision, push. A grasp that holds a part, also one that moves on its
/// own, comes before any of a fixed body. Real-time safe after construction. Not thread-safe.
class GraspAnalysis {
 public:
  /// The first bodies, `fixed_bodies` of them, never move.
  explicit GraspAnalysis(const HandModel& hand, std::size_t fixed_bodies = 0)
      : meaning_(hand.meaning), first_part_(static_cast<std::int32_t>(fixed_bodies)) {}

  /// The grasp after `milliseconds` with these contacts. `up_W` is a unit vector against gravity. As long as the hand
  /// holds the body with the number `held`, no other body counts.
  const Grasp& update(std::span<const LinkContact> contacts, double milliseconds,
                      const Eigen::Vector3d& up_W = Eigen::Vector3d::UnitZ(), std::int32_t held = -1);
  const Grasp& grasp() const { return grasp_; }

  /// The link, by its number in the chain, touches the body no more, at once: it has plainly left it.
  void forget(std::size_t link, std::int32_t object);

  /// Forgets all contacts, as after a loss of tracking.
  void clear();

 private:
  /// A segment's contact with one body.
  struct Touch {
    std::int32_t object = -1;
    bool counts = false;
    double level = 0.0;                             // how much of the last milliseconds it touched, 0 to 1
    Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  // unit, from the object to the segment, the mean of them

    /// The sum of the normals of this moment is zero if the segment does not touch.
    void follow(const Eigen::Vector3d& sum_W, double share);
  };

  static constexpr std::size_t kBodiesOfLink = 3;  // a fingertip may be at an object, at its table and at a wall
  using TouchesOfLink = std::array<Touch, kBodiesOfLink>;

  void follow(std::span<const LinkContact> contacts, double milliseconds);
  /// The link's contact with this body; null: none that counts.
  const Touch* touch(std::size_t link, std::int32_t object) const;
  bool is_firmer(const Grasp& grasp, const Grasp& other) const;
  Grasp analyze(std::int32_t object, const Eigen::Vector3d& up_W) const;
  GraspForm form_of(const Grasp& grasp, const Eigen::Vector3d& up_W) const;
  GraspForm precision_form(const Grasp& grasp) const;
  bool carries(const Grasp& grasp, const Eigen::Vector3d& up_W) const;
  bool are_opposed(const Grasp& grasp) const;
  /// Whether the grasp so far is one of this form of this body: it ends later than it would begin.
  bool had(GraspForm form, std::int32_t object) const { return grasp_.form == form && grasp_.object == object; }
  std::optional<Eigen::Vector3d> normal(std::int32_t object, const SegmentMeaning& segment) const;

  std::array<SegmentMeaning, kHandLinks> meaning_;
  std::int32_t first_part_;  // bodies from this number on may move
  std::array<TouchesOfLink, kHandLinks> touches_{};
  Grasp grasp_;
};

}  // namespace glissade::grasping
