#include "search/candidate_search.h"

#include <algorithm>
#include <stdexcept>

namespace glissade::haptics {
namespace {

/// Work of taking over and sorting a pair, in the unit of `collision::WorkMeter`: rough, and high rather than low.
constexpr std::int64_t kWorkOfPair = 400;

// A single thread: the other processors belong to the haptic thread and to the viewer.
collision::PipelineOptions pipeline_options(double greatest_distance, collision::WorkMeter* meter) {
  return {
      .query = collision::PairQuery::kClosePairs, .greatest_distance = greatest_distance, .threads = 1, .meter = meter};
}

Eigen::Vector3d direction_of(const collision::ClosePair& pair) {
  if (pair.distance < kSharpDistance_m) return Eigen::Vector3d::Zero();
  return (pair.p_B - pair.p_A).normalized();
}

PlanesOfBodies& planes_of(const BodyPair& pair, std::span<const PlacedBody> bodies,
                          std::vector<PlanesOfBodies>& planes) {
  const auto known =
      std::find_if(planes.begin(), planes.end(), [&](const PlanesOfBodies& some) { return some.bodies() == pair; });
  return known != planes.end() ? *known : planes.emplace_back(pair, bodies);
}

void find_planes(std::span<const CandidatePair> pairs, std::span<const PlacedBody> bodies,
                 std::vector<PlanesOfBodies>& planes) {
  planes.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const CandidatePair& pair = pairs[i];
    planes_of(pair.bodies, bodies, planes)
        .add(static_cast<std::uint32_t>(i), pair.obstacle_triangle, pair.part_triangle, pair.n_W, bodies);
  }
}

/// The planes of pairs of triangles, each pair with its place among `pairs` as its number; the places of the others.
void find_planes(std::span<const PairToCertify> pairs, std::span<const PlacedBody> bodies,
                 std::vector<PlanesOfBodies>& planes, std::vector<std::uint32_t>& others) {
  planes.clear();
  others.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairToCertify& pair = pairs[i];
    if (pair.item_O.kind != TreeItem::Kind::kTriangle) {
      others.push_back(static_cast<std::uint32_t>(i));
      continue;
    }
    planes_of(pair.bodies, bodies, planes)
        .add(static_cast<std::uint32_t>(i), static_cast<std::int32_t>(pair.item_O.number),
             static_cast<std::int32_t>(pair.item_V.number), pair.n_W, bodies);
  }
}

template <typename Body>
collision::ObjectDescription description(const std::shared_ptr<const Body>& body, const Eigen::Isometry3d& X_WB,
                                         int group) {
  return {.tree = {body, &body->tree},
          .hull = {body, &body->hull},
          .X_WO = X_WB,
          .group = group,
          .selection = {body, &body->features}};
}

}  // namespace

CandidateSearch::CandidateSearch(const ContactScene& scene, double greatest_radius, collision::WorkMeter* meter)
    : scene_(scene),
      meter_(meter),
      bodies_(scene.bodies().begin(), scene.bodies().end()),
      greatest_radius_(greatest_radius) {
  workspace_.set_meter(meter);
  start_afresh();
}

void CandidateSearch::start_afresh() {
  pipeline_.reset();
  world_.emplace(static_cast<int>(bodies_.size()));
  pipeline_.emplace(*world_, clock_, pipeline_options(greatest_radius_, meter_));
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const int group = scene_.group(body);
    if (!ContactScene::can_touch(group, group)) world_->disable_groups(group, group);
  }
  ids_.clear();
  ignored_.clear();
  for (const Obstacle& obstacle : scene_.obstacles())
    ids_.push_back(world_->add(description(obstacle.body, obstacle.X_WO, ContactScene::kStill)));
  for (std::size_t mover = 0; mover < scene_.movers().size(); ++mover) {
    const int group = scene_.group(scene_.body_of_mover(mover));
    ids_.push_back(world_->add(description(scene_.movers()[mover], Eigen::Isometry3d::Identity(), group)));
  }
}

void CandidateSearch::find(const CandidateRequest& request, CandidateSet& set) {
  ignore(request.ignored);
  for (std::size_t mover = 0; mover < request.X_WB.size(); ++mover) {
    const std::size_t body = scene_.body_of_mover(mover);
    if (!world_->move(ids_[body], request.X_WB[mover]))
      throw std::invalid_argument("the pose of a part must be a rotation and translation");
    bodies_[body].X_WB = request.X_WB[mover];
  }
  const collision::FrameResult& near = pipeline_->step(request.radius);
  set.report = near.report;
  collect_pairs(near, set.pairs);
  find_pairs_to_certify(scene_, bodies_, request.radius, request.ignored, workspace_, set.to_certify);
  if (!request.has_planes) return;
  find_planes(set.pairs, bodies_, set.planes_of_pairs);
  find_planes(set.to_certify, bodies_, set.planes, set.box_pairs);
}

void CandidateSearch::ignore(const std::vector<BodyPair>& bodies) {
  if (bodies == ignored_) return;
  const auto ids = [&](const BodyPair& pair) {
    return std::pair{ids_[static_cast<std::size_t>(pair.obstacle)], ids_[static_cast<std::size_t>(pair.part)]};
  };
  for (const BodyPair& pair : ignored_)
    world_->enable_pair(ids(pair).first, ids(pair).second);
  for (const BodyPair& pair : bodies)
    world_->disable_pair(ids(pair).first, ids(pair).second);
  ignored_ = bodies;
}

void CandidateSearch::collect_pairs(const collision::FrameResult& near, std::vector<CandidatePair>& pairs) const {
  pairs.clear();
  for (std::size_t i = 0; i < near.meeting.size(); ++i) {
    const BodyPair bodies{static_cast<std::int32_t>(near.meeting[i].object_A.index),
                          static_cast<std::int32_t>(near.meeting[i].object_B.index)};
    const PlacedBody& obstacle = bodies_[static_cast<std::size_t>(bodies.obstacle)];
    for (const collision::ClosePair& pair : near.close_pairs(i)) {
      if (meter_ != nullptr) meter_->spend(kWorkOfPair);
      pairs.push_back({{bodies, pair.triangles.triangle_A, pair.triangles.triangle_B},
                       pair.distance,
                       obstacle.X_WB.linear() * direction_of(pair)});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const CandidatePair& a, const CandidatePair& b) { return a.distance < b.distance; });
}

}  // namespace glissade::haptics
