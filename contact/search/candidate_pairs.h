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
///
/// With planes, the memory of a search is limited, too: one that finds too many pairs, of triangles and of boxes, ends
/// without an answer.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glissade/contact/statistics.h>

#include "certificate/path_certificate.h"
#include "scene/contact_scene.h"
#include "search/approach.h"
#include "search/candidate_search.h"
#include "search/known_pairs.h"
#include "search/search_thread.h"
#include "search/tracked_search.h"
#include "search/way_ahead.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// These take 0.4 GB; there is the memory of two searches.
inline constexpr std::size_t kMostPairs = 2'000'000;

/// Not thread-safe.
class CandidatePairs {
 public:
  /// The scene must outlive this object. In `look` and `look_ahead`, reach + ahead must not exceed `greatest_radius`
  /// (metres). With a limit of work, searches have a thread of their own in any case. If `runs_ahead` is false, that
  /// thread never works at the same time as the caller's. Without planes, only `KnownPairs::within` tells of pairs, and
  /// searches are made when they are needed, at the present poses; their pairs are not limited to `most_pairs`.
  CandidatePairs(const ContactScene& scene, double greatest_radius, bool runs_ahead = false,
                 std::int64_t work_of_call = kUnlimitedWork, bool has_planes = true,
                 std::size_t most_pairs = kMostPairs);
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
  /// repeated. Where the search finds too many pairs, the candidates stay, and `found_too_many` tells so: the next one
  /// must be for a smaller radius, or be allowed more pairs.
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
  /// Requests the next search once the parts leave the poses of the last one, or at once if that found very many pairs.
  /// They are expected to go on as they went, in steps of length `step` (metres): the search is made where the next one
  /// will lead halfway, and a share of it suffices as the radius. It is at least `reach` (metres), and `ahead` (metres)
  /// more. To be called once or twice for each step; only with planes: without them nobody works ahead of need, and an
  /// earlier request would only be of earlier poses.
  void look_ahead(double step, double reach, double ahead, std::span<const BodyPair> ignored);

  /// Whether the last search has ended because it found too many pairs.
  bool found_too_many() const { return found_too_many_; }
  /// Whether it has, or the one that `look` could not complete has had the work of several calls.
  bool is_too_large() const;
  /// Gives up the search that `look` could not complete. The next one begins afresh, and can be for a smaller radius.
  void cancel();
  /// To be called where a search finds too many pairs within the smallest radius.
  void allow_twice_as_many();
  /// Whether the candidates are more than half as many as they may be.
  bool are_many() const;

  /// To be called when movers have been placed at other poses.
  void moved();

  /// Discards all candidates: nothing is covered until the next `look`.
  void clear();

  /// Whether every pair within `reach` (metres) of the parts' present poses is certainly among the candidates.
  bool covers(double reach) const { return now_.search().covers(reach); }
  /// The largest reach (metres) that is covered; negative if none is.
  double covered() const { return now_.search().covered(); }
  /// The same on the whole path of the step that `certificate` has begun: other pairs do not come within this distance.
  double covered_on_path(PathCertificate& certificate);

  /// The candidates.
  KnownPairs& pairs() { return now_; }
  const KnownPairs& pairs() const { return now_; }

  /// Work of the search under way, or of the last one, so far; only with a limit of work.
  std::int64_t work_of_search() const { return thread_->work(); }
  /// Work of the search that found the candidates; 0 without a limit of work.
  std::int64_t work() const { return work_; }
  /// Number of calls that the candidates before these served.
  int calls_served() const { return calls_served_; }

  const SearchStatistics& statistics() const { return statistics_; }

 private:
  bool take_or_forget();
  bool take();
  void request(double radius, double ahead, std::span<const BodyPair> ignored, const ExpectedStep& first_step = {});
  bool fits_closely() const;
  SoughtPairs sought() const;
  bool is_settled();
  bool give_up_search();
  void place_ahead(double way, std::vector<Eigen::Isometry3d>& X_WB);
  double covered_on_way(const TrackedSearch& search, double way);
  void forget();

  const ContactScene& scene_;
  std::int64_t work_of_call_;
  double greatest_radius_;  // metres
  bool has_planes_;
  std::int64_t work_left_;  // of this call
  std::size_t most_pairs_;
  bool found_too_many_ = false;
  std::int64_t allowed_ = 0;              // work that the thread's search may have done by now
  bool is_with_thread_ = false;           // a search, whether it is still of use or not
  std::unique_ptr<SearchThread> thread_;  // ends before the members that it uses: see the destructor
  CandidateSearch search_;
  KnownPairs now_;
  TrackedSearch next_;
  WayAhead way_ahead_;
  ExpectedStep first_step_;  // scratch memory
  std::int64_t work_ = 0;
  int calls_ = 0;  // since the search that found the candidates
  int calls_served_ = 0;
  SearchStatistics statistics_;
  // Scratch memory:
  std::vector<Eigen::Isometry3d> X_WB_;
  std::vector<Eigen::Isometry3d> X_WB_ahead_;
  std::vector<BoundedMotion> motions_ahead_;
};

}  // namespace glissade::contact
