#pragma once

/// Pairs that the parts may reach soon, kept over several steps: one search serves until the motion of the parts has
/// used up its look-ahead. The next search is requested ahead of need, and its answer is taken when the last one covers
/// too little. Both moments depend on the motion alone; therefore a thread of its own may run the search
/// meanwhile without changing a bit.
///
/// Parts mostly go on as they went. So a search is made at poses that the parts will reach some time after its answer
/// is taken: it serves on the way there and beyond. A long step needs half its length as the radius, if the search is
/// made at its middle.
///
/// The work of searching in one call of the simulation can be limited. A search then goes on over several calls, and
/// its answer can be taken in the first call up to which so much work was allowed, however early it was done.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glissade/haptics/sliding_simulation.h>

#include "certificate/path_certificate.h"
#include "scene/contact_scene.h"
#include "search/candidate_search.h"
#include "search/search_thread.h"
#include "work/work_budget.h"

namespace glissade::haptics {

/// A candidate pair by its number, with the place of its plane: among those of its bodies, which have a place among
/// all.
struct PairInReach {
  std::uint32_t number;
  std::uint32_t planes;
  std::uint32_t slot;
  float gap;  ///< metres: no contact of the pair has a smaller one
};

/// Not thread-safe.
class CandidatePairs {
 public:
  /// The scene must outlive this object. In `look` and `look_ahead`, reach + ahead must not exceed `greatest_radius`
  /// (metres). With a
  /// limit of work, searches have a thread of their own in any case. If `runs_ahead` is false, that thread never works
  /// at the same time as the caller's. Without planes, only `within` a reach tells of pairs,
  /// and searches are made when they are needed, at the present poses.
  CandidatePairs(const ContactScene& scene, double greatest_radius, bool runs_ahead = false,
                 std::int64_t work_of_call = kUnlimitedWork, bool has_planes = true);
  CandidatePairs(const CandidatePairs&) = delete;
  CandidatePairs& operator=(const CandidatePairs&) = delete;
  ~CandidatePairs();

  /// Begins a call of the simulation: from now on, searches may do `work_of_call` more work.
  void begin_call();

  /// Makes every pair within `reach` (metres) of the parts' present poses a candidate, except pairs of `ignored`
  /// bodies, in ascending order. A new search uses radius reach + `ahead` (metres). Returns whether the candidates
  /// changed. `ignored` must be the same in all calls until `clear`. Exceptions of a search (no memory, or a pose that
  /// `geometry::rigid_pose` rejects) reach the caller; nothing is covered then. Where the work of this call does not
  /// suffice for the search, the candidates stay, `covers(reach)` is still false, and the same call of `look` must be
  /// repeated.
  bool look(double reach, double ahead, std::span<const BodyPair> ignored);
  /// Takes the answer of the search that `look_ahead` requested, if it covers `reach` (metres), and a farther one than
  /// the last search on a step of length `step` (metres), if the parts go on as they went. As `look`.
  bool take_ahead(double reach, double step);
  /// Makes every pair near the way candidates that the parts would go from their present poses: `way` has a
  /// displacement for each part, and two bodies come nearer by at most `length` (metres) on it. A search is made at its
  /// middle, or at that of its beginning where the greatest radius would not suffice. Within `least` (metres, at most
  /// that radius) around the present poses, the candidates are complete afterwards. As `look`.
  bool look_along(std::span<const geometry::Displacement> way, double length, double least,
                  std::span<const BodyPair> ignored);
  /// Whether the candidates will cover another step of this length (metres), if the parts go on as they went.
  bool serve_for(double step);
  /// Requests the next search once the parts leave the poses of the last one. They are expected to go on as they went,
  /// in steps of length `step` (metres): the search is made where the next one will lead halfway, and a share of it
  /// suffices as the radius. It is at least `reach` (metres), and `ahead` (metres) more. To be called once or twice for
  /// each step; only with planes: without them nobody works ahead of need, and an earlier request would only be of
  /// earlier poses.
  void look_ahead(double step, double reach, double ahead, std::span<const BodyPair> ignored);

  /// Whether the search that `look` could not complete has had the work of several calls.
  bool is_too_large() const;
  /// Gives up the search that `look` could not complete. The next one begins afresh, and can be for a smaller radius.
  void cancel();

  /// To be called when movers have been placed at other poses.
  void moved();

  /// Discards all candidates: nothing is covered until the next `look`.
  void clear();

  /// Whether every pair within `reach` (metres) of the parts' present poses is certainly among the candidates.
  bool covers(double reach) const { return now_.covers(reach); }
  /// The largest reach (metres) that is covered; negative if none is.
  double covered() const { return now_.covered(); }
  /// The same on the whole path of the step that `certificate` has begun: other pairs do not come within this distance.
  double covered_on_path(PathCertificate& certificate);

  /// Replaces `pairs` by the candidates that may be within `reach` (metres) of the parts' present poses, in ascending
  /// order of the distance at the poses of the search.
  void within(double reach, std::vector<NearPair>& pairs) const;
  /// The same for the pairs to certify, which hold all triangles, with features or without, in the largest boxes that
  /// separate. Boxes come before triangles.
  void within(double reach, std::vector<PairToCertify>& pairs) const;

  /// The same for the step that `certificate` is about, without the pairs that a known plane keeps apart on the whole
  /// path: only those within `reach` are certain to be there. Spends the work of looking at the planes.
  void unproved_within(double reach, PathCertificate& certificate, std::vector<PairToCertify>& unproved,
                       WorkBudget& budget);
  /// Takes over the directions that `certificate` found for these pairs.
  void note_planes(std::span<const SeparatedPair> separated);

  /// Replaces `pairs` by those candidates that may have contacts within `reach` (metres) at the present poses, as far
  /// as their planes and `note_gaps` tell, in the same order.
  void in_reach(double reach, std::vector<PairInReach>& pairs);
  const NearPair& pair(std::uint32_t number) const { return now_.set.pairs[number]; }
  /// What is known of the features of a pair within `reach` (metres).
  KnownFeatures known_features(std::uint32_t number, double reach) const;
  /// The planes of the pairs of triangles, which may be turned.
  std::vector<PlanesOfBodies>& planes() { return now_.set.planes; }
  /// Notes for the pairs with these numbers that their contacts have at least these gaps (metres) at the present poses.
  void note_gaps(std::span<const std::uint32_t> numbers, std::span<const GapsOfPair> gaps);

  /// Number of pairs of triangles.
  std::size_t pair_count() const { return now_.set.pairs.size(); }
  /// Number of pairs that may yield contacts, plus that of pairs to certify.
  std::size_t size() const { return now_.set.contact_count + now_.set.certify_count; }

  /// Work of the search under way, or of the last one, so far; only with a limit of work.
  std::int64_t work_of_search() const { return thread_->work(); }
  /// Work of the search that found the candidates; 0 without a limit of work.
  std::int64_t work() const { return work_; }
  /// Number of calls that the candidates before these served.
  int calls_served() const { return calls_served_; }

  const SearchStatistics& statistics() const { return statistics_; }

 private:
  /// The motion of a body since a search: each point moved by v_W, with a deviation of at most `turn`.
  struct Motion {
    Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // metres
    double turn = 0.0;                              // metres
  };
  /// A search, and the motions of the bodies since its poses.
  struct Search {
    CandidateRequest request;
    CandidateSet set;
    std::vector<Motion> motions;                  // of each body
    double ahead = 0.0;                           // metres: the look-ahead
    double step = 0.0;                            // metres: of a step at whose middle it was made; else 0
    double drift = 0.0;                           // metres: bound of how much nearer two bodies have come
    double least_drift = 0.0;                     // metres: so far
    std::vector<Eigen::Isometry3d> X_WB_nearest;  // of each mover, when the drift was least
    bool is_there = false;                        // requested; a thread may still be working on it

    /// The largest reach (metres) around the present poses within which all pairs are known.
    double covered() const { return is_there ? request.radius - drift : -std::numeric_limits<double>::infinity(); }
    bool covers(double reach) const { return reach <= covered(); }
    /// Whether it is time for the next search.
    bool is_being_left() const;
    /// Whether the parts go away from the poses of a search whose answer has not been taken.
    bool is_in_vain() const;
    /// Lower bound (metres) of the present distance of two triangles or boxes that the unit vector n_W separated by
    /// `distance`. If n_W is zero, that direction is unknown.
    double still_apart(const BodyPair& bodies, double distance, const Eigen::Vector3d& n_W) const {
      const Motion& of_obstacle = motions[static_cast<std::size_t>(bodies.obstacle)];
      const Motion& of_part = motions[static_cast<std::size_t>(bodies.part)];
      const Eigen::Vector3d v_W = of_part.v_W - of_obstacle.v_W;
      const double apart = n_W.isZero(0.0) ? -v_W.norm() : n_W.dot(v_W);
      return distance + apart - of_part.turn - of_obstacle.turn;
    }
    template <typename Pair, typename Visit>
    void visit_within(const std::vector<Pair>& pairs, double reach, const Visit& visit) const;
  };

  bool take_next(double reach, double ahead, std::span<const BodyPair> ignored);
  bool take();
  void ask(double radius, double ahead, double forward, std::span<const BodyPair> ignored);
  void request(double radius, double ahead, std::span<const BodyPair> ignored);
  void copy_poses(std::vector<Eigen::Isometry3d>& X_WB) const;
  double covered_on_way(const Search& search, double way);
  bool take_or_forget();
  void place_ahead(double way, std::vector<Eigen::Isometry3d>& X_WB);
  bool is_settled();
  double approach_since(std::span<const Eigen::Isometry3d> X_WB, std::vector<Motion>& motions) const;
  template <typename PoseOf>
  double approach(std::span<const Eigen::Isometry3d> X_WB, const PoseOf& pose_of, std::vector<Motion>& motions) const;
  void follow(Search& search) const;
  void advance_clock();
  void place_clock();
  void forget();

  const ContactScene& scene_;
  std::int64_t work_of_call_;
  double greatest_radius_;  // metres
  bool has_planes_;
  std::int64_t work_left_;                // of this call
  std::int64_t allowed_ = 0;              // work that the thread's search may have done by now
  bool is_with_thread_ = false;           // a search, whether it is still of use or not
  std::unique_ptr<SearchThread> thread_;  // ends before the members that it uses: see the destructor
  CandidateSearch search_;
  Search now_;
  Search next_;
  std::vector<Eigen::Isometry3d> X_WB_at_taking_;  // of each mover, when the answer of the last search was taken
  std::vector<Eigen::Isometry3d> X_WB_ahead_;      // of each mover, where it is expected
  // Of the candidates: since they are there, two bodies have come nearer by at most `clock_` (metres). No contact of a
  // pair has a gap below its entry of `gaps_` minus the clock.
  double clock_ = 0.0;
  std::vector<double> gaps_;
  std::vector<KnownFeatures> known_;              // the gaps are so, too, minus the clock
  std::vector<Eigen::Isometry3d> X_WB_of_clock_;  // of each mover
  std::vector<Motion> motions_of_clock_;
  std::vector<Motion> motions_ahead_;  // scratch memory
  std::int64_t work_ = 0;
  /// A pair in the list of the last call of `unproved_within`.
  struct PlaceOfPair {
    PlanesOfBodies* planes;  // null: it has none
    std::size_t slot;
    std::uint32_t number;  // of the pair of triangles
  };
  std::vector<PlaceOfPair> places_;
  /// For the planes of each two bodies: of each block, the least gap (metres), minus the clock as above.
  using GapsOfBlocks = std::vector<std::vector<double>>;
  GapsOfBlocks gaps_at_search() const;
  template <typename Visit>
  void visit_near_blocks(const std::vector<double>& gaps, double reach, const Visit& visit) const;
  GapsOfBlocks gaps_of_contacts_;
  GapsOfBlocks gaps_to_certify_;
  std::vector<float> gaps_at_begin_;
  std::vector<float> gaps_at_end_;
  int calls_ = 0;  // since the search that found the candidates
  int calls_served_ = 0;
  SearchStatistics statistics_;
};

}  // namespace glissade::haptics
