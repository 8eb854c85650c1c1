#include "search/candidate_search.h"

#include <algorithm>
#include <stdexcept>

namespace glissade::contact {
namespace {

/// Of the distance of a point from the origin of its part: how far it may be from where it would be if the pose were
/// corrected to a rigid one, as the poses of the pipeline's objects are (`geometry::rigid_pose`).
constexpr double kDefect = 1e-4;

double farthest_from_origin(const SlidingPart& part) {
  return part.tree.center().norm() + part.tree.radius();
}

// A single thread: the other processors belong to the haptic thread and to the viewer.
collision::PipelineOptions pipeline_options(double greatest_distance, collision::WorkMeter* meter) {
  return {
      .query = collision::PairQuery::kVerdict, .greatest_distance = greatest_distance, .threads = 1, .meter = meter};
}

/// Planes of pairs of bodies. The memory of the last search serves again.
class PlanesOfSearch {
 public:
  PlanesOfSearch(std::span<const PlacedBody> bodies, std::vector<PlanesOfBodies>& planes)
      : bodies_(bodies), planes_(planes) {}

  /// Adds a pair with its place as the number.
  void add(std::uint32_t place, const NearPair& pair) {
    planes_of(pair.bodies).add(place, pair, pair.n_W, pair.turns_with_part, bodies_);
  }
  void finish() { planes_.erase(planes_.begin() + static_cast<std::ptrdiff_t>(used_), planes_.end()); }

 private:
  PlanesOfBodies& planes_of(const BodyPair& pair) {
    const std::span<PlanesOfBodies> used = std::span(planes_).first(used_);
    const auto known =
        std::find_if(used.begin(), used.end(), [&](const PlanesOfBodies& some) { return some.bodies() == pair; });
    if (known != used.end()) return *known;
    if (used_ == planes_.size()) planes_.emplace_back();
    planes_[used_].start(pair, bodies_);
    return planes_[used_++];
  }

  std::span<const PlacedBody> bodies_;
  std::vector<PlanesOfBodies>& planes_;
  std::size_t used_ = 0;
};

template <typename Body>
collision::ObjectDescription description(const std::shared_ptr<const Body>& body, const Eigen::Isometry3d& X_WB,
                                         int group) {
  return {.tree = {body, &body->tree}, .hull = {body, &body->hull}, .X_WO = X_WB, .group = group};
}

}  // namespace

CandidateSearch::CandidateSearch(const ContactScene& scene, double greatest_radius, collision::WorkMeter* meter)
    : scene_(scene),
      meter_(meter),
      bodies_(scene.bodies().begin(), scene.bodies().end()),
      greatest_radius_(greatest_radius),
      lasting_planes_(scene, meter) {
  for (const auto& mover : scene.movers())
    slack_ = std::max(slack_, 2.0 * kDefect * farthest_from_origin(*mover));
  workspace_.set_meter(meter);
  start_afresh();
}

void CandidateSearch::start_afresh() {
  pipeline_.reset();
  world_.emplace(static_cast<int>(bodies_.size()));
  pipeline_.emplace(*world_, clock_, pipeline_options(greatest_radius_ + slack_, meter_));
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
  const std::chrono::nanoseconds start = clock_.now();
  ignore(request.ignored);
  for (std::size_t mover = 0; mover < request.X_WB.size(); ++mover) {
    const std::size_t body = scene_.body_of_mover(mover);
    if (!world_->move(ids_[body], request.X_WB[mover]))
      throw std::invalid_argument("the pose of a part must be a rotation and translation");
    bodies_[body].X_WB = request.X_WB[mover];
  }
  const collision::FrameResult& near = pipeline_->step(request.range.radius + slack_);
  set.report = near.report;
  try {
    find_pairs(near, request, set);
  } catch (const TooManyPairs&) {
    set = {.has_too_many = true};
    return;
  }
  nearest_first_.sort(set.pairs, unsorted_pairs_);
  nearest_first_.sort(set.boxes, unsorted_boxes_);
  if (request.range.sought != SoughtPairs::kWithDistances) {
    find_planes(set);
    if (request.first_step.is_known()) lasting_planes_.turn(request.first_step, bodies_, set.planes);
  }
  set.report.total = clock_.now() - start;
}

void CandidateSearch::find_pairs(const collision::FrameResult& near, const CandidateRequest& request,
                                 CandidateSet& set) {
  set.has_too_many = false;
  set.pairs.clear();
  set.boxes.clear();
  for (const collision::ObjectPair& objects : near.meeting) {
    const BodyPair bodies{static_cast<std::int32_t>(objects.object_A.index),
                          static_cast<std::int32_t>(objects.object_B.index)};
    find_near_pairs(bodies, bodies_[objects.object_A.index], bodies_[objects.object_B.index],
                    scene_.margin(bodies.obstacle, bodies.part), request.range, workspace_, meter_, set.pairs,
                    set.boxes);
  }
  const auto count = [&](bool NearPair::*property) {
    return static_cast<std::size_t>(
        std::count_if(set.pairs.begin(), set.pairs.end(), [&](const NearPair& pair) { return pair.*property; }));
  };
  set.contact_count = count(&NearPair::may_yield_contact);
  set.certify_count = count(&NearPair::is_to_certify) + set.boxes.size();
}

void CandidateSearch::find_planes(CandidateSet& set) const {
  PlanesOfSearch planes(bodies_, set.planes);
  for (std::uint32_t place = 0; place < set.pairs.size(); ++place)
    planes.add(place, set.pairs[place]);
  planes.finish();
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

}  // namespace glissade::contact
