#include "search/lasting_planes.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "search/blocks_of_pairs.h"
#include "search/round_down.h"

namespace glissade::contact {
namespace {

/// In margins: pairs that planes keep so far apart are of no interest to a step, neither for contacts nor for its
/// proof.
constexpr double kOfNoInterest = 2.5;

/// Work of a new plane, in the unit of `collision::WorkMeter`.
constexpr std::int64_t kWorkOfPlane = 300;

}  // namespace

void LastingPlanes::turn(const ExpectedStep& step, std::span<const PlacedBody> bodies,
                         std::vector<PlanesOfBodies>& planes) {
  for (PlanesOfBodies& of_bodies : planes)
    turn(step, bodies, of_bodies);
}

void LastingPlanes::turn(const ExpectedStep& step, std::span<const PlacedBody> bodies, PlanesOfBodies& planes) {
  const auto [obstacle, part] = planes.bodies();
  const auto pose = [&](const std::vector<Eigen::Isometry3d>& X_WB, std::int32_t body) -> const Eigen::Isometry3d& {
    const auto number = static_cast<std::size_t>(body);
    const std::size_t obstacles = scene_.obstacles().size();
    return number < obstacles ? bodies[number].X_WB : X_WB[number - obstacles];
  };
  const Eigen::Isometry3d X_OV_begin = relative_pose(pose(step.X_WB_begin, obstacle), pose(step.X_WB_begin, part));
  const Eigen::Isometry3d X_OV_end = relative_pose(pose(step.X_WB_end, obstacle), pose(step.X_WB_end, part));
  const double enough = kOfNoInterest * scene_.margin(obstacle, part);
  separations_.start({X_OV_begin.linear(), X_OV_begin.translation()}, {X_OV_end.linear(), X_OV_end.translation()},
                     enough, enough);
  planes.find_gaps(planes.maps(X_OV_begin), 0, planes.block_count(), gaps_at_begin_);
  planes.find_gaps(planes.maps(X_OV_end), 0, planes.block_count(), gaps_at_end_);
  const NeededGaps needed{round_up(enough), round_up(enough), std::numeric_limits<float>::infinity()};
  const geometry::TriangleMesh& mesh_O = bodies[static_cast<std::size_t>(obstacle)].body->tree.mesh();
  const geometry::TriangleMesh& mesh_V = bodies[static_cast<std::size_t>(part)].body->tree.mesh();
  waiting_.clear();
  for (std::size_t block = 0; block < planes.block_count(); ++block) {
    const std::size_t first = kPlanesAtOnce * block;
    const PairsOfBlock fail =
        find_unproved(planes.block(block), needed, gaps_at_begin_.data() + first, gaps_at_end_.data() + first);
    for_each_pair(block, fail, [&](std::size_t slot) {
      if (slot >= planes.numbers().size()) return;
      const TrianglesOfBodies pair = planes.triangles(slot);
      const geometry::TrianglePoints corners_O = mesh_O.corners(pair.obstacle_triangle);
      separations_.add(corners_O, mesh_V.corners(pair.part_triangle), planes.ball().holds(corners_O));
      waiting_.push_back(slot);
      if (separations_.is_full()) turn_waiting(bodies, planes);
    });
  }
  turn_waiting(bodies, planes);
}

void LastingPlanes::turn_waiting(std::span<const PlacedBody> bodies, PlanesOfBodies& planes) {
  if (meter_ != nullptr) meter_->spend(kWorkOfPlane * std::ssize(waiting_));
  auto slot = waiting_.begin();
  for (const Separation& separation : separations_.find()) {
    const double before = static_cast<double>(std::min(gaps_at_begin_[*slot], gaps_at_end_[*slot]));
    if (separation.least() > before) planes.turn(*slot, separations_.direction(separation), bodies);
    ++slot;
  }
  waiting_.clear();
}

}  // namespace glissade::contact
