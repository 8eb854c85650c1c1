#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <pybind11/stl.h>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/simulation/scene.h>

#include "arrays.h"
#include "mesh_files.h"
#include "module.h"
#include "trees.h"
#include "unlocked.h"

namespace glissade::python {

namespace {

using simulation::SceneMesh;

void check_rows_of_three(const py::array& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) != 3) throw std::invalid_argument(name + " must have the shape (n, 3)");
}

std::vector<geometry::Triangle> triangles_from(const py::object& argument, std::size_t vertices) {
  const py::array given = py::array::ensure(argument);
  if (!given || (given.dtype().kind() != 'i' && given.dtype().kind() != 'u')) {
    PyErr_Clear();
    throw py::type_error("triangles is no array of whole numbers");
  }
  check_rows_of_three(given, "triangles");
  const auto array = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array) throw std::bad_alloc();
  std::vector<geometry::Triangle> triangles(static_cast<std::size_t>(array.shape(0)));
  const std::int64_t* index = array.data();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::int32_t& corner : triangles[i]) {
      if (*index < 0 || std::cmp_greater_equal(*index, vertices)) {
        const bool is_unsigned = given.dtype().kind() == 'u';  // then a large index is not negative
        throw std::invalid_argument(
            "triangles[" + std::to_string(i) + "] has the index " +
            (is_unsigned ? std::to_string(static_cast<std::uint64_t>(*index)) : std::to_string(*index)) +
            ", but there are " + std::to_string(vertices) + " vertices");
      }
      corner = static_cast<std::int32_t>(*index++);
    }
  }
  return triangles;
}

SceneMesh mesh_from_arrays(const py::object& vertices, const py::object& triangles) {
  const Numbers points = numbers_from(vertices, "vertices");
  check_rows_of_three(points, "vertices");
  geometry::TriangleMesh mesh;
  if (points.shape(0) > std::numeric_limits<std::int32_t>::max())
    throw std::invalid_argument("vertices has more than 2^31 - 1 rows");
  mesh.vertices.reserve(static_cast<std::size_t>(points.shape(0)));
  for (py::ssize_t i = 0; i < points.shape(0); ++i)
    mesh.vertices.emplace_back(points.at(i, 0), points.at(i, 1), points.at(i, 2));
  mesh.triangles = triangles_from(triangles, mesh.vertices.size());
  return mesh;
}

/// A mesh, or an object that has the vertices and faces of one, as those of trimesh.
SceneMesh mesh_of(const py::object& other) {
  if (!py::hasattr(other, "vertices") || !py::hasattr(other, "faces"))
    throw py::type_error("a mesh-like object has the attributes 'vertices' and 'faces'");
  return mesh_from_arrays(other.attr("vertices"), other.attr("faces"));
}

SceneMesh read_mesh(const py::object& path, double scale, bool weld) {
  const std::string file = path_from(path);
  SceneMesh mesh = [&] {
    const Unlocked unlocked;
    return SceneMesh(file, scale, weld);
  }();
  warn_of(mesh);
  return mesh;
}

py::array_t<double> vertices_of(const SceneMesh& mesh) {
  py::array_t<double> array = new_array<double>({static_cast<py::ssize_t>(mesh->vertices.size())}, {3});
  double* values = array.mutable_data();
  for (const Eigen::Vector3d& vertex : mesh->vertices)
    values = std::copy(vertex.data(), vertex.data() + 3, values);
  return array;
}

py::array_t<std::int32_t> triangles_of(const SceneMesh& mesh) {
  py::array_t<std::int32_t> array = new_array<std::int32_t>({static_cast<py::ssize_t>(mesh->triangles.size())}, {3});
  std::int32_t* values = array.mutable_data();
  for (const geometry::Triangle& triangle : mesh->triangles)
    values = std::copy(triangle.begin(), triangle.end(), values);
  return array;
}

SceneMesh shape(const std::string& name, const py::kwargs& parameters) {
  std::map<std::string, double> values;
  for (const auto& [key, value] : parameters) {
    try {
      values[key.cast<std::string>()] = value.cast<double>();
    } catch (const py::cast_error&) {
      throw py::type_error(key.cast<std::string>() + " is no number");
    }
  }
  return SceneMesh::of_shape(name, values);
}

}  // namespace

std::shared_ptr<collision::DopTree> tree_from(const py::object& argument, const std::string& name) {
  if (py::isinstance<collision::DopTree>(argument)) return argument.cast<std::shared_ptr<collision::DopTree>>();
  if (py::isinstance<SceneMesh>(argument))
    throw py::type_error(name + " is a Mesh; build a tree of it first, once for all queries: glissade.Tree(mesh)");
  throw py::type_error(name + " is no Tree but of type " + py::type::of(argument).attr("__name__").cast<std::string>());
}

void add_meshes(py::module_& module) {
  py::class_<SceneMesh>(module, "Mesh", R"(Triangles over an indexed set of vertices, in metres. Immutable.

A mesh is a surface without an inside. It may be open, non-manifold, self-intersecting and inconsistently oriented.)")
      .def(py::init(&mesh_from_arrays), py::arg("vertices"), py::arg("triangles"),
           R"(Copies a mesh from arrays.

vertices: (n, 3) metres. triangles: (m, 3) indices of vertices. Triangles that share vertices are neighbours, so vertices
at the same place should be one. Raises ValueError for a wrong shape or index, TypeError for other things than numbers.)")
      .def_static(
          "of", &mesh_of, py::arg("mesh"),
          "Copies any object with the attributes `vertices` (n, 3) and `faces` (m, 3), such as a trimesh.Trimesh.")
      .def_static("read", &read_mesh, py::arg("path"), py::arg("scale") = 1.0, py::arg("weld") = true,
                  R"(Reads an OBJ, STL, PLY or glTF file whose unit is `scale` metres (0.001 for millimetres).

With `weld`, vertices at the same place become one, and triangles without area are left out. What is skipped is a Python
warning, and in `warnings`. Raises ValueError, naming file and line, for what cannot be read.)")
      .def_static(
          "shape", &shape, py::arg("name"),
          R"(Makes a shape of the catalogue, such as Mesh.shape("box", size_x_m=0.1, size_y_m=0.06, size_z_m=0.04).

Parameters that are not given have their defaults. Raises ValueError, listing the known names, for unknown ones.)")
      .def_property_readonly("vertices", &vertices_of, "(n, 3) metres, a copy")
      .def_property_readonly("triangles", &triangles_of, "(m, 3) indices of vertices, a copy")
      .def_property_readonly("warnings", &SceneMesh::warnings, "sentences about what was skipped in the file")
      .def("__len__", [](const SceneMesh& mesh) { return mesh->triangles.size(); })
      .def("__repr__", [](const SceneMesh& mesh) {
        return "<glissade.Mesh of " + std::to_string(mesh->triangles.size()) + " triangles>";
      });

  using collision::DopTree;
  py::class_<DopTree, std::shared_ptr<DopTree>>(module, "Tree", R"(The DOP-tree of a mesh, which the queries need.

Build one for each mesh, and share it. Any number of threads may query a tree at once. Founding paper, section 2.1.)")
      .def(
          py::init([](const SceneMesh& mesh) {
            const Unlocked unlocked;
            return std::make_shared<DopTree>(mesh.shared());
          }),
          py::arg("mesh"),
          "Builds the tree in O(n log n). Raises ValueError for a mesh without area, or with coordinates beyond 1e9 m.")
      .def_property_readonly(
          "center", [](const DopTree& tree) { return to_array(tree.center()); },
          "(3,) centre of the bounding box, metres")
      .def_property_readonly("radius", &DopTree::radius, "of a sphere about the centre that encloses the mesh, metres")
      .def_property_readonly("memory_bytes", &DopTree::memory_bytes, "without the mesh")
      .def("__repr__", [](const DopTree& tree) {
        return "<glissade.Tree of " + std::to_string(tree.mesh().triangles.size()) + " triangles>";
      });
}

}  // namespace glissade::python
