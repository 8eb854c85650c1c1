#include "clasped_hand.h"

#include <string_view>
#include <utility>

#include <glissade/geometry/displacement.h>

namespace glissade::test_support {

using grasping::Posture;

Posture bent_hand(double angle) {
  Posture posture = open_hand();
  for (std::size_t v = 0; v < posture.values.size(); ++v) {
    const std::string_view name = hand_chain()->values()[v].name;
    if (name.ends_with("_mcp") || name.ends_with("_pip")) posture.values[v] = angle;
    if (name.ends_with("_dip") || name.ends_with("_ip")) posture.values[v] = 2.0 / 3.0 * angle;
    if (name == "thumb_roll") posture.values[v] = angle;
  }
  hand_chain()->clamp(posture.values);
  return posture;
}

Posture between(const Posture& from, const Posture& to, double t) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Posture result = from;
  result.X_WR =
      geometry::displaced(from.X_WR, origin, geometry::displacement_between(from.X_WR, to.X_WR, origin).scaled(t));
  for (std::size_t v = 0; v < result.values.size(); ++v)
    result.values[v] += t * (to.values[v] - from.values[v]);
  return result;
}

ClaspedHand::ClaspedHand(const geometry::TriangleMesh& object, const Eigen::Isometry3d& X_WB,
                         const grasping::ClaspRules& rules)
    : ClaspedHand(hand_chain(), std::make_shared<const geometry::TriangleMesh>(object), X_WB, rules) {}

ClaspedHand::ClaspedHand(std::shared_ptr<const grasping::KinematicChain> chain, const geometry::TriangleMesh& object,
                         const Eigen::Isometry3d& X_WB)
    : ClaspedHand(std::move(chain), std::make_shared<const geometry::TriangleMesh>(object), X_WB, {}) {}

ClaspedHand::ClaspedHand(std::shared_ptr<const grasping::KinematicChain> chain,
                         std::shared_ptr<const geometry::TriangleMesh> object, const Eigen::Isometry3d& X_WB,
                         const grasping::ClaspRules& rules)
    : clasp(std::move(chain), {}, {std::make_shared<const contact::SlidingPart>(object)}, rules),
      check_({{std::move(object), X_WB}}) {
  clasp.place_object(0, X_WB);
}

bool ClaspedHand::collides(const Posture& posture) const {
  const grasping::KinematicChain& chain = clasp.chain();
  std::vector<Eigen::Isometry3d> X_WL(chain.links().size());
  chain.poses(posture.X_WR, posture.values, X_WL);
  for (std::size_t link = 0; link < X_WL.size(); ++link) {
    const auto& mesh = chain.links()[link].mesh;
    if (mesh != nullptr && check_.collides(*mesh, X_WL[link])) return true;
  }
  return false;
}

bool ClaspedHand::way_collides(const Posture& start, int parts) const {
  Posture from = start;
  for (const Posture& to : clasp.way()) {
    for (int i = 1; i <= parts; ++i) {
      if (collides(between(from, to, static_cast<double>(i) / parts))) return true;
    }
    from = to;
  }
  return false;
}

}  // namespace glissade::test_support
