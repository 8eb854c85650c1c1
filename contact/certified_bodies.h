#pragma once

/// Rigid bodies that move together among bodies that stand still, for example the links of a chain. `CertifiedBodies`
/// finds near contacts. It also proves that a motion touches nothing on its whole path.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>

namespace glissade::contact {

/// Bodies are numbered: first the fixed bodies, then the objects, then the movers. Objects stand still while movers
/// move. Between two motions, the caller may move objects to other places. Only pairs of a mover and a fixed body, and
/// of a mover and an object, are considered. Not thread-safe. After the first few calls with the same bodies, memory is
/// allocated only for new contacts.
class GLISSADE_EXPORT CertifiedBodies {
 public:
  /// `margin` (metres) is the gap to all other bodies at which the caller should stop the movers. A certified motion
  /// keeps a gap of at least kMinClearanceOfMargin × `margin`. Throws std::invalid_argument if there is no mover. Also
  /// throws for bodies, poses and margins that `MultiPartSliding` refuses.
  CertifiedBodies(std::vector<Obstacle> fixed, std::vector<std::shared_ptr<const SlidingPart>> objects,
                  const std::vector<std::shared_ptr<const SlidingPart>>& movers, double margin);
  CertifiedBodies(CertifiedBodies&&) noexcept;
  CertifiedBodies& operator=(CertifiedBodies&&) noexcept;
  ~CertifiedBodies();

  std::size_t fixed_count() const;
  std::size_t object_count() const;
  std::size_t mover_count() const;
  double margin() const;
  /// The largest of `margin()` and the margins of the obstacles.
  double greatest_margin() const;

  /// Places an object, or all movers, at given poses. The path from the old poses is not examined. The pose of mover i
  /// is X_WM[numbers[i]].
  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB);
  void place_movers(std::span<const Eigen::Isometry3d> X_WM, std::span<const std::size_t> numbers);

  /// Whether every mover is apart from all fixed bodies and objects at the present poses. Exact, except that a distance
  /// below the bound of rounding errors counts as touching.
  bool is_free() const;

  /// Finds all surfaces within reach[i] (metres, at most 50 mm) of each mover i. A search covers a radius larger than
  /// the reach. Later calls reuse its result until the mover has moved by radius minus reach. So a mover that hardly
  /// moves needs no search. Throws std::invalid_argument for a pose that is not rigid.
  void look(std::span<const double> reach);
  /// Number of pairs of triangles or boxes that the last search for a mover found. `find_contacts` and `certify`
  /// examine all these pairs.
  std::size_t pair_count(std::size_t mover) const;
  /// Approximate work of all calls of `look`, `find_contacts` and `certify` so far, in the unit of
  /// `SlidingRules::work_budget`.
  std::int64_t work() const;

  /// Replaces `contacts` by the contacts within the reach of the last `look`, at the present poses. `Contact::part` is
  /// the number of the mover, and `Contact::obstacle` is the number of the other body. Normals point to the mover. Gaps
  /// are positive.
  void find_contacts(std::vector<Contact>& contacts);

  /// Proves that `motion` from the present poses touches nothing. Returns false if no proof is found. `failures` then
  /// has the contacts that prevent the proof, at the present poses. If the result is false and `failures` is empty, the
  /// motion is too long. A motion longer than the reach of the last `look` requires another search. No body moves.
  bool certify(const BodiesMotion& motion, std::vector<Contact>& failures);
  /// Like `certify`. Also proves that the gap of every pair of bodies never falls below the pair's margin minus
  /// `most_taken` (metres, less than `margin()`).
  bool certify_taking(double most_taken, const BodiesMotion& motion, std::vector<Contact>& failures);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade::contact
