#include <algorithm>
#include <iostream>

#include <Eigen/Geometry>

#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/text.h>

namespace glissade::apps {
namespace {

constexpr double kDoubtful_m = 10.0;     // no car
constexpr double kDoubtfulPart_m = 2.0;  // no thing for a hand
constexpr double kDoubtfulRatio = 1e3;   // of a part to what it meets: that of metres to millimetres
constexpr double kMillimetre = 1e-3;

std::string in_millimetres(double scale, const std::string& option) {
  return ": millimetres? " + option + rounded_text(kMillimetre * scale);
}

}  // namespace

double size_of(const geometry::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    box.extend(vertex);
  return box.sizes().maxCoeff();
}

bool is_doubtful(double size_m) {
  return size_m > kDoubtful_m;
}

std::string told_size(double size_m, double scale, const std::string& option) {
  const std::string text = rounded_text(size_m) + " m across";
  return is_doubtful(size_m) ? text + in_millimetres(scale, option) : text;
}

std::vector<std::string> doubtful_meshes(const Scene& file) {
  std::vector<std::string> sentences;
  for (const SceneObject& object : file.objects) {
    const double size = size_of(*object.mesh);
    if (!object.file_scale || size <= (object.movable ? kDoubtfulPart_m : kDoubtful_m)) continue;
    sentences.push_back(file.source + ": object " + in_quotes(object.name) + " is " + rounded_text(size) + " m across" +
                        in_millimetres(*object.file_scale, "scale: "));
  }
  return sentences;
}

std::vector<std::string> doubtful_sizes(const Scene& file, const HapticScene& scene) {
  std::vector<std::string> sentences = doubtful_meshes(file);
  double largest_obstacle = 0.0;
  for (const SceneObject& object : file.objects) {
    if (!scene.part_number(object.name)) largest_obstacle = std::max(largest_obstacle, size_of(*object.mesh));
  }
  for (const ScenePart& part : scene.parts) {
    const double size = size_of(part.part_V->tree.mesh());
    if (largest_obstacle == 0.0 || size <= kDoubtfulRatio * largest_obstacle) continue;
    sentences.push_back(file.source + ": object " + in_quotes(part.name) + " is " + rounded_text(size) +
                        " m across, and everything around it at most " + rounded_text(largest_obstacle) +
                        " m: one of both has the wrong 'scale'");
  }
  return sentences;
}

void warn(const std::string& sentence) {
  std::cerr << "glissade: warning: " << one_line(sentence) << '\n';
}

}  // namespace glissade::apps
