#include "certificate/separating_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/base/assert.h>

namespace glissade::haptics {
namespace {

/// The height of an obstacle's triangle whose direction is not known.
constexpr float kUnknownTop = 1e30F;

/// Of a gap, in the greatest lengths that it is made of. With u = 2^-24: the products n_j A_jk x_k have four factors
/// that are rounded and pass two sums of three each, so all together they err by less than 8 √3 u times the part's
/// radius; n·t by 4 u |t|, the heights of the obstacle by 3 u. The rest is for the length of n and the last sums.
constexpr double kSlackOfGap = 32.0 / (1 << 24);

}  // namespace

void PlanesOfBodies::start(const BodyPair& pair, std::span<const PlacedBody> bodies) {
  pair_ = pair;
  farthest_ = 0.0;
  numbers_.clear();
  blocks_.clear();
  const PlacedBody& obstacle = bodies[static_cast<std::size_t>(pair.obstacle)];
  const PlacedBody& part = bodies[static_cast<std::size_t>(pair.part)];
  c_V_ = part.body->tree.center();
  o_O_ = relative_pose(obstacle.X_WB, part.X_WB) * c_V_;
  radius_ = part.body->tree.radius();
}

void PlanesOfBodies::add(std::uint32_t number, std::int32_t obstacle_triangle, std::int32_t part_triangle,
                         const Eigen::Vector3d& n_W, std::span<const PlacedBody> bodies) {
  const PlacedBody& obstacle = bodies[static_cast<std::size_t>(pair_.obstacle)];
  const geometry::TriangleMesh& mesh_V = bodies[static_cast<std::size_t>(pair_.part)].body->tree.mesh();
  const std::size_t slot = numbers_.size();
  const std::size_t lane = slot % kPlanesAtOnce;
  numbers_.push_back(number);
  if (lane == 0) blocks_.push_back({});
  PlaneBlock& block = blocks_.back();
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d x = mesh_V.corner(part_triangle, c) - c_V_;
    for (std::size_t axis = 0; axis < 3; ++axis)
      block.x[static_cast<std::size_t>(c)][axis][lane] = static_cast<float>(x[static_cast<Eigen::Index>(axis)]);
  }
  block.top[lane] = kUnknownTop;
  if (!n_W.isZero(0.0)) turn(slot, *obstacle.body, obstacle_triangle, obstacle.X_WB.linear().transpose() * n_W);
}

void PlanesOfBodies::turn(std::size_t slot, const ContactBody& obstacle, std::int32_t obstacle_triangle,
                          const Eigen::Vector3d& n_O) {
  PlaneBlock& block = blocks_[slot / kPlanesAtOnce];
  const std::size_t lane = slot % kPlanesAtOnce;
  const Eigen::Vector3f n = n_O.cast<float>();
  double top = -std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d y = obstacle.tree.mesh().corner(obstacle_triangle, c) - o_O_;
    farthest_ = std::max(farthest_, y.norm());
    top = std::max(top, n.cast<double>().dot(y));
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    block.n[axis][lane] = n[static_cast<Eigen::Index>(axis)];
  block.top[lane] = static_cast<float>(top);
}

void PlanesOfBodies::find_gaps(const Eigen::Matrix3d& A, const Eigen::Vector3d& t, std::size_t first, std::size_t end,
                               std::vector<float>& gaps) const {
  GLISSADE_ASSERT(first <= end && end <= blocks_.size());
  const Eigen::Vector3d from_o = A * c_V_ + t - o_O_;
  PlaneMap map;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      map.A[row][column] = static_cast<float>(A(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
    map.t[row] = static_cast<float>(from_o[static_cast<Eigen::Index>(row)]);
  }
  const double slack = kSlackOfGap * (radius_ + from_o.norm() + farthest_);
  gaps.resize(kPlanesAtOnce * blocks_.size());
  find_plane_gaps(std::span(blocks_).subspan(first, end - first), map, static_cast<float>(slack),
                  gaps.data() + kPlanesAtOnce * first);
}

}  // namespace glissade::haptics
