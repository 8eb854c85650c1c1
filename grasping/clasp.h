#pragma once

/// The clasp of a chain round objects (paper §4): of all postures that a glove asks for, the nearest one that touches
/// nothing. The visible hand gets these postures only, and the way from each to the next is free too.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {

enum class ClaspState : std::uint8_t {
  kClasping,  ///< the posture touches nothing, and follows the target as far as objects allow
  /// The chain has not been free since the start, since the motion of the cart, or since an object was placed inside
  /// it. The posture stays where it is, and gives no forces; the clasp begins once the target is free.
  kWaiting,
  kLost,  ///< `lose_track`, and no target since: as `kWaiting`
};

std::string_view name_of(ClaspState state);

struct ClaspRules {
  /// The gap (metres) at which contacts stop a link.
  double margin = 20e-6;
  /// A link that is nearer to an object than this (metres, at most 0.2 mm) and whose target lies deeper touches it. It
  /// may be as much farther from an obstacle as that one's own margin is greater.
  double touching = 0.1e-3;
  /// The steps of one call; each has a proof. More of them follow a fast hand more closely.
  int most_steps = 8;
  /// Work after which a call takes no further step, in the unit of `contact::SlidingRules::work_budget`: the next call
  /// goes on from there. A step is never divided, and where there was none, one flex value may still try to go on
  /// alone. Positive; none: no limit.
  std::optional<std::int64_t> work_budget{};
};

/// A link near an object.
struct LinkContact {
  std::size_t link = 0;
  contact::Contact contact;  ///< `Contact::obstacle`: fixed bodies first, then objects
  double depth = 0.0;        ///< metres, to first order: how far beyond the contact the target of the link lies
};

/// Surfaces stop a link, not what they enclose, because meshes may be open: a chain that lies wholly within a closed
/// object counts as free and cannot leave it, and so does a chain that has an object wholly within one of its links.
///
/// Deterministic. Not thread-safe.
class Clasp {
 public:
  /// `fixed` are bodies that never move; `objects` stand still during a call, and may be placed elsewhere between two.
  /// The links of the chain may touch each other. Throws std::invalid_argument for a null chain, for a chain without
  /// meshes and for rules out of range. Throws also where the constructor of `contact::CertifiedBodies` does. Cost: the
  /// trees of the links.
  Clasp(std::shared_ptr<const KinematicChain> chain, std::vector<contact::Obstacle> fixed,
        std::vector<std::shared_ptr<const contact::SlidingPart>> objects, const ClaspRules& rules = {});
  Clasp(Clasp&&) noexcept;
  Clasp& operator=(Clasp&&) noexcept;
  ~Clasp();

  const KinematicChain& chain() const;
  /// The links with meshes, in their order.
  const std::vector<std::shared_ptr<const contact::SlidingPart>>& bodies() const;

  /// Places an object. If the chain is no longer free there, the clasp waits.
  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB);

  /// The same for an object of which the caller knows that it has touched nothing on its way there.
  void place_free_object(std::size_t object, const Eigen::Isometry3d& X_WB);
  /// Places the chain, which moves with an object that it holds. The caller knows that it has touched nothing on its
  /// way. In the next call of `advance`, every link that is near an object touches it unless its target leads away: a
  /// root that is led has no target that lies deeper.
  void carry(const Posture& posture);

  /// Moves the chain towards the target; flex values beyond their limits count as the limits. A target that is not
  /// finite is ignored: the posture stays, and touches what it touched.
  void advance(const Posture& target);

  /// The tracker has not seen the hand for a while. Nothing touches any more. The clasp begins anew at the next target
  /// that is free, wherever that is; where a target is inside something, from where the chain was, if that is still
  /// free.
  void lose_track();

  /// Nothing touches any more, until the next call of `advance`: nobody knows where the hand wants to go.
  void forget_contacts();

  /// Moves the chain with the user's cart, whatever is in the way: the clasp waits until a target is free. A posture
  /// that is not finite is ignored.
  void move_cart(const Posture& target);

  ClaspState state() const;
  const Posture& posture() const;
  /// The last target, within the limits of the chain.
  const Posture& target() const;
  /// Whether a link touches, by its number in the chain: it must itself be at an object, with a target that lies
  /// deeper. That links beyond it touch does not count. Which joint was stopped first does not matter, other than in
  /// the paper.
  std::span<const char> touching() const;
  /// The contacts of all links that touch.
  const std::vector<LinkContact>& contacts() const;
  /// The postures at which the steps of the last call ended. The root moves straight and by a rotation at a constant
  /// rate about its origin from each to the next, and the flex values at constant rates; all of this is proven free.
  std::span<const Posture> way() const;

 private:
  class Iteration;
  std::unique_ptr<Iteration> iteration_;
};

}  // namespace glissade::grasping
