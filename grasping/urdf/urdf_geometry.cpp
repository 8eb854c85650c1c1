#include "urdf/urdf_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>

#include "urdf/urdf_document.h"

namespace glissade::grasping {
namespace {

using geometry::TriangleMesh;
using std::filesystem::path;

constexpr int kSphereTriangles = 400;
constexpr int kCylinderSegments = 32;

TriangleMesh cylinder(double radius, double length) {
  if (!(std::isfinite(radius) && radius > 0.0 && std::isfinite(length) && length > 0.0))
    throw std::invalid_argument("the radius and the length of a cylinder must be positive");
  const std::array<Eigen::Vector2d, 4> profile{
      {{0.0, -length / 2}, {radius, -length / 2}, {radius, length / 2}, {0.0, length / 2}}};
  return geometry::make_revolution(profile, false, kCylinderSegments);
}

/// The path `rest` in the nearest folder `name` that contains `file`, or that is in a folder that contains it.
path in_package(const std::string& name, const path& rest, const path& file) {
  path folder = std::filesystem::absolute(file).parent_path();
  for (;; folder = folder.parent_path()) {
    if (folder.filename() == name && exists(folder / rest)) return folder / rest;
    if (exists(folder / name / rest)) return folder / name / rest;
    if (folder == folder.parent_path()) break;
  }
  throw std::invalid_argument("package '" + name + "' with '" + rest.string() + "' is in no folder above the file");
}

path resolved(const std::string& name, const path& file) {
  const std::string package = "package://";
  const std::string local = "file://";
  if (name.starts_with(package)) {
    const std::string rest = name.substr(package.size());
    const std::size_t slash = rest.find('/');
    if (slash == std::string::npos || slash == 0)
      throw std::invalid_argument("'" + name + "' names no file of a package");
    return in_package(rest.substr(0, slash), rest.substr(slash + 1), file);
  }
  return file.parent_path() / (name.starts_with(local) ? name.substr(local.size()) : name);
}

TriangleMesh from_file(const urdf::Mesh& mesh, const path& file, std::vector<std::string>& warnings) {
  const Eigen::Vector3d scale = to_vector(mesh.scale);
  if (!scale.allFinite() || (scale.array() == 0.0).any()) throw std::invalid_argument("a scale is 0 or not finite");
  const path mesh_file = resolved(mesh.filename, file);
  geometry::ImportedMesh with_warnings = geometry::import_mesh(mesh_file);
  for (const std::string& sentence : with_warnings.warnings) {
    const std::string warning = mesh_file.string() + ": " + sentence;
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  }
  TriangleMesh imported = std::move(with_warnings.mesh);
  for (Eigen::Vector3d& p : imported.vertices)
    p = scale.cwiseProduct(p);
  if (scale.prod() < 0.0) {
    for (geometry::Triangle& triangle : imported.triangles)
      std::swap(triangle[1], triangle[2]);
  }
  return imported;
}

TriangleMesh mesh_of(const urdf::Geometry& shape, const path& file, std::vector<std::string>& warnings) {
  switch (shape.type) {
    case urdf::Geometry::SPHERE:
      return geometry::make_sphere(static_cast<const urdf::Sphere&>(shape).radius, kSphereTriangles);
    case urdf::Geometry::BOX:
      return geometry::make_box(to_vector(static_cast<const urdf::Box&>(shape).dim), 12);
    case urdf::Geometry::CYLINDER: {
      const auto& round = static_cast<const urdf::Cylinder&>(shape);
      return cylinder(round.radius, round.length);
    }
    case urdf::Geometry::MESH:
      return from_file(static_cast<const urdf::Mesh&>(shape), file, warnings);
  }
  throw std::invalid_argument("the collision geometry is of an unknown kind");
}

}  // namespace

std::shared_ptr<const TriangleMesh> collision_mesh(const urdf::Link& link, const path& file,
                                                   std::vector<std::string>& warnings) {
  std::vector<TriangleMesh> meshes;
  try {
    for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
      const auto X_LG = geometry::rigid_pose(to_pose(collision->origin));
      if (!X_LG) throw std::invalid_argument("the origin of a collision geometry is not finite");
      meshes.push_back(transformed(mesh_of(*collision->geometry, file, warnings), *X_LG));
    }
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(file.string() + ": link '" + link.name + "': " + error.what());
  }
  if (meshes.empty()) return nullptr;
  return std::make_shared<const TriangleMesh>(geometry::merge(meshes));
}

}  // namespace glissade::grasping
