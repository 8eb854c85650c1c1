#include "sweeps/torture_run.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

#include <Eigen/Geometry>

#include <glissade/contact/projection.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/reference/grid_check.h>

#include "random_numbers.h"
#include "sweeps/fit_scene.h"
#include "sweeps/torture_scene.h"
#include "swept_check.h"

namespace glissade::test_support {
namespace {

using namespace contact;
using Eigen::Isometry3d;
using Eigen::Vector3d;

// The target is elsewhere if the lag exceeds kFarFromGhost_m, or if both lag and motion of the ghost exceed
// kGhostMoves_m.
constexpr double kFarFromGhost_m = 0.1e-3;
constexpr double kGhostMoves_m = 10e-6;
// A part that stands still is jammed if a step of this length is free and brings it nearer to the target. The step is
// so short that the paths of a turning part are straight to a thousandth.
constexpr double kLongestTrial_m = 20e-6;
constexpr double kTrialOfRadius = 2e-3;
constexpr double kStraight = 1e-3;
constexpr std::int64_t kMostFaultsKept = 5;  // of one scene
constexpr std::size_t kMostTrialRows = 2000;
// Shares of the margin: bodies that start nearer count as touching; a part that does is checked with its faces so much
// further inside.
constexpr double kTouches = 1e-3;
constexpr double kDeeper = 0.1;

constexpr std::uint64_t kFnvOffset = 14695981039346656037U;
constexpr std::uint64_t kFnvPrime = 1099511628211U;

void mix(std::uint64_t value, std::uint64_t& hash) {
  for (int byte = 0; byte < 8; ++byte) {
    hash = (hash ^ (value & 0xff)) * kFnvPrime;
    value >>= 8;
  }
}

void mix(double value, std::uint64_t& hash) {
  mix(std::bit_cast<std::uint64_t>(value), hash);
}

SlidingOptions random_options(Metaphor metaphor, const SlidingPart& part, bool has_search_thread,
                              RandomNumbers& random) {
  SlidingOptions options;
  options.metaphor = metaphor;
  options.rules.has_search_thread = has_search_thread;
  constexpr std::array<int, 5> kCycles{1, 1, 2, 10, 10};
  options.rules.max_cycles = kCycles[static_cast<std::size_t>(random.integer(0, 4))];
  if (random.chance(0.2)) {
    const double translational = random.power_of_ten(1.0, 4.0);
    options.stiffness = {translational, translational * part.radius() * part.radius() * random.power_of_ten(-1.0, 1.0)};
  }
  if (random.chance(0.2)) {
    options.rules.friction.at_rest = random.uniform(0.0, 0.8);
    options.rules.friction.sliding = random.uniform(0.0, 1.0) * options.rules.friction.at_rest;
  }
  options.rules.spiral_search = random.chance(0.2);
  if (random.chance(0.3)) options.rules.contacts_ahead_ms = random.uniform(0.0, 10.0);
  return options;
}

TortureScene off_centre(TortureScene scene, RandomNumbers random) {
  const collision::DopTree& tree = scene.part_V->tree;
  const Eigen::Vector3d p_Vref = tree.center() + random.uniform(0.0, 2.0) * tree.radius() * random.direction();
  scene.part_V = std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(tree.mesh()), p_Vref);
  return scene;
}

TortureScene random_scene(const TortureOptions& options, RandomNumbers& random) {
  TortureScene scene = options.has_fits ? random_fit_scene(random) : random_torture_scene(random);
  return options.is_off_centre ? off_centre(std::move(scene), random) : scene;
}

class TortureRun {
 public:
  TortureRun(std::uint64_t seed, std::int64_t index, const TortureOptions& options)
      : random_(seed * 1'000'003 + static_cast<std::uint64_t>(index)),
        label_("--seed " + std::to_string(seed) + " --only-scene " + std::to_string(index) +
               (options.is_off_centre ? " --off-centre" : "") + (options.has_fits ? " --fits" : "")),
        scene_(random_scene(options, random_)),
        metaphor_(static_cast<Metaphor>(index % std::ssize(kMetaphorNames))),
        options_(random_options(metaphor_, *scene_.part_V, options.has_search_thread, random_)),
        sliding_(scene_.obstacles, scene_.part_V, scene_.X_WV_start, options_),
        hand_(scene_, random_),
        touches_(start_distance(scene_.part_V->tree.mesh()) < kTouches * sliding_.margin()),
        checked_(mesh_to_check()),
        grid_(placed()),
        swept_(scene_.obstacles, checked_, scene_.part_V->p_Vref()) {
    milliseconds_ = random_.chance(0.1) ? 3.0 : 1.0;
    distance_ = swept_.distance(scene_.X_WV_start, sliding_.margin());
    start_distance_ = distance_;
    started_near_ = distance_ < sliding_.min_clearance();
    counts_.scenes = 1;
    counts_.hash = kFnvOffset;
  }

  TortureCounts run(int ticks) {
    for (tick_ = 0; tick_ < ticks; ++tick_)
      tick();
    return counts_;
  }

 private:
  geometry::TriangleMesh mesh_to_check() const {
    const geometry::TriangleMesh& whole = scene_.part_V->tree.mesh();
    return touches_ ? inset_mesh(*scene_.part_V, kDeeper * sliding_.margin()).value_or(whole) : whole;
  }

  std::vector<reference::PlacedMesh> placed() const {
    std::vector<reference::PlacedMesh> meshes;
    for (const Obstacle& obstacle : scene_.obstacles)
      meshes.push_back({std::make_shared<geometry::TriangleMesh>(obstacle.body->tree.mesh()), obstacle.X_WO});
    return meshes;
  }

  const SlidingPart& part() const { return *scene_.part_V; }

  double start_distance(const geometry::TriangleMesh& mesh) const {
    return SweptCheck(scene_.obstacles, mesh, part().p_Vref()).distance(scene_.X_WV_start, sliding_.margin());
  }

  double length(const geometry::Displacement& d) const { return geometry::motion_bound(d, part().radius()); }

  geometry::Displacement between(const Isometry3d& from, const Isometry3d& to) const {
    return geometry::displacement_between(from, to, part().p_Vref());
  }

  void fault(const std::string& what) {
    if (++counts_.fault_count > kMostFaultsKept) return;
    counts_.faults.push_back(what + "\n  " + label_ + ", tick " + std::to_string(tick_) + ", " +
                             std::string(name_of(metaphor_)) + ", at most " +
                             std::to_string(options_.rules.max_cycles) + " cycles, " +
                             (options_.rules.friction.is_on() ? "with friction, " : "") +
                             (options_.rules.spiral_search ? "with spiral search, " : "") + scene_.description);
  }

  void tick() {
    const Isometry3d X_WG_previous = sliding_.result().X_WG;
    const Isometry3d X_WV_previous = sliding_.result().X_WV;
    const Isometry3d& X_WG = hand_.next();
    const bool released = sliding_.result().state == SlidingState::kReleased;
    if (!hand_.holds() && !released) sliding_.release();
    const bool grasps = hand_.holds() && released;
    if (grasps) sliding_.grasp(X_WG);
    const SlidingResult& result = sliding_.advance(X_WG, milliseconds_);
    ++counts_.ticks;
    counts_.held += hand_.holds() ? 1 : 0;
    counts_.pushed += result.pushing > 0 ? 1 : 0;
    record(result);
    if (!result.X_WV.matrix().allFinite()) {
      ++counts_.not_finite;
      fault("the visible pose is not finite");
      return;
    }
    if (result.X_WV.matrix() != X_WV_previous.matrix()) {
      ++counts_.moved;
      check_pose(result.X_WV);
      check_path(X_WV_previous, result);
      check_distance(result);
    }
    if (hand_.holds()) {
      const double ghost_motion = grasps ? 0.0 : length(between(X_WG_previous, result.X_WG));
      check_force(ghost_motion);
      check_progress(length(between(X_WV_previous, result.X_WV)), ghost_motion);
    } else {
      force_.setZero();  // a release ends the force at once
    }
  }

  void record(const SlidingResult& result) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row)
        mix(result.X_WV(row, column), counts_.hash);
    }
    mix(static_cast<std::uint64_t>(result.state), counts_.hash);
    for (const Contact& contact : result.contacts) {
      mix(contact.force, counts_.hash);
      if (!std::isfinite(contact.force)) ++counts_.not_finite;
    }
  }

  void check_pose(const Isometry3d& X_WV) {
    if (!grid_.collides(checked_, X_WV)) return;
    ++counts_.collisions;
    fault("the visible part collides");
  }

  // A call with one cycle is one motion; a call with two cycles is two motions, with X_WV_before_step in between. With
  // more cycles, only the motion of the last one is known.
  void check_path(const Isometry3d& X_WV_previous, const SlidingResult& result) {
    const bool known = result.cycles <= 2;
    ++(known ? counts_.paths : counts_.partial_paths);
    const auto check = [&](const Isometry3d& from, const Isometry3d& to) {
      if (from.matrix() == to.matrix()) return;
      const std::optional<std::string> what = swept_.fault_of(from, between(from, to));
      if (!what) return;
      ++counts_.unproved_paths;
      fault(*what);
    };
    if (known) check(X_WV_previous, result.X_WV_before_step);
    check(result.X_WV_before_step, result.X_WV);
  }

  // A part that starts nearer than the minimum clearance keeps 95 % of its initial distance. One that touches may get
  // into the other body by three fifths of what is checked less of it.
  void check_distance(const SlidingResult& result) {
    const double before = distance_;
    distance_ = swept_.distance(result.X_WV, sliding_.margin());
    if (distance_ >= sliding_.min_clearance()) started_near_ = false;
    if (!started_near_)
      counts_.least_of_min_clearance = std::min(counts_.least_of_min_clearance, distance_ / sliding_.min_clearance());
    const double magnitude = result.X_WV.translation().cwiseAbs().maxCoeff() + part().radius();
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * magnitude;
    const double allowed = std::min(sliding_.min_clearance(), (touches_ ? 0.4 : 0.95) * start_distance_);
    if (distance_ >= allowed * (1.0 - 1e-9) - rounding) return;
    ++counts_.below_min_clearance;
    char text[200];
    std::snprintf(text, sizeof text, "the distance is %.6g m, before it was %.6g m, the minimum clearance is %.6g m",
                  distance_, before, sliding_.min_clearance());
    fault(text);
  }

  void check_force(double ghost_motion) {
    const Vector3d force = spring_wrench(sliding_.stiffness(), sliding_.lag()).f;
    if (!force.allFinite()) ++counts_.not_finite;
    const double allowed = sliding_.stiffness().translational * (kSlew_m * milliseconds_ + ghost_motion);
    if (metaphor_ == Metaphor::kForceFeedback)
      counts_.force_jump = std::max(counts_.force_jump, (force - force_).norm() / allowed);
    force_ = force;
  }

  // Checks whether a part that stands still with its target elsewhere had to. With friction it may rest anywhere.
  void check_progress(double moved, double ghost_motion) {
    if (options_.rules.friction.is_on()) return;
    const geometry::Displacement error = sliding_.lag();
    const double away = length(error);
    if (!(away > kFarFromGhost_m || (ghost_motion > kGhostMoves_m && away > kGhostMoves_m))) return;
    ++counts_.wanted;
    if (moved >= 0.05 * sliding_.margin()) return;
    if (length(unbalanced_step(error)) > kGhostMoves_m) ++counts_.unbalanced;
    if (could_move(error)) ++(started_near_ ? counts_.jammed_near : counts_.jammed);
  }

  // The displacement that the sum of spring and contact forces would cause.
  geometry::Displacement unbalanced_step(const geometry::Displacement& error) const {
    const CouplingStiffness& k = sliding_.stiffness();
    Vector3d f = k.translational * error.v;
    Vector3d t = k.rotational * error.w;
    const Vector3d p_Wref = sliding_.result().X_WV * part().p_Vref();
    for (const Contact& contact : sliding_.result().contacts) {
      f += contact.force * contact.n_W;
      t += contact.force * (contact.p_W - p_Wref).cross(contact.n_W);
    }
    return {f / k.translational, t / k.rotational};
  }

  // Projects the error on planes normal to the shortest lines between near triangles, and tries a short step along the
  // result. The step counts if it is proved free, does not reduce the distance within the margin, and lowers the energy
  // by at least a hundredth of what a step along the spring's force would.
  bool could_move(const geometry::Displacement& error) {
    const CouplingStiffness& k = sliding_.stiffness();
    const double margin = sliding_.margin();
    const double step = std::min(kLongestTrial_m, kTrialOfRadius * part().radius());
    const Isometry3d& X_WV = sliding_.result().X_WV;
    if (!project_on_near_pairs(error, X_WV, margin + 1.5 * step)) return false;
    if (length(projection_.displacement()) < step) return false;
    const geometry::Displacement trial =
        projection_.displacement().scaled(geometry::fraction_within(projection_.displacement(), part().radius(), step));
    const Isometry3d X_WV_trial = geometry::displaced(X_WV, part().p_Vref(), trial);
    const auto energy = [&](const geometry::Displacement& d) {
      return 0.5 * (k.translational * d.v.squaredNorm() + k.rotational * d.w.squaredNorm());
    };
    const double before = energy(error);
    const double gain = before - energy(between(X_WV_trial, sliding_.result().X_WT));
    if (gain < 0.01 * std::sqrt(2.0 * before * k.translational) * step) return false;
    if (swept_.distance(X_WV_trial, margin) < swept_.distance(X_WV, margin) - kStraight * step) return false;
    return !swept_.fault_of(X_WV, trial);
  }

  bool project_on_near_pairs(const geometry::Displacement& error, const Isometry3d& X_WV, double reach) {
    const Vector3d p_Wref = X_WV * part().p_Vref();
    const auto& near = swept_.near_pairs(X_WV, reach, kMostTrialRows);
    if (near.size() == kMostTrialRows) return false;
    rows_.clear();
    for (const SweptCheck::NearPair& pair : near) {
      if (pair.distance == 0.0) return false;
      const Vector3d n = (pair.p_part - pair.p_obstacle) / pair.distance;
      rows_.push_back({n, pair.p_part - p_Wref, std::min(0.0, sliding_.margin() - pair.distance)});
    }
    projection_ = solver_.project(error, sliding_.stiffness(), rows_);
    return projection_.status == ProjectionStatus::kSolved;
  }

  RandomNumbers random_;
  std::string label_;
  TortureScene scene_;
  Metaphor metaphor_;
  SlidingOptions options_;
  Sliding sliding_;
  TortureHand hand_;
  bool touches_;  // at the start
  geometry::TriangleMesh checked_;
  reference::GridCheck grid_;
  SweptCheck swept_;
  double milliseconds_;
  double distance_;
  double start_distance_;
  bool started_near_;
  Vector3d force_ = Vector3d::Zero();
  int tick_ = 0;
  std::vector<ConstraintRow> rows_;
  ProjectionSolver solver_;
  Projection<1> projection_;
  TortureCounts counts_;
};

}  // namespace

void TortureCounts::add(const TortureCounts& later) {
  scenes += later.scenes;
  ticks += later.ticks;
  held += later.held;
  pushed += later.pushed;
  moved += later.moved;
  collisions += later.collisions;
  paths += later.paths;
  partial_paths += later.partial_paths;
  unproved_paths += later.unproved_paths;
  below_min_clearance += later.below_min_clearance;
  least_of_min_clearance = std::min(least_of_min_clearance, later.least_of_min_clearance);
  not_finite += later.not_finite;
  wanted += later.wanted;
  jammed += later.jammed;
  jammed_near += later.jammed_near;
  unbalanced += later.unbalanced;
  force_jump = std::max(force_jump, later.force_jump);
  mix(later.hash, hash);
  fault_count += later.fault_count;
  faults.insert(faults.end(), later.faults.begin(), later.faults.end());
}

TortureCounts run_torture_scene(std::uint64_t seed, std::int64_t index, int milliseconds,
                                const TortureOptions& options) {
  return TortureRun(seed, index, options).run(milliseconds);
}

}  // namespace glissade::test_support
