/// Which side of a surface is outside.

#include "cycle/orientation.h"

#include <utility>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

namespace glissade::contact {
namespace {

using Eigen::Vector3d;
using geometry::TriangleMesh;

TriangleMesh box_of(double size, const Vector3d& centre = Vector3d::Zero()) {
  TriangleMesh mesh = geometry::make_box({size, size, size}, 12);
  for (Vector3d& vertex : mesh.vertices)
    vertex += centre;
  return mesh;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (geometry::Triangle& triangle : mesh.triangles)
    std::swap(triangle[0], triangle[1]);
  return mesh;
}

TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const geometry::Triangle& triangle : other.triangles)
    mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  return mesh;
}

TEST(Encloses, InteriorPointsForAnyTriangleOrientation) {
  EXPECT_TRUE(encloses(box_of(2.0), {0.9, 0.9, 0.9}));
  EXPECT_FALSE(encloses(box_of(2.0), {0.9, 0.9, 1.1}));
  EXPECT_TRUE(encloses(turned_inside_out(box_of(2.0)), {0.9, 0.9, 0.9}));
  TriangleMesh mixed = box_of(2.0);
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 3)
    std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  EXPECT_TRUE(encloses(mixed, {0.9, 0.9, 0.9}));
}

TEST(Encloses, NothingWhereTheSurfaceIsOpen) {
  TriangleMesh open = box_of(2.0);
  open.triangles.pop_back();
  EXPECT_FALSE(encloses(open, Vector3d::Zero()));
}

// A file of several bodies, of which a program has written one inside out.
TEST(Encloses, EachOfSeveralShellsByItself) {
  const TriangleMesh both = joined(box_of(2.0), turned_inside_out(box_of(1.0, {5.0, 0.0, 0.0})));
  EXPECT_TRUE(encloses(both, Vector3d::Zero()));
  EXPECT_TRUE(encloses(both, {5.0, 0.0, 0.0}));
  EXPECT_FALSE(encloses(both, {2.5, 0.0, 0.0}));
}

TEST(Encloses, NoCavity) {
  const TriangleMesh hollow = joined(box_of(2.0), turned_inside_out(box_of(1.0)));
  for (const TriangleMesh& mesh : {hollow, turned_inside_out(hollow)}) {
    EXPECT_FALSE(encloses(mesh, {0.1, 0.2, 0.3}));
    EXPECT_TRUE(encloses(mesh, {0.7, 0.2, 0.3}));
  }
}

TEST(Encloses, ABodyInAnother) {
  EXPECT_TRUE(encloses(joined(box_of(1.0), box_of(2.0)), {0.1, 0.2, 0.3}));
}

}  // namespace
}  // namespace glissade::contact
