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
#include "sanitizers.h"

namespace glissade::geometry {
namespace {

struct BadFile {
  std::string name;
  std::string content;
  std::string place;   // what the message must name
  std::string reason;  // and what must be wrong
};

class BadMeshFile : public MeshImport {
 protected:
  static bool has_error_or_warning(const std::filesystem::path& file) {
    try {
      return !import_mesh(file).warnings.empty();
    } catch (const std::invalid_argument&) {
      return true;
    }
  }

  void expect_errors(const std::vector<BadFile>& files) const {
    for (const BadFile& file : files) {
      SCOPED_TRACE(file.name + ": " + file.place + ", " + file.reason);
      EXPECT_THAT(error_of(file.name, file.content),
                  testing::AllOf(testing::HasSubstr(file.place), testing::HasSubstr(file.reason)));
    }
  }
};

TEST_F(BadMeshFile, Obj) {
  expect_errors({
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "", "no faces"},
      {"a.obj", with(kObj, "v 1 0 0", "v 1 nan 0"), "line 3", "not finite"},
      {"a.obj", with(kObj, "v 1 0 0", "v 1 0 -inf"), "line 3", "not finite"},
      {"a.obj", with(kObj, "v 1 0 0", "v 1 1e400 0"), "line 3", "not finite"},
      {"a.obj", with(kObj, "v 1 0 0", "v 1 0 2e9"), "line 3", "beyond 1e9"},
      {"a.obj", with(kObj, "v 1 0 0", "v 1 0"), "line 3", "3 coordinates"},
      {"a.obj", with(kObj, "v 1 0 0", "v 1 0 O"), "line 3", "'O' is not a number"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 5"), "line 7", "vertex 5"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 0"), "line 7", "index 0"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 -5"), "line 7", "-5"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 99999999999999"), "line 7", "99999999999999"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 99999999999999999999999"), "line 7", "99999999999999999999999"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 4/x"), "line 7", "'4/x'"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 4/1/1/1"), "line 7", "4/1/1/1"},
      {"a.obj", with(kObj, "f 1 2 4", "f 1 2 \\"), "line 7", "'f'"},
      {"a.obj", kObj + "f 1 2 \\", "line 10", "ends where the line should go on"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 1\n", "", "has an area"},
      {"a.obj", "f 1 1 1\n", "line 1", "vertex 1, but the file has 0"},
      {"a.obj", "v 0 0 0\nf 1\n", "", "no faces of 3 corners"},
      {"a.obj", with(kObj, "v 1 0 0", "w 1 0 0"), "line 7", "vertex 4, but the file has 3"},
  });
}

/// To skip them would lose surface.
TEST_F(BadMeshFile, ObjSurfacesThatAreNotPolygons) {
  for (const char* statement : {"surf", "bsp", "bzp", "cdp", "call"}) {
    expect_errors(
        {{"a.obj", kObj + statement + " 0 1 2 3 4\n", "line 10", "'" + std::string(statement) + "' is not supported"}});
  }
}

TEST_F(BadMeshFile, Ply) {
  const std::string header = kAsciiPly.substr(0, kAsciiPly.find("0 0 0"));
  expect_errors({
      {"a.ply", header, "vertex 0", "truncated"},
      {"a.ply", header.substr(0, header.size() - 1), "vertex 0", "truncated"},
      {"a.ply", header.substr(0, header.size() - 12), "line 9", "end_header"},
      {"a.ply", with(kAsciiPly, "3 1 2 3\n", ""), "face 3", "truncated"},
      {"a.ply", with(kAsciiPly, "3 1 2 3\n", "3 1 2\n"), "face 3", "truncated"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 2 4"), "face 3", "index 4 is out of range"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 2 -1"), "face 3", "index -1 is out of range"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 2 0.5"), "face 3", "out of range"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 2 nan"), "face 3", "out of range"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "-3 1 2 3"), "face 3", "entries"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "1e300 1 2 3"), "face 3", "entries"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 2 x"), "line 18, face 3", "not a number"},
      {"a.ply", kAsciiPly + "3 0 1 2\n", "", "longer than its header says"},
      {"a.ply", with(kAsciiPly, "\n1 0 0", "\n1 nan 0"), "vertex 1", "not finite"},
      {"a.ply", with(kAsciiPly, "\n1 0 0", "\n1 0 1e10"), "vertex 1", "beyond 1e9"},
      {"a.ply", with(kAsciiPly, "ascii", "binary_little_endian"), "face 0", "out of range"},
      {"a.ply", with(kAsciiPly, "ascii 1.0", "ascii 2.0"), "line 2", "format"},
      {"a.ply", with(kAsciiPly, "ascii", "morse"), "line 2", "format"},
      {"a.ply", with(kAsciiPly, "format ascii 1.0\n", ""), "line", "names no format"},
      {"a.ply", with(kAsciiPly, "element face", "element vertex 0\nelement face"), "line 8", "named before"},
      {"a.ply", with(kAsciiPly, "vertex 4", "vertex -4"), "line 4", "count"},
      {"a.ply", with(kAsciiPly, "vertex 4", "vertex 99999999999999999999"), "line 4", "count"},
      {"a.ply", with(kAsciiPly, "vertex 4", "vertex 2000000000"), "vertex 9", "truncated"},
      {"a.ply", with(kAsciiPly, "property float y", "property quad y"), "line 6", "type"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3.5 1 2 3"), "face 3", "entries"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 nan 3"), "face 3", "index nan is out of range"},
      {"a.ply", with(kAsciiPly, "3 1 2 3", "3 1 1e300 3"), "face 3", "index 1e+300 is"},
      {"a.ply", with(kAsciiPly, "property float z\n", ""), "header", "x, y and z"},
      {"a.ply", with(kAsciiPly, "property float z\n", "property float x\n"), "header", "x, y and z"},
      {"a.ply", with(kAsciiPly, "vertex_indices", "corners"), "header", "vertex_indices"},
      {"a.ply", with(kAsciiPly, "comment", "remark"), "line 3", "header line"},
      {"a.ply", with(kAsciiPly, "element face 4", "element face 0").substr(0, kAsciiPly.find("3 0 2 1")), "",
       "no faces"},
  });
}

TEST_F(BadMeshFile, Stl) {
  std::string none = binary_stl("x").substr(0, 84);
  none[80] = 0;
  std::string infinite = binary_stl("x");
  infinite.replace(84 + 50 + 12, 4, bytes_of<float>({INFINITY}));
  std::string far = binary_stl("x");
  far.replace(84 + 100 + 12, 4, bytes_of<float>({-3e9F}));
  expect_errors({
      {"a.stl", none, "", "no triangles"},
      {"a.stl", "solid nothing\nendsolid nothing\n", "", "no triangles"},
      {"a.stl", infinite, "triangle 1", "not finite"},
      {"a.stl", far, "triangle 2", "beyond 1e9"},
      {"a.stl", binary_stl("x").substr(0, 200), "as a binary STL it is truncated", "4 triangles, which take 284 bytes"},
      {"a.stl", binary_stl("solid").substr(0, 200), "it has 200 bytes, enough for 2", "truncated"},
      {"a.stl", binary_stl("x") + std::string(50, 'x'), "too long", "334 bytes, enough for 5"},
      {"a.stl", std::string(10, '\0'), "10 bytes", "truncated"},
      {"a.stl", "short", "", "no triangles"},
      {"a.stl", with(kAsciiStl, "1.00", "x"), "line", "not a number"},
      {"a.stl", with(kAsciiStl, "1.00", "nan"), "line 25", "not finite"},
      {"a.stl", with(kAsciiStl, "1.00", "1e12"), "line 25", "beyond 1e9"},
      {"a.stl", with(kAsciiStl, "vertex 1.00 0 0", "vertex 1.00 0"), "line 26", "not a number"},
      {"a.stl", with(kAsciiStl, "\n  endfacet\nendsolid a name with words\n", ""), "line 28", "truncated"},
      {"a.stl", with(kAsciiStl, "outer loop", "outer"), "line 4", "'outer loop' should stand here"},
      {"a.stl", with(kAsciiStl, "facet", "faset"), "line 3", "'outer' stands outside of a facet"},
      {"a.stl", with(kAsciiStl, "endloop", "vertex 1 1 1\nendloop"), "line 7", "endloop"},
      {"a.stl", "solid\n" + ascii_stl_facet("0 0 0", "1 1 1", "2 2 2") + "endsolid\n", "", "has an area"},
  });
}

/// The good file, with another text in one place of its JSON.
std::string altered_gltf(std::string_view from, std::string_view to) {
  return glb(with(gltf(R"({"byteLength":72})"), from, to), gltf_binary());
}

TEST_F(BadMeshFile, GltfContainersAndBuffers) {
  const std::string good = gltf(R"({"byteLength":72})");
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  std::string out_of_range = gltf_binary();
  out_of_range.replace(48, 2, bytes_of<std::uint16_t>({4}));
  std::string not_finite = gltf_binary();
  not_finite.replace(12, 4, bytes_of<float>({NAN}));
  expect_errors({
      {"a.gltf", "{", "byte", "JSON"},
      {"a.gltf", "[]", "", "wrong kind"},
      {"a.gltf", std::string(100'000, '['), "", "nested more than 100 deep"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":)" + deep), "", "nested more than 100 deep"},
      {"a.gltf", good, "buffers[0]", "should have 72"},
      {"a.gltf", gltf(R"({"byteLength":72,"uri":"missing.bin"})"), "buffers[0]", "missing.bin"},
      {"a.gltf", gltf(R"({"byteLength":72,"uri":"https://example.org/a.bin"})"), "buffers[0]", "only files"},
      {"a.gltf", gltf(R"({"byteLength":72,"uri":"data:;base64,AAAA"})"), "buffers[0]", "3 bytes"},
      {"a.gltf", gltf(R"({"byteLength":72,"uri":"data:;base64,A*AA"})"), "buffers[0]", "base64"},
      {"a.gltf", gltf(R"({"byteLength":72,"uri":"data:text/plain,A"})"), "buffers[0]", "1 bytes"},
      {"a.glb", glb(good, out_of_range), "meshes[0].primitives[0]", "index 0 is 4"},
      {"a.glb", glb(good, not_finite), "position 1", "not finite"},
      {"a.glb", glb(good, gltf_binary().substr(0, 60)), "buffers[0]", "60 bytes"},
      {"a.gltf", gltf(R"({"byteLength":7e99})"), "buffers[0].byteLength", "wrong kind"},
      {"a.gltf", gltf(R"({"byteLength":72,"uri":"two\nlines\t.bin"})"), "buffers[0]", "two?lines?.bin"},
      {"a.glb", tetrahedron_glb().substr(0, 15), "", "header"},
      {"a.glb", with(tetrahedron_glb(), std::string("glTF\2", 5), std::string("glTF\1", 5)), "version", "2"},
  });
}

TEST_F(BadMeshFile, GltfAccessorsAndPrimitives) {
  expect_errors({
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":[1])"), "accessors[array]", "out of range"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":15)"), "accessors[1]", "do not lie within"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":11)"), "primitives[0]", "do not make up triangles"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":0)"), "no triangles", "1 primitive without corners"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":18446744073709551615)"), "accessors[1]", "do not lie within"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":"many")"), "", "wrong kind"},
      {"a.glb", altered_gltf(R"("byteOffset":48)", R"("byteOffset":18446744073709551600)"), "bufferViews[1]", "beyond"},
      {"a.glb", altered_gltf(R"("byteLength":48)", R"("byteLength":48,"byteStride":4)"), "accessors[0]", "byteStride"},
      {"a.glb", altered_gltf(R"("bufferView":1)", R"("bufferView":2)"), "bufferViews[2]", "out of range"},
      {"a.glb", altered_gltf(R"("buffer":0)", R"("buffer":1)"), "buffers[1]", "out of range"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":7)"), "accessors[7]", "out of range"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":-1)"), "accessors[-1]", "out of range"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":0)"), "primitives[0]", "componentType"},
      {"a.glb", altered_gltf(R"("POSITION":0)", R"("POSITION":1)"), "accessors[1]", "VEC3"},
      {"a.glb", altered_gltf(R"("POSITION":0)", R"("NORMAL":0)"), "", "POSITION"},
      {"a.glb", altered_gltf(R"("VEC3")", R"("VEC2")"), "accessors[0]", "VEC3"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":1,"mode":1)"), "", "no triangles"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":1,"mode":9)"), "primitives[0]", "mode 9"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":12.0)"), "accessors[1].count", "12.0 is not a whole number"},
      {"a.glb", altered_gltf(R"("count":12)", R"("count":true)"), "accessors[1].count", "wrong kind"},
      {"a.glb", altered_gltf(R"("componentType":5123)", R"("componentType":5123e99)"), "accessors[1].componentType",
       "wrong kind"},
      {"a.glb", altered_gltf(R"("byteLength":48)", R"("byteLength":48,"byteStride":-1)"), "bufferViews[0].byteStride",
       "-1"},
      {"a.glb", altered_gltf(R"("byteOffset":48)", R"("byteOffset":-1)"), "bufferViews[1].byteOffset", "-1"},
      {"a.glb", altered_gltf(R"("indices":1)", R"("indices":1,"mode":4.5)"), "primitives[0].mode", "4.5"},
  });
}

TEST_F(BadMeshFile, GltfAssetAndScenes) {
  expect_errors({
      {"a.glb", altered_gltf(R"({"mesh":0})", R"({"mesh":3})"), "meshes[3]", "out of range"},
      {"a.glb", altered_gltf(R"({"mesh":0})", R"({"mesh":0,"children":[0]})"), "nodes[0]", "twice"},
      {"a.glb", altered_gltf(R"("children":[1])", R"("children":[5])"), "nodes[5]", "out of range"},
      {"a.glb", altered_gltf(R"([0,0,0]},)", R"([0,0]},)"), "nodes[0].translation", "3 numbers"},
      {"a.glb", altered_gltf(R"([0,0,0]},)", R"([0,0,1e300]},)"), "nodes[0].translation", "beyond"},
      {"a.glb", altered_gltf(R"("scene":0)", R"("scene":1)"), "scenes[1]", "out of range"},
      {"a.glb", altered_gltf(R"([{"nodes":[0]}])", R"([{}])"), "", "no triangles"},
      {"a.glb", altered_gltf(R"("version":"2.0")", R"("version":"1.0")"), "version", "2"},
      {"a.glb", altered_gltf(R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"],"scene":0)"), "",
       "KHR_draco_mesh_compression"},
      {"a.glb", altered_gltf(R"([0,0,0]},)", R"([0,0,1e999]},)"), "", "beyond every double"},
      {"a.glb", altered_gltf(R"([0,0,0]},)", R"([0,0,true]},)"), "nodes[0].translation", "array of numbers"},
  });
}

TEST_F(BadMeshFile, GltfNodes) {
  const auto with_node = [](const std::string& entries) {
    return glb(with(gltf(R"({"byteLength":72})"), R"({"mesh":0})", R"({"mesh":0,)" + entries + "}"), gltf_binary());
  };
  const std::string identity = R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1])";
  expect_errors({
      {"a.glb", with_node(R"("rotation":[0,0,0,0])"), "nodes[1].rotation", "[0.0,0.0,0.0,0.0]"},
      {"a.glb", with_node(R"("rotation":[0,0,0,1.002])"), "nodes[1].rotation", "length 1.002"},
      {"a.glb", with_node(identity + R"(,"translation":[0,0,0])"), "nodes[1]", "both a matrix and a translation"},
      {"a.glb", with_node(identity + R"(,"rotation":[0,0,0,1])"), "nodes[1]", "both a matrix and a rotation"},
      {"a.glb", with_node(identity + R"(,"scale":[1,1,1])"), "nodes[1]", "both a matrix and a scale"},
      {"a.glb", with_node(with(identity, "0,1]", "0,2]")), "nodes[1].matrix", "last row is [0.0,0.0,0.0,2.0]"},
      {"a.glb", with_node(with(identity, "[1,0,0,0", "[1,0,0,0.5")), "nodes[1].matrix", "last row is [0.5,"},
  });
}

/// A few bytes may place the same triangles again and again: 9000 nodes of 1500 times the tetrahedron.
TEST_F(BadMeshFile, GltfWithTooManyPlacedPoints) {
  if (test_support::kSanitized) GTEST_SKIP() << "places 50 million points before it stops: a minute for a sanitizer";
  const std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string primitives;
  for (int i = 0; i < 1500; ++i) {
    primitives += primitive + ",";
  }
  std::string nodes;
  std::string children;
  for (int i = 0; i < 9000; ++i) {
    nodes += R"(,{"mesh":0})";
    children += "," + std::to_string(i + 2);
  }
  std::string text = gltf(R"({"byteLength":72})");
  text = with(text, R"("primitives":[)", R"("primitives":[)" + primitives);
  text = with(text, R"("children":[1)", R"("children":[1)" + children);
  text = with(text, R"({"mesh":0})", R"({"mesh":0})" + nodes);
  EXPECT_THAT(error_of("a.glb", glb(text, gltf_binary())),
              testing::AllOf(testing::HasSubstr("nodes[8"), testing::HasSubstr("more than 200000000 points")));
}

TEST_F(BadMeshFile, WordsOfAnyLengthMakeShortMessages) {
  const std::string name(50'000, 'x');
  EXPECT_LT(error_of("a.ply", with(kAsciiPly, "vertex 4", name + " 4")).size(), 2000U);
}

/// Files that end too early are the weak spot of importers. Beginnings of every 11th length are tried,
/// which falls on all parts of their numbers, and the last one.
TEST_F(BadMeshFile, EveryTruncationIsNoticed) {
  for (const auto& [name, content] : Files{{"ascii.ply", kAsciiPly},
                                           {"little.ply", binary_ply(false)},
                                           {"big.ply", binary_ply(true)},
                                           {"ascii.stl", kAsciiStl.substr(0, kAsciiStl.rfind(" a name"))},
                                           {"binary.stl", binary_stl("solid")},
                                           {"a.glb", tetrahedron_glb()},
                                           {"a.gltf", gltf(R"({"byteLength":72,"uri":"tetrahedron%20data.bin"})")}}) {
    const std::size_t end = content.back() == '\n' ? content.size() - 2 : content.size() - 1;
    for (std::size_t size = end % 11; size <= end; size += 11) {
      SCOPED_TRACE(name + " cut to " + std::to_string(size) + " bytes");
      EXPECT_TRUE(has_error_or_warning(folder_.write(name, content.substr(0, size))));
    }
  }
}

/// Whatever the damage: a mesh or an error that names the file, but no crash and no mesh out of bounds.
TEST_F(BadMeshFile, RandomDamageNeverCrashes) {
  constexpr std::uint64_t kSeed = 20;
  std::mt19937_64 generator(kSeed);
  for (const auto& [name, content] : tetrahedra()) {
    for (int attempt = 0; attempt < 20; ++attempt) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", " + name + ", attempt " + std::to_string(attempt));
      std::string damaged = content;
      for (int hits = 0; hits < 1 + attempt % 4; ++hits) {
        damaged[generator() % damaged.size()] = static_cast<char>(generator());
      }
      const std::filesystem::path file = folder_.write(name, damaged);
      try {
        const ImportedMesh imported = import_mesh(file);
        EXPECT_GT(imported.mesh.triangles.size(), 0U);
        EXPECT_TRUE((report(imported.mesh).bounds.sizes().array() <= 2e9).all());
      } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(file.string()));
      }
    }
  }
}

}  // namespace
}  // namespace glissade::geometry
