// Hundreds of files as exporters write them: each is read whole, and no other reader finds more in it without a
// warning.

#include <cstdint>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/mesh_topology.h>

#include "assimp_oracle.h"
#include "dialect_files.h"
#include "mesh_import_fixture.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::geometry {
namespace {

/// Not under a sanitizer: it reports memory errors in assimp itself for some of these files, and ends the test.
std::int64_t triangles_by_another(const std::filesystem::path& file) {
  return test_support::kSanitized ? 0 : test_support::triangles_by_assimp(file.string());
}

TEST_F(MeshImport, FilesInManyDialectsAreReadWhole) {
  const TriangleMesh mesh = make_sphere(0.5, 60);
  const MeshReport whole = report(mesh);
  int read_by_another = 0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    const DialectFile dialect = dialect_file(mesh, number);
    SCOPED_TRACE("file " + std::to_string(number) + "\n" + (dialect.is_text ? dialect.content.substr(0, 1500) : ""));
    const std::filesystem::path file = folder_.write(dialect.name, dialect.content);
    ASSERT_NO_THROW(import_mesh(file));
    const ImportedMesh imported = import_mesh(file);
    const MeshReport r = report(imported.mesh);
    EXPECT_EQ(r.triangles, whole.triangles);
    EXPECT_TRUE(r.is_watertight);
    EXPECT_EQ(r.inconsistent_edges, 0);
    EXPECT_NEAR(r.area, whole.area, 1e-6);
    EXPECT_EQ(!imported.warnings.empty(), dialect.has_warning);
    const std::int64_t others = triangles_by_another(file);
    if (imported.warnings.empty()) {
      EXPECT_GE(r.triangles + imported.degenerate_triangles, others);
    }
    if (others == r.triangles) ++read_by_another;
  }
  if (!test_support::kSanitized) {
    EXPECT_GT(read_by_another, 200) << "the comparison is of many files";
  }
}

/// A line of a text is lost, doubled or cut.
std::string damaged(const std::string& text, std::uint64_t seed) {
  test_support::RandomNumbers random(seed);
  const std::size_t at = text.find_first_of("\r\n", static_cast<std::size_t>(random.integer(0, 10'000)) % text.size());
  if (at == std::string::npos) return text;
  const std::size_t end = std::min(text.find_first_of("\r\n", at + 1), text.size());
  const std::string line = text.substr(at, end - at);
  const int damage = random.integer(0, 2);
  return text.substr(0, at) +
         (damage == 0   ? ""
          : damage == 1 ? line + line
                        : line.substr(0, line.size() / 2)) +
         text.substr(end);
}

TEST_F(MeshImport, FindsNoFewerTrianglesThanAssimpInDamagedFiles) {
  const TriangleMesh mesh = make_sphere(0.5, 60);
  int read = 0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    const DialectFile dialect = dialect_file(mesh, number);
    if (!dialect.is_text || dialect.name == "a.ply") continue;  // damaged PLY files crash assimp
    const std::string content = damaged(dialect.content, number);
    SCOPED_TRACE("file " + std::to_string(number) + "\n" + content.substr(0, 1500));
    const std::filesystem::path file = folder_.write(dialect.name, content);
    try {
      const ImportedMesh imported = import_mesh(file);
      if (!imported.warnings.empty()) continue;
      ++read;
      EXPECT_GE(std::ssize(imported.mesh.triangles) + imported.degenerate_triangles, triangles_by_another(file));
    } catch (const std::invalid_argument&) {
    }
  }
  EXPECT_GT(read, 30);
}

}  // namespace
}  // namespace glissade::geometry
