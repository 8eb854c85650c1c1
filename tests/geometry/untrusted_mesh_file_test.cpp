// Files made to do harm: sizes that a header invents, and documents that ask for other people's files.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <glissade/geometry/mesh_import.h>

#include "mesh_import_fixture.h"

namespace glissade::geometry {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint64_t kMebi = std::uint64_t{1} << 20U;

/// The most memory that this process has had so far, in bytes.
std::uint64_t largest_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

class UntrustedMeshFile : public MeshImport {
 protected:
  /// A file that begins with `beginning` and goes on with zeros up to `size`, which take no room on the disk.
  std::filesystem::path sparse(const std::string& name, const std::string& beginning, std::uint64_t size) const {
    const std::filesystem::path file = folder_.write(name, beginning);
    std::filesystem::resize_file(file, size);
    return file;
  }
};

TEST_F(UntrustedMeshFile, LargerThanItsHeaderSaysIsNotRead) {
  const std::string ply = binary_ply(false);
  const std::uint64_t before = largest_memory();
  EXPECT_THAT(error_of(sparse("a.stl", binary_stl("x"), 256 * kMebi)),
              AllOf(HasSubstr("too long"), HasSubstr("4 triangles")));
  EXPECT_THAT(import_mesh(sparse("a.glb", tetrahedron_glb(), 256 * kMebi)).warnings,
              testing::ElementsAre(HasSubstr("bytes after the end that the header names are ignored")));
  EXPECT_THAT(error_of(sparse("a.ply", ply, 256 * kMebi)), HasSubstr("longer than its header says"));
  EXPECT_THAT(error_of(sparse("header.ply", "ply\nformat ascii 1.0\ncomment ", 256 * kMebi)),
              HasSubstr("does not end within"));
  EXPECT_LT(largest_memory() - before, 128 * kMebi);
}

TEST_F(UntrustedMeshFile, ShorterThanItsHeaderSaysIsNotRead) {
  std::string stl = binary_stl("x");
  stl.replace(80, 4, bytes_of<std::uint32_t>({0xFFFFFFFF}));
  sparse("large.bin", gltf_binary(), 256 * kMebi);
  const std::uint64_t before = largest_memory();
  EXPECT_THAT(error_of(sparse("a.stl", stl, 256 * kMebi)), AllOf(HasSubstr("truncated"), HasSubstr("4294967295")));
  std::string glb = tetrahedron_glb();
  glb.replace(8, 4, bytes_of<std::uint32_t>({0xFFFFFFFF}));
  EXPECT_THAT(error_of(sparse("a.glb", glb, 256 * kMebi)), AllOf(HasSubstr("truncated"), HasSubstr("4294967295")));
  EXPECT_THAT(error_of(sparse("a.ply", with(binary_ply(false), "face 4", "face 2000000000"), 256 * kMebi)),
              AllOf(HasSubstr("face 0 to 1999999999"), HasSubstr("truncated")));
  EXPECT_THAT(error_of("a.gltf", gltf(R"({"byteLength":9000000000,"uri":"large.bin"})")),
              AllOf(HasSubstr("buffers[0]"), HasSubstr("268435456 bytes")));
  EXPECT_LT(largest_memory() - before, 128 * kMebi);
}

TEST_F(UntrustedMeshFile, OfABufferOnlyWhatTheDocumentNamesIsRead) {
  const std::uint64_t before = largest_memory();
  sparse("large.bin", gltf_binary(), 256 * kMebi);
  const auto file = folder_.write("a.gltf", gltf(R"({"byteLength":72,"uri":"large.bin"})"));
  EXPECT_EQ(import_mesh(file).mesh.triangles.size(), 4U);
  EXPECT_LT(largest_memory() - before, 128 * kMebi);
}

TEST_F(UntrustedMeshFile, LargerThan16GiBIsNotRead) {
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.gltf", "a.glb"}) {
    EXPECT_THAT(error_of(sparse(name, "solid", 16 * 1024 * kMebi + 1)), HasSubstr("larger than 16 GiB"));
  }
  EXPECT_THAT(error_of("a.gltf", gltf(R"({"byteLength":17179869185,"uri":"tetrahedron%20data.bin"})")),
              AllOf(HasSubstr("buffers[0]"), HasSubstr("16 GiB")));
}

TEST_F(UntrustedMeshFile, GltfReadsNoFileOutsideItsFolder) {
  const std::filesystem::path inner = folder_.path() / "inner";
  std::filesystem::create_directories(inner / "deeper");
  folder_.write("secret.bin", gltf_binary());
  folder_.write("inner/deeper/data.bin", gltf_binary());
  folder_.write("inner/..data.bin", gltf_binary());
  const std::string absolute = (folder_.path() / "secret.bin").string();
  const auto with_uri = [](const std::string& uri) { return gltf(R"({"byteLength":72,"uri":")" + uri + R"("})"); };
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2E/secret.bin"), std::string("..%2fsecret.bin"),
        std::string("deeper/../../secret.bin"), std::string("./../secret.bin"), std::string("..\\\\secret.bin"),
        absolute, "%2F" + absolute.substr(1), "file:" + absolute, "file://" + absolute, std::string("FILE:secret.bin"),
        std::string("C:/secret.bin"), std::string("http://localhost/secret.bin"), std::string("//host/secret.bin"),
        std::string("deeper/data.bin%00.txt")}) {
    SCOPED_TRACE(uri);
    EXPECT_THAT(error_of("inner/a.gltf", with_uri(uri)),
                AllOf(HasSubstr("buffers[0]"), HasSubstr("only files in the folder")));
  }
  for (const char* uri : {"deeper/data.bin", "./deeper/data.bin", "deeper%2Fdata.bin", "..data.bin"}) {
    SCOPED_TRACE(uri);
    EXPECT_EQ(import_mesh(folder_.write("inner/a.gltf", with_uri(uri))).mesh.triangles.size(), 4U);
  }
}

}  // namespace
}  // namespace glissade::geometry
