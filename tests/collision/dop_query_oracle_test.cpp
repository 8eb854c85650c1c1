// The tree's answers against CGAL and plain loops, on more than 20,000 poses of nine pairs of meshes: half of the poses
// anywhere, half within a thousandth of the size of a first contact.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/shapes/car_door_parts.h>
#include <glissade/shapes/shape_catalog.h>

#include "cgal_oracle.h"
#include "mesh_oracle.h"
#include "sanitizers.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::affordable;
using test_support::MeshOracle;

constexpr int kContactsPerPair = 150;
constexpr int kPosesPerContact = 16;  // eight near the contact, eight anywhere

geometry::TriangleMesh sheet() {
  return shapes::make_shape("sheet", {{"size_x_m", 0.4}, {"size_y_m", 0.3}, {"triangles", 400.0}});
}
geometry::TriangleMesh small_sheet() {
  return shapes::make_shape("sheet", {{"size_x_m", 0.2},
                                      {"size_y_m", 0.15},
                                      {"hole_x_m", 0.06},
                                      {"hole_y_m", 0.04},
                                      {"hole_corner_radius_m", 0.01},
                                      {"bead_width_m", 0.01},
                                      {"triangles", 300.0}});
}
geometry::TriangleMesh sphere() {
  return geometry::make_sphere(0.1, 300);
}
geometry::TriangleMesh torus() {
  return geometry::make_torus(0.1, 0.03, 400);
}
geometry::TriangleMesh hyperboloid() {
  return geometry::make_hyperboloid(0.04, 0.1, 0.2, 400);
}
geometry::TriangleMesh plate() {
  return geometry::make_plate({0.2, 0.15}, 200);
}
geometry::TriangleMesh inner_panel() {
  return shapes::make_door_inner_panel(0.005);
}
geometry::TriangleMesh impact_tube() {
  return shapes::make_door_impact_tube(0.05);
}
geometry::TriangleMesh hose() {
  return shapes::make_door_hose(0.05);
}
geometry::TriangleMesh motor() {
  return shapes::make_window_motor(0.005);
}

struct MeshPair {
  std::string name;
  geometry::TriangleMesh (*make_A)();
  geometry::TriangleMesh (*make_B)();
};

// Both trees, the oracle, and poses that depend on nothing but the seed.
class Duel {
 public:
  explicit Duel(const MeshPair& pair)
      : mesh_A_(std::make_shared<const geometry::TriangleMesh>(pair.make_A())),
        mesh_B_(std::make_shared<const geometry::TriangleMesh>(pair.make_B())),
        tree_A_(mesh_A_),
        tree_B_(mesh_B_),
        oracle_(*mesh_A_, *mesh_B_) {}

  const DopTree& tree_A() const { return tree_A_; }
  const DopTree& tree_B() const { return tree_B_; }
  const MeshOracle& oracle() const { return oracle_; }
  double size() const { return oracle_.radius_A() + oracle_.radius_B(); }

  /// Poses about one first contact in a random direction and orientation, and as many anywhere.
  std::vector<Isometry3d> poses(std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    std::vector<Isometry3d> poses;
    while (!append_poses_near_contact(random, poses)) {
    }
    for (int i = 0; i < kPosesPerContact / 2; ++i) {
      poses.push_back(placed(random_rotation(random), uniform(random, 0.0, 0.8) * size() * random_direction(random)));
    }
    return poses;
  }

 private:
  static double uniform(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  static Vector3d random_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    return Vector3d(x, y, normal(random)).normalized();
  }
  static Eigen::AngleAxisd random_rotation(std::mt19937_64& random) {
    const Vector3d axis = random_direction(random);
    return {uniform(random, -std::numbers::pi, std::numbers::pi), axis};
  }
  static Isometry3d placed(const Eigen::AngleAxisd& rotation, const Vector3d& p_AB) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.linear() = rotation.toRotationMatrix();
    X_AB.translation() = p_AB;
    return X_AB;
  }

  /// Approaches a point of A from afar; false when there is nothing in the way.
  bool append_poses_near_contact(std::mt19937_64& random, std::vector<Isometry3d>& poses) const {
    const Eigen::AngleAxisd rotation = random_rotation(random);
    const Vector3d direction = random_direction(random);
    const Vector3d target = uniform(random, 0.0, 0.6) * oracle_.radius_A() * random_direction(random);
    const auto pose_at = [&](double t) { return placed(rotation, target + t * direction); };
    double free = 2.0 * size();
    double colliding = free;
    while (!oracle_.intersects(pose_at(colliding))) {
      free = colliding;
      colliding -= 0.05 * size();
      if (colliding < 0.0) return false;
    }
    while (free - colliding > 1e-15 * size()) {
      const double middle = 0.5 * (free + colliding);
      if (middle <= colliding || middle >= free) break;
      (oracle_.intersects(pose_at(middle)) ? colliding : free) = middle;
    }
    poses.push_back(pose_at(colliding));
    poses.push_back(pose_at(free));
    for (int i = 2; i < kPosesPerContact / 2; ++i) {
      const double offset = std::pow(10.0, uniform(random, -15.0, -3.0)) * size();
      poses.push_back(pose_at(colliding + (i % 2 == 0 ? offset : -offset)));
    }
    return true;
  }

  std::shared_ptr<const geometry::TriangleMesh> mesh_A_;
  std::shared_ptr<const geometry::TriangleMesh> mesh_B_;
  DopTree tree_A_;
  DopTree tree_B_;
  MeshOracle oracle_;
};

std::string text(const Isometry3d& X) {
  std::ostringstream stream;
  stream.precision(17);
  stream << X.matrix();
  return stream.str();
}

class DopQueryOracle : public testing::TestWithParam<MeshPair> {
 protected:
  static std::uint64_t seed(int contact) { return 1'000 + static_cast<std::uint64_t>(contact); }
};

TEST_P(DopQueryOracle, IntersectsExactlyWhenCgalSaysSo) {
  const Duel duel(GetParam());
  const int contacts = affordable(kContactsPerPair);
  std::vector<std::string> differences(static_cast<std::size_t>(contacts));
  std::vector<int> colliding(static_cast<std::size_t>(contacts));
  tbb::parallel_for(0, contacts, [&](int contact) {
    QueryWorkspace workspace;
    for (const Isometry3d& X_AB : duel.poses(seed(contact))) {
      const bool expected = duel.oracle().intersects(X_AB);
      const auto slot = static_cast<std::size_t>(contact);
      colliding[slot] += expected ? 1 : 0;
      if (intersects(duel.tree_A(), duel.tree_B(), X_AB, workspace) != expected) differences[slot] += text(X_AB) + "\n";
    }
  });
  int total = 0;
  for (int contact = 0; contact < contacts; ++contact) {
    EXPECT_EQ(differences[static_cast<std::size_t>(contact)], "") << "seed " << seed(contact);
    total += colliding[static_cast<std::size_t>(contact)];
  }
  // A quarter of the poses are in contact by construction, and another is free.
  EXPECT_GE(total, contacts * kPosesPerContact / 4);
  EXPECT_LE(total, contacts * kPosesPerContact * 3 / 4 + contacts);
}

TEST_P(DopQueryOracle, FindsThePairsThatCgalFinds) {
  const Duel duel(GetParam());
  QueryWorkspace workspace;
  std::vector<TrianglePair> pairs;
  for (int contact = 0; contact < std::max(1, affordable(20)); ++contact) {
    for (const Isometry3d& X_AB : duel.poses(seed(contact))) {
      intersecting_pairs(duel.tree_A(), duel.tree_B(), X_AB, workspace, pairs);
      ASSERT_EQ(pairs, duel.oracle().intersecting_pairs(X_AB)) << "seed " << seed(contact) << "\n" << text(X_AB);
    }
  }
}

void expect_same(const std::vector<ClosePair>& actual, const std::vector<ClosePair>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    ASSERT_EQ(actual[i].triangles, expected[i].triangles);
    ASSERT_NEAR(actual[i].distance, expected[i].distance, 1e-12 * expected[i].distance);
  }
}

// The points must lie on the triangles and the distance be CGAL's, for a few of the pairs: its arithmetic is slow.
void expect_true_distances(const std::vector<ClosePair>& pairs, const MeshOracle& oracle, const Isometry3d& X_AB) {
  for (std::size_t i = 0; i < pairs.size(); i += 1 + pairs.size() / 3) {
    const geometry::TrianglePoints a = oracle.points_A(pairs[i].triangles.triangle_A);
    const geometry::TrianglePoints b = oracle.points_B(pairs[i].triangles.triangle_B, X_AB);
    const bool intersect = test_support::cgal_intersect(a, b);
    ASSERT_EQ(pairs[i].distance == 0.0, intersect);
    ASSERT_NEAR(pairs[i].distance, intersect ? 0.0 : test_support::cgal_distance(a, b), 1e-14);
    ASSERT_LE(test_support::cgal_distance(pairs[i].p_A, a), 1e-14);
    ASSERT_LE(test_support::cgal_distance(pairs[i].p_B, b), 1e-14);
  }
}

TEST_P(DopQueryOracle, FindsThePairsWithinADistance) {
  const Duel duel(GetParam());
  QueryWorkspace workspace;
  std::vector<ClosePair> pairs;
  for (int contact = 0; contact < std::max(1, affordable(20)); ++contact) {
    const std::vector<Isometry3d> poses = duel.poses(seed(contact));
    for (std::size_t i = 0; i < poses.size(); i += 4) {
      for (const double distance : {0.0, 1e-3 * duel.size(), 1e-2 * duel.size()}) {
        SCOPED_TRACE("seed " + std::to_string(seed(contact)) + ", distance " + std::to_string(distance) + "\n" +
                     text(poses[i]));
        pairs_within(duel.tree_A(), duel.tree_B(), poses[i], distance, workspace, pairs);
        ASSERT_NO_FATAL_FAILURE(expect_same(pairs, duel.oracle().pairs_within(poses[i], distance)));
        ASSERT_NO_FATAL_FAILURE(expect_true_distances(pairs, duel.oracle(), poses[i]));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, DopQueryOracle,
                         testing::Values(MeshPair{"SphereSphere", sphere, sphere}, MeshPair{"TorusTorus", torus, torus},
                                         MeshPair{"HyperboloidTorus", hyperboloid, torus},
                                         MeshPair{"SheetSphere", sheet, sphere},
                                         MeshPair{"SheetSheet", sheet, small_sheet},
                                         MeshPair{"HyperboloidPlate", hyperboloid, plate},
                                         MeshPair{"PanelMotor", inner_panel, motor},
                                         MeshPair{"TubeMotor", impact_tube, motor}, MeshPair{"HoseMotor", hose, motor}),
                         [](const auto& instance) { return instance.param.name; });

// The bracket lies flush on the panel and touches a bead: hundreds of coplanar and touching pairs in one pose.
TEST(DopQueryOracleSeat, MatchesCgalForAFlushMotor) {
  const Duel duel({"PanelMotor", inner_panel, motor});
  QueryWorkspace workspace;
  std::vector<TrianglePair> pairs;
  bool both[2] = {false, false};
  for (const double dy : {0.0, 1e-17, -1e-15, 1e-9, 1e-5}) {
    for (const double dz : {0.0, 1e-16, -1e-12, -1e-5}) {
      Isometry3d X_WV = shapes::seat_pose_WV();
      X_WV.translation() += Vector3d(0.0, dy, dz);
      SCOPED_TRACE(text(X_WV));
      intersecting_pairs(duel.tree_A(), duel.tree_B(), X_WV, workspace, pairs);
      EXPECT_EQ(pairs, duel.oracle().intersecting_pairs(X_WV));
      EXPECT_EQ(intersects(duel.tree_A(), duel.tree_B(), X_WV, workspace), !pairs.empty());
      both[pairs.empty() ? 0 : 1] = true;
    }
  }
  EXPECT_TRUE(both[0] && both[1]);
}

}  // namespace
}  // namespace glissade::collision
