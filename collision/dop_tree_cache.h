#pragma once

/// DOP-trees kept in a file next to their mesh, so that a large mesh need not be built a tree again in every run.
///
/// The file holds the shape of the tree only: which triangles share a leaf, and which leaves a node. Boxes are fitted
/// to the mesh at hand when it is read, and the shape is checked to be one tree of all triangles. So whatever a file
/// holds, damaged or forged, it is either rejected or gives a tree whose answers are right. Finding the shape is the
/// greater part of building: with 100,000 triangles reading takes 31 ms of processor time, building 102 ms; the file
/// takes 4.4 bytes a triangle.
///
/// A file is bound to the vertices and triangles of its mesh, to the options and to the version of its format, which
/// counts ways to build as well. Bytes are in the same order on every machine. The last eight are a checksum of all
/// others: it notices every change of one byte, and all but one in 2^64 of other changes.

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
  kMissing,  ///< there is no such file
  kStale,    ///< of another mesh, other options or another version
  kDamaged,  ///< truncated, changed, not a cache at all, or cannot be read
};

/// What became of a file.
struct CachedTree {
  CacheState state;
  std::string reason;           ///< why it was not read, in a few words
  std::optional<DopTree> tree;  ///< when it was

  explicit operator bool() const { return tree.has_value(); }
};

/// The file that belongs to a mesh file: its name followed by ".dop-tree".
std::filesystem::path tree_cache_path(const std::filesystem::path& mesh_path);

/// Writes the file anew. It appears complete or not at all: until then it has another name, and is deleted when it
/// cannot be completed. Throws std::runtime_error, in one line that names the file and the reason. May block on the
/// disk.
void write_tree_cache(const std::filesystem::path& path, const DopTree& tree);

/// Reads a file for the tree that DopTree(mesh, options) would build. A file that is of no use is not an error, but
/// throws as DopTree does what DopTree refuses of `mesh` and `options`. Cost O(n log n); may block on the disk.
CachedTree read_tree_cache(const std::filesystem::path& path, std::shared_ptr<const geometry::TriangleMesh> mesh,
                           const DopTreeOptions& options = {});

/// The same for the bytes of a file.
CachedTree read_tree_cache_bytes(std::span<const std::byte> bytes, std::shared_ptr<const geometry::TriangleMesh> mesh,
                                 const DopTreeOptions& options = {});

/// A tree, and what its user should know about the file.
struct LoadedTree {
  DopTree tree;
  std::string note;  ///< one line that names the file; empty when it was read, or written for the first time
};

/// Reads the tree from the file that belongs to `mesh_path`. Where that is missing or of no use, builds the tree and
/// writes the file; one that cannot be written is told in the note. Throws as DopTree does.
LoadedTree load_or_build_tree(const std::filesystem::path& mesh_path,
                              const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                              const DopTreeOptions& options = {});

}  // namespace glissade::collision
