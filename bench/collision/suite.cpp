#include "suite.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include <Eigen/Geometry>

#include <glissade/geometry/mesh_import.h>
#include <glissade/shapes/benchmark_shapes.h>

namespace glissade::bench {
namespace {

using geometry::TriangleMesh;

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    box.extend(vertex);
  return box;
}

double extent(const TriangleMesh& mesh) {
  return box_of(mesh).sizes().maxCoeff();
}

TriangleMesh centered(TriangleMesh mesh, double size, double extent) {
  const Eigen::Vector3d center = box_of(mesh).center();
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex = size / extent * (vertex - center);
  return mesh;
}

TriangleMesh centered(const TriangleMesh& mesh, double size) {
  return centered(mesh, size, extent(mesh));
}

std::string name_of_file(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  std::replace(name.begin(), name.end(), ',', '_');  // results.csv has no quoting
  return name;
}

// The meshes of all folders and files, in the order of their paths within a folder.
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

using MeshesByName = std::map<std::string, std::shared_ptr<const TriangleMesh>>;

PartPair pair_of(const MeshesByName& meshes, const std::string& name_A, const std::string& name_B) {
  for (const std::string& name : {name_A, name_B}) {
    if (!meshes.contains(name)) throw std::invalid_argument("--pairs: no mesh " + name + " was given with --mesh");
  }
  const TriangleMesh& mesh_A = *meshes.at(name_A);
  const TriangleMesh& mesh_B = *meshes.at(name_B);
  const double largest = std::max(extent(mesh_A), extent(mesh_B));
  return {name_A + "/" + name_B, std::make_shared<const TriangleMesh>(centered(mesh_A, kSize, largest)),
          std::make_shared<const TriangleMesh>(centered(mesh_B, kSize, largest))};
}

}  // namespace

std::vector<std::string> all_shapes() {
  std::vector<std::string> names;
  for (const shapes::BenchmarkShape& shape : shapes::benchmark_shapes())
    names.push_back(shape.name);
  return names;
}

geometry::TriangleMesh make_shape(const std::string& shape, std::int64_t triangles, double size) {
  for (const shapes::BenchmarkShape& known : shapes::benchmark_shapes()) {
    if (known.name == shape) return centered(known.make(triangles), size);
  }
  throw std::invalid_argument("shape " + shape + " is unknown");
}

std::string short_count(std::int64_t count) {
  if (count >= 1'000'000 && count % 1'000'000 == 0) return std::to_string(count / 1'000'000) + "M";
  if (count >= 1'000 && count % 1'000 == 0) return std::to_string(count / 1'000) + "k";
  return std::to_string(count);
}

std::vector<SuiteMesh> suite_meshes(const Suite& suite, const std::vector<std::int64_t>& triangles, double size) {
  std::vector<SuiteMesh> meshes;
  for (const std::string& shape : suite.shapes) {
    for (const std::int64_t count : triangles) {
      meshes.push_back(
          {shape + "-" + short_count(count), [shape, count, size] { return make_shape(shape, count, size); }});
    }
  }
  for (const std::filesystem::path& file : mesh_files(suite.files)) {
    const auto mesh = std::make_shared<const TriangleMesh>(geometry::import_mesh(file).mesh);
    meshes.push_back({name_of_file(file), [mesh, size] { return centered(*mesh, size); }});
  }
  return meshes;
}

std::vector<PartPair> part_pairs(const Suite& suite) {
  MeshesByName meshes;
  std::vector<PartPair> pairs;
  for (const std::filesystem::path& file : mesh_files(suite.files)) {
    const std::string name = name_of_file(file);
    const auto mesh = std::make_shared<const TriangleMesh>(geometry::import_mesh(file).mesh);
    meshes[name] = mesh;
    const auto copy = std::make_shared<const TriangleMesh>(centered(*mesh, kSize));
    pairs.push_back({name, copy, copy});
  }
  if (suite.pairs.empty()) return pairs;
  std::ifstream list(suite.pairs);
  if (!list) throw std::invalid_argument("--pairs: " + suite.pairs.string() + " cannot be read");
  std::string name_A;
  std::string name_B;
  while (list >> name_A >> name_B)
    pairs.push_back(pair_of(meshes, name_A, name_B));
  return pairs;
}

}  // namespace glissade::bench
