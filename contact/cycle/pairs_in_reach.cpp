#include "cycle/pairs_in_reach.h"

#include <algorithm>
#include <bit>
#include <limits>

#include <glissade/base/assert.h>

#include "search/blocks_of_pairs.h"
#include "search/round_down.h"

namespace glissade::contact {
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

/// Visits the blocks with pairs that have not been taken and whose gaps are at most `gap` (metres): the number of their
/// planes, their own, and these pairs.
template <typename Visit>
void PairsInReach::visit_blocks_within(double gap, const Visit& visit) const {
  const float most = round_down(gap);
  for (std::uint32_t i = 0; i < left_.size(); ++i) {
    const std::vector<float>& of_blocks = left_[i].of_blocks;
    for (std::size_t block = 0; block < of_blocks.size(); ++block) {
      if (of_blocks[block] > most) continue;
      visit(i, block, find_pairs_within(most, left_[i].gaps.data() + kPlanesAtOnce * block));
    }
  }
}

/// Visits the pairs of these blocks, those of two bodies together.
template <typename Visit>
void PairsInReach::visit_within(double gap, const Visit& visit) const {
  visit_blocks_within(gap, [&](std::uint32_t i, std::size_t block, PairsOfBlock pairs) {
    for_each_pair(block, pairs, [&](std::size_t slot) {
      const std::uint32_t number = shared_.candidates.pairs().planes()[i].numbers()[slot];
      visit(PlaceOfPair{number, i, static_cast<std::uint32_t>(slot)});
    });
  });
}

void PairsInReach::look(double reach) {
  left_count_ = shared_.candidates.pairs().find_gaps(reach, left_);
}

double PairsInReach::take_nearest(double gap, std::size_t count, double reach) {
  const double most = distance_of_nearest(gap, count, reach);
  begin_taking();
  visit_within(most, [&](const PlaceOfPair& pair) { places_.push_back(pair); });
  if (left_.size() > 1) {
    std::sort(places_.begin(), places_.end(),
              [](const PlaceOfPair& a, const PlaceOfPair& b) { return a.number < b.number; });
  }
  for (const PlaceOfPair& pair : places_)
    take(pair);
  return most;
}

std::size_t PairsInReach::count_within(double gap) const {
  std::size_t count = 0;
  visit_blocks_within(gap, [&](std::uint32_t, std::size_t, PairsOfBlock pairs) {
    count += static_cast<std::size_t>(std::popcount(pairs));
  });
  return count;
}

/// The distance within which there are all pairs within `gap`, and `count` in all; at most `reach`.
double PairsInReach::distance_of_nearest(double gap, std::size_t count, double reach) {
  GLISSADE_ASSERT(gap > 0.0);
  if (left_count_ <= count) return reach;
  if (count_within(gap) >= count) return std::min(gap, reach);
  double within = std::min(2.0 * gap, reach);
  while (within < reach && count_within(within) <= count)
    within = std::min(2.0 * within, reach);
  gaps_.clear();
  visit_within(within, [&](const PlaceOfPair& pair) { gaps_.push_back(gap_of(pair)); });
  if (gaps_.size() <= count) return reach;
  std::nth_element(gaps_.begin(), gaps_.begin() + static_cast<std::ptrdiff_t>(count), gaps_.end());
  return static_cast<double>(gaps_[count]);
}

void PairsInReach::find_too_near(const Displacements& displacements, double reach) {
  too_near_.clear();
  next_ = 0;
  const std::vector<PlanesOfBodies>& planes = shared_.candidates.pairs().planes();
  double nearer = 0.0;
  for (std::size_t p = 0; p < shared_.count(); ++p)
    nearer += displacements[p].v.norm() + shared_.states[p].lever * displacements[p].w.norm();
  const float most = round_down(std::min(reach, nearer + shared_.largest_margin));
  const auto is_near = [&](float gap) { return gap <= most; };
  ways_.resize(left_.size());
  for (std::uint32_t i = 0; i < left_.size(); ++i) {
    if (std::none_of(left_[i].of_blocks.begin(), left_[i].of_blocks.end(), is_near)) continue;
    const Way& way = ways_[i] = way_of(planes[i], displacements);
    const std::vector<float>& gaps = left_[i].gaps;
    visit_runs_of_blocks(left_[i].of_blocks, is_near, [&](std::size_t first, std::size_t end) {
      planes[i].find_gaps(way.maps_at_end, first, end, gaps_at_end_);
      for (std::size_t block = first; block < end; ++block) {
        const std::size_t of_block = kPlanesAtOnce * block;
        const PairsOfBlock pairs = find_pairs_within(most, gaps.data() + of_block) &
                                   find_pairs_within(round_down(way.margin), gaps_at_end_.data() + of_block);
        for_each_pair(block, pairs, [&](std::size_t slot) {
          too_near_.push_back({gaps_at_end_[slot], {planes[i].numbers()[slot], i, static_cast<std::uint32_t>(slot)}});
        });
      }
    });
  }
  std::sort(too_near_.begin(), too_near_.end(), [](const TooNear& a, const TooNear& b) {
    return a.gap_at_end != b.gap_at_end ? a.gap_at_end < b.gap_at_end : a.pair.number < b.pair.number;
  });
}

void PairsInReach::take_too_near(std::size_t most) {
  begin_taking();
  while (next_ < too_near_.size() && pairs_.size() < most) {
    const std::uint32_t planes = too_near_[next_].pair.planes;
    const Way& way = ways_[planes];
    separations_.start(way.begin, way.end, kLasting * way.margin, kLasting * way.margin);
    for (std::size_t i = next_; i < too_near_.size() && !separations_.is_full(); ++i) {
      const PlaceOfPair& pair = too_near_[i].pair;
      if (pair.planes != planes) break;
      add_separation(pair);
    }
    for (const Separation& separation : separations_.find()) {
      const PlaceOfPair& pair = too_near_[next_].pair;
      if (separation.least() >= way.margin) {
        turn_plane(pair, separations_.direction(separation));
      } else if (pairs_.size() < most) {
        places_.push_back(pair);
        take(pair);
      } else {
        return;
      }
      ++next_;
    }
  }
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

void PairsInReach::add_separation(const PlaceOfPair& pair) {
  const TrianglesOfBodies candidate = shared_.candidates.pairs().triangles(pair);
  const geometry::TrianglePoints corners_O =
      body(candidate.bodies.obstacle).tree.mesh().corners(candidate.obstacle_triangle);
  separations_.add(corners_O, body(candidate.bodies.part).tree.mesh().corners(candidate.part_triangle),
                   shared_.candidates.pairs().planes()[pair.planes].ball().holds(corners_O));
}

void PairsInReach::turn_plane(const PlaceOfPair& pair, const FixedDirection& direction) {
  shared_.candidates.pairs().planes()[pair.planes].turn(pair.slot, direction, shared_.scene.bodies());
}

const ContactBody& PairsInReach::body(std::int32_t number) const {
  return *shared_.scene.bodies()[static_cast<std::size_t>(number)].body;
}

void PairsInReach::begin_taking() {
  pairs_.clear();
  places_.clear();
}

void PairsInReach::take(const PlaceOfPair& pair) {
  pairs_.push_back(shared_.candidates.pairs().triangles(pair));
  gap_of(pair) = kTaken;
  --left_count_;
}

}  // namespace glissade::contact
