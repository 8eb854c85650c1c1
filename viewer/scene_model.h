#pragma once

/// The scene as binary glTF (GLB). The viewer's page loads this model, and other programs can read it.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

/// Number of triangles of the first model. A page draws this model first. On a slow machine, the page also draws it
/// during motion.
inline constexpr std::size_t kFirstTriangles = 12'000;

/// The scene at its start as glTF 2.0 with KHR_mesh_quantization. Coordinates are world coordinates minus
/// `ViewScene::p_WO()`, in metres. The objects have at most about `most_triangles` triangles. Each object gets a share
/// of them in proportion to its own number of triangles. Throws std::invalid_argument for a model beyond 4 GiB.
///
/// The extras of the scene include `title`, `origin_W_m`, `parts` (names), `hands` and `triangles` (the number of
/// triangles in the whole scene). The extras of a node include `name` and `kind`. The kinds are `fixed`, `part`,
/// `moving` and `segment`. `part` and `moving` have the number `part`; `segment` has the numbers `hand` and `link`.
std::string scene_model(const ViewScene& scene, std::size_t most_triangles);

/// The meshes of the objects, simplified to at most about `most_triangles` triangles, with shares as in `scene_model`.
/// If the scene has no more triangles than that, the meshes are unchanged. Objects that share a mesh share its
/// simplified mesh. The vertices of a simplified mesh lie on a grid of 65,536 steps across the mesh.
std::vector<std::shared_ptr<const geometry::TriangleMesh>> simplified_meshes(const ViewScene& scene,
                                                                             std::size_t most_triangles);

}  // namespace glissade::viewer
