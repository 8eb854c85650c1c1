#include <algorithm>
#include <cmath>

#include <glissade/haptics/contact_search.h>
#include <glissade/haptics/joint_sliding.h>

#include "sliding_constants.h"

namespace glissade::haptics {
namespace {

constexpr int kProjections = 4;  // the first, and three more with rows for what could not be proved
constexpr int kHalvings = 6;

/// The largest fraction of a displacement `d` of the part that lets its lag, which was `then` and is `now`, change by
/// no more than `most` metres, or than it has changed already.
double fraction_with_lag(const Displacement& then, const Displacement& now, const Displacement& d, double radius,
                         double most) {
  // Rotations by their angle apart: their vectors may change faster than what they stand for turns.
  const Eigen::Quaterniond q_then = rotation_by(then.w);
  const Eigen::Quaterniond q_now = rotation_by(now.w);
  const auto changed = [&](double fraction) {
    const Eigen::Quaterniond q = q_now * rotation_by(fraction * d.w).conjugate();
    return (now.v - fraction * d.v - then.v).norm() + radius * q.angularDistance(q_then);
  };
  most = std::max(most, changed(0.0));
  if (changed(1.0) <= most) return 1.0;
  double allowed = 0.0;  // stays one that is
  double refused = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (allowed + refused);
    (changed(middle) <= most ? allowed : refused) = middle;
  }
  return allowed;
}

}  // namespace

void JointSliding::find_rows() {
  candidates_.within(reach_, pairs_);
  find_contacts(surroundings_.bodies(), surroundings_.obstacles().size(), pairs_, reach_, largest_margin_, contacts_);
  for (Part& part : parts_)
    part.result.X_WV_of_contacts = part.result.X_WV;
  rows_.clear();
  for (const Contact& contact : contacts_) {
    // A contact nearer than the margin asks for some of it back.
    const auto body = static_cast<std::int32_t>(surroundings_.body_of_part(static_cast<std::size_t>(contact.part)));
    const double missing = surroundings_.margin(contact.obstacle, body) - contact.gap;
    const double bound = missing > 0.0 ? 0.7 * missing : missing;
    add_row(contact.obstacle, static_cast<std::size_t>(contact.part), contact.n_W, contact.p_W, bound);
  }
}

Displacement JointSliding::lag_of(const Part& part) const {
  return displacement_between(part.result.X_WV, part.result.X_WT, part.part_V->p_Vref());
}

Eigen::Vector3d JointSliding::reference_point(std::size_t part) const {
  return parts_[part].result.X_WV * parts_[part].part_V->p_Vref();
}

void JointSliding::add_row(std::int32_t obstacle, std::size_t part, const Eigen::Vector3d& n_W,
                           const Eigen::Vector3d& p_W, double bound) {
  JointRow& row = rows_.emplace_back();
  row.n = n_W;
  row.r = p_W - reference_point(part);
  row.bound = bound;
  row.part = static_cast<std::int32_t>(part);
  const auto obstacles = static_cast<std::int32_t>(surroundings_.obstacles().size());
  bool is_held_by_any = is_held(parts_[part]);
  if (obstacle >= obstacles) {
    row.other = obstacle - obstacles;
    const auto other = static_cast<std::size_t>(row.other);
    row.r_other = p_W - reference_point(other);
    is_held_by_any = is_held_by_any || is_held(parts_[other]);
  }
  // What nobody holds gives no margin back.
  if (!is_held_by_any) row.bound = -kUnbounded;
}

/// The largest step towards `wanted` that can be proved free.
JointSliding::Step JointSliding::certified_step(std::span<const Displacement> wanted) {
  rows_.resize(contacts_.size());
  proof_contacts_.clear();
  Step step;
  Step first;  // what the contacts alone allow
  bool proved = false;
  int projections = 0;
  for (; projections < kProjections && !proved; ++projections) {
    if (projections > 0) add_rows_for_failures();
    if (!project_on_rows(wanted)) return {.clipped = true};
    const std::array<double, kMaxParts> fractions = allowed_fractions(projected_);
    Displacements shortened;
    step.clipped = false;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      shortened[p] = projected_[p].scaled(fractions[p]);
      step.arrives[p] = fractions[p] == 1.0;
      step.clipped = step.clipped || fractions[p] < 1.0;
    }
    proved = prove(shortened, step);
    if (projections > 0) continue;
    first = step;
    first_forces_ = forces_;
  }
  // Rows for failed proofs forbid more than they must, and may leave nothing where a shorter step would be free.
  if (proved && projections > 1 && step.length < kNotWorthIt * largest_margin_) {
    proved = false;
    step = first;
    forces_ = first_forces_;
  }
  // What cannot be proved of one part does not keep the others.
  const int attempts = kHalvings + static_cast<int>(parts_.size());
  for (int attempt = 0; attempt < attempts && !proved; ++attempt) {
    const std::array<bool, kMaxParts> fails = parts_that_fail();
    Displacements shortened = step.displacements;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!fails[p]) continue;
      shortened[p] = shortened[p].scaled(attempt < kHalvings ? 0.5 : 0.0);
      step.arrives[p] = false;
    }
    step.clipped = true;
    proved = prove(shortened, step);
  }
  if (!proved) return {.clipped = true};
  for (const RowForce& force : forces_) {
    const JointRow& row = rows_[static_cast<std::size_t>(force.row)];
    step.arrives[static_cast<std::size_t>(row.part)] = false;
    if (row.other >= 0) step.arrives[static_cast<std::size_t>(row.other)] = false;
  }
  for (std::size_t p = 0; p < parts_.size(); ++p)
    step.arrives[p] = step.arrives[p] || !is_held(parts_[p]);
  return step;
}

/// The parts of the pairs that could not be proved; all of them where the pairs were not even known.
std::array<bool, kMaxParts> JointSliding::parts_that_fail() const {
  std::array<bool, kMaxParts> fails{};
  if (failures_.empty()) fails.fill(true);
  const auto obstacles = static_cast<std::int32_t>(surroundings_.obstacles().size());
  for (const UncertifiedPair& failure : failures_) {
    fails[static_cast<std::size_t>(failure.bodies.part - obstacles)] = true;
    if (failure.bodies.obstacle >= obstacles)
      fails[static_cast<std::size_t>(failure.bodies.obstacle - obstacles)] = true;
  }
  return fails;
}

/// Makes `step` those displacements and tells whether they are proved free.
bool JointSliding::prove(const Displacements& displacements, Step& step) {
  step.displacements = displacements;
  step.length = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    step.lengths[p] = motion_bound(displacements[p], parts_[p].part_V->radius());
    step.length += step.lengths[p];
  }
  // What is further away than this keeps the floor whatever happens on the way.
  const double concerned = step.length + kFloorOfMargin * largest_margin_ + certificate_.certain_distance();
  failures_.clear();
  if (!candidates_.covers(concerned)) return false;
  candidates_.within(concerned, obligations_);
  return certificate_.prove({displacements.data(), parts_.size()}, obligations_, failures_);
}

/// Projects on all rows; false when the solver finds nothing, which leaves standing still.
bool JointSliding::project_on_rows(std::span<const Displacement> wanted) {
  JointProjection projection = solver_.project(wanted, grips_, rows_);
  if (projection.status == ProjectionStatus::kInfeasible) {
    // Not every contact can have its margin back. Standing still is always allowed.
    for (JointRow& row : rows_)
      row.bound = std::min(row.bound, 0.0);
    projection = solver_.project(wanted, grips_, rows_);
  }
  forces_.clear();
  projected_.fill({});
  if (projection.status != ProjectionStatus::kSolved) return false;
  projected_ = projection.displacements;
  const bool rubs = rules_.friction.is_on() && projection.active_count > 0;
  if (rubs) remember_forces();
  if (forces_.empty()) {
    for (int i = 0; i < projection.active_count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      forces_.push_back({projection.active[slot], projection.force[slot]});
    }
  }
  if (rubs) solve_friction(wanted);
  return true;
}

void JointSliding::solve_friction(std::span<const Displacement> wanted) {
  coefficients_.clear();
  for (const JointRow& row : rows_)
    coefficients_.push_back(slipped(row) ? rules_.friction.sliding : rules_.friction.at_rest);
  friction_solver_.solve(wanted, grips_, rows_, coefficients_, projected_, forces_);
}

/// Whether the two sides went past each other in the last call, whatever they did together.
bool JointSliding::slipped(const JointRow& row) const {
  double still = kUnbounded;  // less than this does not count
  double curved = 0.0;        // what a step that holds this point to first order may carry it away by
  const auto motion_of = [&](std::int32_t number, const Eigen::Vector3d& r) -> Eigen::Vector3d {
    const Part& part = parts_[static_cast<std::size_t>(number)];
    const Eigen::Isometry3d& X_from = part.X_WV_before_last;
    const Eigen::Isometry3d& X_to = part.X_WV_before;
    const double angle = Eigen::Quaterniond(X_from.linear()).angularDistance(Eigen::Quaterniond(X_to.linear()));
    still = std::min(still, kNotWorthIt * part.margin);
    curved += 0.5 * angle * angle * r.norm();
    const Eigen::Vector3d p_V = part.part_V->p_Vref() + part.result.X_WV.linear().transpose() * r;
    return X_to.translation() - X_from.translation() + (X_to.linear() - X_from.linear()) * p_V;
  };
  Eigen::Vector3d slip = motion_of(row.part, row.r);
  if (row.other >= 0) slip -= motion_of(row.other, row.r_other);
  slip -= slip.dot(row.n) * row.n;
  return slip.norm() > still + curved;
}

/// Those of the last cycle, where the same features still touch.
void JointSliding::remember_forces() {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    if (rows_[i].bound == -kUnbounded) continue;  // nobody holds it
    for (const Contact& before : pushed_) {
      if (before.part != contact.part || before.obstacle != contact.obstacle || before.kind != contact.kind ||
          before.part_feature != contact.part_feature || before.obstacle_feature != contact.obstacle_feature) {
        continue;
      }
      forces_.push_back({static_cast<std::int32_t>(i), before.force, before.friction_W});
      break;
    }
  }
}

/// How much of its displacement each part may go: by the reach, the slew and the linearisation of rotations. Parts that
/// touch, or may soon, are shortened alike, or what holds for both together would not hold any more.
std::array<double, kMaxParts> JointSliding::allowed_fractions(const Displacements& d) const {
  std::array<double, kMaxParts> fractions{};
  const double share = (reach_ - largest_margin_) / static_cast<double>(parts_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    const double radius = part.part_V->radius();
    fractions[p] = fraction_within(d[p], radius, share);
    if (part.slew != kUnbounded && is_held(part)) {
      const double by_lag = fraction_with_lag(part.lag_then, lag_of(part), d[p], radius, part.slew);
      fractions[p] = std::min(fractions[p], by_lag);
    }
    const double angle = d[p].w.norm();
    const double largest_angle = std::sqrt(part.margin / radius);
    if (!rows_.empty() && angle * fractions[p] > largest_angle) fractions[p] = largest_angle / angle;
  }
  for (std::size_t pass = 1; pass < parts_.size(); ++pass) {
    for (const JointRow& row : rows_) {
      if (row.other < 0) continue;
      double& a = fractions[static_cast<std::size_t>(row.part)];
      double& b = fractions[static_cast<std::size_t>(row.other)];
      a = b = std::min(a, b);
    }
  }
  return fractions;
}

/// Keeps each triangle of the part that could not be proved apart on its side of the plane that separated it.
void JointSliding::add_rows_for_failures() {
  for (const UncertifiedPair& failure : failures_) {
    const PlacedBody& obstacle = surroundings_.bodies()[static_cast<std::size_t>(failure.bodies.obstacle)];
    const PlacedBody& part = surroundings_.bodies()[static_cast<std::size_t>(failure.bodies.part)];
    const std::size_t number = static_cast<std::size_t>(failure.bodies.part) - surroundings_.obstacles().size();
    const double margin = surroundings_.margin(failure.bodies.obstacle, failure.bodies.part);
    double top = -kUnbounded;
    for (const Eigen::Vector3d& y_W : obstacle.triangle_W(failure.obstacle_triangle))
      top = std::max(top, failure.n_W.dot(y_W));
    for (const Eigen::Vector3d& x_W : part.triangle_W(failure.part_triangle)) {
      const double gap = failure.n_W.dot(x_W) - top;
      add_row(failure.bodies.obstacle, number, failure.n_W, x_W, std::min(0.0, margin - gap));
      Contact& contact =
          proof_contacts_.emplace_back(Contact{ContactKind::kVertexFace, failure.part_triangle, failure.bodies.obstacle,
                                               failure.obstacle_triangle, failure.n_W, x_W, gap});
      contact.part = static_cast<std::int32_t>(number);
    }
  }
}

}  // namespace glissade::haptics
