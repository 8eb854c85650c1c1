#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <glissade/base/byte_order.h>
#include <glissade/collision/dop_tree.h>

#include "tree/content_hash.h"
#include "tree/dop_tree_build.h"
#include "tree/tree_nodes.h"
#include "tree/tree_shape_code.h"

namespace glissade::collision {
namespace {

// Raise this with every change of the format and of `build_shape`: a tree of an old shape would be correct, but not the
// same.
constexpr std::uint32_t kVersion = 2;

// A file consists of the head, the code of the shape, and the checksum of both.
constexpr std::string_view kMagic = "DOP-tree";
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kOptionsAt = 12;
constexpr std::size_t kMeshAt = 24;
constexpr std::size_t kHeadSize = 32;
constexpr std::size_t kChecksumSize = 8;

std::uint64_t hash_of(const geometry::TriangleMesh& mesh) {
  ContentHash hash;
  hash.add(mesh.vertices.size());
  hash.add(mesh.triangles.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    for (const double coordinate : vertex)
      hash.add(std::bit_cast<std::uint64_t>(coordinate));
  }
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t index : triangle)
      hash.add(static_cast<std::uint32_t>(index));
  }
  return hash.value();
}

std::string head_of(const geometry::TriangleMesh& mesh, const DopTreeOptions& options) {
  std::string head(kMagic);
  base::append_number(head, kVersion);
  base::append_number(head, static_cast<std::int32_t>(options.directions));
  base::append_number(head, static_cast<std::int32_t>(options.thin_slab));
  base::append_number(head, static_cast<std::int32_t>(options.realignment));
  base::append_number(head, hash_of(mesh));
  return head;
}

void require(const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  if (mesh == nullptr) throw std::invalid_argument("a tree cannot be read from its cache without the mesh");
}

CachedTree rejected(CacheState state, std::string reason) {
  return {state, std::move(reason), std::nullopt};
}

CachedTree read_bytes(std::string_view bytes, std::shared_ptr<const geometry::TriangleMesh> mesh,
                      const DopTreeOptions& options) {
  if (!bytes.starts_with(kMagic)) return rejected(CacheState::kDamaged, "not a cached tree");
  if (bytes.size() < kHeadSize + kChecksumSize) return rejected(CacheState::kDamaged, "truncated");
  const std::string head = head_of(*mesh, options);
  const auto same = [&](std::size_t from, std::size_t to) {
    return bytes.substr(from, to - from) == std::string_view(head).substr(from, to - from);
  };
  if (!same(kVersionAt, kOptionsAt)) return rejected(CacheState::kStale, "of another version");
  if (!same(kOptionsAt, kMeshAt)) return rejected(CacheState::kStale, "of other options");
  if (!same(kMeshAt, kHeadSize)) return rejected(CacheState::kStale, "of another mesh");

  const std::size_t checksum_at = bytes.size() - kChecksumSize;
  if (content_hash(bytes.substr(0, checksum_at)) != base::number_at<std::uint64_t>(bytes, checksum_at)) {
    return rejected(CacheState::kDamaged, "the checksum is wrong");
  }
  TreeShape shape;
  try {
    shape = decode_shape(bytes.substr(kHeadSize, checksum_at - kHeadSize), mesh->triangles.size());
  } catch (const std::invalid_argument& error) {
    return rejected(CacheState::kDamaged, error.what());
  }
  return {CacheState::kRead, "", tree_of_shape(std::move(mesh), options, std::move(shape))};
}

// The reason why the last system call failed.
std::string system_reason() {
  return std::generic_category().message(errno);
}

// A file with a temporary name next to `path`, renamed to `path` once it is complete.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path) : path_(path), draft_(path) {
    draft_ += "." + std::to_string(std::random_device()()) + ".new";
    file_ = std::fopen(draft_.c_str(), "wbx");
    if (file_ == nullptr) fail(system_reason());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (file_ != nullptr) std::fclose(file_);
    std::error_code ignored;
    if (!is_complete_) std::filesystem::remove(draft_, ignored);
  }

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(system_reason());
  }

  // Does not wait for the disk: a file that a power failure left incomplete is rejected by its checksum.
  void complete() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(system_reason());
    std::error_code error;
    std::filesystem::rename(draft_, path_, error);
    if (error) fail(error.message());
    is_complete_ = true;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw std::runtime_error(path_.string() + ": " + reason); }

  const std::filesystem::path path_;
  std::filesystem::path draft_;
  std::FILE* file_ = nullptr;
  bool is_complete_ = false;
};

}  // namespace

std::filesystem::path tree_cache_path(const std::filesystem::path& mesh_path) {
  std::filesystem::path path = mesh_path;
  path += ".dop-tree";
  return path;
}

void write_tree_cache(const std::filesystem::path& path, const DopTree& tree) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::symlink_status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw std::runtime_error(path.string() + ": not a regular file, and not replaced");
  }
  std::string bytes = head_of(tree.mesh(), tree.options());
  append_shape_code(tree, bytes);
  base::append_number(bytes, content_hash(bytes));
  NewFile file(path);
  file.write(bytes);
  file.complete();
}

CachedTree read_tree_cache_bytes(std::span<const std::byte> bytes, std::shared_ptr<const geometry::TriangleMesh> mesh,
                                 const DopTreeOptions& options) {
  require(mesh);
  return read_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, std::move(mesh), options);
}

CachedTree read_tree_cache(const std::filesystem::path& path, std::shared_ptr<const geometry::TriangleMesh> mesh,
                           const DopTreeOptions& options) {
  require(mesh);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return rejected(CacheState::kMissing, "missing");
  if (error) return rejected(CacheState::kDamaged, error.message());
  // A pipe or a device may never end.
  if (!std::filesystem::is_regular_file(status)) return rejected(CacheState::kDamaged, "not a regular file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return rejected(CacheState::kDamaged, system_reason());

  // Reads one byte more than a valid file can have, which is enough to recognise a longer one.
  std::string bytes(kHeadSize + longest_shape_code(mesh->triangles.size()) + kChecksumSize + 1, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (file.bad()) return rejected(CacheState::kDamaged, "cannot be read");
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return read_bytes(bytes, std::move(mesh), options);
}

LoadedTree load_or_build_tree(const std::filesystem::path& mesh_path,
                              const std::shared_ptr<const geometry::TriangleMesh>& mesh,
                              const DopTreeOptions& options) {
  const std::filesystem::path path = tree_cache_path(mesh_path);
  CachedTree cached = read_tree_cache(path, mesh, options);
  if (cached) return {*std::move(cached.tree), ""};

  LoadedTree built{DopTree(mesh, options), ""};
  if (cached.state != CacheState::kMissing) built.note = path.string() + ": " + cached.reason + "; built anew";
  try {
    write_tree_cache(path, built.tree);
  } catch (const std::runtime_error& error) {
    built.note += (built.note.empty() ? "" : "; ") + std::string("the tree cannot be saved: ") + error.what();
  }
  return built;
}

}  // namespace glissade::collision
