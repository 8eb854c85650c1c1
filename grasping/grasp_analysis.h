#pragma once

/// Classifies the grasp of a hand from its contacts, by the rules of the founding paper (§4). Also recognizes the
/// grasps that the paper names without a rule. docs/grasps.md shows each grasp.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include <glissade/base/export.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/hands/hand.h>

namespace glissade::grasping {

using hands::GraspForm;
using hands::GraspType;

/// The reason why a hand holds nothing: what its touching segments lack for a grasp.
enum class GraspLack : std::uint8_t {
  kNothing,           ///< the segments hold the object
  kTouch,             ///< nothing touches
  kFinger,            ///< the thumb touches, but neither palm nor fingers
  kThumbOrPalm,       ///< fingers touch, but neither thumb nor palm
  kSegmentFartherOut  ///< the palm touches, but no middle or outer segment
};

/// Number of values of `GraspLack`. The values run from 0 to kGraspLacks − 1.
inline constexpr std::int32_t kGraspLacks = 5;

/// A sentence about what a grasp lacks, such as "a grasp needs a finger as well, or the palm and a middle or outer
/// segment"; empty for `kNothing`.
GLISSADE_EXPORT std::string_view words_of(GraspLack lack);

struct GLISSADE_EXPORT Grasp {
  GraspType type = GraspType::kNone;
  GraspForm form = GraspForm::kNone;
  std::int32_t object = -1;   ///< number of the touched body, as in `Contact::obstacle`; −1: none
  TouchingSegments segments;  ///< the segments that touch this body

  /// Whether the object moves with the hand.
  bool holds() const {
    return type == GraspType::kPrecision || type == GraspType::kPower || form == GraspForm::kCigarette ||
           form == GraspForm::kGravity;
  }
  GraspLack lack() const;
};

/// The grasp of a hand with fingers, from the data of the haptic loop. `Grasp::object` is not set.
GLISSADE_EXPORT Grasp grasp_of(const hands::VisibleHand& hand);

/// A sentence without a full stop, such as "power: the palm and the middle segment of the index touch".
GLISSADE_EXPORT std::string reason_of(const Grasp& grasp);

/// Follows the grasp over time. A delay keeps sensor noise from making a grasp flicker: a segment counts as touching
/// once it has touched in most of the last 40 ms, and no longer counts once it has hardly touched for 70 ms. No grasp
/// lasts longer than 70 ms without contacts in `update`. For a hand that holds a part, `GraspSimulation` also passes
/// contacts to `update` that noise may have removed. A segment may touch up to three bodies. The body with the firmest
/// grasp counts, in the order power, precision, push. A grasp that holds a part, scripted or not, takes precedence over
/// any grasp of a fixed body. Real-time safe after construction. Not thread-safe.
class GLISSADE_EXPORT GraspAnalysis {
 public:
  /// The first `fixed_bodies` bodies never move.
  explicit GraspAnalysis(const HandModel& hand, std::size_t fixed_bodies = 0)
      : meaning_(hand.meaning), first_part_(static_cast<std::int32_t>(fixed_bodies)) {}

  /// The grasp after `milliseconds` with these contacts. `up_W` is a unit vector against gravity. If `held` is not −1,
  /// the hand holds the body with the number `held`. Other bodies then count only if the contacts with this body no
  /// longer hold it.
  const Grasp& update(std::span<const LinkContact> contacts, double milliseconds,
                      const Eigen::Vector3d& up_W = Eigen::Vector3d::UnitZ(), std::int32_t held = -1);
  const Grasp& grasp() const { return grasp_; }

  /// Call this function when a link (by its number in the chain) has clearly left a body. Their contact ends at once.
  void forget(std::size_t link, std::int32_t object);

  /// Forgets all contacts, for example after a loss of tracking.
  void clear();

 private:
  /// A segment's contact with one body.
  struct Touch {
    std::int32_t object = -1;
    bool counts = false;
    double level = 0.0;                             // how much of the last milliseconds it touched, 0 to 1
    Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  // unit, from the object to the segment, the mean of them

    /// `sum_W` is the sum of the present normals, zero if the segment does not touch.
    void follow(const Eigen::Vector3d& sum_W, double share);
  };

  static constexpr std::size_t kBodiesOfLink = 3;  // a fingertip may be at an object, at its table and at a wall
  using TouchesOfLink = std::array<Touch, kBodiesOfLink>;

  void follow(std::span<const LinkContact> contacts, double milliseconds);
  /// The link's contact with this body; null if there is none, or if it does not count.
  const Touch* touch(std::size_t link, std::int32_t object) const;
  bool is_firmer(const Grasp& grasp, const Grasp& other) const;
  Grasp analyze(std::int32_t object, const Eigen::Vector3d& up_W) const;
  GraspForm form_of(const Grasp& grasp, const Eigen::Vector3d& up_W) const;
  GraspForm precision_form(const Grasp& grasp) const;
  bool carries(const Grasp& grasp, const Eigen::Vector3d& up_W) const;
  bool are_opposed(const Grasp& grasp) const;
  /// Whether the present grasp has this form and this body. The limits for keeping a grasp are wider than for a new
  /// grasp.
  bool had(GraspForm form, std::int32_t object) const { return grasp_.form == form && grasp_.object == object; }
  std::optional<Eigen::Vector3d> normal(std::int32_t object, const SegmentMeaning& segment) const;

  std::array<SegmentMeaning, kHandLinks> meaning_;
  std::int32_t first_part_;  // bodies from this number on may move
  std::array<TouchesOfLink, kHandLinks> touches_{};
  Grasp grasp_;
};

}  // namespace glissade::grasping
