#pragma once

/// What the contacts of a chain allow, to first order: how fast each flex value, and the root, closes the gap of each
/// contact.

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/grasping/kinematic_chain.h>
#include <glissade/haptics/sliding_result.h>

#include "clasp/chain_step.h"

namespace glissade::grasping {

/// Movers of a step are numbered: 0 the root, 1 + v the flex value v.
class ClosingRows {
 public:
  explicit ClosingRows(const KinematicChain& chain)
      : chain_(chain), columns_(1 + chain.values().size()), X_WL_(chain.links().size()) {}

  /// Computes all rows anew. `contacts` number the links by `movers`.
  void set(const Posture& posture, const ChainStep& wanted, std::span<const haptics::Contact> contacts,
           std::span<const std::size_t> movers);
  /// Adds a row to them.
  void add(const haptics::Contact& contact, std::size_t link);
  /// Adds a row that no mover of this link may close, whichever way it moves the link.
  void bar(std::size_t link);

  std::size_t count() const { return rooms_.size(); }
  std::size_t columns() const { return columns_; }
  /// Metres that the gap of a contact may shrink, at least 0.
  double room(std::size_t row) const { return rooms_[row]; }
  /// Metres by which the gap grows when this mover makes its whole step; negative where it closes.
  double rate(std::size_t row, std::size_t mover) const { return rates_[row * columns_ + mover]; }
  /// The contact of a row: its normal, and the contact point relative to the root's origin.
  const Eigen::Vector3d& n_W(std::size_t row) const { return normals_[row]; }
  const Eigen::Vector3d& r_W(std::size_t row) const { return arms_[row]; }

 private:
  const KinematicChain& chain_;
  std::size_t columns_;
  Eigen::Vector3d p_WR_ = Eigen::Vector3d::Zero();
  geometry::Displacement root_;
  std::vector<double> wanted_;  // of each flex value
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<double> rooms_;
  std::vector<double> rates_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<Eigen::Vector3d> arms_;
};

}  // namespace glissade::grasping
