#include "sweeps/sweep_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

constexpr double kLargestCenter_m = 5e8;  // trees take coordinates up to 1e9
constexpr double kSmallestSize_m = 1e-6;

constexpr std::array<SweepFamily, 15> kFamilies{{
    {Placement::kNear, Approach::kAnywhere},
    {Placement::kNear, Approach::kBisected},
    {Placement::kNear, Approach::kTouching},
    {Placement::kScaled, Approach::kAnywhere},
    {Placement::kScaled, Approach::kBisected},
    {Placement::kScaled, Approach::kTouching},
    {Placement::kUnequal, Approach::kAnywhere},
    {Placement::kUnequal, Approach::kBisected},
    {Placement::kUnequal, Approach::kTouching},
    {Placement::kFar, Approach::kAnywhere},
    {Placement::kFar, Approach::kBisected},
    {Placement::kFar, Approach::kTouching},
    {Placement::kGrid, Approach::kAnywhere},
    {Placement::kGrid, Approach::kBisected},
    {Placement::kGrid, Approach::kTouching},
}};

std::string name_of(Placement placement) {
  switch (placement) {
    case Placement::kNear:
      return "near";
    case Placement::kScaled:
      return "scaled";
    case Placement::kUnequal:
      return "unequal";
    case Placement::kFar:
      return "far";
    case Placement::kGrid:
      return "grid";
  }
  return "unknown";
}

std::string name_of(Approach approach) {
  switch (approach) {
    case Approach::kAnywhere:
      return "anywhere";
    case Approach::kBisected:
      return "bisected";
    case Approach::kTouching:
      return "touching";
  }
  return "unknown";
}

Isometry3d placed(const Matrix3d& R_AB, const Vector3d& p_AB) {
  Isometry3d X_AB = Isometry3d::Identity();
  X_AB.linear() = R_AB;
  X_AB.translation() = p_AB;
  return X_AB;
}

// The rotation by R that takes `p_B` to `p_A`.
Isometry3d meeting(const Matrix3d& R_AB, const Vector3d& p_A, const Vector3d& p_B) {
  return placed(R_AB, p_A - R_AB * p_B);
}

std::int32_t any_triangle(const geometry::TriangleMesh& mesh, RandomNumbers& random) {
  return random.integer(0, static_cast<int>(mesh.triangles.size()) - 1);
}

// A corner, the middle or another point of an edge, or a point of the face.
Vector3d feature_point(const geometry::TriangleMesh& mesh, std::int32_t triangle, RandomNumbers& random) {
  const Vector3d& p = mesh.corner(triangle, 0);
  const Vector3d along = mesh.corner(triangle, 1) - p;
  const Vector3d across = mesh.corner(triangle, 2) - p;
  switch (random.integer(0, 3)) {
    case 0:
      return p;
    case 1:
      return p + 0.5 * along;
    case 2:
      return p + random.uniform(0.0, 1.0) * along;
    default: {
      const double u = random.uniform(0.0, 1.0);
      return p + u * along + random.uniform(0.0, 1.0 - u) * across;
    }
  }
}

// Axes along an edge, along the normal and across; the identity if the triangle has no area.
Matrix3d frame_of(const geometry::TriangleMesh& mesh, std::int32_t triangle) {
  const Vector3d along = (mesh.corner(triangle, 1) - mesh.corner(triangle, 0)).normalized();
  const Vector3d normal = along.cross(mesh.corner(triangle, 2) - mesh.corner(triangle, 0));
  const Vector3d across = along.cross(normal.normalized()).normalized();
  if (!(normal.norm() > 0.0) || !(across.norm() > 0.5)) return Matrix3d::Identity();
  Matrix3d R;
  R << along, across.cross(along), across;
  return R;
}

Isometry3d pose_anywhere(const SweepPair& pair, RandomNumbers& random) {
  const Matrix3d R = random.rotation();
  if (random.chance(0.5)) {
    const Vector3d offset = random.uniform(0.0, 1.5) * (pair.A.size + pair.B.size) * random.direction();
    return meeting(R, pair.A.center + offset, pair.B.center);
  }
  const Vector3d p_A = feature_point(pair.A.mesh, any_triangle(pair.A.mesh, random), random);
  return meeting(R, p_A + random.power_of_ten(-3.0, 0.5) * pair.scale() * random.direction(), pair.B.center);
}

Isometry3d pose_on_grid(const SweepPair& pair, double cell, RandomNumbers& random) {
  const int reach = static_cast<int>((pair.A.size + pair.B.size) / cell);
  const int x = random.integer(-reach, reach);
  const int y = random.integer(-reach, reach);
  const Vector3d offset(x, y, random.integer(-reach, reach));
  return meeting(random.cube_rotation(), pair.A.center + cell * offset, pair.B.center);
}

// A rotation that is random, or maps axes to axes, or makes two faces and their edges parallel.
Matrix3d touching_rotation(const SweepPair& pair, std::int32_t triangle_A, std::int32_t triangle_B,
                           RandomNumbers& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return random.rotation();
    case 1:
      return random.cube_rotation();
    default:
      return frame_of(pair.A.mesh, triangle_A) * random.cube_rotation() * frame_of(pair.B.mesh, triangle_B).transpose();
  }
}

Vector3d nudge(const SweepPair& pair, RandomNumbers& random) {
  if (random.chance(0.5)) return Vector3d::Zero();
  return random.power_of_ten(-17.0, -6.0) * pair.scale() * random.direction();
}

Isometry3d pose_touching(const SweepPair& pair, RandomNumbers& random) {
  const std::int32_t triangle_A = any_triangle(pair.A.mesh, random);
  const std::int32_t triangle_B = any_triangle(pair.B.mesh, random);
  const Matrix3d R = touching_rotation(pair, triangle_A, triangle_B, random);
  const Vector3d p_A = feature_point(pair.A.mesh, triangle_A, random);
  return meeting(R, p_A + nudge(pair, random), feature_point(pair.B.mesh, triangle_B, random));
}

const Vector3d& farthest_along(const Vector3d& direction, const geometry::TriangleMesh& mesh) {
  return *std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](const Vector3d& u, const Vector3d& v) { return direction.dot(u) < direction.dot(v); });
}

// The meshes lie on either side of a plane, mostly one that bounds DOPs; sometimes with a gap.
Isometry3d pose_side_by_side(const SweepPair& pair, RandomNumbers& random) {
  const Matrix3d R =
      touching_rotation(pair, any_triangle(pair.A.mesh, random), any_triangle(pair.B.mesh, random), random);
  Vector3d direction = random.direction();
  if (random.chance(0.7)) {
    const int x = random.integer(-1, 1);
    const int y = random.integer(-1, 1);
    direction = Vector3d(x, y, random.integer(-1, 1));
  }
  Vector3d p_A = farthest_along(direction, pair.A.mesh);
  if (random.chance(0.3) && direction.norm() > 0.0)
    p_A += random.power_of_ten(-6.0, -1.0) * pair.scale() * direction.normalized();
  return meeting(R, p_A + nudge(pair, random), farthest_along(-(R.transpose() * direction), pair.B.mesh));
}

// Poses on both sides of a contact, as close as double precision allows and up to a millionth of the size away.
void append_bisected(const SweepPair& pair, int count, const Collides& collides, bool on_grid, RandomNumbers& random,
                     std::vector<Isometry3d>& poses) {
  const Isometry3d start = on_grid ? pose_touching(pair, random) : pose_anywhere(pair, random);
  const Vector3d direction = random.chance(0.2) ? random.cube_rotation().col(0).eval() : random.direction();
  const Vector3d p_A = feature_point(pair.A.mesh, any_triangle(pair.A.mesh, random), random);
  const Vector3d p_B = feature_point(pair.B.mesh, any_triangle(pair.B.mesh, random), random);
  const Vector3d origin = p_A - start.linear() * p_B;
  const auto pose_at = [&](double t) { return placed(start.linear(), origin + t * direction); };

  double colliding = 0.0;
  for (int i = 0; i < 8 && !collides(pose_at(colliding)); ++i)
    colliding = random.uniform(-0.2, 0.2) * pair.scale();
  double free = 4.0 * (pair.A.size + pair.B.size);
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (free + colliding);
    if (middle == colliding || middle == free) break;
    (collides(pose_at(middle)) ? colliding : free) = middle;
  }
  for (int i = 0; i < count; ++i) {
    const double offset = i < 2 ? 0.0 : random.power_of_ten(-17.0, -6.0) * pair.scale();
    poses.push_back(i % 2 == 0 ? pose_at(colliding - offset) : pose_at(free + offset));
  }
}

}  // namespace

std::span<const SweepFamily> sweep_families() {
  return kFamilies;
}

std::string family_name(const SweepFamily& family) {
  return name_of(family.placement) + "/" + name_of(family.approach);
}

SweepPair random_pair(Placement placement, RandomNumbers& random) {
  if (placement == Placement::kGrid) {
    // A power of two, and centers that are multiples of it, keep every coordinate exact.
    const double cell = random.chance(0.5) ? 1.0 : std::ldexp(1.0, random.integer(-20, 8));
    const auto center = [&]() -> Vector3d {
      if (random.chance(0.7)) return Vector3d::Zero();
      const int reach = 1 << random.integer(1, 20);
      const int x = random.integer(-reach, reach);
      const int y = random.integer(-reach, reach);
      return cell * Vector3d(x, y, random.integer(-reach, reach));
    };
    const Vector3d center_A = center();
    const Vector3d center_B = center();
    SweepMesh mesh_A = random_grid_mesh(cell, center_A, random);
    return {std::move(mesh_A), random_grid_mesh(cell, center_B, random), cell};
  }
  double size_A = placement == Placement::kNear ? 1.0 : random.power_of_ten(-6.0, 3.0);
  double size_B = size_A * random.uniform(0.3, 3.0);
  if (placement == Placement::kUnequal) {
    size_B = std::max(kSmallestSize_m, size_A * random.power_of_ten(-6.0, 0.0));
    if (random.chance(0.5)) std::swap(size_A, size_B);
  }
  const auto center = [&](double size) -> Vector3d {
    if (placement != Placement::kFar) return Vector3d::Zero();
    return std::min(kLargestCenter_m, size * random.power_of_ten(0.0, 6.0)) * random.direction();
  };
  const int which = random.integer(0, 2);
  const Vector3d center_A = which == 1 ? Vector3d::Zero() : center(size_A);
  const Vector3d center_B = which == 0 ? Vector3d::Zero() : center(size_B);
  SweepMesh mesh_A = random_mesh(size_A, center_A, random);
  return {std::move(mesh_A), random_mesh(size_B, center_B, random), 0.0};
}

std::vector<Isometry3d> random_poses(const SweepFamily& family, const SweepPair& pair, int count,
                                     const Collides& collides, RandomNumbers& random) {
  constexpr int kPosesPerContact = 12;
  const bool on_grid = family.placement == Placement::kGrid;
  std::vector<Isometry3d> poses;
  while (static_cast<int>(poses.size()) < count) {
    if (family.approach == Approach::kBisected) {
      const int wanted = std::min(kPosesPerContact, count - static_cast<int>(poses.size()));
      append_bisected(pair, wanted, collides, on_grid, random, poses);
    } else if (family.approach == Approach::kTouching) {
      poses.push_back(random.chance(0.5) ? pose_touching(pair, random) : pose_side_by_side(pair, random));
    } else {
      poses.push_back(on_grid ? pose_on_grid(pair, pair.cell, random) : pose_anywhere(pair, random));
    }
  }
  if (!on_grid && random.chance(0.1)) {
    // Matrices that are only approximately rotations, like those of files and other programs.
    const double error = random.power_of_ten(-16.0, -4.0);
    for (Isometry3d& X_AB : poses)
      X_AB.linear() += error * random.rotation();
  }
  return poses;
}

std::string text(const Isometry3d& X) {
  std::ostringstream stream;
  stream.precision(17);
  stream << X.matrix().topRows<3>();
  return stream.str();
}

std::string text(double number) {
  std::ostringstream stream;
  stream.precision(17);
  stream << number;
  return stream.str();
}

}  // namespace glissade::test_support
