#include <algorithm>
#include <span>

#include <glissade/apps/progress.h>
#include <glissade/apps/run/session_check.h>

namespace glissade::apps {

SessionCheck::SessionCheck(const SessionRecorder& samples, const HapticScene& scene)
    : samples_(samples), obstacles_(scene.placed_obstacles) {
  for (const ScenePart& part : scene.parts)
    meshes_.emplace_back(part.part_V, &part.part_V->tree.mesh());
  for (const haptics::ScriptedPart& part : scene.moving)
    meshes_.emplace_back(part.part_B, &part.part_B->tree.mesh());
  for (const auto& mesh : meshes_)
    parts_.emplace_back(std::vector<reference::PlacedMesh>{{mesh}});
}

std::int64_t SessionCheck::colliding_ticks_of_part(std::size_t part) const {
  std::vector<char> collides(samples_.size(), 0);
  const std::vector<char> all(samples_.size(), 1);
  check(
      obstacles_, *meshes_[part], all, [&](std::size_t i) { return samples_.part(i, part).X_WV; }, collides);
  for (std::size_t other = 0; other < part; ++other) {
    const auto X_OV = [&](std::size_t i) -> Eigen::Isometry3d {
      return samples_.part(i, other).X_WV.inverse(Eigen::Isometry) * samples_.part(i, part).X_WV;
    };
    check(parts_[other], *meshes_[part], all, X_OV, collides);
  }
  return std::count(collides.begin(), collides.end(), 1);
}

std::int64_t SessionCheck::colliding_ticks_of_hand(std::size_t hand, const grasping::HandModel& model) const {
  std::vector<char> counts(samples_.size(), 0);
  const std::size_t links = model.chain.links().size();
  std::vector<Eigen::Isometry3d> X_WL(samples_.size() * links);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const devices::VisibleHand& visible = samples_.hand(i, hand).visible;
    counts[i] = devices::is_present(visible.activity) ? 1 : 0;
    if (counts[i] != 0) model.chain.poses(visible.X_WH, visible.angles, std::span(X_WL).subspan(i * links, links));
  }
  std::vector<char> collides(samples_.size(), 0);
  for (std::size_t l = 0; l < links; ++l) {
    const geometry::TriangleMesh* const mesh = model.chain.links()[l].mesh.get();
    if (mesh == nullptr) continue;
    check(
        obstacles_, *mesh, counts, [&](std::size_t i) { return X_WL[i * links + l]; }, collides);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const auto X_VL = [&](std::size_t i) -> Eigen::Isometry3d {
        return samples_.part(i, p).X_WV.inverse(Eigen::Isometry) * X_WL[i * links + l];
      };
      check(parts_[p], *mesh, counts, X_VL, collides);
    }
  }
  return std::count(collides.begin(), collides.end(), 1);
}

/// Marks the ticks that count and in which the mesh collides.
template <typename PoseAt>
void SessionCheck::check(const reference::GridCheck& obstacles, const geometry::TriangleMesh& mesh,
                         const std::vector<char>& counts, const PoseAt& pose_at, std::vector<char>& collides) const {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<std::size_t> pose_of_tick(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (counts[i] == 0) continue;
    const Eigen::Isometry3d X = pose_at(i);
    if (poses.empty() || poses.back().matrix() != X.matrix()) poses.push_back(X);
    pose_of_tick[i] = poses.size() - 1;
  }
  if (poses.empty()) return;
  ProgressBar progress("checking poses", static_cast<std::int64_t>(poses.size()));
  const std::vector<char> of_pose =
      obstacles.collisions(mesh, poses, [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (counts[i] != 0) collides[i] = static_cast<char>(collides[i] | of_pose[pose_of_tick[i]]);
  }
}

}  // namespace glissade::apps
