#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/text.h>

namespace glissade::apps {
namespace {

constexpr double kDoubtful_m = 10.0;        // no car
constexpr double kDoubtfulPart_m = 2.0;     // no thing for a hand
constexpr double kDoubtfulScaled_m = 1e-3;  // a scale was applied twice, or the file was in metres
constexpr double kDoubtfulRatio = 1e3;      // of a part and what it meets: that of metres and millimetres
constexpr double kMillimetre = 1e-3;

bool is_too_small(double size_m, double scale) {
  return scale != 1.0 && size_m < kDoubtfulScaled_m;
}

std::string across(double size_m) {
  return rounded_text(size_m) + " m across";
}

std::string in_millimetres(double scale, const std::string& option) {
  return ": millimetres? " + option + rounded_text(kMillimetre * scale);
}

std::string in_metres(double scale, const std::string& option) {
  const double larger = scale / kMillimetre;
  return (larger == 1.0 ? ": in metres already? " : ": too small a scale? ") + option + rounded_text(larger);
}

/// What is doubtful in the size of an object alone; empty if nothing is.
std::string doubt_of(const SceneObject& object) {
  const double size = size_of(*object.mesh);
  const SceneMesh::Origin& origin = object.mesh.origin();
  const auto file_scale = origin.file.empty() ? std::nullopt : std::optional(origin.scale);
  const bool is_too_large = size > (object.movable ? kDoubtfulPart_m : kDoubtful_m);
  if (file_scale && is_too_large) return across(size) + in_millimetres(*file_scale, "scale: ");
  if (file_scale && is_too_small(size, *file_scale)) {
    return across(size) + in_metres(*file_scale, "scale: ");
  }
  // A large shape that stays where it is, such as a floor, is meant to be large.
  if (!file_scale && object.movable && is_too_large) {
    return across(size) + ", too large for a hand: is its shape in metres?";
  }
  return "";
}

/// The sizes of the smallest and the largest object that is no part.
struct SizesAround {
  double smallest_m = std::numeric_limits<double>::infinity();
  double largest_m = 0.0;
};

SizesAround sizes_around(const Scene& file, const HapticScene& scene) {
  SizesAround sizes;
  for (const SceneObject& object : file.objects) {
    if (scene.part_number(object.name)) continue;
    const double size = size_of(*object.mesh);
    sizes.smallest_m = std::min(sizes.smallest_m, size);
    sizes.largest_m = std::max(sizes.largest_m, size);
  }
  return sizes;
}

}  // namespace

double size_of(const geometry::TriangleMesh& mesh) {
  return geometry::bounds_of(mesh).sizes().maxCoeff();
}

bool is_doubtful(double size_m, double scale) {
  return size_m > kDoubtful_m || is_too_small(size_m, scale);
}

std::string told_size(double size_m, double scale, const std::string& option) {
  if (!is_doubtful(size_m, scale)) return across(size_m);
  return across(size_m) + (size_m > kDoubtful_m ? in_millimetres(scale, option) : in_metres(scale, option));
}

std::vector<std::string> doubtful_objects(const Scene& file) {
  std::vector<std::string> sentences;
  for (const SceneObject& object : file.objects) {
    const std::string doubt = doubt_of(object);
    if (!doubt.empty()) sentences.push_back(file.source + ": object " + in_quotes(object.name) + " is " + doubt);
  }
  return sentences;
}

std::vector<std::string> doubtful_sizes(const Scene& file, const HapticScene& scene) {
  std::vector<std::string> sentences = doubtful_objects(file);
  const SizesAround around = sizes_around(file, scene);
  if (around.largest_m == 0.0) return sentences;
  for (const ScenePart& part : scene.parts) {
    if (!doubt_of(file.find(part.name)).empty()) continue;  // one warning is enough
    const double size = size_of(part.part_V->tree.mesh());
    std::string others;
    if (size > kDoubtfulRatio * around.largest_m) others = "at most " + rounded_text(around.largest_m);
    if (kDoubtfulRatio * size < around.smallest_m) others = "at least " + rounded_text(around.smallest_m);
    if (others.empty()) continue;
    sentences.push_back(file.source + ": object " + in_quotes(part.name) + " is " + across(size) +
                        ", and everything around it " + others + " m: one of the two has the wrong 'scale'");
  }
  return sentences;
}

std::string doubt_of_positions(const Eigen::AlignedBox3d& positions, const HapticScene& scene) {
  constexpr double kFar_m = 2.0;         // no reach of an arm
  constexpr double kFarSizes = 5.0;      // of the scene
  if (!scene.moving.empty()) return "";  // something may lead the way
  Eigen::AlignedBox3d around;
  for (const viewer::ViewObject& object : scene.shown) {
    const Eigen::AlignedBox3d box_B = geometry::bounds_of(*object.mesh);
    for (int corner = 0; corner < 8; ++corner)
      around.extend(object.X_WB * box_B.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  for (const ScenePart& part : scene.parts)  // whose origin may be far from its mesh
    around.extend(Eigen::Vector3d(part.X_WV_start.translation()));
  if (scene.X_WGoal) around.extend(Eigen::Vector3d(scene.X_WGoal->translation()));
  const double beyond_m = (positions.max() - around.max()).cwiseMax(around.min() - positions.min()).maxCoeff();
  if (beyond_m <= std::max(kFar_m, kFarSizes * around.diagonal().norm())) return "";
  return "it leads " + rounded_text(beyond_m) + " m beyond everything in the scene: are its positions in millimetres?";
}

}  // namespace glissade::apps
