#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glissade/apps/progress.h>
#include <glissade/apps/run/session_check.h>
#include <glissade/collision/dop_query.h>
#include <glissade/contact/multi_part_sliding.h>

namespace glissade::apps {

namespace {

/// Metres: how much deeper than at its start a part may overlap others, a twentieth of the usual margins and more.
constexpr double kDeeper_m = 1e-6;
/// Metres: parts that are less apart may count as touching.
constexpr double kTouching_m = 1e-7;

constexpr std::size_t kStrides = 64;  // in which the run is checked

struct StartingPart {
  std::shared_ptr<const contact::SlidingPart> part_V;
  Eigen::Isometry3d X_WV;
};

/// A body that a part touches or overlaps at its start, and the part's pose there.
struct PlacedBody {
  const contact::ContactBody* body;
  Eigen::Isometry3d X_BV;
};

/// Those in hands, then those that move on their own.
std::vector<StartingPart> starting_parts(const HapticScene& scene) {
  std::vector<StartingPart> parts;
  for (const ScenePart& part : scene.parts)
    parts.push_back({part.part_V, part.X_WV_start});
  for (const contact::ScriptedPart& part : scene.moving)
    parts.push_back({part.part_B, part.script_X_WB.pose_at(part.start)});
  return parts;
}

/// What must never collide of a part: all of it, or if it touches or overlaps others at its start, what is inside of
/// the faces that do. An open part has no inside: it is checked a little farther away from these others.
std::shared_ptr<const geometry::TriangleMesh> mesh_to_check(const HapticScene& scene,
                                                            const std::vector<StartingPart>& parts, std::size_t part) {
  const std::shared_ptr<const contact::SlidingPart>& part_V = parts[part].part_V;
  collision::QueryWorkspace workspace;
  std::vector<PlacedBody> touched;
  const auto look_at = [&](const contact::ContactBody& body, const Eigen::Isometry3d& X_WB) {
    const Eigen::Isometry3d X_BV = X_WB.inverse(Eigen::Isometry) * parts[part].X_WV;
    if (collision::intersects(body.tree, part_V->tree, X_BV, workspace, kTouching_m)) touched.push_back({&body, X_BV});
  };
  for (const contact::Obstacle& obstacle : scene.obstacles)
    look_at(*obstacle.body, obstacle.X_WO);
  for (std::size_t other = 0; other < part; ++other)
    look_at(*parts[other].part_V, parts[other].X_WV);
  if (touched.empty()) return {part_V, &part_V->tree.mesh()};
  double depth = 0.0;
  for (const PlacedBody& body : touched)
    depth = std::max(depth, contact::overlap_depth(*body.body, *part_V, body.X_BV));
  std::optional<geometry::TriangleMesh> mesh = contact::inset_mesh(*part_V, depth + kDeeper_m);
  if (!mesh) {
    Eigen::Vector3d away_V = Eigen::Vector3d::Zero();
    for (const auto& [body, X_BV] : touched)
      away_V += X_BV.linear().transpose() *
                collision::find_way_out(body->tree, part_V->tree, X_BV, workspace, kDeeper_m).way_out_A;
    mesh = geometry::transformed(part_V->tree.mesh(), Eigen::Isometry3d(Eigen::Translation3d(away_V)));
  }
  return std::make_shared<const geometry::TriangleMesh>(std::move(*mesh));
}

}  // namespace

SessionCheck::SessionCheck(const SessionRecorder& samples, const HapticScene& scene, const HandModels& hands,
                           const std::function<bool()>& should_end)
    : samples_(samples),
      obstacles_(scene.placed_obstacles),
      colliding_of_parts_(samples.parts(), 0),
      colliding_of_hands_(samples.hands(), 0) {
  const std::vector<StartingPart> parts = starting_parts(scene);
  for (std::size_t part = 0; part < parts.size(); ++part)
    meshes_.push_back(mesh_to_check(scene, parts, part));
  for (const auto& mesh : meshes_)
    parts_.emplace_back(std::vector<reference::PlacedMesh>{{mesh}});
  ProgressBar progress("checking poses", static_cast<std::int64_t>(samples.size()));
  for (std::size_t first = 0; first < std::min(kStrides, samples.size()); ++first) {
    if (first > 0 && should_end && should_end()) return;
    Mask chosen(samples.size(), 0);
    for (std::size_t i = first; i < samples.size(); i += kStrides)
      chosen[i] = 1;
    for (std::size_t p = 0; p < samples.parts(); ++p)
      check_part(p, chosen);
    for (std::size_t h = 0; h < samples.hands(); ++h)
      if (hands[h]) check_hand(h, *hands[h], chosen);
    checked_ticks_ += std::count(chosen.begin(), chosen.end(), 1);
    progress.update(checked_ticks_);
  }
}

void SessionCheck::check_part(std::size_t part, const Mask& chosen) {
  Mask collides(samples_.size(), 0);
  check(
      obstacles_, *meshes_[part], chosen, [&](std::size_t i) { return samples_.part(i, part).X_WV; }, collides);
  for (std::size_t other = 0; other < part; ++other) {
    const auto X_OV = [&](std::size_t i) -> Eigen::Isometry3d {
      return samples_.part(i, other).X_WV.inverse(Eigen::Isometry) * samples_.part(i, part).X_WV;
    };
    check(parts_[other], *meshes_[part], chosen, X_OV, collides);
  }
  colliding_of_parts_[part] += std::count(collides.begin(), collides.end(), 1);
}

void SessionCheck::check_hand(std::size_t hand, const grasping::HandModel& model, const Mask& chosen) {
  Mask counts = chosen;
  const std::size_t links = model.chain.links().size();
  std::vector<Eigen::Isometry3d> X_WL(samples_.size() * links);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const hands::VisibleHand& visible = samples_.hand(i, hand).visible;
    if (!hands::is_present(visible.activity)) counts[i] = 0;
    if (counts[i] != 0) model.chain.poses(visible.X_WH, visible.angles, std::span(X_WL).subspan(i * links, links));
  }
  Mask collides(samples_.size(), 0);
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
  colliding_of_hands_[hand] += std::count(collides.begin(), collides.end(), 1);
}

/// Marks the ticks that count and in which the mesh collides.
template <typename PoseAt>
void SessionCheck::check(const reference::GridCheck& obstacles, const geometry::TriangleMesh& mesh, const Mask& counts,
                         const PoseAt& pose_at, Mask& collides) const {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<std::size_t> pose_of_tick(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (counts[i] == 0) continue;
    const Eigen::Isometry3d X = pose_at(i);
    if (poses.empty() || poses.back().matrix() != X.matrix()) poses.push_back(X);
    pose_of_tick[i] = poses.size() - 1;
  }
  if (poses.empty()) return;
  const std::vector<char> of_pose = obstacles.collisions(mesh, poses);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (counts[i] != 0) collides[i] = static_cast<char>(collides[i] | of_pose[pose_of_tick[i]]);
  }
}

}  // namespace glissade::apps
