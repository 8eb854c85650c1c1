#pragma once

/// Riders: bodies that stand where the caller places them, or move with the part to which their chain is attached. A
/// chain that has not been placed is absent: nothing touches it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding_rules.h>

#include "scene/contact_scene.h"

namespace glissade::contact {

/// Chains are numbered as given, bodies within a chain likewise. Not thread-safe.
class Riders {
 public:
  /// The chains of the riders of `scene`, which must outlive this object.
  Riders(ContactScene& scene, const std::vector<RiderChain>& chains);

  bool empty() const { return first_bodies_.size() == 1; }
  std::size_t chain_count() const { return first_bodies_.size() - 1; }

  /// Places the bodies of a chain. If it is attached, they stay so relative to its part from now on. Returns whether
  /// the chain was absent.
  bool place(std::size_t chain, std::span<const Eigen::Isometry3d> X_WB);
  /// Takes a chain away, until it is placed again.
  void remove(std::size_t chain);
  /// `part`: a part, or ContactScene::kStands to detach.
  void attach(std::size_t chain, std::int32_t part);
  /// Carries the riders of a part to where it has been placed.
  void follow(std::int32_t part);

  /// Bound (metres) of the distance of a part's riders from its reference point; 0 without riders.
  double lever(std::int32_t part) const;

  /// Pairs of bodies with a rider that is absent, or that keep their distance because both stand still or move
  /// together. In ascending order.
  const std::vector<BodyPair>& inert_pairs() const { return inert_pairs_; }

 private:
  void hold_on(std::int32_t body);
  bool is_absent(std::int32_t body) const {
    const std::int32_t rider = scene_.rider(body);
    return rider >= 0 && is_absent_[static_cast<std::size_t>(rider)] != 0;
  }
  void find_inert_pairs();

  ContactScene& scene_;
  std::vector<std::int32_t> first_bodies_;  // of each chain, and the number of bodies
  std::vector<Eigen::Isometry3d> X_VB_;     // of each rider that is attached
  std::vector<char> is_absent_;             // by rider
  std::vector<BodyPair> inert_pairs_;
};

}  // namespace glissade::contact
