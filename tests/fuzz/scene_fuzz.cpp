// Scene files. Whatever they hold, they give a scene that is written and read back as the same, or a sentence says why
// not.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/simulation/scene.h>

#include "fuzz_target.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::fuzz {
namespace {

const std::string kAllKeys =
    "objects:\n"
    "  - {name: 'a', mesh: part.obj, scale: 0.1, movable: true, compliance_point_m: [0, 0, 0.1],\n"
    "     pose: {position_m: [1, 2, 3], orientation_rpy_deg: [10, 20, 30]}}\n"
    "  - name: b\n"
    "    mesh: part.obj\n"
    "    welded: false\n"
    "    margin_m: 1e-6\n"
    "    pose: {orientation_wxyz: [0, 1, 0, 0]}\n"
    "    gives_way: [{min_m: [-1, -1, -1], max_m: [2, 2, 0]}]\n"
    "  - {name: c, mesh: part.obj, moves: [{t_s: 0}, {t_s: 1, orientation_matrix: [0, -1, 0, 1, 0, 0, 0, 0, 1]}],\n"
    "     grip_N_per_m: 1000}\n"
    "script: hand.csv\n"
    "goal: {position_m: [0, 0, 1]}\n";

const test_support::TemporaryFolder& folder() {
  static const test_support::TemporaryFolder folder;
  static const std::string mesh = folder.write("part.obj", test_support::kTetrahedronObj);
  return folder;
}

bool are_equal(const simulation::SceneObject& a, const simulation::SceneObject& b) {
  return a.name == b.name && a.X_WB.matrix() == b.X_WB.matrix() && a.giving_way == b.giving_way &&
         a.mesh->vertices == b.mesh->vertices && a.mesh->triangles == b.mesh->triangles && a.margin_m == b.margin_m &&
         a.movable == b.movable && a.motion.has_value() == b.motion.has_value() &&
         a.compliance_point_B == b.compliance_point_B;
}

}  // namespace

bool try_input(std::string_view bytes) {
  simulation::Scene scene;
  try {
    scene = simulation::parse_scene(std::string(bytes), "input", folder().path(""));
  } catch (const std::invalid_argument&) {
    return false;
  }
  const std::string copy = folder().path("copy.yaml");
  std::filesystem::remove(copy);
  try {
    simulation::write_scene(scene, copy);
  } catch (const std::invalid_argument&) {
    return true;  // such as a name that is no UTF-8
  }
  const simulation::Scene read = simulation::read_scene(copy);
  if (read.objects.size() != scene.objects.size()) throw std::logic_error("an object was lost");
  for (std::size_t i = 0; i < read.objects.size(); ++i)
    if (!are_equal(scene.objects[i], read.objects[i])) throw std::logic_error("an object came back as another");
  return true;
}

std::vector<Seed> seeds() {
  return {{"all_keys", kAllKeys}, {"one", "objects: [{name: a, mesh: part.obj}]\n"}};
}

std::vector<std::string> dictionary() {
  return {"name: ",
          "mesh: part.obj",
          "pose: {",
          "movable: true",
          "moves: [",
          "t_s: ",
          "position_m: [",
          "[0, 0, 0]",
          "nan",
          "1e999",
          "\"",
          "'",
          "#",
          "&a ",
          "*a",
          "!!binary ",
          "<<: ",
          "|\n",
          "---\n",
          "...\n",
          "? ",
          "- ",
          "{}",
          "-0"};
}

// Nothing in a scene file depends on the rest of it.
void repair(std::string&) {}

}  // namespace glissade::fuzz
