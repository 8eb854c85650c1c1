#pragma once

/// Sliding contact of several parts that are held at once, in two hands or by scripts that move them (paper §3): each
/// visible part follows its ghost as nearly as obstacles and other parts allow, and nothing is ever inside anything,
/// neither at rest nor on its way.
///
/// The method is sequential projection with a margin and a certificate. Each cycle finds the contacts within reach,
/// projects the wanted displacements on what they allow, in the metric of the couplings, and takes the step only when
/// every triangle pair within reach is proved apart on its whole path. The paper's bisection finds the instant of
/// contact instead and derives a new direction from it; at that instant the gap is zero, where a closed predicate
/// already says "colliding" and no further motion is possible, so here contacts hold parts one margin away.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/anti_jam.h>
#include <glissade/haptics/candidate_pairs.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/friction.h>
#include <glissade/haptics/metaphor.h>
#include <glissade/haptics/motion.h>
#include <glissade/haptics/overlaps.h>
#include <glissade/haptics/path_certificate.h>
#include <glissade/haptics/projection.h>
#include <glissade/haptics/sliding_result.h>
#include <glissade/haptics/sliding_simulation.h>
#include <glissade/haptics/surroundings.h>

namespace glissade::haptics {

/// How far the lag of a part under force feedback may change in a tick beyond the ghost's own motion: it takes the
/// jumps out of the force where the part snaps into a gap.
inline constexpr double kSlew_m = 0.2e-3;

/// How fast the offset of a grasp closes under force feedback, metres a millisecond: half of the slew, so that the part
/// can slide and be led meanwhile.
inline constexpr double kClosing_m = 0.5 * kSlew_m;

/// What becomes of a part that overlaps an obstacle at its start; two parts must not.
enum class OverlapRule : std::uint8_t {
  kRefuse,  ///< it cannot be held there
  /// The part goes a short way out, straight and without turning, by kSlew_m a millisecond, wherever the hand wants it;
  /// from the moment they are a margin apart it follows again, and the obstacle is like any other. Other obstacles are
  /// as ever, so where they are in the way it stays. Out of several it is led one after the other, the deepest first.
  kLeadOut,
};

/// How contact is simulated, for all parts.
struct SlidingRules {
  /// Projection cycles in one call: more follow corners more closely, fewer bound the work.
  int max_cycles = 10;
  /// Metres at which contacts hold a part away; by default 1e-4 of the part's radius, but 2 to 10 µm. Obstacles may
  /// have margins of their own.
  std::optional<double> margin{};
  Friction friction{};
  OverlapRule overlap = OverlapRule::kRefuse;
  /// Shake parts that are stuck, see `AntiJam`.
  bool anti_jam = false;
  /// Look for what is near in a thread of its own, ahead of need, so that few calls wait for it; for simulations in
  /// real time. Poses and forces are the same to the bit.
  bool has_search_thread = false;
};

/// One of the parts and who holds it. A part that moves on its own is one held by a script, with a stiffer grip than
/// those it pushes; what it cannot push out of its way it waits for.
struct HeldPart {
  std::shared_ptr<const SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
  Metaphor metaphor = Metaphor::kForceFeedback;
  /// By default that of `default_stiffness`: k_r = k_t ρ².
  std::optional<CouplingStiffness> stiffness{};
  std::string name = "the part";  ///< for messages
  bool is_scripted = false;       ///< goes where its script says or waits: it is neither shaken nor led out of anything
};

/// The simulation of up to kMaxParts parts among fixed obstacles. Deterministic: the same calls give the same bits.
/// Not thread-safe; several simulations may share bodies.
class JointSliding {
 public:
  /// Throws std::invalid_argument when there is no part or too many, nothing to touch, a pose or a number that is none,
  /// when parts overlap each other at their start, and when one overlaps an obstacle, unless the rules lead it out.
  /// Bodies that are no further apart than can be told for certain count as overlapping.
  JointSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts, const SlidingRules& rules = {});

  /// As in `SlidingSimulation`, for one of the parts, which must be below `part_count`. A part that is released stands
  /// still like an obstacle. Where a ghost takes hold at an offset under force feedback, the part is wanted where it
  /// was wanted before, or where it is, and from there to the ghost by kClosing_m a millisecond: neither part nor force
  /// jumps.
  void grasp(std::size_t part, const Eigen::Isometry3d& X_WG);
  void release(std::size_t part);

  /// As `SlidingSimulation::advance`, for all parts at once; there must be one pose for each.
  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds = 1.0);

  std::size_t part_count() const { return parts_.size(); }
  const SlidingResult& result(std::size_t part) const { return parts_[part].result; }
  const SlidingPart& part(std::size_t part) const { return *parts_[part].part_V; }
  const CouplingStiffness& stiffness(std::size_t part) const { return parts_[part].stiffness; }
  /// Metres at which contacts hold a part away.
  double margin(std::size_t part) const { return parts_[part].margin; }
  /// What is around the parts.
  const Surroundings& surroundings() const { return surroundings_; }
  /// What looking for it took.
  const SearchAccount& search_account() const { return candidates_.account(); }

 private:
  struct Part {
    std::shared_ptr<const SlidingPart> part_V;
    Metaphor metaphor;
    CouplingStiffness stiffness;
    double margin;
    bool is_scripted;
    AntiJam anti_jam;
    SlidingResult result{};
    Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();       // where it is aimed, mostly X_WT
    Eigen::Isometry3d X_WG_then = Eigen::Isometry3d::Identity();  // the ghost in the last call
    double ghost_motion = 0.0;                                    // metres, of this tick
    Displacement offset{};  // from the ghost to where the part is wanted, since it was taken hold of
    double closing = 0.0;   // metres that the offset became less in this tick
    double moved = 0.0;     // metres, in this tick
    // The part before the last call and before this one, from which friction knows what slips.
    Eigen::Isometry3d X_WV_before_last = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d X_WV_before = Eigen::Isometry3d::Identity();
    Displacement lag_then{};  // from the part to where it was wanted, at the end of the last call
    double slew = 0.0;        // metres that this lag may change by in this tick
  };
  using Displacements = std::array<Displacement, kMaxParts>;

  /// Displacements that are proved free, and what led to them.
  struct Step {
    Displacements displacements{};
    std::array<double, kMaxParts> lengths{};  ///< their motion bounds, metres
    std::array<bool, kMaxParts> arrives{};    ///< nothing shortened or turned it
    double length = 0.0;                      ///< the sum of the lengths: what two bodies can come nearer by
    bool clipped = false;                     ///< shortened by the reach, the slew or a missing proof
  };

  bool is_held(const Part& part) const { return part.result.state != SlidingState::kReleased; }
  bool is_shaken(const Part& part) const { return rules_.anti_jam && !part.is_scripted; }
  void let_rest(Part& part, SlidingState state);
  void close_offset(Part& part, double most) const;
  void find_overlaps(const std::vector<HeldPart>& parts);
  void raise_floors();
  double gap_of(const BodyPair& pair, double limit);
  bool take_ghosts(std::span<const Eigen::Isometry3d> X_WG, double milliseconds);
  void lead_out(double most);
  void aim();
  Step cycle();
  double choose_reach() const;
  void look_around();
  void find_rows();
  Displacement lag_of(const Part& part) const;
  Eigen::Vector3d reference_point(std::size_t part) const;
  void add_row(std::int32_t obstacle, std::size_t part, const Eigen::Vector3d& n_W, const Eigen::Vector3d& p_W,
               double bound);
  Step certified_step(std::span<const Displacement> wanted);
  bool prove(const Displacements& displacements, Step& step);
  std::array<bool, kMaxParts> parts_that_fail() const;
  bool project_on_rows(std::span<const Displacement> wanted);
  void solve_friction(std::span<const Displacement> wanted);
  bool slipped(const JointRow& row) const;
  void remember_forces();
  std::array<double, kMaxParts> allowed_fractions(const Displacements& d) const;
  void add_rows_for_failures();
  double energy(std::span<const Displacement> errors) const;
  double allowance(std::span<const Displacement> errors) const;
  void apply(const Step& step);
  void hand_out_contacts();
  SlidingState classify(const Part& part) const;

  SlidingRules rules_;
  std::vector<Part> parts_;
  Surroundings surroundings_;
  CandidatePairs candidates_;
  PathCertificate certificate_;
  Overlaps overlaps_;
  std::vector<BodyPair> near_starts_;  // nearer than their floor would be
  collision::QueryWorkspace workspace_;
  double largest_margin_ = 0.0;

  std::vector<CandidatePair> pairs_;      // within reach
  std::vector<Obligation> obligations_;   // of the step that is being proved
  std::vector<Contact> contacts_;         // one for each of the first rows
  std::vector<JointRow> rows_;            // those of contacts, then those of failed proofs
  std::vector<Contact> proof_contacts_;   // one for each of the latter
  std::vector<CouplingStiffness> grips_;  // infinite for a part that is released
  ProjectionSolver solver_;
  FrictionSolver friction_solver_;
  std::vector<double> coefficients_;  // of friction, one for each row
  Displacements projected_;
  std::vector<RowForce> forces_;
  std::vector<Contact> pushed_;         // in the last cycle, where there is friction
  std::vector<RowForce> first_forces_;  // of the contacts alone
  std::vector<UncertifiedPair> failures_;
  double led_out_ = 0.0;  // metres that a part is led out of something in this tick
  double reach_ = 0.0;
  double last_step_ = 0.0;  // metres
  bool last_clipped_ = false;
  double reach_limit_;    // metres; adapts to how many pairs the queries find
  double damping_ = 0.0;  // Levenberg–Marquardt
};

}  // namespace glissade::haptics
