// Files of DOP-trees, read for one mesh. What is taken must answer as brute force does.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include <glissade/base/byte_order.h>
#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/reference/brute_force.h>

#include "fuzz_target.h"
#include "temporary_folder.h"
#include "tree/content_hash.h"

namespace glissade::fuzz {
namespace {

using collision::CachedTree;
using collision::CacheState;
using collision::DopTree;
using geometry::TriangleMesh;

constexpr std::size_t kHeadSize = 32;
constexpr std::size_t kChecksumSize = 8;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

const std::shared_ptr<const geometry::TriangleMesh>& torus() {
  static const auto mesh = std::make_shared<const geometry::TriangleMesh>(geometry::make_torus(0.1, 0.03, 60));
  return mesh;
}

/// The file of the tree as it is built.
const std::string& built_file() {
  static const std::string bytes = [] {
    const test_support::TemporaryFolder folder;
    const std::filesystem::path path = folder.path("torus.dop-tree");
    collision::write_tree_cache(path, DopTree(torus()));
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  return bytes;
}

/// A few poses, of which the last touches nothing.
void check_answers(const DopTree& tree) {
  static const DopTree ball(std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.06, 40)));
  static collision::QueryWorkspace workspace;
  static std::vector<collision::TrianglePair> pairs;
  for (const double x : {0.02, 0.1, 0.5}) {
    Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
    X_AB.linear() = Eigen::AngleAxisd(x, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    X_AB.translation().x() = x;
    collision::intersecting_pairs(tree, ball, X_AB, workspace, pairs);
    require(pairs == reference::brute_force_pairs(tree.mesh(), ball.mesh(), X_AB), "a wrong answer");
  }
}

}  // namespace

bool try_input(std::string_view bytes) {
  const CachedTree cached = collision::read_tree_cache_bytes(std::as_bytes(std::span(bytes)), torus());
  require(cached.tree.has_value() == (cached.state == CacheState::kRead), "a state that does not fit");
  require(cached.state != CacheState::kMissing, "a file that is not missing");
  if (cached) {
    check_answers(*cached.tree);
    return true;
  }
  require(!cached.reason.empty() && cached.reason.find('\n') == std::string::npos, "a reason that is not one line");
  return false;
}

std::vector<Seed> seeds() {
  // Another shape of the same mesh: the first and the last triangle change leaves.
  std::string other = built_file();
  const auto last = other.end() - static_cast<std::ptrdiff_t>(kChecksumSize) - 4;
  const auto first = last - 4 * (static_cast<std::ptrdiff_t>(torus()->triangles.size()) - 1);
  std::swap_ranges(first, first + 4, last);
  repair(other);
  return {{"built", built_file()}, {"other", other}};
}

std::vector<std::string> dictionary() {
  // Children of nodes: four leaves, four nodes, some of each, none.
  return {"DOP-tree", "\x04", "\x40", "\x11", "\x22", std::string(1, '\0')};
}

void repair(std::string& bytes) {
  if (bytes.size() < kHeadSize + kChecksumSize) return;
  bytes.replace(0, kHeadSize, built_file(), 0, kHeadSize);
  bytes.resize(bytes.size() - kChecksumSize);
  base::append_number(bytes, collision::content_hash(bytes));
}

}  // namespace glissade::fuzz
