#include <glissade/files/hash.h>
#include <glissade/simulation/scene.h>

namespace glissade::simulation {

namespace {

using files::Hash;

void add(Hash& hash, const geometry::TriangleMesh& mesh) {
  hash.add(std::uint64_t{mesh.vertices.size()});
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    hash.add(vertex);
  hash.add(std::uint64_t{mesh.triangles.size()});
  for (const auto& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle)
      hash.add(static_cast<std::uint64_t>(vertex));
  }
}

void add(Hash& hash, const contact::SlidingPart& part) {
  add(hash, part.tree.mesh());
  hash.add(part.p_Vref());
  hash.add(std::uint64_t{part.has_chosen_point()});
}

void add(Hash& hash, const geometry::PoseTrajectory& script) {
  hash.add(std::uint64_t{script.rows().size()});
  for (const geometry::TimedPose& row : script.rows()) {
    hash.add(static_cast<std::uint64_t>(row.time.count()));
    hash.add(row.X_WB);
  }
}

}  // namespace

std::uint64_t hash_of(const SceneBodies& bodies) {
  Hash hash;
  for (const ScenePart& part : bodies.parts) {
    add(hash, *part.part_V);
    hash.add(part.X_WV_start);
  }
  for (const contact::Obstacle& obstacle : bodies.obstacles) {
    add(hash, obstacle.body->tree.mesh());
    hash.add(obstacle.X_WO);
    hash.add(obstacle.margin.value_or(-1.0));
  }
  for (const contact::ScriptedPart& part : bodies.moving) {
    add(hash, *part.part_B);
    add(hash, part.script_X_WB);
    hash.add(part.grip_N_per_m);
  }
  return hash.value();
}

}  // namespace glissade::simulation
