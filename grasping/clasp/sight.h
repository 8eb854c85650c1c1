#pragma once

/// How far the links of a chain look for contacts: as far as their next step may lead, and not much farther.

#include <cstddef>
#include <span>
#include <vector>

#include <glissade/contact/certified_bodies.h>
#include <glissade/contact/contact_body.h>

namespace glissade::grasping {

/// A clasped hand wants far more than it can do: the steps that a link takes say how far to look, and so does the
/// number of pairs that a search finds. Distances are in metres. Not thread-safe.
class Sight {
 public:
  static constexpr double kLeast_m = 0.2e-3;

  /// `least`: all contacts that count are within it.
  Sight(std::size_t movers, double least);

  /// Of each mover.
  std::span<const double> reach() const { return reach_; }

  /// For a step that would be this motion, if nothing were in the way.
  void choose(const contact::BodiesMotion& motion, double margin);
  /// Only contacts that count.
  void choose_least();
  /// What the last look has found.
  void note_found(const contact::CertifiedBodies& bodies);
  /// The step that was taken; null: none was.
  void note_taken(const contact::BodiesMotion* motion);

  /// The share of the motion on which no link goes beyond what it has seen.
  double share_of(const contact::BodiesMotion& motion) const;

 private:
  double least_;
  std::vector<double> reach_;
  std::vector<double> next_reach_;  // that the last steps of the mover suggest
  std::vector<double> limit_;       // that the pairs found allow
};

}  // namespace glissade::grasping
