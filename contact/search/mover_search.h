#pragma once

/// What is near one body that moves among others. What stands still together is searched together, in a frame in which
/// it rests: a link of a hand keeps what it has found on the object that the hand carries.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>

#include "scene/contact_scene.h"
#include "search/candidate_pairs.h"

namespace glissade::contact {

/// The pairs of triangles of one mover and of bodies that rest in a frame S, at X_WS in the world. Not thread-safe.
class NearMover {
 public:
  /// The bodies get the numbers from `first_body` on. Throws std::invalid_argument as `ContactScene` does.
  NearMover(std::vector<Obstacle> bodies, std::int32_t first_body, const std::shared_ptr<const SlidingPart>& mover,
            double margin);

  void place_bodies(const Eigen::Isometry3d& X_WS);
  void place_mover(const Eigen::Isometry3d& X_WM);

  /// Finds all pairs within `reach` (metres). Returns false where this is too far.
  bool look(double reach);
  std::size_t pair_count() const { return candidates_.pairs().size(); }
  /// Work of all searches so far, in the unit of `SlidingRules::work_budget`.
  std::int64_t work() const { return work_; }

  /// Appends the pairs within `reach` that the last search knows, with the mover as the body `number`.
  template <typename Pair>
  void add_within(double reach, std::int32_t number, std::vector<Pair>& all);

 private:
  void place();

  std::int32_t first_body_;
  Eigen::Isometry3d X_WS_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WM_ = Eigen::Isometry3d::Identity();
  ContactScene scene_;
  CandidatePairs candidates_;
  bool has_moved_ = false;
  std::int64_t work_ = 0;
  std::vector<TrianglesOfBodies> pairs_;
  std::vector<PairToCertify> to_certify_;
};

extern template void NearMover::add_within(double, std::int32_t, std::vector<TrianglesOfBodies>&);
extern template void NearMover::add_within(double, std::int32_t, std::vector<PairToCertify>&);

/// One mover among bodies that stand still and objects that move by themselves between its motions. Not thread-safe.
class MoverSearch {
 public:
  MoverSearch(const std::vector<Obstacle>& fixed, const std::vector<std::shared_ptr<const SlidingPart>>& objects,
              const std::shared_ptr<const SlidingPart>& mover, double margin);

  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB) { of_objects_[object]->place_bodies(X_WB); }
  void place_mover(const Eigen::Isometry3d& X_WM);

  /// As those of `NearMover`.
  bool look(double reach);
  std::size_t pair_count() const;
  std::int64_t work() const;
  template <typename Pair>
  void add_within(double reach, std::int32_t number, std::vector<Pair>& all) {
    if (of_fixed_) of_fixed_->add_within(reach, number, all);
    for (const auto& near : of_objects_)
      near->add_within(reach, number, all);
  }

  /// That of the last look.
  double reach() const { return reach_; }

 private:
  std::unique_ptr<NearMover> of_fixed_;  // none without fixed bodies
  std::vector<std::unique_ptr<NearMover>> of_objects_;
  double reach_ = 0.0;
};

}  // namespace glissade::contact
