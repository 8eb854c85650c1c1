#include <algorithm>
#include <cstddef>
#include <span>

#include <glissade/apps/files/obj_file.h>
#include <glissade/apps/text.h>
#include <glissade/files/obj_text.h>

namespace glissade::apps {

namespace {

class ObjText {
 public:
  explicit ObjText(const std::string& title) : text_("# " + one_line(title) + "; metres, axes of the world\n") {}

  void add_group(std::string name, const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X_WB) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return (c >= 0 && c <= ' ') || c == '\\'; }, '_');
    text_ += "g " + name + '\n';
    append_obj(text_, geometry::transformed(mesh, X_WB), first_);
    first_ += mesh.vertices.size();
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t first_ = 1;  // number of the next vertex
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
