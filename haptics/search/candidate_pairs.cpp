#include "search/candidate_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/geometry/displacement.h>
#include <glissade/geometry/rigid_pose.h>

#include "search/round_down.h"

namespace glissade::haptics {
namespace {

/// A search that takes more calls than this is too large: a thread that went on with it would be late for the next.
constexpr std::int64_t kCallsAhead = 4;

// Shares of the look-ahead:
/// The drift at which the next search is requested. Earlier, more of them are in vain; later, a thread has less time.
constexpr double kAskAt = 0.4;
/// The way away from the poses of a search after which a part is leaving them.
constexpr double kLeaving = 0.1;
/// The same before its answer is taken: the part has turned back, and the search is of no use.
constexpr double kTurnedBack = 0.4;
/// How far ahead of the parts a search is made when its answer is taken. The rest is for parts that turn back.
constexpr double kForward = 0.6;
/// Of the way since the parts were nearest to the poses of a search: they are expected to go on so for as long at most.
constexpr double kMostForward = 3.0;

// Shares of a step:
/// The radius of a search at its middle: half a step is needed where it leads as expected.
constexpr double kRadiusOfStep = 0.6;
/// What must be left of a radius after a step for yet another one.
constexpr double kLeftAfterStep = 0.1;

/// Work of the gap of a pair along a known direction, in the unit of `collision::WorkMeter`.
constexpr std::int64_t kWorkOfGap = 2;

std::int64_t work_ahead(bool runs_ahead, std::int64_t work_of_call) {
  if (!runs_ahead) return 0;
  return work_of_call > kUnlimitedWork / kCallsAhead ? kUnlimitedWork : kCallsAhead * work_of_call;
}

/// The search refuses a pose that is not rigid. Going on from it would make it rigid.
bool are_rigid(std::span<const Eigen::Isometry3d> poses) {
  return std::all_of(poses.begin(), poses.end(), [](const auto& X) { return geometry::rigid_pose(X).has_value(); });
}

}  // namespace

/// Calls `visit` with the pairs that may be within `reach` now, nearest first at the poses of the search.
template <typename Pair, typename Visit>
void CandidatePairs::Search::visit_within(const std::vector<Pair>& pairs, double reach, const Visit& visit) const {
  for (const Pair& pair : pairs) {
    if (pair.distance > reach + drift) return;  // as are all that follow
    if (still_apart(pair.bodies, pair.distance, pair.n_W) <= reach) visit(pair);
  }
}

void CandidatePairs::within(double reach, std::vector<NearPair>& pairs) const {
  pairs.clear();
  now_.visit_within(now_.set.pairs, reach, [&](const NearPair& pair) {
    if (pair.may_yield_contact) pairs.push_back(pair);
  });
}

void CandidatePairs::within(double reach, std::vector<PairToCertify>& pairs) const {
  pairs.clear();
  now_.visit_within(now_.set.boxes, reach, [&](const PairToCertify& pair) { pairs.push_back(pair); });
  now_.visit_within(now_.set.pairs, reach, [&](const NearPair& pair) {
    if (pair.is_to_certify) pairs.push_back(to_certify(pair));
  });
}

CandidatePairs::CandidatePairs(const ContactScene& scene, double greatest_radius, bool runs_ahead,
                               std::int64_t work_of_call, bool has_planes)
    : scene_(scene),
      work_of_call_(work_of_call),
      greatest_radius_(greatest_radius),
      has_planes_(has_planes),
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
  if (now_.covers(reach)) return false;
  if (!next_.covers(reach)) {
    if (!is_settled()) return false;  // it is of no use any more
    ask(reach + ahead, ahead, kForward * ahead, ignored);
  }
  return take_or_forget();
}

bool CandidatePairs::take_ahead(double reach, double step) {
  if (!next_.covers(reach)) return false;
  if (now_.covers(reach) && covered_on_way(now_, step) >= covered_on_way(next_, step)) return false;
  return take_or_forget();
}

bool CandidatePairs::look_along(std::span<const geometry::Displacement> way, double length, double least,
                                std::span<const BodyPair> ignored) {
  GLISSADE_ASSERT(length > 0.0);
  copy_poses(X_WB_ahead_);
  if (!are_rigid(X_WB_ahead_)) return false;
  const double share = std::min(1.0, (greatest_radius_ - least) / (kRadiusOfStep * length));
  for (std::size_t mover = 0; mover < X_WB_ahead_.size(); ++mover) {
    const std::int32_t leader = scene_.leader(static_cast<std::int32_t>(scene_.body_of_mover(mover)));
    if (leader == ContactScene::kStands) continue;
    const geometry::Displacement half = way[static_cast<std::size_t>(leader)].scaled(0.5 * share);
    if (!half.is_zero()) X_WB_ahead_[mover] = geometry::displaced(X_WB_ahead_[mover], scene_.p_Bref(mover), half);
  }
  const auto are_alike = [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return a.matrix() == b.matrix();
  };
  const bool is_requested =
      next_.is_there && std::equal(X_WB_ahead_.begin(), X_WB_ahead_.end(), next_.request.X_WB.begin(), are_alike);
  if (!is_requested) {
    if (!is_settled()) return false;  // it is of no use any more
    next_.request.X_WB = X_WB_ahead_;
    request(std::min(kRadiusOfStep * share * length + least, greatest_radius_), least, ignored);
  }
  return take_or_forget();
}

bool CandidatePairs::serve_for(double step) {
  if (!now_.is_there) return false;
  const double left = kLeftAfterStep * step;
  return now_.covers(step + left) || covered_on_way(now_, step) >= left;  // mostly, the cheap answer suffices
}

void CandidatePairs::look_ahead(double step, double reach, double ahead, std::span<const BodyPair> ignored) {
  GLISSADE_ASSERT(has_planes_);
  if (!now_.is_there) return;
  if (next_.is_there && next_.is_in_vain() && is_settled()) next_.is_there = false;
  if (next_.is_there || (!now_.is_being_left() && serve_for(step))) return;
  double until_needed = std::max(0.0, covered() - std::max(step, reach));
  if (step > 0.0) until_needed = step * std::ceil(until_needed / step);  // answers are taken before a step
  ask(std::max(kRadiusOfStep * step, reach) + ahead, ahead, until_needed + 0.5 * step + kForward * ahead, ignored);
  next_.step = step;
}

/// Replaces the candidates by the answer of the search that was requested. Returns false if that has to go on.
bool CandidatePairs::take_or_forget() {
  try {
    return take();
  } catch (...) {
    forget();
    throw;
  }
}

bool CandidatePairs::take() {
  if (!is_settled()) return false;
  if (!thread_) search_.find(next_.request, next_.set);  // only now, when its answer is certainly needed
  std::swap(now_, next_);
  next_.is_there = false;
  copy_poses(X_WB_at_taking_);
  clock_ = 0.0;
  gaps_.assign(now_.set.pairs.size(), 0.0);
  known_.assign(now_.set.pairs.size(), {});
  motions_of_clock_.assign(scene_.bodies().size(), {});
  place_clock();
  gaps_of_contacts_ = gaps_at_search();
  gaps_to_certify_ = gaps_of_contacts_;
  calls_served_ = std::exchange(calls_, 0);
  ++statistics_.searches;
  statistics_.reports += now_.set.report;
  return true;
}

/// Requests a search where the movers will be after `forward` more metres.
void CandidatePairs::ask(double radius, double ahead, double forward, std::span<const BodyPair> ignored) {
  place_ahead(forward, next_.request.X_WB);
  request(radius, ahead, ignored);
}

/// Requests the search at the poses of `next_`.
void CandidatePairs::request(double radius, double ahead, std::span<const BodyPair> ignored) {
  GLISSADE_ASSERT(!is_with_thread_);
  next_.request.radius = radius;
  next_.request.has_planes = has_planes_;
  next_.request.ignored.assign(ignored.begin(), ignored.end());
  next_.ahead = ahead;
  next_.step = 0.0;
  next_.least_drift = std::numeric_limits<double>::infinity();
  next_.motions.assign(scene_.bodies().size(), {});
  next_.is_there = true;
  follow(next_);
  if (!thread_) return;
  is_with_thread_ = true;
  allowed_ = work_of_call_ == kUnlimitedWork ? kUnlimitedWork : std::exchange(work_left_, 0);
  thread_->begin(search_, next_.request, next_.set);
  if (thread_->work_ahead() == 0) thread_->wait_for_work(allowed_);
}

/// Copies the present poses of the movers.
void CandidatePairs::copy_poses(std::vector<Eigen::Isometry3d>& X_WB) const {
  X_WB.clear();
  for (const PlacedBody& mover : scene_.bodies().subspan(scene_.obstacles().size()))
    X_WB.push_back(mover.X_WB);
}

/// Sets the poses at which the movers will be after `way` more metres, if they go on as since they were nearest to the
/// poses of the last search.
void CandidatePairs::place_ahead(double way, std::vector<Eigen::Isometry3d>& X_WB) {
  copy_poses(X_WB);
  if (!has_planes_ || !now_.is_there || !(way > 0.0)) return;
  motions_ahead_.assign(scene_.bodies().size(), {});
  const std::vector<Eigen::Isometry3d>* before = &now_.X_WB_nearest;
  double gone = approach_since(*before, motions_ahead_);
  if (kMostForward * gone < way) {  // the parts are about there, and their last steps may be small corrections
    before = &X_WB_at_taking_;
    gone = approach_since(*before, motions_ahead_);
  }
  if (!(gone > 0.0) || !std::isfinite(gone)) return;
  if (!are_rigid(X_WB)) return;
  const double share = std::min(kMostForward, way / gone);
  for (std::size_t mover = 0; mover < X_WB.size(); ++mover) {
    const Eigen::Vector3d& p_Bref = scene_.movers()[mover]->p_Vref();
    const geometry::Displacement d = geometry::displacement_between((*before)[mover], X_WB[mover], p_Bref);
    if (!d.is_zero()) X_WB[mover] = geometry::displaced(X_WB[mover], p_Bref, d.scaled(share));
  }
}

/// Whether the thread, if there is one, is done with its search, within the work that is allowed.
bool CandidatePairs::is_settled() {
  if (!is_with_thread_) return true;
  try {
    if (!thread_->wait(allowed_)) return false;
  } catch (...) {
    is_with_thread_ = false;
    forget();
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
  if (!search.is_there) return;
  search.drift = approach_since(search.request.X_WB, search.motions);
  if (!(search.drift < search.least_drift)) return;
  search.least_drift = search.drift;
  copy_poses(search.X_WB_nearest);
}

bool CandidatePairs::Search::is_being_left() const {
  return drift > kAskAt * ahead && drift > least_drift + kLeaving * ahead;
}

bool CandidatePairs::Search::is_in_vain() const {
  return drift > least_drift + kTurnedBack * (step + ahead);
}

/// Bound (metres) of how much nearer two bodies come while the movers go from X_WB to the poses that `pose_of` tells of
/// a body; infinite for a pose that is not finite: nothing is covered then, and the next search reports the pose. Sets
/// the motions. Two bodies come nearer by their motions. Those of one unit keep their distance, or do not matter.
template <typename PoseOf>
double CandidatePairs::approach(std::span<const Eigen::Isometry3d> X_WB, const PoseOf& pose_of,
                                std::vector<Motion>& motions) const {
  double farthest = 0.0;
  double farthest_of_others = 0.0;  // than the unit of the body that moved farthest
  std::optional<std::int32_t> unit;
  for (std::size_t mover = 0; mover < X_WB.size(); ++mover) {
    const std::size_t body = scene_.body_of_mover(mover);
    if (X_WB[mover].matrix() == pose_of(body).matrix()) {
      motions[body] = {};
      continue;
    }
    const SlidingPart& part = *scene_.movers()[mover];
    const geometry::Displacement d = geometry::displacement_between(X_WB[mover], pose_of(body), part.p_Vref());
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

/// The same as `approach` to the present poses.
double CandidatePairs::approach_since(std::span<const Eigen::Isometry3d> X_WB, std::vector<Motion>& motions) const {
  return approach(
      X_WB, [&](std::size_t body) -> const Eigen::Isometry3d& { return scene_.bodies()[body].X_WB; }, motions);
}

/// The largest reach (metres) that `search` will cover on the next `way` metres, if the movers go on as before.
double CandidatePairs::covered_on_way(const Search& search, double way) {
  place_ahead(way, X_WB_ahead_);
  motions_ahead_.assign(scene_.bodies().size(), {});
  const std::size_t first_mover = scene_.obstacles().size();
  const double drift = approach(
      search.request.X_WB,
      [&](std::size_t body) -> const Eigen::Isometry3d& { return X_WB_ahead_[body - first_mover]; }, motions_ahead_);
  return search.request.radius - std::max(drift, search.drift);
}

/// How far the difference of two points is from that at the search is greatest at an end, if both go straight.
double CandidatePairs::covered_on_path(PathCertificate& certificate) {
  if (!now_.is_there) return covered();
  motions_ahead_.assign(scene_.bodies().size(), {});
  const double at_end = approach(
      now_.request.X_WB,
      [&](std::size_t body) -> const Eigen::Isometry3d& {
        return certificate.pose_at_end(static_cast<std::int32_t>(body));
      },
      motions_ahead_);
  return now_.request.radius - std::max(now_.drift, at_end) - certificate.curvature();
}

void CandidatePairs::advance_clock() {
  if (!now_.is_there) return;
  clock_ += approach_since(X_WB_of_clock_, motions_of_clock_);
  place_clock();
}

/// From now on, motions count from the present poses.
void CandidatePairs::place_clock() {
  copy_poses(X_WB_of_clock_);
}

/// The pairs of a block are in the order of the search, the nearest first.
CandidatePairs::GapsOfBlocks CandidatePairs::gaps_at_search() const {
  GapsOfBlocks gaps;
  for (const PlanesOfBodies& of_bodies : now_.set.planes) {
    std::vector<double>& of_blocks = gaps.emplace_back();
    for (std::size_t slot = 0; slot < of_bodies.numbers().size(); slot += kPlanesAtOnce)
      of_blocks.push_back(now_.set.pairs[of_bodies.numbers()[slot]].distance - now_.drift);
  }
  return gaps;
}

/// Visits the runs of blocks that may have gaps up to `reach`, by their beginnings and ends.
template <typename Visit>
void CandidatePairs::visit_near_blocks(const std::vector<double>& gaps, double reach, const Visit& visit) const {
  const auto is_near = [&](double gap) { return gap - clock_ <= reach; };
  auto first = std::find_if(gaps.begin(), gaps.end(), is_near);
  while (first != gaps.end()) {
    const auto end = std::find_if_not(first, gaps.end(), is_near);
    visit(static_cast<std::size_t>(first - gaps.begin()), static_cast<std::size_t>(end - gaps.begin()));
    first = std::find_if(end, gaps.end(), is_near);
  }
}

void CandidatePairs::in_reach(double reach, std::vector<PairInReach>& pairs) {
  pairs.clear();
  for (std::uint32_t i = 0; i < now_.set.planes.size(); ++i) {
    const PlanesOfBodies& planes = now_.set.planes[i];
    const Eigen::Isometry3d X_OV =
        relative_pose(scene_.bodies()[static_cast<std::size_t>(planes.bodies().obstacle)].X_WB,
                      scene_.bodies()[static_cast<std::size_t>(planes.bodies().part)].X_WB);
    const std::span<const std::uint32_t> numbers = planes.numbers();
    std::vector<double>& of_blocks = gaps_of_contacts_[i];
    visit_near_blocks(of_blocks, reach, [&](std::size_t first, std::size_t end) {
      planes.find_gaps(X_OV.linear(), X_OV.translation(), first, end, gaps_at_begin_);
      for (std::size_t block = first; block < end; ++block) {
        double least = std::numeric_limits<double>::infinity();
        const std::size_t last = std::min(numbers.size(), kPlanesAtOnce * (block + 1));
        for (std::size_t slot = kPlanesAtOnce * block; slot < last; ++slot) {
          const auto along_plane = static_cast<double>(gaps_at_begin_[slot]);
          if (along_plane > reach) {
            least = std::min(least, along_plane);
            continue;
          }
          const std::uint32_t number = numbers[slot];
          const NearPair& pair = now_.set.pairs[number];
          if (!pair.may_yield_contact) continue;
          const double gap = std::max(along_plane, gaps_[number] - clock_);
          least = std::min(least, gap);
          if (gap > reach || now_.still_apart(pair.bodies, pair.distance, pair.n_W) > reach) continue;
          pairs.push_back({number, i, static_cast<std::uint32_t>(slot), round_down(gap)});
        }
        of_blocks[block] = std::max(of_blocks[block], least + clock_);
      }
    });
  }
  if (now_.set.planes.size() < 2) return;
  std::sort(pairs.begin(), pairs.end(), [](const PairInReach& a, const PairInReach& b) { return a.number < b.number; });
}

KnownFeatures CandidatePairs::known_features(std::uint32_t number, double reach) const {
  const KnownFeatures& known = known_[number];
  return known.left_out > reach + clock_ ? KnownFeatures{known.features, known.left_out - clock_} : KnownFeatures{};
}

void CandidatePairs::note_gaps(std::span<const std::uint32_t> numbers, std::span<const GapsOfPair> gaps) {
  GLISSADE_ASSERT(numbers.size() == gaps.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    double& gap = gaps_[numbers[i]];
    gap = std::max(gap, gaps[i].least + clock_);
    if (gaps[i].left_out > 0.0) known_[numbers[i]] = {gaps[i].features, gaps[i].left_out + clock_};
  }
}

void CandidatePairs::unproved_within(double reach, PathCertificate& certificate, std::vector<PairToCertify>& unproved,
                                     WorkBudget& budget) {
  unproved.clear();
  places_.clear();
  now_.visit_within(now_.set.boxes, reach, [&](const PairToCertify& boxes) {
    unproved.push_back(boxes);
    places_.push_back({nullptr, 0, 0});
  });
  for (std::size_t i = 0; i < now_.set.planes.size(); ++i) {
    PlanesOfBodies& planes = now_.set.planes[i];
    const std::span<const std::uint32_t> numbers = planes.numbers();
    const std::optional<PathOfBodies> known_path = certificate.path_of(planes.bodies());
    if (!known_path) {
      for (const std::uint32_t number : numbers) {
        const NearPair& pair = now_.set.pairs[number];
        if (pair.distance > reach + now_.drift) break;  // as are all that follow
        if (!pair.is_to_certify || now_.still_apart(pair.bodies, pair.distance, pair.n_W) > reach) continue;
        unproved.push_back(to_certify(pair));
        places_.push_back({nullptr, 0, number});
      }
      continue;
    }
    const PathOfBodies& path = *known_path;
    std::vector<double>& of_blocks = gaps_to_certify_[i];
    visit_near_blocks(of_blocks, path.far, [&](std::size_t first, std::size_t end) {
      planes.find_gaps(path.X_OV_begin.linear(), path.X_OV_begin.translation(), first, end, gaps_at_begin_);
      planes.find_gaps(path.X_OV_end.linear(), path.X_OV_end.translation(), first, end, gaps_at_end_);
      budget.spend(2 * kWorkOfGap * static_cast<std::int64_t>(kPlanesAtOnce * (end - first)));
      for (std::size_t block = first; block < end; ++block) {
        double least = std::numeric_limits<double>::infinity();
        const std::size_t last = std::min(numbers.size(), kPlanesAtOnce * (block + 1));
        for (std::size_t slot = kPlanesAtOnce * block; slot < last; ++slot) {
          const auto at_begin = static_cast<double>(gaps_at_begin_[slot]);
          if (at_begin > path.far) {
            least = std::min(least, at_begin);
            continue;
          }
          const NearPair& pair = now_.set.pairs[numbers[slot]];
          if (!pair.is_to_certify) continue;
          least = std::min(least, at_begin);
          if (at_begin >= path.needed && static_cast<double>(gaps_at_end_[slot]) >= path.needed) continue;
          if (now_.still_apart(pair.bodies, pair.distance, pair.n_W) > reach) continue;
          unproved.push_back(to_certify(pair));
          places_.push_back({&planes, slot, numbers[slot]});
        }
        of_blocks[block] = std::max(of_blocks[block], least + clock_);
      }
    });
  }
}

void CandidatePairs::note_planes(std::span<const SeparatedPair> separated) {
  for (const SeparatedPair& pair : separated) {
    const PlaceOfPair& place = places_[pair.place];
    if (place.planes == nullptr) continue;
    const NearPair& known = now_.set.pairs[place.number];
    const PlacedBody& obstacle = scene_.bodies()[static_cast<std::size_t>(known.bodies.obstacle)];
    place.planes->turn(place.slot, *obstacle.body, known.obstacle_triangle,
                       obstacle.X_WB.linear().transpose() * pair.n_W);
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

}  // namespace glissade::haptics
