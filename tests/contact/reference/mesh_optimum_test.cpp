// Where a part comes to rest among convex meshes, against a minimiser of other making (constrained_minimiser.h). Bodies
// that turn may have more than one local optimum, and the part may come to rest in any of them; what must not happen is
// that it rests where it could still go downhill.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "constrained_minimiser.h"
#include "convex_shapes.h"
#include "held_part.h"
#include "hull_oracle.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using test_support::affordable;
using test_support::ConvexPiece;
using test_support::HullOracle;
using test_support::kRestBalance;
using test_support::kRestPosition_m;
using test_support::kRestRotation_rad;
using test_support::pose;
using test_support::RandomNumbers;
using test_support::RestOptimum;
using test_support::RestProblem;
using test_support::turn;

/// A part and what is around it, as meshes for the library and as convex pieces for the minimiser.
struct Scene {
  geometry::TriangleMesh part_mesh;
  std::vector<ConvexPiece> part_pieces;
  std::vector<Obstacle> obstacles;
  std::vector<ConvexPiece> obstacle_pieces;
  Isometry3d X_WV_start;
  Vector3d inwards;  ///< where the ghost goes from there until there is contact, and then deeper

  void add_obstacle(const geometry::TriangleMesh& mesh, const Isometry3d& X_WO) {
    obstacles.push_back(test_support::obstacle_of(mesh, X_WO));
    obstacle_pieces.push_back(test_support::piece_of(mesh, X_WO));
  }
  void set_part(const geometry::TriangleMesh& mesh) {
    part_mesh = mesh;
    part_pieces = {test_support::piece_of(mesh)};
  }
};

double energy(const Sliding& sliding, const Isometry3d& X_WV) {
  const double length = test_support::length_in(
      sliding.stiffness(), geometry::displacement_between(X_WV, sliding.result().X_WG, sliding.part().p_Vref()));
  return 0.5 * length * length;
}

/// The vector between the two pieces that are nearest to each other.
Vector3d nearest_difference(const RestProblem& problem, const Isometry3d& X_WV) {
  Vector3d nearest = Vector3d::Constant(1e9);
  for (const ConvexPiece& piece : problem.part_V) {
    for (const ConvexPiece& obstacle : problem.obstacles_W) {
      const Vector3d difference = HullOracle(obstacle, piece, X_WV).difference();
      if (difference.norm() < nearest.norm()) nearest = difference;
    }
  }
  return nearest;
}

/// The pose, moved out along what is nearest until nothing is nearer than `gap`.
Isometry3d moved_out(const RestProblem& problem, Isometry3d X_WV, double gap) {
  for (int i = 0; i < 200; ++i) {
    const Vector3d difference = nearest_difference(problem, X_WV);
    if (difference.norm() >= gap) break;
    X_WV.translation() += (gap - difference.norm() + 1e-13) * difference.normalized();
  }
  return X_WV;
}

bool is_at(const Sliding& sliding, const Isometry3d& X_WV) {
  const geometry::Displacement error =
      geometry::displacement_between(X_WV, sliding.result().X_WV, sliding.part().p_Vref());
  return error.v.norm() <= kRestPosition_m && error.w.norm() <= kRestRotation_rad;
}

/// Whether the energy falls when the part goes a micrometre towards X_WV, kept off the obstacles by the margin.
bool goes_downhill_towards(const Sliding& sliding, const RestProblem& problem, const Isometry3d& X_WV) {
  const geometry::Displacement d = geometry::displacement_between(sliding.result().X_WV, X_WV, sliding.part().p_Vref());
  const double fraction = 1e-6 / geometry::motion_bound(d, sliding.part().radius());
  const Isometry3d X_near = geometry::displaced(sliding.result().X_WV, sliding.part().p_Vref(), d.scaled(fraction));
  return energy(sliding, moved_out(problem, X_near, problem.margin)) < energy(sliding, sliding.result().X_WV);
}

/// Leads a ghost into the obstacles and compares where the part rests. Returns whether it is where the minimiser comes
/// to rest from the part's start, or from right beside the part; otherwise the part must be in a hollow of its own.
bool expect_rest_at_optimum(const Scene& scene, RandomNumbers& random) {
  Sliding sliding(scene.obstacles, test_support::part_of(scene.part_mesh), scene.X_WV_start,
                  {.metaphor = Metaphor::kRubberBandSpring});
  Isometry3d X_WG = scene.X_WV_start;
  for (int i = 0; i < 800 && sliding.result().pushing == 0; ++i) {
    X_WG.translation() += 0.5e-3 * scene.inwards;
    sliding.advance(X_WG);
  }
  EXPECT_GT(sliding.result().pushing, 0) << "the scene has no contact";
  const Vector3d deeper = random.uniform(1e-3, 5e-3) * scene.inwards + random.point(2e-3);
  const Eigen::Quaterniond turned = turn(random.uniform(-0.1, 0.1), random.direction());
  X_WG = pose(X_WG.translation() + deeper, turned * Eigen::Quaterniond(X_WG.linear()));
  test_support::lead(sliding, X_WG, 100);
  EXPECT_GE(test_support::hold_until_rest(sliding), 0);
  if (sliding.result().state == SlidingState::kFree) return true;
  EXPECT_LE(test_support::imbalance(sliding), kRestBalance);

  const RestProblem problem{scene.part_pieces, scene.obstacle_pieces, sliding.part().p_Vref(), sliding.stiffness(),
                            sliding.margin()};
  EXPECT_GE(nearest_difference(problem, sliding.result().X_WV).norm(), sliding.margin() - 1e-9);
  const RestOptimum far = test_support::find_rest(problem, X_WG, scene.X_WV_start);
  EXPECT_TRUE(far.converged);
  EXPECT_GE(far.least_distance, sliding.margin());
  if (is_at(sliding, far.X_WV)) return true;
  const Isometry3d beside = moved_out(problem, sliding.result().X_WV, sliding.margin() + 2e-6);
  const RestOptimum near = test_support::find_rest(problem, X_WG, beside, 0.5e-6);
  if (is_at(sliding, near.X_WV)) return true;
  EXPECT_FALSE(goes_downhill_towards(sliding, problem, near.X_WV)) << "the part is stuck";
  EXPECT_FALSE(goes_downhill_towards(sliding, problem, far.X_WV)) << "the part is stuck";
  return false;
}

/// Compares many scenes, each of a seed of its own. All but a few must agree with the minimiser.
template <typename MakeScene>
void compare(int first_seed, int scenes, const MakeScene& make_scene) {
  int in_another_hollow = 0;
  for (int seed = first_seed; seed < first_seed + scenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomNumbers random(static_cast<std::uint64_t>(seed));
    if (!expect_rest_at_optimum(make_scene(random), random)) ++in_another_hollow;
  }
  ::testing::Test::RecordProperty("in_another_hollow", in_another_hollow);
  EXPECT_LE(in_another_hollow, scenes / 25);
}

Isometry3d random_turn(RandomNumbers& random, const Vector3d& p) {
  return pose(p, Eigen::Quaterniond(random.rotation()));
}

Scene convex_part_on_convex_obstacle(RandomNumbers& random) {
  Scene scene;
  scene.set_part(test_support::random_convex_mesh(random, 0.03));
  scene.add_obstacle(test_support::random_convex_mesh(random, 0.05), random_turn(random, random.point(0.02)));
  const Vector3d direction = random.direction();
  scene.X_WV_start = random_turn(random, 0.2 * direction);
  scene.inwards = -direction;
  return scene;
}

TEST(MeshOptimum, OfConvexPartsOnConvexObstacles) {
  compare(1, affordable(100), convex_part_on_convex_obstacle);
}

TEST(MeshOptimum, OfAnEdgeThatNearlyLiesOnAFace) {
  // It rests on one side of the face and is some micrometres above the other. Rows for whole triangles that could not
  // be proved apart once kept it there.
  compare(1876, 1, convex_part_on_convex_obstacle);
}

/// Blocks that meet at right angles: two make a groove along y, three a corner.
void add_blocks(Scene& scene, int count, const Isometry3d& X_WB) {
  constexpr double kEdge = 0.3;
  const geometry::TriangleMesh block = geometry::make_box(Vector3d::Constant(kEdge), 12);
  for (const Vector3d& axis : std::vector<Vector3d>{Vector3d::UnitX(), Vector3d::UnitZ(), Vector3d::UnitY()}) {
    if (count-- == 0) return;
    scene.add_obstacle(block, X_WB * pose(-0.5 * kEdge * axis + 0.1 * (Vector3d::Ones() - axis)));
  }
}

TEST(MeshOptimum, OfConvexPartsInGroovesAndCorners) {
  compare(1, affordable(60), [](RandomNumbers& random) {
    Scene scene;
    scene.set_part(test_support::random_convex_mesh(random, 0.03));
    const Isometry3d X_WB = random_turn(random, random.point(0.02));
    add_blocks(scene, random.integer(2, 3), X_WB);
    const Vector3d inside = random.uniform(0.06, 0.08) * Vector3d(1.0, 1.0, 1.0) + random.point(0.005);
    scene.X_WV_start = random_turn(random, X_WB * inside);
    scene.inwards = X_WB.linear() * Vector3d(-1.0, random.uniform(-1.0, 0.0), random.uniform(-1.0, 0.0)).normalized();
    return scene;
  });
}

TEST(MeshOptimum, OfAnAngleBracketOverABlock) {
  // A part that is not convex, of two convex pieces that share a face: it hangs over the edge of the block, and both
  // its legs touch.
  const geometry::TriangleMesh leg = geometry::make_box({0.06, 0.03, 0.01}, 12);
  const geometry::TriangleMesh upright =
      geometry::transformed(leg, pose({-0.025, 0.0, -0.035}, turn(0.5 * std::numbers::pi, Vector3d::UnitY())));
  compare(1, affordable(40), [&](RandomNumbers& random) {
    Scene scene;
    scene.part_mesh = geometry::merge(std::vector<geometry::TriangleMesh>{leg, upright});
    scene.part_pieces = {test_support::piece_of(leg), test_support::piece_of(upright)};
    scene.add_obstacle(geometry::make_box({0.1, 0.2, 0.1}, 12), pose({0.05, 0.0, -0.05}));
    scene.X_WV_start =
        pose(Vector3d(0.0, 0.0, 0.03) + random.point(2e-3), turn(random.uniform(-0.1, 0.1), random.direction()));
    scene.inwards = Vector3d(0.3, 0.0, -1.0).normalized();
    return scene;
  });
}

}  // namespace
}  // namespace glissade::contact
