#include <algorithm>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/shape_catalog.h>

namespace glissade::shapes {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& name, const std::map<std::string, double>& parameters) {
  try {
    make_shape(name, parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(ShapeCatalog, EveryShapeIsAValidMeshWithItsDefaults) {
  for (const Shape& shape : shape_catalog()) {
    SCOPED_TRACE(shape.name);
    EXPECT_FALSE(shape.description.empty());
    std::map<std::string, double> parameters;
    for (const ShapeParameter& parameter : shape.parameters) {
      EXPECT_FALSE(parameter.description.empty());
      if (parameter.name == "detail") parameters["detail"] = 0.1;
    }
    const geometry::TriangleMesh mesh = make_shape(shape.name, parameters);
    const geometry::MeshReport r = geometry::report(mesh);
    EXPECT_GE(r.triangles, 12);
    EXPECT_EQ(r.degenerate, 0);
    EXPECT_EQ(r.nonmanifold_edges, 0);
    EXPECT_TRUE(std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const auto& p) { return p.allFinite(); }));
  }
}

TEST(ShapeCatalog, IsInAlphabeticalOrder) {
  EXPECT_TRUE(std::is_sorted(shape_catalog().begin(), shape_catalog().end(),
                             [](const Shape& a, const Shape& b) { return a.name < b.name; }));
}

TEST(ShapeCatalog, ParametersTakeEffect) {
  const geometry::MeshReport r = geometry::report(make_shape("box", {{"size_y_m", 0.5}, {"triangles", 1000}}));
  EXPECT_DOUBLE_EQ(r.bounds.sizes().y(), 0.5);
  EXPECT_DOUBLE_EQ(r.bounds.sizes().x(), 0.1);
  EXPECT_NEAR(static_cast<double>(r.triangles), 1000, 200);
}

TEST(ShapeCatalog, ErrorsNameWhatIsUnknownAndWhatIsKnown) {
  EXPECT_THAT(error_of("blob", {}), AllOf(HasSubstr("blob"), HasSubstr("sphere"), HasSubstr("window_motor")));
  EXPECT_THAT(error_of("sphere", {{"radios_m", 1}}),
              AllOf(HasSubstr("sphere"), HasSubstr("radios_m"), HasSubstr("radius_m")));
  EXPECT_THAT(error_of("sphere", {{"radius_m", -1}}), AllOf(HasSubstr("sphere"), HasSubstr("-1")));
  EXPECT_THAT(error_of("sphere", {{"triangles", 1e300}}), AllOf(HasSubstr("triangles"), HasSubstr("1e+300")));
  EXPECT_THAT(error_of("window_motor", {{"detail", 0}}), HasSubstr("detail"));
}

}  // namespace
}  // namespace glissade::shapes
