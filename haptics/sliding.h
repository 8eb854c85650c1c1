#pragma once

/// Sliding contact (paper §3): the visible part follows the ghost as nearly as the obstacles allow, and is never inside
/// anything, neither at rest nor on its way.
///
/// The method is sequential projection with a margin and a certificate. Each cycle finds the contacts within reach,
/// projects the wanted displacement on what they allow, in the metric of the coupling, and takes the step only when
/// every triangle pair within reach is proved apart on its whole path. The paper's bisection finds the instant of
/// contact instead and derives a new direction from it; at that instant the gap is zero, where a closed predicate
/// already says "colliding" and no further motion is possible, so here contacts hold the part one margin away.

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/candidate_pairs.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/metaphor.h>
#include <glissade/haptics/motion.h>
#include <glissade/haptics/path_certificate.h>
#include <glissade/haptics/projection.h>
#include <glissade/haptics/sliding_simulation.h>
#include <glissade/haptics/surroundings.h>

namespace glissade::haptics {

/// What a part under force feedback may catch up in a tick beyond twice the ghost's own motion: it takes the jumps out
/// of the force where the part snaps into a gap.
inline constexpr double kSlew_m = 0.2e-3;

struct SlidingOptions {
  Metaphor metaphor = Metaphor::kForceFeedback;
  /// By default 1000 N/m, and as much against rotation as that gives at the part's radius: k_r = k_t ρ².
  std::optional<CouplingStiffness> stiffness;
  /// Projection cycles in one call: more follow corners more closely, fewer bound the work.
  int max_cycles = 10;
};

/// The simulation of one part among fixed obstacles. Deterministic: the same calls give the same bits.
/// Not thread-safe; several simulations may share bodies.
class Sliding final : public SlidingSimulation {
 public:
  /// Throws std::invalid_argument when there is no obstacle, and when the part collides with one at X_WV_start.
  Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
          const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {});

  void grasp(const Eigen::Isometry3d& X_WG) override;
  void release() override;
  const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) override;

  const SlidingResult& result() const override { return result_; }
  const SlidingPart& part() const override { return *part_V_; }
  const CouplingStiffness& stiffness() const override { return stiffness_; }
  /// Metres at which contacts hold the part away: 1e-4 ρ, but 2 to 10 µm.
  double margin() const { return margin_; }
  /// Metres that every certified path keeps away from everything.
  double floor() const { return kFloorOfMargin * margin_; }
  /// What is around the part, and what looking for it took.
  const Surroundings& surroundings() const { return surroundings_; }

  static constexpr double kFloorOfMargin = 0.3;

 private:
  /// A displacement that is proved free, and what led to it.
  struct Step {
    Displacement displacement;
    double length = 0.0;   ///< its motion bound, metres
    bool arrives = false;  ///< nothing shortened or turned it
    bool clipped = false;  ///< shortened by the reach, the slew or a missing proof
  };

  static const Step kNoStep;

  Step cycle(double budget);
  double choose_reach(double budget) const;
  void refresh_candidates();
  void find_rows();
  Step certified_step(const Displacement& wanted, double budget);
  bool prove(const Displacement& displacement, Step& step);
  bool project_on_rows(const Displacement& wanted);
  double allowed_fraction(const Displacement& d, double budget) const;
  void add_rows_for_failures();
  double energy(const Displacement& error) const;
  void apply(const Step& step);
  SlidingState classify(double moved) const;
  void let_rest(SlidingState state);

  std::shared_ptr<const SlidingPart> part_V_;
  Surroundings surroundings_;
  CouplingStiffness stiffness_;
  Metaphor metaphor_;
  int max_cycles_;
  double margin_;
  CandidatePairs candidates_;
  PathCertificate certificate_;

  SlidingResult result_;
  std::vector<ConstraintRow> rows_;      // one for each contact, then those of failed proofs
  std::vector<Contact> proof_contacts_;  // one for each of the latter
  Projection projection_;
  std::vector<UncertifiedPair> failures_;
  double ghost_motion_ = 0.0;  // metres, of this tick
  double last_step_ = 0.0;     // metres
  bool last_clipped_ = false;
  double reach_limit_;    // metres; adapts to how many pairs the queries find
  double damping_ = 0.0;  // Levenberg–Marquardt
};

}  // namespace glissade::haptics
