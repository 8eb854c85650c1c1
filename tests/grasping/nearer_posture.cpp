#include "nearer_posture.h"

#include <algorithm>
#include <cmath>

namespace glissade::test_support {
namespace {

std::vector<Eigen::Isometry3d> link_poses(const grasping::KinematicChain& chain, const grasping::Posture& posture) {
  std::vector<Eigen::Isometry3d> X_WL(chain.links().size());
  chain.poses(posture.X_WR, posture.values, X_WL);
  return X_WL;
}

}  // namespace

NearerPosture::NearerPosture(const grasping::KinematicChain& chain, const geometry::TriangleMesh& object_W)
    : chain_(chain), distances_(chain.links().size()) {
  for (std::size_t link = 0; link < distances_.size(); ++link) {
    const auto& mesh = chain.links()[link].mesh;
    if (mesh != nullptr) distances_[link].emplace(object_W, *mesh);
  }
}

std::optional<std::size_t> NearerPosture::find(const grasping::Posture& posture, const grasping::Posture& target,
                                               double margin, double farther) const {
  constexpr int kPlaces = 8;
  const std::vector<double> near = clearances(posture, margin);
  for (std::size_t v = 0; v < posture.values.size(); ++v) {
    const double left = target.values[v] - posture.values[v];
    const double speed_here = speed(posture, v);
    if (std::abs(left) * speed_here <= 0.5 * farther) continue;
    const double turn = std::copysign(std::min(std::abs(left), farther / speed_here), left);
    bool is_way_free = true;
    for (int place = 1; is_way_free && place <= kPlaces; ++place) {
      grasping::Posture nearer = posture;
      nearer.values[v] += turn * place / kPlaces;
      is_way_free = is_free(nearer, v, near);
    }
    if (is_way_free) return v;
  }
  return std::nullopt;
}

double NearerPosture::speed(const grasping::Posture& posture, std::size_t value) const {
  constexpr double kTurn = 1e-4;
  grasping::Posture turned = posture;
  turned.values[value] += kTurn;
  const std::vector<Eigen::Isometry3d> X_before = link_poses(chain_, posture);
  const std::vector<Eigen::Isometry3d> X_after = link_poses(chain_, turned);
  double farthest = 0.0;
  for (std::size_t link = 0; link < X_before.size(); ++link) {
    if (!distances_[link] || !chain_.moves(value, link)) continue;
    for (const Eigen::Vector3d& p_L : chain_.links()[link].mesh->vertices)
      farthest = std::max(farthest, (X_after[link] * p_L - X_before[link] * p_L).norm());
  }
  return farthest / kTurn;
}

std::vector<double> NearerPosture::clearances(const grasping::Posture& posture, double margin) const {
  constexpr double kRounding_m = 1e-9;
  const std::vector<Eigen::Isometry3d> X_WL = link_poses(chain_, posture);
  std::vector<double> clearances(X_WL.size(), margin);
  for (std::size_t link = 0; link < X_WL.size(); ++link) {
    if (!distances_[link]) continue;
    for (const collision::ClosePair& pair : distances_[link]->pairs_within(X_WL[link], margin))
      clearances[link] = std::min(clearances[link], pair.distance);
    clearances[link] += kRounding_m;
  }
  return clearances;
}

bool NearerPosture::is_free(const grasping::Posture& posture, std::size_t value,
                            std::span<const double> clearances) const {
  const std::vector<Eigen::Isometry3d> X_WL = link_poses(chain_, posture);
  for (std::size_t link = 0; link < X_WL.size(); ++link) {
    if (!distances_[link] || !chain_.moves(value, link)) continue;
    if (!distances_[link]->pairs_within(X_WL[link], clearances[link]).empty()) return false;
  }
  return true;
}

}  // namespace glissade::test_support
