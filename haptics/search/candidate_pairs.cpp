#include "search/candidate_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/geometry/displacement.h>

namespace glissade::haptics {
namespace {

/// A search that takes more calls than this is too large: a thread that went on with it would be late for the next.
constexpr std::int64_t kCallsAhead = 4;

std::int64_t work_ahead(bool runs_ahead, std::int64_t work_of_call) {
  if (!runs_ahead) return 0;
  return work_of_call > kUnlimitedWork / kCallsAhead ? kUnlimitedWork : kCallsAhead * work_of_call;
}

}  // namespace

template <typename Pair>
void CandidatePairs::Search::collect(const std::vector<Pair>& pairs, double reach, std::vector<Pair>& found) const {
  found.clear();
  for (const Pair& pair : pairs) {
    if (pair.distance > reach + drift) return;  // as are all that follow
    if (still_apart(pair.bodies, pair.distance, pair.n_W) <= reach) found.push_back(pair);
  }
}

CandidatePairs::CandidatePairs(const ContactScene& scene, double greatest_radius, bool runs_ahead,
                               std::int64_t work_of_call)
    : scene_(scene),
      work_of_call_(work_of_call),
      work_left_(work_of_call),
      thread_(runs_ahead || work_of_call != kUnlimitedWork
                  ? std::make_unique<SearchThread>(work_ahead(runs_ahead, work_of_call))
                  : nullptr),
      search_(scene, greatest_radius, work_of_call == kUnlimitedWork ? nullptr : thread_.get()) {}

CandidatePairs::~CandidatePairs() {
  thread_.reset();
}

void CandidatePairs::begin_call() {
  ++calls_;
  work_left_ = work_of_call_;
  if (!is_with_thread_ || work_of_call_ == kUnlimitedWork) return;
  allowed_ += std::exchange(work_left_, 0);
  if (thread_->work_ahead() == 0) {
    thread_->wait_for_work(allowed_);
  } else {
    thread_->allow(allowed_);
  }
}

bool CandidatePairs::look(double reach, double ahead, std::span<const BodyPair> ignored) {
  bool is_other = false;
  if (!now_.covers(reach)) {
    try {
      if (!take_next(reach, ahead, ignored)) return false;
    } catch (...) {
      forget();
      throw;
    }
    is_other = true;
  }
  if (!next_.is_there && now_.drift > now_.half) ask(next_, reach, ahead, ignored);
  return is_other;
}

/// Replaces the candidates by the answer of the search ahead, or of a new one. Returns false if it has to go on.
bool CandidatePairs::take_next(double reach, double ahead, std::span<const BodyPair> ignored) {
  if (!next_.covers(reach)) {
    if (!is_settled()) return false;  // it is of no use any more
    ask(next_, reach, ahead, ignored);
  }
  if (!is_settled()) return false;
  if (!thread_) search_.find(next_.request, next_.set);  // only now, when its answer is certainly needed
  std::swap(now_, next_);
  next_.is_there = false;
  clock_ = 0.0;
  gaps_.assign(now_.set.pairs.size(), 0.0);
  known_.assign(now_.set.pairs.size(), {});
  motions_of_clock_.assign(scene_.bodies().size(), {});
  place_clock();
  calls_served_ = std::exchange(calls_, 0);
  ++statistics_.searches;
  statistics_.reports += now_.set.report;
  return true;
}

void CandidatePairs::ask(Search& search, double reach, double ahead, std::span<const BodyPair> ignored) {
  GLISSADE_ASSERT(!is_with_thread_);
  search.request.X_WB.clear();
  for (const PlacedBody& mover : scene_.bodies().subspan(scene_.obstacles().size()))
    search.request.X_WB.push_back(mover.X_WB);
  search.request.radius = reach + ahead;
  search.request.ignored.assign(ignored.begin(), ignored.end());
  search.half = 0.5 * ahead;
  search.motions.assign(scene_.bodies().size(), {});
  search.drift = 0.0;
  search.is_there = true;
  if (!thread_) return;
  is_with_thread_ = true;
  allowed_ = work_of_call_ == kUnlimitedWork ? kUnlimitedWork : std::exchange(work_left_, 0);
  thread_->begin(search_, search.request, search.set);
  if (thread_->work_ahead() == 0) thread_->wait_for_work(allowed_);
}

/// Whether the thread, if there is one, is done with its search, within the work that is allowed.
bool CandidatePairs::is_settled() {
  if (!is_with_thread_) return true;
  try {
    if (!thread_->wait(allowed_)) return false;
  } catch (...) {
    is_with_thread_ = false;
    throw;
  }
  is_with_thread_ = false;
  if (work_of_call_ == kUnlimitedWork) return true;
  work_ = thread_->work();
  work_left_ = std::min(work_of_call_, allowed_ - work_);
  return true;
}

bool CandidatePairs::is_too_large() const {
  return is_with_thread_ && allowed_ > kCallsAhead * work_of_call_;
}

void CandidatePairs::cancel() {
  if (is_with_thread_) thread_->cancel();
  is_with_thread_ = false;
  next_.is_there = false;
  search_.start_afresh();
}

void CandidatePairs::moved() {
  follow(now_);
  follow(next_);
  advance_clock();
}

void CandidatePairs::follow(Search& search) const {
  if (search.is_there) search.drift = approach_since(search.request.X_WB, search.motions);
}

/// Bound (metres) of how much nearer two bodies have come since the movers were at X_WB; infinite for a pose that is
/// not finite: nothing is covered then, and the next search reports the pose. Sets the motions. Two bodies come nearer
/// by their motions. Those of one unit keep their distance, or do not matter.
double CandidatePairs::approach_since(std::span<const Eigen::Isometry3d> X_WB, std::vector<Motion>& motions) const {
  double farthest = 0.0;
  double farthest_of_others = 0.0;  // than the unit of the body that moved farthest
  std::optional<std::int32_t> unit;
  for (std::size_t mover = 0; mover < X_WB.size(); ++mover) {
    const std::size_t body = scene_.body_of_mover(mover);
    if (X_WB[mover].matrix() == scene_.bodies()[body].X_WB.matrix()) {
      motions[body] = {};
      continue;
    }
    const SlidingPart& part = *scene_.movers()[mover];
    const geometry::Displacement d =
        geometry::displacement_between(X_WB[mover], scene_.bodies()[body].X_WB, part.p_Vref());
    const double all = geometry::motion_bound(d, part.radius());
    motions[body] = {d.v, all - d.v.norm()};
    if (!std::isfinite(all)) return std::numeric_limits<double>::infinity();
    const std::int32_t own_unit = scene_.unit(static_cast<std::int32_t>(body));
    if (all > farthest) {
      if (unit != own_unit) farthest_of_others = farthest;
      farthest = all;
      unit = own_unit;
    } else if (unit != own_unit) {
      farthest_of_others = std::max(farthest_of_others, all);
    }
  }
  return farthest + farthest_of_others;
}

void CandidatePairs::advance_clock() {
  if (!now_.is_there) return;
  clock_ += approach_since(X_WB_of_clock_, motions_of_clock_);
  place_clock();
}

/// From now on, motions count from the present poses.
void CandidatePairs::place_clock() {
  X_WB_of_clock_.clear();
  for (const PlacedBody& mover : scene_.bodies().subspan(scene_.obstacles().size()))
    X_WB_of_clock_.push_back(mover.X_WB);
}

void CandidatePairs::with_contacts(double reach, std::vector<CandidatePair>& pairs, std::vector<std::uint32_t>& numbers,
                                   std::vector<KnownFeatures>& known) const {
  pairs.clear();
  numbers.clear();
  known.clear();
  for (std::size_t i = 0; i < now_.set.pairs.size(); ++i) {
    if (gaps_[i] > reach + clock_) continue;
    const CandidatePair& pair = now_.set.pairs[i];
    if (pair.distance > reach + now_.drift) return;  // as are all that follow
    if (now_.still_apart(pair.bodies, pair.distance, pair.n_W) > reach) continue;
    pairs.push_back(pair);
    numbers.push_back(static_cast<std::uint32_t>(i));
    const bool is_known = known_[i].left_out > reach + clock_;
    known.push_back(is_known ? KnownFeatures{known_[i].features, known_[i].left_out - clock_} : KnownFeatures{});
  }
}

void CandidatePairs::note_gaps(std::span<const std::uint32_t> numbers, std::span<const GapsOfPair> gaps) {
  GLISSADE_ASSERT(numbers.size() == gaps.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    double& gap = gaps_[numbers[i]];
    gap = std::max(gap, gaps[i].least + clock_);
    if (gaps[i].left_out > 0.0) known_[numbers[i]] = {gaps[i].features, gaps[i].left_out + clock_};
  }
}

/// Also discards the answer of a search under way, which the thread completes all the same.
void CandidatePairs::clear() {
  forget();
}

void CandidatePairs::forget() {
  now_.is_there = false;
  next_.is_there = false;
}

template void CandidatePairs::Search::collect(const std::vector<CandidatePair>&, double,
                                              std::vector<CandidatePair>&) const;
template void CandidatePairs::Search::collect(const std::vector<PairToCertify>&, double,
                                              std::vector<PairToCertify>&) const;

}  // namespace glissade::haptics
