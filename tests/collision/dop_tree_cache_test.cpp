/// Trees in files: what is read is what was written, and nothing that a file may hold gives a wrong answer.

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <glissade/base/byte_order.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>

#include "expect_bad_input.h"
#include "same_tree.h"
#include "sanitizers.h"
#include "temporary_folder.h"
#include "tree/content_hash.h"
#include "tree/tree_shape_code.h"
#include "tree_answers.h"

namespace glissade::collision {
namespace {

using testing::HasSubstr;

std::shared_ptr<geometry::TriangleMesh> torus_with(int triangles) {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_torus(0.1, 0.03, triangles));
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

CachedTree read_bytes(const std::string& bytes, const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  return read_tree_cache_bytes(std::as_bytes(std::span(bytes)), mesh);
}

/// A folder, a mesh, and a file with its tree.
class TreeCache : public testing::Test {
 protected:
  TreeCache() { write_tree_cache(path, tree); }

  CachedTree read() const { return read_tree_cache(path, mesh); }

  void expect_rejected(CacheState state, const std::string& reason) const {
    const CachedTree cached = read();
    EXPECT_FALSE(cached);
    EXPECT_EQ(cached.state, state);
    EXPECT_THAT(cached.reason, HasSubstr(reason));
  }

  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder.path("")), std::filesystem::directory_iterator()));
  }

  test_support::TemporaryFolder folder;
  std::string mesh_path = folder.path("torus.obj");
  std::string path = folder.path("torus.obj.dop-tree");
  std::shared_ptr<geometry::TriangleMesh> mesh = torus_with(60);
  DopTree tree{mesh};
};

TEST_F(TreeCache, ReadsTheTreeThatWasWritten) {
  for (const int k : {6, 14, 18, 24, 26}) {
    for (const std::size_t count : {1U, 4U, 5U, 17U, 3000U}) {
      SCOPED_TRACE(testing::Message() << "k " << k << ", " << count << " triangles");
      const auto some = torus_with(3000);
      some->triangles.resize(std::min(count, some->triangles.size()));
      if (count > 5) some->triangles[5] = {3, 3, 4};  // has no area
      for (const DopTreeOptions& options :
           {DopTreeOptions{.directions = k},
            DopTreeOptions{.directions = k, .thin_slab = false, .realignment = Realignment::kBruteForce}}) {
        const DopTree written(some, options);
        write_tree_cache(path, written);
        const CachedTree cached = read_tree_cache(path, some, options);
        ASSERT_TRUE(cached) << cached.reason;
        EXPECT_EQ(cached.state, CacheState::kRead);
        expect_same_tree(*cached.tree, written);
        EXPECT_EQ(&cached.tree->mesh(), some.get());
      }
    }
  }
}

TEST_F(TreeCache, ReadsATreeThatWasRefitted) {
  for (Eigen::Vector3d& vertex : mesh->vertices)
    vertex.x() *= 3.0;
  tree.refit();
  expect_rejected(CacheState::kStale, "of another mesh");
  write_tree_cache(path, tree);
  const CachedTree cached = read();
  ASSERT_TRUE(cached) << cached.reason;
  expect_same_tree(*cached.tree, tree);
}

TEST_F(TreeCache, BelongsToItsMeshItsOptionsAndItsVersion) {
  const auto expect_stale = [&](const std::shared_ptr<const geometry::TriangleMesh>& other,
                                const DopTreeOptions& options, const std::string& reason) {
    const CachedTree cached = read_tree_cache(path, other, options);
    EXPECT_EQ(cached.state, CacheState::kStale);
    EXPECT_EQ(cached.reason, reason);
  };
  expect_stale(mesh, {.directions = 18}, "of other options");
  expect_stale(mesh, {.thin_slab = false}, "of other options");
  expect_stale(mesh, {.realignment = Realignment::kBruteForce}, "of other options");

  geometry::TriangleMesh moved = *mesh;
  moved.vertices[7].y() = std::nextafter(moved.vertices[7].y(), 1.0);
  geometry::TriangleMesh turned = *mesh;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  geometry::TriangleMesh swapped = *mesh;
  std::swap(swapped.triangles[3], swapped.triangles[4]);
  geometry::TriangleMesh shorter = *mesh;
  shorter.triangles.pop_back();
  geometry::TriangleMesh longer = *mesh;
  longer.vertices.emplace_back(0.0, 0.0, 0.0);
  for (const geometry::TriangleMesh& other :
       {moved, turned, swapped, shorter, longer, geometry::TriangleMesh(*torus_with(2000))})
    expect_stale(std::make_shared<const geometry::TriangleMesh>(other), {}, "of another mesh");

  std::string bytes = content(path);
  ++bytes[8];
  folder.write("torus.obj.dop-tree", bytes);
  expect_rejected(CacheState::kStale, "of another version");
}

TEST_F(TreeCache, MissesAFileThatIsNotThere) {
  std::filesystem::remove(path);
  expect_rejected(CacheState::kMissing, "missing");
}

TEST_F(TreeCache, RejectsFilesThatAreNoCachedTree) {
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  expect_rejected(CacheState::kDamaged, "not a regular file");
  std::filesystem::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_rejected(CacheState::kDamaged, "not a regular file");
  std::filesystem::remove(path);
  folder.write("torus.obj.dop-tree", std::string(1'000'000, 'v'));
  expect_rejected(CacheState::kDamaged, "not a cached tree");
}

TEST_F(TreeCache, NoticesEveryByteThatIsMissing) {
  const std::string bytes = content(path);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const CachedTree cached = read_bytes(bytes.substr(0, size), mesh);
    ASSERT_FALSE(cached) << size << " bytes";
    EXPECT_EQ(cached.state, CacheState::kDamaged);
  }
  for (const char surplus : {'\0', 'x'})
    EXPECT_EQ(read_bytes(bytes + surplus, mesh).state, CacheState::kDamaged);
  // Also where only the beginning of the file is read at all.
  folder.write("torus.obj.dop-tree", bytes + std::string(10'000, '\0'));
  expect_rejected(CacheState::kDamaged, "the checksum is wrong");
}

TEST_F(TreeCache, NoticesEveryByteThatIsChanged) {
  std::string bytes = content(path);
  const int step = test_support::kSanitized ? 37 : 1;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const char right = bytes[at];
    for (int change = 1; change < 256; change += step) {
      bytes[at] = static_cast<char>(static_cast<unsigned char>(right) ^ change);
      ASSERT_FALSE(read_bytes(bytes, mesh)) << "byte " << at << " changed by " << change;
    }
    bytes[at] = right;
  }
  EXPECT_TRUE(read_bytes(bytes, mesh));
}

/// Files with a right checksum, by somebody who knows the format.
class ForgedTreeCache : public TreeCache {
 protected:
  /// Whether `bytes` is taken once its checksum is put right; answers must be right then.
  bool is_taken(std::string bytes) const {
    bytes.resize(bytes.size() - 8);
    base::append_number(bytes, content_hash(bytes));
    const CachedTree cached = read_bytes(bytes, mesh);
    if (cached) expect_right_answers(*cached.tree, ball, 2);
    return static_cast<bool>(cached);
  }

  const DopTree ball{std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.06, 40))};
  const std::string good = content(path);
};

TEST_F(ForgedTreeCache, IsRejectedWhateverByteIsChanged) {
  const int step = test_support::kSanitized ? 37 : 1;
  std::string bytes = good;
  for (std::size_t at = 0; at < bytes.size() - 8; ++at) {
    SCOPED_TRACE(testing::Message() << "byte " << at);
    for (int change = 1; change < 256; change += step) {
      bytes[at] = static_cast<char>(static_cast<unsigned char>(good[at]) ^ change);
      ASSERT_FALSE(is_taken(bytes)) << "changed by " << change;
    }
    bytes[at] = good[at];
  }
}

TEST_F(ForgedTreeCache, IsRejectedOrRightWhateverBytesAreSwapped) {
  constexpr unsigned kSeed = 20;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<std::size_t> anywhere(32, good.size() - 9);
  int taken = 0;
  for (int i = 0; i < std::max(400, test_support::affordable(2000)); ++i) {
    std::string bytes = good;
    std::swap(bytes[anywhere(random)], bytes[anywhere(random)]);
    if (bytes != good && is_taken(bytes)) ++taken;
  }
  EXPECT_GT(taken, 0);  // triangles that changed places
}

using Bytes = std::vector<std::uint8_t>;

/// The code of a shape, written out.
std::string shape_code(const Bytes& nodes, const Bytes& leaves, const std::vector<std::uint32_t>& triangles) {
  std::string code;
  base::append_number(code, static_cast<std::uint32_t>(nodes.size()));
  base::append_number(code, static_cast<std::uint32_t>(leaves.size()));
  code.append(nodes.begin(), nodes.end());
  code.append(leaves.begin(), leaves.end());
  for (const std::uint32_t triangle : triangles)
    base::append_number(code, triangle);
  return code;
}

TEST(TreeShapeCode, DecodesOneTreeOfAllTriangles) {
  // A root of a node and a leaf, the node of three leaves.
  const TreeShape shape = decode_shape(shape_code({0x11, 0x03}, {1, 1, 2, 1}, {4, 2, 0, 3, 1}), 5);
  EXPECT_EQ(shape.depth, 1);
  ASSERT_EQ(shape.nodes.size(), 2U);
  EXPECT_EQ(shape.nodes[0].first_node, 1U);
  EXPECT_EQ(shape.nodes[0].first_leaf, 0U);
  EXPECT_EQ(shape.nodes[1].first_leaf, 1U);
  EXPECT_EQ(shape.leaves[2].triangle, (std::array<std::int32_t, 4>{0, 3, kNoTriangle, kNoTriangle}));
}

TEST(TreeShapeCode, RefusesInvalidCodes) {
  const auto expect_refused = [](const std::string& code, const std::string& reason, std::size_t triangles = 5) {
    test_support::expect_bad_input([&] { decode_shape(code, triangles); }, {reason});
  };
  const std::vector<std::uint32_t> all{0, 1, 2, 3, 4};
  const Bytes nodes{0x11, 0x03};
  const Bytes leaves{1, 1, 2, 1};
  expect_refused("", "truncated");
  expect_refused(shape_code(nodes, leaves, {0, 1, 2, 3}), "length");
  expect_refused(shape_code({}, leaves, all), "too many");
  expect_refused(shape_code({}, {}, {}), "too many", 0);
  expect_refused(shape_code({0x11, 0x03, 0, 0, 0, 0}, leaves, all), "too many");
  expect_refused(shape_code(nodes, {1, 1, 1, 1, 1, 1}, all), "too many");
  expect_refused(shape_code({0x11, 0x02}, leaves, all), "belong to no node");
  expect_refused(shape_code({0x04, 0x03}, leaves, all), "belong to no node");
  expect_refused(shape_code({0x12, 0x03}, leaves, all), "more children than parts");
  expect_refused(shape_code({0x11, 0x12}, leaves, all), "more children than parts");
  expect_refused(shape_code({0x11, 0x05}, leaves, all), "number of children");
  expect_refused(shape_code({0x11, 0x01}, {1, 4}, all), "number of children");
  expect_refused(shape_code({0x10, 0x04}, leaves, all), "number of children");
  expect_refused(shape_code({0x00}, {}, all), "number of children");
  expect_refused(shape_code(nodes, {1, 1, 3, 0}, all), "number of triangles");
  expect_refused(shape_code({0x02}, {0, 5}, all), "number of triangles");
  expect_refused(shape_code(nodes, {1, 1, 2, 2}, all), "number of triangles");
  expect_refused(shape_code(nodes, {1, 1, 1, 1}, all), "number of triangles");
  expect_refused(shape_code(nodes, leaves, {0, 1, 2, 3, 3}), "each one once");
  expect_refused(shape_code(nodes, leaves, {0, 1, 2, 3, 5}), "each one once");
  expect_refused(shape_code(nodes, leaves, {0, 1, 2, 3, 0xffffffff}), "each one once");
}

TEST(TreeShapeCode, RefusesATreeTooDeepToWalk) {
  // A leaf beside a node beside a leaf ...
  const auto chain = [](std::size_t nodes) {
    Bytes codes(nodes, 0x11);
    codes.back() = 0x02;
    std::vector<std::uint32_t> triangles(nodes + 1);
    std::iota(triangles.begin(), triangles.end(), 0U);
    return shape_code(codes, Bytes(nodes + 1, 1), triangles);
  };
  EXPECT_EQ(decode_shape(chain(200), 201).depth, 199);
  test_support::expect_bad_input([&] { decode_shape(chain(100'000), 100'001); }, {"too deep"});
}

TEST_F(TreeCache, ReplacesAFileAndLeavesNoOther) {
  folder.write("torus.obj.dop-tree", "what was there");
  write_tree_cache(path, tree);
  EXPECT_TRUE(read());
  EXPECT_EQ(files_in_folder(), 1U);
}

void expect_not_written(const std::string& path, const DopTree& tree) {
  try {
    write_tree_cache(path, tree);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(path + ": "));
  }
}

TEST_F(TreeCache, NamesTheFileThatCannotBeWritten) {
  expect_not_written(folder.path("none/torus.obj.dop-tree"), tree);
  std::filesystem::create_directories(folder.path("occupied/by a folder"));
  expect_not_written(folder.path("occupied"), tree);
  EXPECT_EQ(files_in_folder(), 2U);
}

TEST_F(TreeCache, AFullDiskLeavesTheOldFileAndNoOther) {
  const std::string before = content(path);
  rlimit unlimited{};
  getrlimit(RLIMIT_FSIZE, &unlimited);
  const rlimit limited{before.size() / 2, unlimited.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limited);
  EXPECT_THROW(write_tree_cache(path, tree), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(content(path), before);
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(TreeCache, LoadsOrBuilds) {
  std::filesystem::remove(path);
  const LoadedTree first = load_or_build_tree(mesh_path, mesh);
  expect_same_tree(first.tree, tree);
  EXPECT_EQ(first.note, "");
  EXPECT_TRUE(read());

  const auto written = std::filesystem::last_write_time(path);
  const LoadedTree second = load_or_build_tree(mesh_path, mesh);
  expect_same_tree(second.tree, tree);
  EXPECT_EQ(second.note, "");
  EXPECT_EQ(std::filesystem::last_write_time(path), written);

  folder.write("torus.obj.dop-tree", "DOP-tree");
  const LoadedTree third = load_or_build_tree(mesh_path, mesh);
  expect_same_tree(third.tree, tree);
  EXPECT_EQ(third.note, path + ": truncated; built anew");
  EXPECT_TRUE(read());
}

TEST_F(TreeCache, BuildsWhereNothingCanBeKept) {
  const std::string nowhere = folder.path("none/torus.obj");
  const LoadedTree loaded = load_or_build_tree(nowhere, mesh);
  expect_same_tree(loaded.tree, tree);
  EXPECT_THAT(loaded.note, testing::StartsWith("the tree cannot be saved: " + nowhere + ".dop-tree: "));
}

TEST_F(TreeCache, RefusesMeshesAsTheTreeDoes) {
  const auto nan = std::make_shared<geometry::TriangleMesh>(*mesh);
  nan->vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  test_support::expect_bad_input([&] { load_or_build_tree(mesh_path, nan); }, {"vertex 3"});
  const auto wild = std::make_shared<geometry::TriangleMesh>(*mesh);
  wild->triangles[3][1] = 1'000'000;
  test_support::expect_bad_input([&] { load_or_build_tree(mesh_path, wild); }, {"triangle 3"});
}

// Vertices of whole numbers, so that every machine builds the same.
TEST(TreeCacheVersion, BuiltTreeIsUnchangedInThisVersion) {
  std::mt19937 random(7);
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < 900; ++i) {
    const auto x = static_cast<double>(random() % 1000);
    const auto y = static_cast<double>(random() % 1000);
    mesh->vertices.emplace_back(x, y, static_cast<double>(random() % 100));
  }
  for (std::int32_t t = 0; t < 300; ++t)
    mesh->triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  std::string code;
  append_shape_code(DopTree(mesh), code);
  EXPECT_EQ(content_hash(code), 3482254864118375482U)
      << "raise kVersion in dop_tree_cache.cpp, then change this number";
}

}  // namespace
}  // namespace glissade::collision
