// Accessors of glTF, 3.6.2: sparse ones, with and without a base, and others that are not plain floats.

#include <string>

#include "gltf_import_fixture.h"

namespace glissade::geometry {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class GltfAccessor : public GltfImport {
 protected:
  /// Replaces elements of an accessor; `count` is their number.
  static void make_sparse(GltfWriter& file, std::size_t accessor, std::size_t count, const std::string& indices,
                          int component, const std::string& values) {
    const std::size_t view_of_indices = file.add_view(indices);
    const std::size_t view_of_values = file.add_view(values);
    file.root["accessors"][accessor]["sparse"] = {
        {"count", count},
        {"indices", {{"bufferView", view_of_indices}, {"componentType", component}}},
        {"values", {{"bufferView", view_of_values}}}};
  }
  static GltfWriter placed_triangle() {
    GltfWriter file = triangle();
    file.add_node({{"mesh", 0}});
    return file;
  }
};

TEST_F(GltfAccessor, SparsePositionsReplaceThoseOfTheView) {
  GltfWriter file = placed_triangle();
  make_sparse(file, 0, 2, bytes_of<std::uint32_t>({0, 2}), 5125, bytes_of<float>({0, 0, 5, 0, 7, 0}));
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 5), Point(1, 0, 0), Point(0, 7, 0)));
}

TEST_F(GltfAccessor, SparsePositionsWithoutAViewReplaceZeros) {
  GltfWriter file = placed_triangle();
  file.root["accessors"][0].erase("bufferView");
  make_sparse(file, 0, 2, bytes_of<std::uint8_t>({1, 2}), 5121, bytes_of<float>({0, 0, 5, 0, 7, 0}));
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(0, 0, 5), Point(0, 7, 0)));
}

/// The second corner becomes point 3, at (1, 1, 0).
TEST_F(GltfAccessor, SparseIndicesOfCorners) {
  GltfWriter file;
  file.add_accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}), 5126, "VEC3", 4);
  const std::size_t indices = file.add_accessor(bytes_of<std::uint16_t>({0, 1, 2}), 5123, "SCALAR", 3);
  make_sparse(file, indices, 1, bytes_of<std::uint16_t>({1}), 5123, bytes_of<std::uint16_t>({3}));
  file.add_mesh({{{"attributes", {{"POSITION", 0}}}, {"indices", indices}}});
  file.add_node({{"mesh", 0}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 1, 0), Point(0, 1, 0)));
}

TEST_F(GltfAccessor, InvalidSparseAccessors) {
  const auto with_indices = [](const std::string& indices, int component) {
    GltfWriter file = placed_triangle();
    make_sparse(file, 0, 2, indices, component, bytes_of<float>({0, 0, 5, 0, 7, 0}));
    return file;
  };
  EXPECT_THAT(error(with_indices(bytes_of<std::uint8_t>({0, 3}), 5121)),
              HasSubstr("accessors[0].sparse: index 1 is 3, but there are 3 elements"));
  EXPECT_THAT(error(with_indices(bytes_of<std::uint8_t>({2, 2}), 5121)), HasSubstr("two values for element 2"));
  EXPECT_THAT(error(with_indices(bytes_of<std::uint8_t>({0}), 5121)),
              HasSubstr("accessors[0].sparse.indices: its 2 elements do not lie within its view of 1 bytes"));
  EXPECT_THAT(error(with_indices(bytes_of<std::int16_t>({0, 1}), 5122)), HasSubstr("componentType 5121, 5123 or 5125"));
}

/// A file of a few bytes cannot ask for any number of zeros.
TEST_F(GltfAccessor, ImplicitZerosAreLimited) {
  GltfWriter file = placed_triangle();
  file.root["accessors"][0].erase("bufferView");
  file.root["accessors"][0]["count"] = 150'000'000;
  make_sparse(file, 0, 1, bytes_of<std::uint8_t>({1}), 5121, bytes_of<float>({0, 0, 5}));
  EXPECT_THAT(error(file), HasSubstr("accessors[0]: it has 150000000 elements, but no bufferView"));
}

TEST_F(GltfAccessor, ZeroStrideMeansTightlyPacked) {
  GltfWriter file = placed_triangle();
  file.root["bufferViews"][0]["byteStride"] = 0;
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)));
}

/// KHR_mesh_quantization, required or only used, and integers without it, which mean the same.
TEST_F(GltfAccessor, IntegerPositions) {
  GltfWriter file;
  file.add_accessor(bytes_of<std::int16_t>({0, 0, 7, 0, 300, 0, 7, 0, 0, -2, 7, 0}), 5122, "VEC3", 3, 8);
  file.add_mesh({{{"attributes", {{"POSITION", 0}}}}});
  file.add_node({{"mesh", 0}, {"scale", {0.5, 0.5, 0.5}}});
  const auto expected = ElementsAre(Point(0, 0, 3.5), Point(150, 0, 3.5), Point(0, -1, 3.5));
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    GltfWriter named = file;
    named.root[key] = {"KHR_mesh_quantization"};
    EXPECT_THAT(vertices(named), expected) << key;
  }
  const ImportedMesh imported = import(file);
  EXPECT_THAT(imported.mesh.vertices, expected);
  EXPECT_THAT(imported.warnings, ElementsAre(AllOf(HasSubstr("1 primitive has positions in integers without naming"),
                                                   HasSubstr("(meshes[0].primitives[0])."))));
}

}  // namespace
}  // namespace glissade::geometry
