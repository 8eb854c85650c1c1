#include "features/contact_filter.h"

#include <algorithm>
#include <limits>

#include <glissade/base/assert.h>

namespace glissade::contact {
namespace {

/// Fewer pairs of the same two bodies are not worth a look.
constexpr std::size_t kFewOfBodies = 4;

/// The pairs of features that may count at all: an edge or vertex does for the triangle that owns it.
FeaturePairs owned(const geometry::MeshTopology& of_part, std::int32_t part_triangle,
                   const geometry::MeshTopology& of_obstacle, std::int32_t obstacle_triangle) {
  const auto bit = [](bool is_owned, int number) { return static_cast<FeaturePairs>(is_owned) << number; };
  FeaturePairs edges_of_obstacle = 0;
  for (int j = 0; j < 3; ++j)
    edges_of_obstacle |= bit(of_obstacle.owns_edge(obstacle_triangle, j), kFirstEdges + j);
  FeaturePairs features = 0;
  for (int i = 0; i < 3; ++i) {
    FeaturePairs with_i = bit(of_part.owns_corner(part_triangle, i), kPartCorner) |
                          bit(of_obstacle.owns_corner(obstacle_triangle, i), kObstacleCorner);
    with_i |= of_part.owns_edge(part_triangle, i) ? edges_of_obstacle : 0;
    features |= with_i << (kBitsOfFeature * i);
  }
  return features;
}

void copy(const geometry::TriangleMesh& mesh, std::int32_t triangle, std::size_t to, TrianglePairs::Corners& corners) {
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d& x = mesh.corner(triangle, c);
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[static_cast<std::size_t>(c)][axis][to] = x[static_cast<Eigen::Index>(axis)];
  }
}

}  // namespace

void ContactFilter::look(std::span<const TrianglesOfBodies> pairs, std::span<const KnownFeatures> known) {
  GLISSADE_ASSERT(pairs.size() <= kMostPairs && (known.empty() || known.size() == pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    gaps_[i] = 0.0;
    gaps_left_out_[i] = 0.0;
    was_looked_at_[i] = !known.empty() && known[i].features != 0;
    if (was_looked_at_[i]) {
      features_[i] = nearest_[i] = known[i].features;
      gaps_beyond_[i] = known[i].left_out;
      continue;
    }
    const TrianglesOfBodies& pair = pairs[i];
    features_[i] = nearest_[i] =
        owned(bodies_[static_cast<std::size_t>(pair.bodies.part)].body->topology, pair.part_triangle,
              bodies_[static_cast<std::size_t>(pair.bodies.obstacle)].body->topology, pair.obstacle_triangle);
    gaps_beyond_[i] = std::numeric_limits<double>::infinity();
    if (features_[i] != 0) add(batch_of(pair.bodies), pair, i);
  }
  for (Batch& batch : batches_)
    complete(batch);
}

ContactFilter::Batch& ContactFilter::batch_of(const BodyPair& bodies) {
  if (last_ < batches_.size() && batches_[last_].bodies == bodies) return batches_[last_];
  const auto known =
      std::find_if(batches_.begin(), batches_.end(), [&](const Batch& batch) { return batch.bodies == bodies; });
  last_ = static_cast<std::size_t>(known - batches_.begin());
  if (known != batches_.end()) return *known;
  const PlacedBody& obstacle = bodies_[static_cast<std::size_t>(bodies.obstacle)];
  const PlacedBody& part = bodies_[static_cast<std::size_t>(bodies.part)];
  const Eigen::Isometry3d X_OV = obstacle.X_WB.inverse(Eigen::Isometry) * part.X_WB;
  Batch& batch = batches_.emplace_back();
  batch.bodies = bodies;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    for (std::size_t column = 0; column < 3; ++column)
      batch.X_OV.R_OV[row][column] = X_OV.linear()(r, static_cast<Eigen::Index>(column));
    batch.X_OV.p_OV[row] = X_OV.translation()[r];
  }
  const auto reach_of = [](const PlacedBody& placed) {
    return placed.X_WB.translation().norm() + placed.body->tree.center().norm() + placed.body->tree.radius();
  };
  batch.coordinates = reach_of(obstacle) + reach_of(part);
  return batch;
}

void ContactFilter::add(Batch& batch, const TrianglesOfBodies& pair, std::size_t number) {
  copy(bodies_[static_cast<std::size_t>(pair.bodies.obstacle)].body->tree.mesh(), pair.obstacle_triangle, batch.count,
       batch.pairs.p_O);
  copy(bodies_[static_cast<std::size_t>(pair.bodies.part)].body->tree.mesh(), pair.part_triangle, batch.count,
       batch.pairs.p_V);
  batch.possible.features[batch.count] = features_[number];
  batch.numbers[batch.count++] = number;
  if (batch.count == kTrianglePairs) complete(batch);
}

/// Leaves out what cannot be in contact, and empties the batch.
void ContactFilter::complete(Batch& batch) {
  if (batch.count >= kFewOfBodies) {
    leave_out_impossible(batch.pairs, batch.X_OV, {reach_, past_end_, margin_, batch.coordinates}, batch.possible);
    for (std::size_t i = 0; i < batch.count; ++i) {
      was_looked_at_[batch.numbers[i]] = true;
      features_[batch.numbers[i]] = batch.possible.features[i];
      nearest_[batch.numbers[i]] = batch.possible.nearest[i];
      gaps_[batch.numbers[i]] = static_cast<double>(batch.possible.gaps[i]) - past_end_;
      gaps_beyond_[batch.numbers[i]] = static_cast<double>(batch.possible.gaps_beyond[i]) - past_end_;
      gaps_left_out_[batch.numbers[i]] = static_cast<double>(batch.possible.gaps_left_out[i]) - past_end_;
    }
  }
  batch.count = 0;
}

}  // namespace glissade::contact
