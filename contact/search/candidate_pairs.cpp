#include "search/candidate_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glissade/base/assert.h>

namespace glissade::contact {
namespace {

/// A search that takes more calls than this is too large: a thread that went on with it would be late for the next.
constexpr std::int64_t kCallsAhead = 4;

/// How far ahead of the parts a search is made when its answer is taken, as a share of the look-ahead. The rest is for
/// parts that turn back.
constexpr double kForward = 0.6;

/// A search that finds more pairs of triangles takes longer than a tick: it is requested as soon as the one before has
/// been answered. Where so many are near, parts mostly fit closely.
constexpr std::size_t kPairsOfLongSearch = 5000;

// Shares of a step:
/// The radius of a search at its middle: half a step is needed where it leads as expected.
constexpr double kRadiusOfStep = 0.6;
/// What must be left of a radius after a step for yet another one.
constexpr double kLeftAfterStep = 0.1;

std::int64_t work_ahead(bool runs_ahead, std::int64_t work_of_call) {
  if (!runs_ahead) return 0;
  return work_of_call > kUnlimitedWork / kCallsAhead ? kUnlimitedWork : kCallsAhead * work_of_call;
}

}  // namespace

CandidatePairs::CandidatePairs(const ContactScene& scene, double greatest_radius, bool runs_ahead,
                               std::int64_t work_of_call, bool has_planes, std::size_t most_pairs)
    : scene_(scene),
      work_of_call_(work_of_call),
      greatest_radius_(greatest_radius),
      has_planes_(has_planes),
      work_left_(work_of_call),
      most_pairs_(has_planes ? most_pairs : std::numeric_limits<std::size_t>::max()),
      thread_(runs_ahead || work_of_call != kUnlimitedWork
                  ? std::make_unique<SearchThread>(work_ahead(runs_ahead, work_of_call))
                  : nullptr),
      search_(scene, greatest_radius, thread_.get()),
      now_(scene),
      way_ahead_(scene) {}

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
  if (covers(reach)) return false;
  if (!next_.covers(reach)) {
    if (!give_up_search()) return false;
    place_ahead(kForward * ahead, next_.request.X_WB);
    request(reach + ahead, ahead, ignored);
  }
  return take_or_forget();
}

bool CandidatePairs::take_ahead(double reach, double step) {
  if (!next_.covers(reach)) return false;
  if (covers(reach) && covered_on_way(now_.search(), step) >= covered_on_way(next_, step)) return false;
  return take_or_forget();
}

bool CandidatePairs::look_along(std::span<const geometry::Displacement> way, double length, double least,
                                std::span<const BodyPair> ignored) {
  GLISSADE_ASSERT(length > 0.0);
  copy_mover_poses(scene_, X_WB_ahead_);
  if (!are_rigid(X_WB_ahead_)) return false;
  const double share = std::min(1.0, (greatest_radius_ - least) / (kRadiusOfStep * length));
  displace_movers(scene_, way, 0.5 * share, X_WB_ahead_);
  const auto are_alike = [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return a.matrix() == b.matrix();
  };
  const bool is_requested =
      next_.is_there && std::equal(X_WB_ahead_.begin(), X_WB_ahead_.end(), next_.request.X_WB.begin(), are_alike);
  if (!is_requested) {
    if (!give_up_search()) return false;
    next_.request.X_WB = X_WB_ahead_;
    request(std::min(kRadiusOfStep * share * length + least, greatest_radius_), least, ignored);
  }
  return take_or_forget();
}

bool CandidatePairs::serve_for(double step) {
  if (!now_.search().is_there) return false;
  const double left = kLeftAfterStep * step;
  return covers(step + left) || covered_on_way(now_.search(), step) >= left;  // mostly, the cheap answer suffices
}

void CandidatePairs::look_ahead(double step, double reach, double ahead, std::span<const BodyPair> ignored) {
  GLISSADE_ASSERT(has_planes_);
  if (!now_.search().is_there) return;
  if (next_.is_there && next_.is_in_vain() && give_up_search()) next_.is_there = false;
  if (next_.is_there) return;
  const bool is_time = now_.search().is_being_left() || !serve_for(step);
  if (!is_time && !fits_closely()) return;
  double until_needed = std::max(0.0, covered() - std::max(step, reach));
  if (!is_time && now_.search().is_approached()) until_needed += 2.0 * now_.search().drift;
  if (step > 0.0) until_needed = step * std::ceil(until_needed / step);  // answers are taken before a step
  const auto place = [&](double way, std::vector<Eigen::Isometry3d>& X_WB) {
    if (!is_time) return way_ahead_.follow_far(way, X_WB);
    place_ahead(way, X_WB);
    return true;
  };
  if (!place(until_needed + 0.5 * step + kForward * ahead, next_.request.X_WB)) return;
  first_step_.forget();
  if (fits_closely()) {
    place(until_needed, first_step_.X_WB_begin);
    place(until_needed + step, first_step_.X_WB_end);
  }
  request(std::max(kRadiusOfStep * step, reach) + ahead, ahead, ignored, first_step_);
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
  found_too_many_ = next_.set.has_too_many;
  if (found_too_many_) {
    next_.is_there = false;
    return false;
  }
  copy_mover_poses(scene_, X_WB_);
  now_.take(next_, X_WB_);
  way_ahead_.begin(X_WB_);
  calls_served_ = std::exchange(calls_, 0);
  ++statistics_.searches;
  statistics_.reports += now_.search().set.report;
  return true;
}

/// Requests the search at the poses of `next_`.
void CandidatePairs::request(double radius, double ahead, std::span<const BodyPair> ignored,
                             const ExpectedStep& first_step) {
  GLISSADE_ASSERT(!is_with_thread_);
  found_too_many_ = false;
  next_.request.range = {.radius = radius, .sought = sought(), .most_pairs = most_pairs_};
  next_.request.first_step = first_step;
  next_.request.ignored.assign(ignored.begin(), ignored.end());
  next_.ahead = ahead;
  next_.step = 0.0;
  next_.least_drift = std::numeric_limits<double>::infinity();
  next_.is_there = true;
  copy_mover_poses(scene_, X_WB_);
  next_.follow(scene_, X_WB_);
  if (!thread_) return;
  is_with_thread_ = true;
  allowed_ = work_of_call_ == kUnlimitedWork ? kUnlimitedWork : std::exchange(work_left_, 0);
  thread_->begin(search_, next_.request, next_.set);
  if (thread_->work_ahead() == 0) thread_->wait_for_work(allowed_);
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

/// Ends a search that is of no use any more. Returns false if it has to go on: where work is limited, what is left of
/// it must not depend on how fast the thread is, and a search must be done at some time, however little a call may do.
bool CandidatePairs::give_up_search() {
  if (work_of_call_ != kUnlimitedWork) return is_settled();
  cancel();
  return true;
}

/// Whether the last search found so many pairs.
bool CandidatePairs::fits_closely() const {
  return has_planes_ && now_.pair_count() > kPairsOfLongSearch;
}

SoughtPairs CandidatePairs::sought() const {
  if (!has_planes_) return SoughtPairs::kWithDistances;
  return fits_closely() ? SoughtPairs::kWithPlanesInCloseFit : SoughtPairs::kWithPlanes;
}

bool CandidatePairs::is_too_large() const {
  return found_too_many_ || (is_with_thread_ && allowed_ > kCallsAhead * work_of_call_);
}

void CandidatePairs::allow_twice_as_many() {
  most_pairs_ *= 2;
  found_too_many_ = false;
}

bool CandidatePairs::are_many() const {
  return now_.search().set.pair_and_box_count() > most_pairs_ / 2;
}

void CandidatePairs::cancel() {
  if (is_with_thread_ && thread_->cancel()) search_.start_afresh();
  is_with_thread_ = false;
  found_too_many_ = false;
  next_.is_there = false;
}

void CandidatePairs::moved() {
  copy_mover_poses(scene_, X_WB_);
  now_.moved(X_WB_);
  next_.follow(scene_, X_WB_);
}

/// Sets the poses at which the movers will be after `way` more metres.
void CandidatePairs::place_ahead(double way, std::vector<Eigen::Isometry3d>& X_WB) {
  if (has_planes_ && now_.search().is_there) {
    way_ahead_.follow(now_.search().X_WB_nearest, way, X_WB);
  } else {
    copy_mover_poses(scene_, X_WB);
  }
}

/// The largest reach (metres) that `search` will cover on the next `way` metres, if the movers go on as before.
double CandidatePairs::covered_on_way(const TrackedSearch& search, double way) {
  place_ahead(way, X_WB_ahead_);
  return search.covered_up_to(approach(scene_, search.request.X_WB, X_WB_ahead_, motions_ahead_));
}

double CandidatePairs::covered_on_path(PathCertificate& certificate) {
  if (!now_.search().is_there) return covered();
  X_WB_ahead_.clear();
  for (std::size_t mover = 0; mover < scene_.movers().size(); ++mover)
    X_WB_ahead_.push_back(certificate.pose_at_end(static_cast<std::int32_t>(scene_.body_of_mover(mover))));
  const double drift_at_end = approach(scene_, now_.search().request.X_WB, X_WB_ahead_, motions_ahead_);
  return now_.search().covered_up_to(drift_at_end) - certificate.curvature();
}

/// Also discards the answer of a search under way; the next request ends it.
void CandidatePairs::clear() {
  forget();
}

void CandidatePairs::forget() {
  now_.forget();
  next_.is_there = false;
  way_ahead_.forget();
}

}  // namespace glissade::contact
