// Containers and buffers of glTF, as programs write them.

#include <string>

#include "gltf_import_fixture.h"

namespace glissade::geometry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfFile : public GltfImport {
 protected:
  void expect_tetrahedron(const std::string& name, const std::string& content) const {
    SCOPED_TRACE(name);
    const ImportedMesh imported = import_mesh(folder_.write(name, content));
    EXPECT_EQ(imported.mesh.triangles.size(), 4U);
    EXPECT_THAT(imported.warnings, IsEmpty());
  }
  static std::string with_uri(const std::string& uri) { return gltf(R"({"byteLength":72,"uri":")" + uri + R"("})"); }
};

TEST_F(GltfFile, DataUris) {
  const std::string text = base64(gltf_binary());
  std::string lines = text;
  lines.insert(40, "\\r\\n");
  std::string percent;
  for (const char c : gltf_binary()) {
    const std::string digits = "0123456789aBCDef";
    const auto byte = static_cast<unsigned char>(c);
    percent += std::string("%") + digits[byte / 16] + digits[byte % 16];
  }
  expect_tetrahedron("octets.gltf", with_uri("data:application/octet-stream;base64," + text));
  expect_tetrahedron("buffer.gltf", with_uri("data:application/gltf-buffer;base64," + text));
  expect_tetrahedron("without_type.gltf", with_uri("data:;base64," + text));
  expect_tetrahedron("lines.gltf", with_uri("data:;base64," + lines));
  expect_tetrahedron("percent.gltf", with_uri("data:application/octet-stream," + percent));
  EXPECT_THAT(error_of("a.gltf", with_uri("data:;base64")), HasSubstr("its data URI has no comma"));
}

/// Names should be percent-encoded; some programs write them as they are.
TEST_F(GltfFile, NamesOfBuffers) {
  folder_.write("50% of ä.bin", gltf_binary());
  folder_.write("raw%20name.bin", gltf_binary());
  expect_tetrahedron("encoded.gltf", with_uri("50%25%20of%20%C3%A4.bin"));
  expect_tetrahedron("partly.gltf", with_uri("50% of ä.bin"));
  expect_tetrahedron("raw.gltf", with_uri("raw%20name.bin"));
}

/// A buffer that only images use may be missing, but none that triangles use.
TEST_F(GltfFile, BuffersThatNothingNeeds) {
  expect_tetrahedron("a.gltf", gltf(R"({"byteLength":72,"uri":"tetrahedron data.bin"},)"
                                    R"({"byteLength":9,"uri":"missing.bin"},{"byteLength":9})"));
}

TEST_F(GltfFile, TheContainerIsKnownByItsContent) {
  expect_tetrahedron("json.glb", with_uri("tetrahedron data.bin"));
  expect_tetrahedron("container.gltf", tetrahedron_glb());
}

TEST_F(GltfFile, DialectsOfContainers) {
  // The JSON padded by zeros instead of spaces.
  std::string text = gltf(R"({"byteLength":72})");
  text.append(4 - text.size() % 4, '\0');
  expect_tetrahedron("zeros.glb", glb(text, gltf_binary()));
  // A chunk of another kind.
  std::string extra = tetrahedron_glb() + bytes_of<std::uint32_t>({4}) + "ABCDefgh";
  extra.replace(8, 4, bytes_of<std::uint32_t>({static_cast<std::uint32_t>(extra.size())}));
  expect_tetrahedron("other_chunk.glb", extra);
  // Padding that is in no chunk.
  std::string padded = tetrahedron_glb() + std::string(2, '\0');
  padded.replace(8, 4, bytes_of<std::uint32_t>({static_cast<std::uint32_t>(padded.size())}));
  expect_tetrahedron("padded.glb", padded);
}

TEST_F(GltfFile, BytesAfterTheContainerAreToldOf) {
  const std::string file = tetrahedron_glb();
  const ImportedMesh imported = import_mesh(folder_.write("a.glb", file + "tail"));
  EXPECT_EQ(imported.mesh.triangles.size(), 4U);
  EXPECT_THAT(imported.warnings,
              ElementsAre("4 bytes after the end that the header names are ignored (the first: byte " +
                          std::to_string(file.size()) + ")."));
}

}  // namespace
}  // namespace glissade::geometry
