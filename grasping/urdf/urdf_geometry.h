#pragma once

/// Collision geometry of URDF links.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <urdf_model/link.h>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::grasping {

/// All collision geometry of a link as one mesh in its frame; null if there is none. `file` is the URDF file. Adds the
/// warnings of mesh files that are not there yet, each after the name of its file. Throws std::invalid_argument, naming
/// the file and the link.
std::shared_ptr<const geometry::TriangleMesh> collision_mesh(const urdf::Link& link, const std::filesystem::path& file,
                                                             std::vector<std::string>& warnings);

}  // namespace glissade::grasping
