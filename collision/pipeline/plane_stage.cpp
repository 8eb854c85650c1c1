#include "pipeline/plane_stage.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace glissade::collision {
namespace {

// Estimated time of a test of hulls.
constexpr double kHullTest_ns = 200.0;

// As a fraction of the smaller radius. Pairs farther apart than this are no longer near, and their memory is freed.
constexpr double kNear = 0.25;

}  // namespace

void PlaneStage::filter(const std::vector<PairTable::Number>& candidates, double distance,
                        std::vector<PairTable::Number>& near, StageReport& report) {
  report.in = std::ssize(candidates);
  is_near_.resize(candidates.size());
  const double expected_ns = kHullTest_ns * static_cast<double>(candidates.size());
  pool_.for_each(candidates.size(), ThreadPool::chunk_of(candidates.size(), expected_ns), expected_ns,
                 [&](std::size_t begin, std::size_t end, int) {
                   for (std::size_t i = begin; i < end; ++i)
                     is_near_[i] = may_be_near(candidates[i], distance);
                 });
  near.clear();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (is_near_[i] != 0) near.push_back(candidates[i]);
  }
  report.out = std::ssize(near);
}

bool PlaneStage::may_be_near(PairTable::Number number, double distance) {
  TrackedPair& pair = pairs_[number];
  return pair.meets || !are_separated(pair, pairs_.memory(number), distance);
}

// Whether the hulls are certainly farther apart than `distance`. Notes their separation.
bool PlaneStage::are_separated(TrackedPair& pair, PairMemory& memory, double distance) const {
  const WorldObject& a = world_.objects()[pair.slots.a];
  const WorldObject& b = world_.objects()[pair.slots.b];
  if (!a.hull || !b.hull) return false;
  // Boxes are fat, so most new pairs are not near yet.
  const double gap_of_spheres = memory.hulls.has_plane ? 0.0 : placed_.gap_of_spheres(pair.slots.a, pair.slots.b);
  if (gap_of_spheres > certain_distance(distance)) {
    const Eigen::Vector3d n_W = placed_.between(pair.slots.a, pair.slots.b);
    pair.separation = placed_.separation(pair.slots.a, pair.slots.b, n_W, gap_of_spheres);
    return true;
  }
  if (!hulls_apart(*a.hull, *b.hull, relative_pose(a, b), memory.hulls, options_.hull_test)) return false;
  if (!(memory.hulls.gap > distance)) return false;
  const Eigen::Vector3d n_W = a.X_WO.linear() * memory.hulls.n_gap_A;
  pair.separation = placed_.separation(pair.slots.a, pair.slots.b, n_W, memory.hulls.gap);
  if (memory.hulls.gap - distance > kNear * std::min(a.hull->radius(), b.hull->radius())) {
    memory.front.reset();
    memory.details.reset();
  }
  return true;
}

}  // namespace glissade::collision
