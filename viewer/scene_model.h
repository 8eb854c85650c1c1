#pragma once

/// The scene as binary glTF (GLB): what the viewer's page loads, and what other programs read.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

/// Of the model that a page draws first, and while things move if its machine is slow.
inline constexpr std::size_t kFirstTriangles = 12'000;

/// The scene at its start, with at most about `most_triangles` triangles, shared among the objects by their size. glTF
/// 2.0 with KHR_mesh_quantization; coordinates are those of W less `ViewScene::p_WO()`, in metres. The extras of the
/// scene have `title`, `origin_W_m`, `parts` (names), `hands` and `triangles`, the number in the whole scene. Those of
/// a node have `name` and `kind`: `fixed`, `part` and `moving` with the number `part`, or `segment` with the numbers
/// `hand` and `link`. Throws std::invalid_argument for a model beyond 4 GiB.
std::string scene_model(const ViewScene& scene, std::size_t most_triangles);

/// The meshes of the objects with at most about `most_triangles` triangles, shared among the objects by their size;
/// those of the scene if it has no more. Equal meshes stay equal. The vertices of a simplified mesh lie on a grid of
/// 65,536 steps across it.
std::vector<std::shared_ptr<const geometry::TriangleMesh>> simplified_meshes(const ViewScene& scene,
                                                                             std::size_t most_triangles);

}  // namespace glissade::viewer
