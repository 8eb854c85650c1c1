#pragma once

/// What the parts could reach soon, kept over several steps: one search serves as long as nothing has certainly moved
/// further than it looked. The next one is asked for ahead of need, when half of that way is used up, and taken when
/// all of it is. Where each begins and is taken depends on the motion alone; so a thread of its own may work on it
/// meanwhile, and the bits are the same without one.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/contact_scene.h"
#include <glissade/haptics/sliding_simulation.h>

#include "search/candidate_search.h"
#include "search/search_thread.h"

namespace glissade::haptics {

/// Not thread-safe.
class CandidatePairs {
 public:
  /// The scene must outlive this object. Nothing further than `greatest_radius` (metres) can be asked for.
  CandidatePairs(const ContactScene& scene, double greatest_radius, bool has_own_thread = false);
  CandidatePairs(const CandidatePairs&) = delete;
  CandidatePairs& operator=(const CandidatePairs&) = delete;
  ~CandidatePairs();

  /// Makes sure that every pair within `reach` (metres) of where the parts are placed is among the candidates, but
  /// those of bodies that are `ignored`; whoever looks looks `ahead` (metres) further. Pairs that are ignored must be
  /// the same in all calls until `clear`. Returns whether the candidates are others than before. What a search
  /// throws, for memory that is not to be had or a pose that is none, reaches the caller; nothing is covered then.
  bool look(double reach, double ahead, std::span<const BodyPair> ignored);

  /// The parts are placed elsewhere now.
  void moved();

  /// Forgets everything: covers nothing until the next search.
  void clear();

  /// Whether every pair within `reach` of the parts' present poses is certainly among the candidates.
  bool covers(double reach) const { return now_.covers(reach); }

  /// Replaces `pairs` by the candidates that may be within `reach` of the parts' present poses, nearest first by the
  /// poses of the search.
  void within(double reach, std::vector<CandidatePair>& pairs) const { now_.collect(now_.set.pairs, reach, pairs); }
  /// The same of all pairs, with features or not, in boxes as large as proofs take them.
  void within(double reach, std::vector<PairToCertify>& to_certify) const {
    now_.collect(now_.set.to_certify, reach, to_certify);
  }

  /// Number of pairs, and of to_certify.
  std::size_t size() const { return now_.set.pairs.size() + now_.set.to_certify.size(); }

  const SearchAccount& account() const { return account_; }

 private:
  /// How a body has moved since a search: no point of it by more than `turn` off `v`.
  struct Motion {
    Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // metres
    double turn = 0.0;                              // metres
  };
  /// A search, and how far the bodies have come since its poses.
  struct Search {
    CandidateRequest request;
    CandidateSet set;
    std::vector<Motion> motions;  // of each body
    double half = 0.0;            // metres of drift at which the next one is asked for
    double drift = 0.0;           // metres: no two points of different bodies have come nearer by more
    bool is_there = false;        // or will be, when the thread is done with it

    bool covers(double reach) const { return is_there && reach + drift <= request.radius; }
    /// Metres that two triangles or boxes are certainly apart still, where the unit vector n_W kept them `distance`
    /// apart; or, where n_W is zero, nobody knows which.
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
  SearchAccount account_;
  std::optional<SearchThread> thread_;  // last: it works on the others
};

}  // namespace glissade::haptics
