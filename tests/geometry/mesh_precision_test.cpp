// Meshes far from the origin: every triangle, and every vertex to the last bit of what the file says. The expected
// vertices come from the generator, never from the importer.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/triangle_mesh.h>

#include "mesh_import_fixture.h"

namespace glissade::geometry {
namespace {

/// The shortest decimal digits that stand for this number and no other.
template <class Number>
std::string digits(Number number) {
  std::array<char, 64> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

template <class Number>
std::string text_of(const Eigen::Vector3d& p) {
  return digits(static_cast<Number>(p.x())) + " " + digits(static_cast<Number>(p.y())) + " " +
         digits(static_cast<Number>(p.z()));
}

/// A sphere of 0.1 m with edges of about 6 mm, at this distance along every axis.
TriangleMesh far_sphere(double distance) {
  TriangleMesh mesh = make_sphere(0.1, 2000);
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    vertex += Eigen::Vector3d(distance, -distance, distance);
  }
  return weld(mesh);
}

/// What a file of single precision can hold of the mesh.
TriangleMesh in_single_precision(TriangleMesh mesh) {
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    for (double& coordinate : vertex) {
      // g++ 12 at -O3 forgets the last two coordinates when it vectorizes this loop, hence volatile.
      const volatile float rounded = static_cast<float>(coordinate);
      coordinate = static_cast<double>(rounded);
    }
  }
  return mesh;
}

std::string obj_of(const TriangleMesh& mesh) {
  std::string file;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    file += "v " + text_of<double>(p) + "\n";
  }
  for (const Triangle& t : mesh.triangles) {
    file += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  return file;
}

std::string text_stl_of(const TriangleMesh& mesh) {
  std::string file = "solid sphere\n";
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    file += ascii_stl_facet(text_of<double>(mesh.corner(t, 0)), text_of<double>(mesh.corner(t, 1)),
                            text_of<double>(mesh.corner(t, 2)));
  }
  return file + "endsolid sphere\n";
}

template <class Number>
std::string bytes_of_point(const Eigen::Vector3d& p, bool is_big_endian = false) {
  return bytes_of<Number>({static_cast<Number>(p.x()), static_cast<Number>(p.y()), static_cast<Number>(p.z())},
                          is_big_endian);
}

std::string binary_stl_of(const TriangleMesh& mesh) {
  std::string file =
      std::string(80, ' ') + bytes_of<std::uint32_t>({static_cast<std::uint32_t>(mesh.triangles.size())});
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    file += std::string(12, '\0');
    for (int corner = 0; corner < 3; ++corner) {
      file += bytes_of_point<float>(mesh.corner(t, corner));
    }
    file += std::string(2, '\0');
  }
  return file;
}

std::string ply_header_of(const TriangleMesh& mesh, const std::string& format, const std::string& type) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) + "\nproperty " +
         type + " x\nproperty " + type + " y\nproperty " + type + " z\nelement face " +
         std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string text_ply_of(const TriangleMesh& mesh, const std::string& type) {
  std::string file = ply_header_of(mesh, "ascii", type);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    file += text_of<double>(p) + "\n";
  }
  for (const Triangle& t : mesh.triangles) {
    file += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  return file;
}

template <class Number>
std::string binary_ply_of(const TriangleMesh& mesh, const std::string& type, bool is_big_endian) {
  std::string file = ply_header_of(mesh, is_big_endian ? "binary_big_endian" : "binary_little_endian", type);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    file += bytes_of_point<Number>(p, is_big_endian);
  }
  for (const Triangle& t : mesh.triangles) {
    file += '\3' + bytes_of<std::int32_t>({t[0], t[1], t[2]}, is_big_endian);
  }
  return file;
}

/// A document whose one node moves the mesh by `translation`.
std::string glb_of(const TriangleMesh& mesh, const Eigen::Vector3d& translation) {
  std::string binary;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    binary += bytes_of_point<float>(p);
  }
  const std::size_t points = binary.size();
  for (const Triangle& t : mesh.triangles) {
    binary += bytes_of<std::int32_t>({t[0], t[1], t[2]});
  }
  const std::string vertices = std::to_string(mesh.vertices.size());
  const std::string corners = std::to_string(3 * mesh.triangles.size());
  const std::string text =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[)" +
      digits(translation.x()) + "," + digits(translation.y()) + "," + digits(translation.z()) +
      R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)" +
      R"({"bufferView":0,"componentType":5126,"count":)" + vertices + R"(,"type":"VEC3"},)" +
      R"({"bufferView":1,"componentType":5125,"count":)" + corners + R"(,"type":"SCALAR"}],"bufferViews":[)" +
      R"({"buffer":0,"byteLength":)" + std::to_string(points) + R"(},{"buffer":0,"byteOffset":)" +
      std::to_string(points) + R"(,"byteLength":)" + std::to_string(binary.size() - points) +
      R"(}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) + "}]}";
  return glb(text, binary);
}

class MeshPrecision : public MeshImport {
 protected:
  /// Expects the triangles of `expected` in the same order, each corner to the last bit.
  void expect_exactly(const TriangleMesh& expected, const std::string& name, const std::string& content) const {
    SCOPED_TRACE(name);
    const ImportedMesh imported = import_mesh(folder_.write(name, content));
    EXPECT_EQ(imported.degenerate_triangles, 0);
    ASSERT_EQ(imported.mesh.triangles.size(), expected.triangles.size());
    EXPECT_EQ(imported.mesh.vertices.size(), expected.vertices.size());
    for (std::int32_t t = 0; t < std::ssize(expected.triangles); ++t) {
      for (int corner = 0; corner < 3; ++corner) {
        ASSERT_EQ(imported.mesh.corner(t, corner), expected.corner(t, corner)) << "triangle " << t;
      }
    }
  }
};

TEST_F(MeshPrecision, TextAndDoublesKeepEveryBitFarFromTheOrigin) {
  for (const double distance : {0.3, 1e3, 1e6}) {
    SCOPED_TRACE(distance);
    const TriangleMesh sphere = far_sphere(distance);
    expect_exactly(sphere, "digits.obj", obj_of(sphere));
    expect_exactly(sphere, "digits.stl", text_stl_of(sphere));
    expect_exactly(sphere, "digits.ply", text_ply_of(sphere, "double"));
    expect_exactly(sphere, "more_digits_than_a_float.ply", text_ply_of(sphere, "float"));
    expect_exactly(sphere, "little.ply", binary_ply_of<double>(sphere, "double", false));
    expect_exactly(sphere, "big.ply", binary_ply_of<double>(sphere, "float64", true));
  }
}

/// A kilometre away, floats are 0.06 mm apart, which does not collapse triangles of 6 mm.
TEST_F(MeshPrecision, FloatsKeepEveryBit) {
  for (const double distance : {0.3, 1e3}) {
    SCOPED_TRACE(distance);
    const TriangleMesh sphere = in_single_precision(far_sphere(distance));
    expect_exactly(sphere, "binary.stl", binary_stl_of(sphere));
    expect_exactly(sphere, "little.ply", binary_ply_of<float>(sphere, "float", false));
    expect_exactly(sphere, "big.ply", binary_ply_of<float>(sphere, "float32", true));
    expect_exactly(sphere, "binary.glb", glb_of(sphere, Eigen::Vector3d::Zero()));
  }
}

TEST_F(MeshPrecision, IntegersOfPlyKeepEveryDigit) {
  const TriangleMesh far{{{123456789, 0, 1}, {123456790, 0, 1}, {123456789, 1, 1}}, {{0, 1, 2}}};
  expect_exactly(far, "integers.ply", binary_ply_of<std::int32_t>(far, "int", false));
}

TEST_F(MeshPrecision, NodesOfGltfMoveInDoublePrecision) {
  const TriangleMesh sphere = in_single_precision(far_sphere(0.0));
  const Eigen::Vector3d translation(1e6 + 0.1, -1e3 / 3, 7e5);
  TriangleMesh moved = sphere;
  for (Eigen::Vector3d& vertex : moved.vertices) {
    vertex += translation;
  }
  expect_exactly(moved, "moved.glb", glb_of(sphere, translation));
}

/// A corner of a part, as drawing programs write it: the digits tell the two points apart, single precision does not.
TEST_F(MeshPrecision, PointsThatDifferByAMicrometreStayTwo) {
  const ImportedMesh imported =
      import_mesh(folder_.write("corner.obj", "v 1000.000001 0 0\nv 1000.000002 0 0\nv 1000 1 0\nf 1 2 3\n"));
  EXPECT_EQ(imported.degenerate_triangles, 0);
  EXPECT_THAT(imported.mesh.vertices,
              testing::ElementsAre(Eigen::Vector3d(1000.000001, 0, 0), Eigen::Vector3d(1000.000002, 0, 0),
                                   Eigen::Vector3d(1000, 1, 0)));
}

}  // namespace
}  // namespace glissade::geometry
