#include "user_meshes.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include <Eigen/Geometry>

#include <glissade/geometry/mesh_import.h>

namespace glissade::bench {
namespace {

using geometry::TriangleMesh;

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    box.extend(vertex);
  return box;
}

std::string name_of_file(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (const char c : {' ', '/', ','})
    std::replace(name.begin(), name.end(), c, '_');  // they part the names of benchmarks
  return name;
}

std::vector<std::filesystem::path> mesh_files(const std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::path> all;
  for (const std::filesystem::path& file : files) {
    if (!std::filesystem::is_directory(file)) {
      all.push_back(file);
      continue;
    }
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(file)) {
      const std::string kind = entry.path().extension().string();
      if (kind == ".obj" || kind == ".stl" || kind == ".ply") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

const UserMesh& mesh_named(const std::vector<UserMesh>& meshes, const std::string& name) {
  const auto found =
      std::find_if(meshes.begin(), meshes.end(), [&](const UserMesh& mesh) { return mesh.name == name; });
  if (found == meshes.end()) throw std::invalid_argument("no mesh " + name + " was given with --mesh");
  return *found;
}

UserPair pair_of(const std::string& line, const std::vector<UserMesh>& meshes) {
  std::istringstream words(line);
  std::string name_A;
  std::string name_B;
  if (!(words >> name_A >> name_B)) throw std::invalid_argument("two names of meshes are expected");
  UserPair pair{mesh_named(meshes, name_A), mesh_named(meshes, name_B), std::nullopt, std::nullopt};
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;)
    numbers.push_back(number);
  const bool is_read = words.eof() && (numbers.empty() || numbers.size() == 1 || numbers.size() == 4);
  if (!is_read || (!numbers.empty() && !(numbers[0] > 0.0))) {
    throw std::invalid_argument(
        "after the names, metres per unit may follow, then three coordinates, and nothing else");
  }
  if (!numbers.empty()) pair.metres_per_unit = numbers[0];
  if (numbers.size() == 4) pair.p_AB = Eigen::Vector3d(numbers[1], numbers[2], numbers[3]);
  return pair;
}

}  // namespace

std::vector<UserMesh> user_meshes(const std::vector<std::filesystem::path>& files) {
  std::vector<UserMesh> meshes;
  std::set<std::string> names;
  for (const std::filesystem::path& file : mesh_files(files)) {
    const std::string name = name_of_file(file);
    if (!names.insert(name).second) throw std::invalid_argument("--mesh: two meshes have the name " + name);
    meshes.push_back({name, std::make_shared<const TriangleMesh>(geometry::import_mesh(file).mesh)});
  }
  return meshes;
}

std::vector<UserPair> user_pairs(const std::filesystem::path& list, const std::vector<UserMesh>& meshes) {
  std::ifstream file(list);
  if (!file) throw std::invalid_argument("--pairs: " + list.string() + " cannot be read");
  std::vector<UserPair> pairs;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      pairs.push_back(pair_of(line, meshes));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("--pairs: " + list.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return pairs;
}

geometry::TriangleMesh centered(geometry::TriangleMesh mesh, double scale) {
  const Eigen::Vector3d center = center_of(mesh);
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex = scale * (vertex - center);
  return mesh;
}

Eigen::Vector3d center_of(const geometry::TriangleMesh& mesh) {
  return box_of(mesh).center();
}

double largest_extent(const geometry::TriangleMesh& mesh) {
  return box_of(mesh).sizes().maxCoeff();
}

}  // namespace glissade::bench
