#pragma once

/// The clasp of a chain round objects (paper §4). A clasp finds the collision-free posture nearest to the posture that
/// a glove asks for. The path from each posture to the next is also collision-free. The visible hand takes only the
/// postures of a clasp.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {

enum class ClaspState : std::uint8_t {
  kClasping,  ///< the posture is collision-free, and follows the target as far as objects allow
  /// The chain has not been free since the start, since a motion of the cart, or since an object was placed where the
  /// chain is. The posture stays the same, and there are no forces. The clasp begins once the target is free.
  kWaiting,
  kLost,  ///< the tracker has lost the hand (`lose_track`); else like `kWaiting`, until the next target
};

GLISSADE_EXPORT std::string_view name_of(ClaspState state);

struct ClaspRules {
  /// The gap (metres) at which contacts stop a link.
  double margin = 20e-6;
  /// A link touches an object if their distance is less than `touching` (metres, at most 0.2 mm) and the link's target
  /// lies deeper in the object than the link. For an obstacle with a greater margin of its own, `touching` is increased
  /// by the difference of the margins.
  double touching = 0.1e-3;
  /// The greatest number of steps in a call. Each step is proven collision-free. With more steps, the chain follows a
  /// fast hand more closely.
  int most_steps = 8;
  /// Work after which a call takes no further step, in the unit of `contact::SlidingRules::work_budget`. The next call
  /// continues after the last step. A step that has begun is always completed. If a call takes no step, one flex value
  /// (`FlexValue`) may still try to move alone. Positive; std::nullopt means no limit.
  std::optional<std::int64_t> work_budget{};
};

/// A link near an object.
struct LinkContact {
  std::size_t link = 0;
  contact::Contact contact;  ///< `Contact::obstacle` counts the fixed bodies first, then the objects
  double depth = 0.0;        ///< distance of the link's target beyond the contact; metres, to first order
};

/// Only surfaces stop a link, not the volume within them, because meshes may be open. So a chain wholly within a closed
/// object counts as free and cannot leave the object. A chain also counts as free if an object is wholly within one of
/// its links.
///
/// Deterministic. Not thread-safe.
class GLISSADE_EXPORT Clasp {
 public:
  /// `fixed` are bodies that never move. `objects` stand still during a call, and may be placed elsewhere between
  /// calls. The links of the chain may touch each other. Throws std::invalid_argument for a null chain, for a chain
  /// without meshes and for rules out of range. Also throws what the constructor of `contact::CertifiedBodies` throws.
  /// Cost: building the trees of the links.
  Clasp(std::shared_ptr<const KinematicChain> chain, std::vector<contact::Obstacle> fixed,
        std::vector<std::shared_ptr<const contact::SlidingPart>> objects, const ClaspRules& rules = {});
  Clasp(Clasp&&) noexcept;
  Clasp& operator=(Clasp&&) noexcept;
  ~Clasp();

  const KinematicChain& chain() const;
  /// The links with meshes, in order.
  const std::vector<std::shared_ptr<const contact::SlidingPart>>& bodies() const;

  /// Places an object. If the chain is then not free, the clasp waits.
  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB);

  /// Places an object without a check. The caller must know that the object has touched nothing on its path.
  void place_free_object(std::size_t object, const Eigen::Isometry3d& X_WB);
  /// Places, without a check, a chain that moves with the object that it holds. The caller must know that the chain has
  /// touched nothing on its path. The root is then at its target, so the targets of its links need not lie deeper in
  /// the object than the links. Therefore, in the next call of `advance`, a link near an object touches this object
  /// unless the link's target leads away from the object.
  void carry(const Posture& posture);

  /// Moves the chain towards the target. Flex values beyond a limit are set to the limit. If the target is not finite,
  /// posture and contacts stay the same.
  void advance(const Posture& target);

  /// Call this function when the tracker has lost the hand. From then on, nothing touches. The clasp begins anew at the
  /// next free target, wherever this target is. If the target is inside an object, the clasp begins at the old posture,
  /// provided that this posture is still free.
  void lose_track();

  /// Call this function when the target is not known. Nothing touches until the next call of `advance`.
  void forget_contacts();

  /// Moves the chain with the user's cart (a vehicle that takes the user to another place), even through obstacles. The
  /// clasp waits until a target is free. Ignores a posture that is not finite.
  void move_cart(const Posture& target);

  ClaspState state() const;
  const Posture& posture() const;
  /// The last target, within the limits of the chain.
  const Posture& target() const;
  /// For each link, by its number in the chain, whether the link touches. The link itself must touch an object, and its
  /// target must lie deeper in this object. Contacts of links that hang on this link do not count. Unlike in the paper,
  /// the order in which joints were stopped does not matter.
  std::span<const char> touching() const;
  /// The contacts of all links that touch.
  const std::vector<LinkContact>& contacts() const;
  /// The postures at the ends of the steps of the last call. From each posture to the next, the root moves along a line
  /// and rotates at a constant rate about its origin, and the flex values change at constant rates. This motion is
  /// proven collision-free.
  std::span<const Posture> way() const;

 private:
  class Iteration;
  std::unique_ptr<Iteration> iteration_;
};

}  // namespace glissade::grasping
