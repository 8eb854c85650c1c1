#include "sliding/pairs_in_reach.h"

#include <algorithm>
#include <array>
#include <limits>

namespace glissade::haptics {
namespace {

constexpr float kTaken = std::numeric_limits<float>::infinity();

/// In margins: planes are to keep pairs so far apart that they are none of the nearest.
constexpr double kLasting = 2.5;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& w) {
  Eigen::Matrix3d m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

/// The motion of a body to first order: x moves by A x + t, in world axes.
struct LinearMotion {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

LinearMotion linear_motion_of(const SimulatedParts& shared, std::int32_t body, const Displacements& displacements) {
  const std::int32_t leader = shared.scene.leader(body);
  if (leader == ContactScene::kStands) return {};
  const geometry::Displacement& d = displacements[static_cast<std::size_t>(leader)];
  const Eigen::Vector3d p_Wref = shared.states[static_cast<std::size_t>(leader)].p_Wref();
  return {cross_matrix(d.w), d.v - d.w.cross(p_Wref)};
}

}  // namespace

void PairsInReach::look(double reach) {
  shared_.candidates.pairs().in_reach(reach, left_);
}

double PairsInReach::take_nearest(double gap, std::size_t count, double reach) {
  forget_taken();
  double most = reach;
  if (left_.size() > count) {
    const auto nearer = std::count_if(left_.begin(), left_.end(),
                                      [&](const PairInReach& pair) { return static_cast<double>(pair.gap) <= gap; });
    most = gap;
    if (static_cast<std::size_t>(nearer) < count) {
      gaps_.clear();
      for (const PairInReach& pair : left_)
        gaps_.push_back(pair.gap);
      std::nth_element(gaps_.begin(), gaps_.begin() + static_cast<std::ptrdiff_t>(count), gaps_.end());
      most = static_cast<double>(gaps_[count]);
    }
    most = std::min(most, reach);
  }
  begin_taking();
  for (PairInReach& pair : left_) {
    if (!(static_cast<double>(pair.gap) <= most)) continue;
    take(pair);
    pair.gap = kTaken;
  }
  return most;
}

void PairsInReach::forget_taken() {
  std::erase_if(left_, [](const PairInReach& pair) { return pair.gap == kTaken; });
}

void PairsInReach::take_too_near(std::size_t most) {
  begin_taking();
  while (next_ < too_near_.size() && pairs_.size() < most) {
    const std::uint32_t planes = left_[too_near_[next_].place].planes;
    const Way& way = ways_[planes];
    separations_.start(way.begin, way.end, kLasting * way.margin, kLasting * way.margin);
    for (std::size_t i = next_; i < too_near_.size() && !separations_.is_full(); ++i) {
      const PairInReach& pair = left_[too_near_[i].place];
      if (pair.planes != planes) break;
      add_separation(pair);
    }
    for (const Separation& separation : separations_.find()) {
      PairInReach& pair = left_[too_near_[next_].place];
      if (separation.least() >= way.margin) {
        turn_plane(pair, separations_.direction(separation));
      } else if (pairs_.size() < most) {
        take(pair);
        pair.gap = kTaken;
      } else {
        return;
      }
      ++next_;
    }
  }
}

void PairsInReach::find_too_near(const Displacements& displacements, double reach) {
  forget_taken();
  too_near_.clear();
  next_ = 0;
  const std::vector<PlanesOfBodies>& planes = shared_.candidates.pairs().planes();
  double nearer = 0.0;
  for (std::size_t p = 0; p < shared_.count(); ++p)
    nearer += displacements[p].v.norm() + shared_.states[p].lever * displacements[p].w.norm();
  reach = std::min(reach, nearer + shared_.largest_margin);
  watched_.clear();
  for (std::uint32_t place = 0; place < left_.size(); ++place) {
    if (static_cast<double>(left_[place].gap) <= reach) watched_.push_back(place);
  }
  if (watched_.empty()) return;
  ways_.clear();
  for (const PlanesOfBodies& of_bodies : planes)
    ways_.push_back(way_of(of_bodies, displacements));
  gaps_at_end_.resize(std::max(gaps_at_end_.size(), planes.size()));
  known_blocks_.assign(planes.size(), {});
  for (const std::uint32_t place : watched_) {
    const PairInReach& pair = left_[place];
    const std::size_t block = pair.slot / kPlanesAtOnce;
    std::vector<bool>& is_known = known_blocks_[pair.planes];
    is_known.resize(planes[pair.planes].block_count());
    const Way& way = ways_[pair.planes];
    if (!is_known[block]) planes[pair.planes].find_gaps(way.maps_at_end, block, block + 1, gaps_at_end_[pair.planes]);
    is_known[block] = true;
    const float at_end = gaps_at_end_[pair.planes][pair.slot];
    if (static_cast<double>(at_end) < way.margin) too_near_.push_back({at_end, place});
  }
  std::sort(too_near_.begin(), too_near_.end(), [](const TooNear& a, const TooNear& b) {
    return a.gap_at_end != b.gap_at_end ? a.gap_at_end < b.gap_at_end : a.place < b.place;
  });
}

PairsInReach::Way PairsInReach::way_of(const PlanesOfBodies& planes, const Displacements& displacements) const {
  const BodyPair& bodies = planes.bodies();
  const Eigen::Isometry3d& X_WO = shared_.scene.bodies()[static_cast<std::size_t>(bodies.obstacle)].X_WB;
  const Eigen::Isometry3d& X_WV = shared_.scene.bodies()[static_cast<std::size_t>(bodies.part)].X_WB;
  const LinearMotion of_part = linear_motion_of(shared_, bodies.part, displacements);
  const LinearMotion of_obstacle = linear_motion_of(shared_, bodies.obstacle, displacements);
  const Eigen::Matrix3d A_W = Eigen::Matrix3d::Identity() + of_part.A - of_obstacle.A;
  const Eigen::Vector3d t_W = of_part.t - of_obstacle.t;
  const Eigen::Matrix3d R_OW = X_WO.linear().inverse();  // as in `relative_pose`
  const Eigen::Isometry3d X_OV = relative_pose(X_WO, X_WV);
  const CornerMap end{R_OW * A_W * X_WV.linear(), R_OW * (A_W * X_WV.translation() + t_W - X_WO.translation())};
  return {{X_OV.linear(), X_OV.translation()},
          end,
          planes.maps(end.A, end.t),
          shared_.scene.margin(bodies.obstacle, bodies.part)};
}

void PairsInReach::add_separation(const PairInReach& pair) {
  const NearPair& candidate = shared_.candidates.pairs().pair(pair.number);
  const geometry::TrianglePoints corners_O =
      body(candidate.bodies.obstacle).tree.mesh().corners(candidate.obstacle_triangle);
  separations_.add(corners_O, body(candidate.bodies.part).tree.mesh().corners(candidate.part_triangle),
                   shared_.candidates.pairs().planes()[pair.planes].ball().holds(corners_O));
}

void PairsInReach::turn_plane(const PairInReach& pair, const FixedDirection& direction) {
  shared_.candidates.pairs().planes()[pair.planes].turn(pair.slot, shared_.candidates.pairs().pair(pair.number),
                                                        direction, shared_.scene.bodies());
}

const ContactBody& PairsInReach::body(std::int32_t number) const {
  return *shared_.scene.bodies()[static_cast<std::size_t>(number)].body;
}

void PairsInReach::begin_taking() {
  pairs_.clear();
  numbers_.clear();
}

void PairsInReach::take(const PairInReach& pair) {
  pairs_.push_back(shared_.candidates.pairs().pair(pair.number));
  numbers_.push_back(pair.number);
}

}  // namespace glissade::haptics
