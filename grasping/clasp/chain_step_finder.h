#pragma once

/// The steps of a clasp: each leads a chain nearer to its target, and is certified on its whole way.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glissade/contact/certified_bodies.h>
#include <glissade/grasping/kinematic_chain.h>

#include "clasp/chain_step.h"
#include "clasp/closing_rows.h"
#include "clasp/interpolation.h"
#include "clasp/sight.h"

namespace glissade::grasping {

/// Not thread-safe. The chain, the movers and the bodies must outlive this object.
class ChainStepFinder {
 public:
  /// `movers` are the links of the chain with meshes. `touching` (metres) as in `ClaspRules`.
  ChainStepFinder(const KinematicChain& chain, std::span<const std::size_t> movers, contact::CertifiedBodies& bodies,
                  double touching);

  /// Begins a call of the clasp: what is short is counted anew.
  void begin_call();
  /// The chain or an object has been placed.
  void note_placed() { is_found_here_ = false; }

  /// Finds the next step from `from`, where the chain is, and the posture after it. Returns whether there is one.
  bool find(const Posture& from, const Posture& target, Posture& next);
  /// A step of one flex value where `find` finds none: along a way that contacts only graze although as rows they stop
  /// it, or as near to all contacts of a link as its nearest one is. Each call tries one value; after a round of calls
  /// without success, no value can go on.
  bool find_alone(const Posture& from, const Posture& target, Posture& next);
  /// Whether the steps of this call have become too short for another one.
  bool is_slow() const;

  /// The contacts that count at the present posture.
  const std::vector<contact::Contact>& contacts();
  /// Work of all calls so far, in the unit of `contact::SlidingRules::work_budget`: rough.
  std::int64_t work() const;

 private:
  bool prove();
  bool go(bool slides);
  bool go_on_by_halves();
  bool go_without_failures();
  bool go_alone(const Posture& target);
  void want_alone(std::size_t value, const Posture& target);
  bool graze();
  bool go_as_near_as_the_nearest();
  bool go_a_little();
  void find_shares();
  bool find_slide();

  std::span<const std::size_t> movers_;
  contact::CertifiedBodies& bodies_;
  Sight sight_;
  ChainMotion motion_;
  ClosingRows rows_;
  Interpolation interpolation_;
  double radius_ = 0.0;  // metres: what a turn of the root counts
  Posture from_;
  ChainStep wanted_;
  ChainStep step_;
  bool slides_ = false;       // the root did not arrive
  bool is_in_doubt_ = false;  // in this step, a proof has failed
  bool is_alone_ = false;     // in this step, only one flex value moves
  int short_steps_ = 0;       // of this call
  std::size_t alone_ = 0;     // the flex value whose turn it is
  std::int64_t interpolations_ = 0;
  std::vector<contact::Contact> found_;
  bool is_found_here_ = false;  // at the present posture
  std::vector<contact::Contact> failures_;
  std::vector<double> forces_;
};

}  // namespace glissade::grasping
