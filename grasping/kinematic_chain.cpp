#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/base/assert.h>
#include <glissade/geometry/displacement.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {
namespace {

constexpr double kAxisTolerance = 1e-6;
/// Rounding of poses that are products of many rotations must not lead out of a reach.
constexpr double kRoundUp = 1.0 + 1e-12;

void require_link(bool holds, const ChainLink& link, const std::string& what) {
  if (!holds) throw std::invalid_argument("Link '" + link.name + "': " + what + ".");
}

void require_value(bool holds, const FlexValue& value, const std::string& what) {
  if (!holds) throw std::invalid_argument("Flex value '" + value.name + "': " + what + ".");
}

void check_values(const std::vector<FlexValue>& values) {
  std::set<std::string> names;
  for (const FlexValue& value : values) {
    require_value(!value.name.empty(), value, "the name is empty");
    require_value(names.insert(value.name).second, value, "the name occurs twice");
    require_value(std::isfinite(value.lower) && std::isfinite(value.upper), value, "a limit is not finite");
    require_value(value.lower <= value.upper, value, "the lower limit is above the upper one");
  }
}

void check_joint(const ChainLink& link, std::size_t number, std::size_t values) {
  require_link(link.parent.has_value() && *link.parent < number, link,
               link.parent ? "its parent must come before it, but is link " + std::to_string(*link.parent)
                           : "it has no parent, but only link 0 may be the root");
  require_link(geometry::rigid_pose(link.X_PJ).has_value(), link, "X_PJ is no rigid pose");
  require_link(std::abs(link.axis_J.norm() - 1.0) <= kAxisTolerance, link, "the axis is not of unit length");
  require_link(std::isfinite(link.offset), link, "the offset is not finite");
  for (const JointTerm& term : link.terms) {
    require_link(term.value < values, link, "there is no flex value " + std::to_string(term.value));
    require_link(std::isfinite(term.factor), link, "a factor is not finite");
  }
}

void check_root(const ChainLink& root) {
  require_link(!root.parent.has_value(), root, "link 0 is the root and has no parent");
  require_link(root.terms.empty() && root.offset == 0.0 && root.X_PJ.matrix().isIdentity(0.0), root,
               "the root has no joint");
}

void check_mesh(const ChainLink& link) {
  if (!link.mesh) return;
  require_link(!link.mesh->vertices.empty(), link, "the mesh has no vertices");
  for (const Eigen::Vector3d& p_L : link.mesh->vertices)
    require_link(p_L.allFinite(), link, "a vertex is not finite");
}

double radius_of(const ChainLink& link) {
  double radius = 0.0;
  for (const Eigen::Vector3d& p_L : link.mesh->vertices)
    radius = std::max(radius, p_L.norm());
  return radius;
}

}  // namespace

KinematicChain::KinematicChain(std::vector<FlexValue> values, std::vector<ChainLink> links)
    : values_(std::move(values)), links_(std::move(links)) {
  if (links_.empty()) throw std::invalid_argument("A kinematic chain needs at least one link, the root.");
  check_values(values_);
  std::set<std::string> names;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    ChainLink& link = links_[i];
    require_link(!link.name.empty(), link, "the name is empty");
    require_link(names.insert(link.name).second, link, "the name occurs twice");
    if (i == 0) {
      check_root(link);
    } else {
      check_joint(link, i, values_.size());
      link.X_PJ = *geometry::rigid_pose(link.X_PJ);
      link.axis_J.normalize();
    }
    check_mesh(link);
    X_PJ_.push_back(link.X_PJ);
    if (link.terms.empty() && i > 0) X_PJ_.back().rotate(Eigen::AngleAxisd(link.offset, link.axis_J));
  }
  find_dependencies();
  find_reaches();
}

void KinematicChain::find_dependencies() {
  moves_.assign(links_.size() * values_.size(), 0);
  hangs_on_.assign(links_.size() * links_.size(), 0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].parent) {
      const std::size_t parent = *links_[i].parent;
      for (std::size_t value = 0; value < values_.size(); ++value)
        moves_[i * values_.size() + value] = moves_[parent * values_.size() + value];
      for (std::size_t other = 0; other < i; ++other)
        hangs_on_[pair(i, other)] = hangs_on_[pair(parent, other)];
    }
    hangs_on_[pair(i, i)] = 1;
    for (const JointTerm& term : links_[i].terms)
      if (term.factor != 0.0) moves_[i * values_.size() + term.value] = 1;
  }
}

// However the joints turn, the origins of neighboring joints stay as far apart as X_PJ says: the triangle inequality.
void KinematicChain::find_reaches() {
  reach_.assign(links_.size() * links_.size(), 0.0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!links_[i].mesh) continue;
    double reach = radius_of(links_[i]);
    for (std::size_t joint = i;; joint = *links_[joint].parent) {
      reach_[pair(i, joint)] = reach * kRoundUp;
      if (!links_[joint].parent) break;
      reach += links_[joint].X_PJ.translation().norm();
    }
  }
}

void KinematicChain::poses(const Eigen::Isometry3d& X_WR, std::span<const double> values,
                           std::span<Eigen::Isometry3d> X_WL) const noexcept {
  GLISSADE_ASSERT(values.size() == values_.size() && X_WL.size() == links_.size());
  X_WL[0] = X_WR;
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const ChainLink& link = links_[i];
    X_WL[i] = X_WL[*link.parent] * X_PJ_[i];
    if (link.terms.empty()) continue;
    double angle = link.offset;
    for (const JointTerm& term : link.terms)
      angle += term.factor * values[term.value];
    X_WL[i].rotate(Eigen::AngleAxisd(angle, link.axis_J));
  }
}

void KinematicChain::add_rates(std::size_t link, const Eigen::Vector3d& p_W, const Eigen::Vector3d& n_W,
                               std::span<const Eigen::Isometry3d> X_WL, std::span<double> rates) const noexcept {
  GLISSADE_ASSERT(link < links_.size() && X_WL.size() == links_.size() && rates.size() >= values_.size());
  for (std::optional<std::size_t> l = link; l; l = links_[*l].parent) {
    if (links_[*l].terms.empty()) continue;
    const Eigen::Vector3d axis_W = X_WL[*l].linear() * links_[*l].axis_J;
    const double per_rad = n_W.dot(axis_W.cross(p_W - X_WL[*l].translation()));
    for (const JointTerm& term : links_[*l].terms)
      rates[term.value] += term.factor * per_rad;
  }
}

bool KinematicChain::moves(std::size_t value, std::size_t link) const noexcept {
  GLISSADE_ASSERT(value < values_.size() && link < links_.size());
  return moves_[link * values_.size() + value] != 0;
}

bool KinematicChain::hangs_on(std::size_t descendant, std::size_t link) const noexcept {
  GLISSADE_ASSERT(descendant < links_.size() && link < links_.size());
  return hangs_on_[pair(descendant, link)] != 0;
}

double KinematicChain::reach(std::size_t link, std::size_t joint) const noexcept {
  GLISSADE_ASSERT(hangs_on(link, joint));
  return reach_[pair(link, joint)];
}

void KinematicChain::clamp(std::span<double> values) const noexcept {
  GLISSADE_ASSERT(values.size() == values_.size());
  for (std::size_t i = 0; i < values_.size(); ++i)
    values[i] = std::clamp(values[i], values_[i].lower, values_[i].upper);
}

}  // namespace glissade::grasping
