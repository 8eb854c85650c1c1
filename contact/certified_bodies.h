#pragma once

/// Rigid bodies that move at once, such as the links of a chain, among bodies that stand still meanwhile: which
/// contacts are near, and the proof that a motion touches nothing on its whole way.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/bodies_motion.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>

namespace glissade::contact {

/// Bodies are numbered: fixed ones first, then objects, then movers. Objects stand still while movers move; between two
/// motions the caller may place them elsewhere. Pairs of movers are never considered, nor are pairs of the others. Not
/// thread-safe. After the first few calls with the same bodies, only new contacts allocate.
class CertifiedBodies {
 public:
  /// The movers keep `margin` (metres) from everything as far as the user of this class can help it, and a certified
  /// motion keeps kMinClearanceOfMargin of it. Throws std::invalid_argument as `MultiPartSliding` does for bodies,
  /// poses and margins, and when there is no mover.
  CertifiedBodies(std::vector<Obstacle> fixed, std::vector<std::shared_ptr<const SlidingPart>> objects,
                  const std::vector<std::shared_ptr<const SlidingPart>>& movers, double margin);
  CertifiedBodies(CertifiedBodies&&) noexcept;
  CertifiedBodies& operator=(CertifiedBodies&&) noexcept;
  ~CertifiedBodies();

  std::size_t fixed_count() const;
  std::size_t object_count() const;
  std::size_t mover_count() const;
  double margin() const;
  /// The greatest of this margin and those that obstacles have of their own.
  double greatest_margin() const;

  /// Places an object, or all movers, at rigid poses. Nothing is proved of the way there. The pose of mover i is entry
  /// numbers[i] of X_WM.
  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB);
  void place_movers(std::span<const Eigen::Isometry3d> X_WM, std::span<const std::size_t> numbers);

  /// Whether no mover touches anything at the present poses, or comes nearer than the smallest certain distance. Exact.
  bool is_free() const;

  /// Finds everything within its `reach` (metres, at most 50 mm) of each mover. A search looks farther, and serves
  /// until the mover has used this up, so movers that hardly move cost nothing. Throws std::invalid_argument for a pose
  /// that is not rigid.
  void look(std::span<const double> reach);
  /// The pairs of triangles and boxes that the last search of a mover has found: the calls below look at all of them.
  std::size_t pair_count(std::size_t mover) const;
  /// Work of all calls of `look`, `find_contacts` and `certify` so far, in the unit of `SlidingRules::work_budget`:
  /// rough.
  std::int64_t work() const;

  /// Replaces `contacts` by those within the reach of the last `look`, at the present poses. `Contact::part` is the
  /// number of the mover, `Contact::obstacle` that of the other body; normals point to the mover. Gaps are positive.
  void find_contacts(std::vector<Contact>& contacts);

  /// Whether the motion, from the present poses, certainly touches nothing. Motions that are longer than the reach of
  /// the last `look` cost another search. `failures` are the contacts in the way, at the present poses; without any,
  /// the motion is too long. Does not move anything.
  bool certify(const BodiesMotion& motion, std::vector<Contact>& failures);
  /// The same, and whether the motion also takes at most so much (metres, less than `margin()`) of every margin.
  bool certify_taking(double most_taken, const BodiesMotion& motion, std::vector<Contact>& failures);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade::contact
