#pragma once

/// Pairs that the parts may reach soon, kept over several steps: one search serves until the motion of the parts has
/// used up its look-ahead. The next search is requested ahead of need, when half of the look-ahead is used up, and its
/// answer is taken when all of it is. Both moments depend on the motion alone; therefore a thread of its own may run
/// the search meanwhile without changing a bit.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glissade/haptics/sliding_simulation.h>

#include "scene/contact_scene.h"
#include "search/candidate_search.h"
#include "search/search_thread.h"

namespace glissade::haptics {

/// Not thread-safe.
class CandidatePairs {
 public:
  /// The scene must outlive this object. In `look`, reach + ahead must not exceed `greatest_radius` (metres).
  CandidatePairs(const ContactScene& scene, double greatest_radius, bool has_own_thread = false);
  CandidatePairs(const CandidatePairs&) = delete;
  CandidatePairs& operator=(const CandidatePairs&) = delete;
  ~CandidatePairs();

  /// Makes every pair within `reach` (metres) of the parts' present poses a candidate, except pairs of `ignored`
  /// bodies. A new search uses radius reach + `ahead` (metres). Returns whether the candidates changed. `ignored` must
  /// be the same in all calls until `clear`. Exceptions of a search (no memory, or a pose that `geometry::rigid_pose`
  /// rejects) reach the caller; nothing is covered then.
  bool look(double reach, double ahead, std::span<const BodyPair> ignored);

  /// To be called when parts have been placed at other poses.
  void moved();

  /// Discards all candidates: nothing is covered until the next `look`.
  void clear();

  /// Whether every pair within `reach` (metres) of the parts' present poses is certainly among the candidates.
  bool covers(double reach) const { return now_.covers(reach); }

  /// Replaces `pairs` by the candidates that may be within `reach` (metres) of the parts' present poses, in ascending
  /// order of the distance at the poses of the search.
  void within(double reach, std::vector<CandidatePair>& pairs) const { now_.collect(now_.set.pairs, reach, pairs); }
  /// The same for the pairs to certify, which hold all triangles, with features or without, in the largest boxes that
  /// separate.
  void within(double reach, std::vector<PairToCertify>& to_certify) const {
    now_.collect(now_.set.to_certify, reach, to_certify);
  }

  /// Number of candidate pairs plus number of pairs to certify.
  std::size_t size() const { return now_.set.pairs.size() + now_.set.to_certify.size(); }

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
    std::vector<Motion> motions;  // of each body
    double half = 0.0;            // metres of drift at which the next search is requested
    double drift = 0.0;           // metres: bound of how much nearer two bodies have come
    bool is_there = false;        // requested; a thread may still be working on it

    bool covers(double reach) const { return is_there && reach + drift <= request.radius; }
    /// Lower bound (metres) of the present distance of two triangles or boxes that the unit vector n_W separated by
    /// `distance`. If n_W is zero, that direction is unknown.
    double still_apart(const BodyPair& bodies, double distance, const Eigen::Vector3d& n_W) const {
      const Motion& of_obstacle = motions[static_cast<std::size_t>(bodies.obstacle)];
      const Motion& of_part = motions[static_cast<std::size_t>(bodies.part)];
      const Eigen::Vector3d v_W = of_part.v_W - of_obstacle.v_W;
      const double apart = n_W.isZero(0.0) ? -v_W.norm() : n_W.dot(v_W);
      return distance + apart - of_part.turn - of_obstacle.turn;
    }
    template <typename Pair>
    void collect(const std::vector<Pair>& pairs, double reach, std::vector<Pair>& found) const;
  };

  void ask(Search& search, double reach, double ahead, std::span<const BodyPair> ignored);
  void answer(Search& search);
  void follow(Search& search) const;
  void forget();

  const ContactScene& scene_;
  CandidateSearch search_;
  Search now_;
  Search next_;
  SearchStatistics statistics_;
  std::optional<SearchThread> thread_;  // last: it uses the members above
};

}  // namespace glissade::haptics
