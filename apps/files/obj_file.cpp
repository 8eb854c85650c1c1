#include <algorithm>
#include <cstddef>
#include <span>

#include <glissade/apps/files/obj_file.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

class ObjText {
 public:
  explicit ObjText(const std::string& title) : text_("# " + one_line(title) + "; metres, axes of the world\n") {}

  void add_group(std::string name, const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X_WB) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return (c >= 0 && c <= ' ') || c == '\\'; }, '_');
    text_ += "g " + name + '\n';
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      text_ += 'v';
      for (const double coordinate : Eigen::Vector3d(X_WB * vertex))
        text_ += ' ' + format_number(coordinate);
      text_ += '\n';
    }
    for (const auto& triangle : mesh.triangles) {
      text_ += 'f';
      for (const std::int32_t vertex : triangle)
        text_ += ' ' + std::to_string(first_ + static_cast<std::size_t>(vertex));
      text_ += '\n';
    }
    first_ += mesh.vertices.size();
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t first_ = 1;  // number of the next vertex; OBJ counts from 1
};

}  // namespace

std::string obj_text(const viewer::ViewScene& scene) {
  ObjText text(scene.title);
  for (const viewer::ViewObject& object : scene.objects)
    text.add_group(object.name, *object.mesh, object.X_WB);
  for (std::size_t h = 0; h < scene.hands.size(); ++h) {
    const viewer::ViewHand& hand = scene.hands[h];
    if (!hand.model || hand.X_WL.empty()) continue;
    const std::span<const grasping::ChainLink> links = hand.model->chain.links();
    for (std::size_t l = 0; l < links.size(); ++l) {
      if (links[l].mesh)
        text.add_group("hand_" + std::to_string(h) + "_" + links[l].name, *links[l].mesh, hand.X_WL[l]);
    }
  }
  return text.take();
}

}  // namespace glissade::apps
