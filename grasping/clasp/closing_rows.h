#pragma once

/// What the contacts of a chain allow, to first order: how fast each flex value, and the root, closes the gap of each
/// contact.

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding_result.h>
#include <glissade/grasping/kinematic_chain.h>

#include "clasp/chain_step.h"
#include "clasp/slide_past.h"

namespace glissade::grasping {

/// Movers of a step are numbered: 0 the root, 1 + v the flex value v.
class ClosingRows {
 public:
  explicit ClosingRows(const KinematicChain& chain)
      : chain_(chain),
        columns_(1 + chain.values().size()),
        X_WL_(chain.links().size()),
        shortfalls_(chain.links().size()) {}

  /// Computes all rows anew. `contacts` number the links by `movers`.
  void set(const Posture& posture, const ChainStep& wanted, std::span<const contact::Contact> contacts,
           std::span<const std::size_t> movers);
  /// Adds a row to them.
  void add(const contact::Contact& contact, std::size_t link);
  /// Lets every contact of a link come as near, for its margin, as the nearest one of this link is already.
  void share_shortfalls();
  /// Adds a row that no mover of this link may close, whichever way it moves the link.
  void bar(std::size_t link);

  std::size_t count() const { return planes_.size(); }
  std::size_t columns() const { return columns_; }
  /// Metres that the gap of a contact may shrink, at least 0.
  double room(std::size_t row) const { return planes_[row].room; }
  /// Metres by which the gap grows when this mover makes its whole step; negative where it closes.
  double rate(std::size_t row, std::size_t mover) const { return rates_[row * columns_ + mover]; }
  /// The contacts as those of one rigid body, whose reference point is the root's origin.
  std::span<const ContactPlane> planes() const { return planes_; }

 private:
  /// A contact of a link: how much more than its margin the gap is, metres.
  struct LinkGap {
    std::size_t link;
    double beyond_margin;
  };

  const KinematicChain& chain_;
  std::size_t columns_;
  Eigen::Vector3d p_WR_ = Eigen::Vector3d::Zero();
  geometry::Displacement root_;
  std::vector<double> wanted_;  // of each flex value
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<ContactPlane> planes_;
  std::vector<LinkGap> gaps_;       // of the planes
  std::vector<double> shortfalls_;  // of the links, metres
  std::vector<double> rates_;
};

}  // namespace glissade::grasping
