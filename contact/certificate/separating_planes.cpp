#include "certificate/separating_planes.h"

#include <algorithm>
#include <cmath>

#include <glissade/base/assert.h>

namespace glissade::contact {
namespace {

/// The height of a triangle whose direction is not known.
constexpr float kUnknownTop = 1e30F;

/// Of a gap along n as it was before it was rounded, in the greatest lengths that it is made of. With u = 2^-24: the
/// products n_j A_jk x_k have four factors that are rounded and pass two sums of three each, so all together they err
/// by less than 8 √3 u times the length of x; n·t by 4 u |t|, the height of the other triangle by u. The rest covers
/// the length of n and the last sums. It also covers the rounding of n, because certificates use the rounded n.
constexpr double kSlackOfGap = 32.0 / (1 << 24);

PlaneMap map_of(const Eigen::Matrix3d& A, const Eigen::Vector3d& t) {
  PlaneMap map;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      map.A[row][column] = static_cast<float>(A(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
    map.t[row] = static_cast<float>(t[static_cast<Eigen::Index>(row)]);
  }
  return map;
}

}  // namespace

void PlanesOfBodies::start(const BodyPair& pair, std::span<const PlacedBody> bodies) {
  pair_ = pair;
  farthest_squared_ = 0.0;
  numbers_.clear();
  triangles_.clear();
  blocks_.clear();
  const PlacedBody& obstacle = bodies[static_cast<std::size_t>(pair.obstacle)];
  const PlacedBody& part = bodies[static_cast<std::size_t>(pair.part)];
  c_V_ = part.body->tree.center();
  radius_ = part.body->tree.radius();
  ball_ = BallAboutPart::at(relative_pose(obstacle.X_WB, part.X_WB), part.body->tree);
}

void PlanesOfBodies::add(std::uint32_t number, const TrianglesOfBodies& pair, const Eigen::Vector3d& n_W,
                         bool turns_with_part, std::span<const PlacedBody> bodies) {
  const std::size_t slot = numbers_.size();
  numbers_.push_back(number);
  triangles_.push_back({pair.obstacle_triangle, pair.part_triangle});
  if (slot % kPlanesAtOnce == 0) blocks_.push_back({});
  blocks_.back().top[slot % kPlanesAtOnce] = kUnknownTop;
  if (n_W.isZero(0.0)) return;
  const auto fixed_to = [&](std::int32_t body) -> Eigen::Vector3d {
    return bodies[static_cast<std::size_t>(body)].X_WB.linear().transpose() * n_W;
  };
  if (turns_with_part && turn(slot, {fixed_to(pair_.part), true}, bodies)) return;
  turn(slot, {fixed_to(pair_.obstacle), false}, bodies);
}

bool PlanesOfBodies::turn(std::size_t slot, const FixedDirection& direction, std::span<const PlacedBody> bodies) {
  const TrianglesOfBodies pair = triangles(slot);
  geometry::TrianglePoints y =
      bodies[static_cast<std::size_t>(pair_.obstacle)].body->tree.mesh().corners(pair.obstacle_triangle);
  geometry::TrianglePoints x =
      bodies[static_cast<std::size_t>(pair_.part)].body->tree.mesh().corners(pair.part_triangle);
  double farthest_squared = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    y[c] -= ball_.center_O;
    x[c] -= c_V_;
    farthest_squared = std::max(farthest_squared, y[c].squaredNorm());
  }
  if (direction.turns_with_part && farthest_squared > ball_.radius * ball_.radius) return false;
  farthest_squared_ = std::max(farthest_squared_, farthest_squared);
  const geometry::TrianglePoints& own = direction.turns_with_part ? x : y;
  const geometry::TrianglePoints& other = direction.turns_with_part ? y : x;
  const Eigen::Vector3d n = direction.turns_with_part ? Eigen::Vector3d(-direction.n) : direction.n;
  const double top = std::max({n.dot(own[0]), n.dot(own[1]), n.dot(own[2])});
  PlaneBlock& block = blocks_[slot / kPlanesAtOnce];
  const std::size_t lane = slot % kPlanesAtOnce;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    block.n[axis][lane] = static_cast<float>(n[i]);
    for (std::size_t c = 0; c < 3; ++c)
      block.x[c][axis][lane] = static_cast<float>(other[c][i]);
  }
  block.top[lane] = static_cast<float>(top);
  block.turns_with_part[lane] = direction.turns_with_part ? 1.0F : 0.0F;
  return true;
}

PlaneMaps PlanesOfBodies::maps(const Eigen::Matrix3d& A, const Eigen::Vector3d& t) const {
  const Eigen::Vector3d from_center = A * c_V_ + t - ball_.center_O;
  const Eigen::Matrix3d back = A.inverse();
  return {map_of(A, from_center), map_of(back, -(back * from_center)),
          static_cast<float>(kSlackOfGap * (radius_ + from_center.norm() + std::sqrt(farthest_squared_)))};
}

void PlanesOfBodies::find_gaps(const PlaneMaps& maps, std::size_t first, std::size_t end,
                               std::vector<float>& gaps) const {
  GLISSADE_ASSERT(first <= end && end <= blocks_.size());
  gaps.resize(kPlanesAtOnce * blocks_.size());
  find_plane_gaps(std::span(blocks_).subspan(first, end - first), maps, gaps.data() + kPlanesAtOnce * first);
}

}  // namespace glissade::contact
