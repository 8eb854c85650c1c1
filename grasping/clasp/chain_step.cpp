#include "clasp/chain_step.h"

#include <algorithm>
#include <cmath>

namespace glissade::grasping {

void scale(ChainStep& step, double factor) {
  step.root = step.root.scaled(factor);
  for (double& value : step.values)
    value *= factor;
}

void step_between(const Posture& from, const Posture& to, ChainStep& step) {
  step.root = geometry::displacement_between(from.X_WR, to.X_WR, Eigen::Vector3d::Zero());
  step.values.resize(from.values.size());
  for (std::size_t v = 0; v < step.values.size(); ++v)
    step.values[v] = to.values[v] - from.values[v];
}

void advance(const Posture& from, const ChainStep& step, double t, Posture& to) {
  to.X_WR = geometry::displaced(from.X_WR, Eigen::Vector3d::Zero(), step.root.scaled(t));
  to.values.resize(from.values.size());
  for (std::size_t v = 0; v < to.values.size(); ++v)
    to.values[v] = from.values[v] + t * step.values[v];
}

std::vector<std::size_t> links_that_touch(const KinematicChain& chain) {
  std::vector<std::size_t> links;
  for (std::size_t link = 0; link < chain.links().size(); ++link) {
    if (chain.links()[link].mesh != nullptr) links.push_back(link);
  }
  return links;
}

ChainMotion::ChainMotion(const KinematicChain& chain, std::span<const std::size_t> movers)
    : chain_(chain),
      movers_(movers),
      turns_(chain.links().size()),
      lengths_(movers.size()),
      accelerations_(movers.size()),
      X_WL_(chain.links().size()) {}

// A joint that turns by the angle ω_j during the step moves the points of a link by at most ω_j r_j, with r_j their
// greatest distance from the joint. Its axis turns with all joints above, by W_j. The second derivative of the way of a
// point is therefore at most Σ_j ω_j (2 W_j r_j + Σ_{i ≥ j} ω_i r_i).
void ChainMotion::set(const Posture& from, const ChainStep& step) {
  from_ = from;
  step_ = step;
  const std::span<const ChainLink> links = chain_.links();
  for (std::size_t l = 0; l < links.size(); ++l) {
    turns_[l] = 0.0;
    for (const JointTerm& term : links[l].terms)
      turns_[l] += term.factor * step.values[term.value];
  }
  const double root_turn = step.root.w.norm();
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const std::size_t link = movers_[m];
    double above = root_turn;  // W_j of the joint after the last one
    for (std::optional<std::size_t> l = link; l; l = links[*l].parent)
      above += std::abs(turns_[*l]);
    double below = 0.0;  // Σ_{i ≥ j} ω_i r_i
    double acceleration = 0.0;
    const auto add = [&](double turn, double reach) {
      above -= turn;
      below += turn * reach;
      acceleration += turn * (2.0 * std::max(0.0, above) * reach + below);
    };
    for (std::optional<std::size_t> l = link; l; l = links[*l].parent)
      add(std::abs(turns_[*l]), chain_.reach(link, *l));
    add(root_turn, chain_.reach(link, 0));
    lengths_[m] = step.root.v.norm() + below;
    accelerations_[m] = acceleration;
  }
}

void ChainMotion::poses(double t, std::span<Eigen::Isometry3d> X_WM) const {
  advance(from_, step_, t, at_);
  chain_.poses(at_.X_WR, at_.values, X_WL_);
  for (std::size_t m = 0; m < movers_.size(); ++m)
    X_WM[m] = X_WL_[movers_[m]];
}

double ChainMotion::longest() const {
  return *std::max_element(lengths_.begin(), lengths_.end());
}

}  // namespace glissade::grasping
