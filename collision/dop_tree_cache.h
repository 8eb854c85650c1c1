#pragma once

/// Cache files of DOP-trees next to mesh files. With a cache file, a program does not rebuild the tree of a large mesh
/// in every run.
///
/// A file holds only the shape of a tree, i.e. which triangles share a leaf, and which leaves and nodes share a parent.
/// `read_tree_cache` checks that the shape is one tree of all triangles, and fits the bounding volumes to the given
/// mesh. So a damaged or forged file is either rejected or gives a tree with correct answers. With 100,000 triangles,
/// building a tree takes 102 ms of processor time, and reading the tree from a file takes 31 ms. The file takes 4.4
/// bytes a triangle.
///
/// A file is valid only for the same vertices and triangles, the same options, and the same version of the format. The
/// version of the format also changes when the algorithm that builds trees changes. The byte order is the same on every
/// machine. The last eight bytes are a checksum of all other bytes. The checksum detects every change of a single byte,
/// and all but one in 2^64 of the other changes.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::collision {

enum class CacheState {
  kRead,
  kMissing,  ///< the file does not exist
  kStale,    ///< the file belongs to another mesh, other options or another version
  kDamaged,  ///< the file is truncated, altered, unreadable, or not a cache file
};

/// Result of reading a file.
struct CachedTree {
  CacheState state;
  std::string reason;           ///< why the file was not read, in a few words
  std::optional<DopTree> tree;  ///< empty if the file was not read

  explicit operator bool() const { return tree.has_value(); }
};

/// The cache file of a mesh file: the name of the mesh file followed by ".dop-tree".
std::filesystem::path tree_cache_path(const std::filesystem::path& mesh_path);

/// Writes or replaces the file. The file has another name until it is complete. A file that cannot be completed is
/// deleted. So `path` never names an incomplete file. Replaces regular files only, and not, for example, symbolic
/// links. Throws std::runtime_error with one line that names the file and the reason. May block on the disk.
void write_tree_cache(const std::filesystem::path& path, const DopTree& tree);

/// Reads the tree that DopTree(mesh, options) would build. An unusable file is not an error, see `CachedTree::state`.
/// Throws for the same meshes and options as the constructor of DopTree. Cost O(n log n). May block on the disk.
CachedTree read_tree_cache(const std::filesystem::path& path, std::shared_ptr<const geometry::TriangleMesh> mesh,
                           const DopTreeOptions& options = {});

/// Like `read_tree_cache`, but takes the bytes of a file instead of its path.
CachedTree read_tree_cache_bytes(std::span<const std::byte> bytes, std::shared_ptr<const geometry::TriangleMesh> mesh,
                                 const DopTreeOptions& options = {});

/// A tree, and a note about its cache file.
struct LoadedTree {
  DopTree tree;
  std::string note;  ///< one line that names the file; empty if the file was read, or was missing and is now written
};

/// Reads the tree from the cache file of `mesh_path`. If that file is missing or unusable, builds the tree and writes
/// the file. The note reports a file that is unusable or cannot be written. Throws what the constructor of DopTree
/// throws.
LoadedTree load_or_build_tree(const std::filesystem::path& mesh_path,
                              const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                              const DopTreeOptions& options = {});

}  // namespace glissade::collision
