#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/mesh_topology.h>

#include "mesh_import_fixture.h"

namespace glissade::geometry {
namespace {

TEST_F(MeshImport, ATetrahedronInEveryFormat) {
  for (auto [name, content] : tetrahedra()) {
    SCOPED_TRACE(name);
    if (name == "embedded.gltf") {
      content = with(with(content, R"("buffer":0)", R"("buffer":1)"), R"("buffer":0)", R"("buffer":1)");
    }
    const ImportedMesh imported = import_mesh(folder_.write(name, content));
    const MeshReport r = report(imported.mesh);
    EXPECT_EQ(r.vertices, 4);
    EXPECT_EQ(r.triangles, 4);
    EXPECT_TRUE(r.is_watertight);
    EXPECT_EQ(r.inconsistent_edges, 0);
    EXPECT_NEAR(r.area, 1.5 + std::sqrt(3) / 2, 1e-12);
    EXPECT_EQ(r.bounds.max(), Eigen::Vector3d::Ones());
    EXPECT_EQ(imported.degenerate_triangles, 0);
    EXPECT_EQ(imported.polygons_triangulated, 0);
  }
}

TEST_F(MeshImport, ScaleConvertsToMetres) {
  const MeshReport r = report(import_mesh(folder_.write("mm.obj", kObj), 1e-3).mesh);
  EXPECT_EQ(r.bounds.max(), Eigen::Vector3d::Constant(1e-3));
}

TEST_F(MeshImport, PolygonsAreTriangulatedAlsoConcaveOnes) {
  // An L of six corners with area 3 and a square of four with area 4, side by side.
  const std::string obj =
      "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 3 0 0\nv 5 0 0\nv 5 2 0\nv 3 2 0\n"
      "f 1 2 3 4 5 6\nf 7 8 9 10\n";
  const ImportedMesh imported = import_mesh(folder_.write("polygons.obj", obj));
  EXPECT_EQ(imported.polygons_triangulated, 2);
  EXPECT_EQ(imported.mesh.triangles.size(), 6U);
  EXPECT_NEAR(report(imported.mesh).area, 7, 1e-12);
}

TEST_F(MeshImport, PolygonsThatCrossThemselvesBecomeTrianglesToo) {
  const std::string points = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nv 3 3 3\n";
  EXPECT_EQ(import_mesh(folder_.write("bow_tie.obj", points + "f 1 2 3 4\n")).mesh.triangles.size(), 2U);
  const ImportedMesh twice = import_mesh(folder_.write("twice_around.obj", points + "f 1 3 2 4 1 3 2 4\n"));
  EXPECT_EQ(twice.mesh.triangles.size() + static_cast<std::size_t>(twice.degenerate_triangles), 6U);
  std::string huge = "f";
  for (int i = 0; i < 6000; ++i) {
    huge += ' ';
    huge += std::to_string(1 + i % 5);
  }
  EXPECT_THAT(error_of("huge.obj", points + huge + "\n"), testing::HasSubstr("line 6: a face of 6000 corners"));
}

TEST_F(MeshImport, DegenerateTrianglesAreDroppedAndCounted) {
  const std::string obj = kObj + "v 0.5 0 0\nv 9 9 9\nf 1 5 2\nf 1 1 2\nf 6 6 6\n";
  const ImportedMesh imported = import_mesh(folder_.write("slivers.obj", obj));
  EXPECT_EQ(imported.degenerate_triangles, 3);
  EXPECT_EQ(imported.mesh.triangles.size(), 4U);
  EXPECT_EQ(imported.mesh.vertices.size(), 4U) << "vertices that only degenerate triangles used are gone";
}

TEST_F(MeshImport, NodesPlaceTheirMeshes) {
  // The tetrahedron turned by 90 degrees about z, doubled and moved, below a node that moves it on.
  const std::string text =
      with(with(gltf(R"({"byteLength":72})"), R"("translation":[0,0,0])", R"("translation":[0,0,7])"), R"({"mesh":0})",
           R"({"mesh":0,"matrix":[0,2,0,0,-2,0,0,0,0,0,2,0,5,0,0,1]})");
  const MeshReport r = report(import_mesh(folder_.write("nodes.glb", glb(text, gltf_binary()))).mesh);
  EXPECT_TRUE(r.bounds.min().isApprox(Eigen::Vector3d(3, 0, 7)));
  EXPECT_TRUE(r.bounds.max().isApprox(Eigen::Vector3d(5, 2, 9)));
}

TEST_F(MeshImport, NodesMayTurnByAQuaternionOfNearlyUnitLength) {
  const std::string text =
      with(gltf(R"({"byteLength":72})"), R"({"mesh":0})", R"({"mesh":0,"rotation":[0,0,0.7075,0.7075]})");
  const MeshReport r = report(import_mesh(folder_.write("nodes.glb", glb(text, gltf_binary()))).mesh);
  EXPECT_NEAR(r.area, 1.5 + std::sqrt(3) / 2, 1e-6) << "the excess length of 6e-4 must not scale the mesh";
  EXPECT_TRUE(r.bounds.min().isApprox(Eigen::Vector3d(-1, 0, 0), 1e-6));
}

/// Hand-computed: a strip and a fan over the corners of a unit square, in this order: (0, 0), (1, 0), (0, 1), (1, 1).
TEST_F(MeshImport, StripsAndFansOfGltf) {
  const std::string square = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const auto mode = [&](int number, const std::vector<std::uint16_t>& corners) {
    std::string binary = square;
    for (const std::uint16_t corner : corners) {
      binary += bytes_of<std::uint16_t>({corner});
    }
    std::string text =
        with(gltf(R"({"byteLength":56})"), R"("indices":1)", R"("indices":1,"mode":)" + std::to_string(number));
    text = with(with(text, R"("count":12)", R"("count":4)"), R"("byteLength":24)", R"("byteLength":8)");
    return import_mesh(folder_.write("a.glb", glb(text, binary))).mesh;
  };
  // Vertices are numbered by their first use.
  const TriangleMesh strip = mode(5, {0, 1, 2, 3});
  EXPECT_THAT(strip.triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
  EXPECT_EQ(strip.vertices[3], Eigen::Vector3d(1, 1, 0));
  const TriangleMesh fan = mode(6, {0, 1, 3, 2});
  EXPECT_THAT(fan.triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(fan.vertices[3], Eigen::Vector3d(0, 1, 0));
}

/// KHR_mesh_quantization: positions are integers, as they are or as fractions of the largest one.
TEST_F(MeshImport, QuantizedPositionsOfGltf) {
  const std::string corners = bytes_of<std::uint16_t>({0, 1, 2});
  const auto triangle = [&](const std::string& points, const std::string& component, int point_bytes) {
    const std::string bytes = std::to_string(3 * point_bytes);
    std::string text = gltf(R"({"byteLength":)" + std::to_string(3 * point_bytes + 6) + "}");
    text = with(text, R"("scene":0)", R"("extensionsRequired":["KHR_mesh_quantization"],"scene":0)");
    text = with(text, R"("componentType":5126,"count":4)", component + R"(,"count":3)");
    text = with(text, R"("count":12)", R"("count":3)");
    text = with(text, R"({"buffer":0,"byteLength":48})",
                R"({"buffer":0,"byteLength":)" + bytes + R"(,"byteStride":)" + std::to_string(point_bytes) + "}");
    text = with(text, R"("byteOffset":48,"byteLength":24)", R"("byteOffset":)" + bytes + R"(,"byteLength":6)");
    return import_mesh(folder_.write("a.glb", glb(text, points + corners))).mesh.vertices;
  };
  using testing::ElementsAre;
  using Point = Eigen::Vector3d;
  EXPECT_THAT(triangle(bytes_of<std::int8_t>({-128, 0, 5, 9, 127, 0, 5, 9, 0, 3, 5, 9}), R"("componentType":5120)", 4),
              ElementsAre(Point(-128, 0, 5), Point(127, 0, 5), Point(0, 3, 5)));
  EXPECT_THAT(triangle(bytes_of<std::int8_t>({-128, 0, 0, 9, 127, 0, 0, 9, 0, 127, 0, 9}),
                       R"("componentType":5120,"normalized":true)", 4),
              ElementsAre(Point(-1, 0, 0), Point(1, 0, 0), Point(0, 1, 0)));
  EXPECT_THAT(triangle(bytes_of<std::uint8_t>({0, 0, 0, 9, 255, 0, 0, 9, 0, 51, 0, 9}),
                       R"("componentType":5121,"normalized":true)", 4),
              ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, 0.2, 0)));
  EXPECT_THAT(
      triangle(bytes_of<std::int16_t>({-32768, 0, 0, 9, 32767, 0, 0, 9, 0, 7, 0, 9}), R"("componentType":5122)", 8),
      ElementsAre(Point(-32768, 0, 0), Point(32767, 0, 0), Point(0, 7, 0)));
  EXPECT_THAT(triangle(bytes_of<std::uint16_t>({0, 0, 0, 9, 65535, 0, 0, 9, 0, 13107, 0, 9}),
                       R"("componentType":5123,"normalized":true)", 8),
              ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, 0.2, 0)));
}

TEST_F(MeshImport, UnreadableFilesAreErrors) {
  EXPECT_THROW(import_mesh(""), std::invalid_argument);
  EXPECT_THAT(error_of(folder_.path() / "missing.obj"), testing::EndsWith("missing.obj: there is no such file"));
  EXPECT_THAT(error_of(folder_.path()), testing::HasSubstr("folder"));
  EXPECT_THAT(error_of("mesh.step", "anything"),
              testing::AllOf(testing::HasSubstr(".step"), testing::HasSubstr(".obj")));
  EXPECT_THAT(error_of("mesh", "anything"), testing::HasSubstr("not known"));
  EXPECT_THAT(error_of("/dev/null"), testing::HasSubstr("not a regular file"));
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.gltf", "a.glb"}) {
    EXPECT_THAT(error_of(name, ""), testing::HasSubstr("empty"));
    EXPECT_FALSE(error_of(name, "\n").empty());
    EXPECT_FALSE(error_of(name, std::string(1000, '\0')).empty());
    EXPECT_FALSE(error_of(name, std::string(1000, '\xff')).empty());
  }
}

TEST_F(MeshImport, AnErrorNamesTheFormatOfAMisnamedFile) {
  const auto expect_guess = [&](const std::string& name, const std::string& content, const std::string& formats) {
    EXPECT_THAT(error_of(name, content), testing::EndsWith(formats)) << name;
  };
  expect_guess("obj.stl", kObj, " By its name it is STL, by its content it seems to be OBJ.");
  expect_guess("obj.ply", "# a comment\n" + kObj, "PLY, by its content it seems to be OBJ.");
  expect_guess("obj.glb", kByteOrderMark + with_crlf(kObj), "glTF, by its content it seems to be OBJ.");
  expect_guess("text_stl.obj", kAsciiStl, "OBJ, by its content it seems to be STL.");
  expect_guess("binary_stl.obj", binary_stl("made by a test"), "OBJ, by its content it seems to be STL.");
  expect_guess("ply.stl", kAsciiPly, "STL, by its content it seems to be PLY.");
  expect_guess("gltf.obj", gltf(R"({"byteLength":72,"uri":"tetrahedron%20data.bin"})"), "seems to be glTF.");
  expect_guess("glb.ply", tetrahedron_glb(), "PLY, by its content it seems to be glTF.");
  EXPECT_THAT(error_of("cut_off.obj", "v 0 0 0\n"), testing::Not(testing::HasSubstr("seems to be")));
  EXPECT_THAT(error_of("noise.obj", "anything"), testing::Not(testing::HasSubstr("seems to be")));
}

TEST_F(MeshImport, UnweldedImportKeepsAllVerticesAndTriangles) {
  const std::string text = "v 7 7 7\nv 0 0 0\nv 1 0 0\nv 0 -0.0 1\nv 1 0 0\nf 4 2 3\nf 2 2 5\nrock 1\n";
  const ImportedMesh raw = import_unwelded_mesh(folder_.write("raw.obj", text), 2.0);
  ASSERT_EQ(raw.mesh.vertices.size(), 5U);
  EXPECT_EQ(raw.mesh.vertices[0], Eigen::Vector3d(14, 14, 14)) << "of no triangle";
  EXPECT_TRUE(std::signbit(raw.mesh.vertices[3].y()));
  EXPECT_EQ(raw.mesh.vertices[4], raw.mesh.vertices[2]);
  EXPECT_EQ(raw.mesh.triangles, (std::vector<Triangle>{{3, 1, 2}, {1, 1, 4}}));
  EXPECT_EQ(raw.warnings.size(), 1U) << "of the unknown statement";
}

TEST_F(MeshImport, ScaleMustBePositiveAndFinite) {
  const std::filesystem::path file = folder_.write("good.obj", kObj);
  EXPECT_THAT(error_of(file, 0), testing::HasSubstr("scale"));
  EXPECT_THAT(error_of(file, -1), testing::HasSubstr("-1"));
  EXPECT_THAT(error_of(file, std::nan("")), testing::HasSubstr("nan"));
  EXPECT_THAT(error_of(file, 1e10), testing::HasSubstr("beyond"));
}

}  // namespace
}  // namespace glissade::geometry
