#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/devices/haptic_state.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/viewer/page.h>
#include <glissade/viewer/scene_model.h>

#include "model/glb.h"

namespace glissade::viewer {

namespace {

/// A colour of the page as glTF has it: linear, with opacity. The page gives parts other colours by their state.
std::array<double, 4> linear_color(std::string_view name) {
  const auto linear = [](double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  const auto [red, green, blue] = color(name);
  return {linear(red), linear(green), linear(blue), 1.0};
}

struct Kind {
  const char* name;
  const char* color;
};

Kind kind_of(const ViewObject& object) {
  if (!object.part) return {"fixed", "fixed"};
  return object.moves_on_its_own ? Kind{"moving", "moving"} : Kind{"part", "held"};
}

/// How many triangles the mesh of each object may keep.
class Shares {
 public:
  Shares(const ViewScene& scene, std::size_t most_triangles)
      : triangles_(scene.triangles()),
        share_(std::min(
            1.0, static_cast<double>(most_triangles) / static_cast<double>(std::max<std::size_t>(triangles_, 1)))) {}

  std::size_t of(const geometry::TriangleMesh& mesh) const {
    constexpr double kLeast = 24.0;  // triangles of a simplified object
    return static_cast<std::size_t>(std::max(kLeast, std::ceil(share_ * static_cast<double>(mesh.triangles.size()))));
  }
  std::size_t in_scene() const { return triangles_; }

 private:
  std::size_t triangles_;
  double share_;  // of the triangles to keep
};

geometry::TriangleMesh simplified(const geometry::TriangleMesh& mesh, std::size_t most_triangles) {
  const DisplayMesh shown = display_mesh(mesh, most_triangles);
  geometry::TriangleMesh result;
  for (const auto& position : shown.positions)
    result.vertices.emplace_back(shown.lower + shown.step * Eigen::Vector3d(position[0], position[1], position[2]));
  for (std::size_t t = 0; t < shown.triangles(); ++t) {
    auto& triangle = result.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      triangle[c] = static_cast<std::int32_t>(shown.indices[3 * t + c]);
  }
  return result;
}

/// Objects of one mesh and one kind share it.
class Meshes {
 public:
  Meshes(GlbWriter& writer, const Shares& shares) : writer_(writer), shares_(shares) {}

  std::size_t number_of(const geometry::TriangleMesh& mesh, const Kind& kind) {
    const auto [place, is_new] = numbers_.try_emplace({&mesh, kind.name}, 0);
    if (!is_new) return place->second;
    return place->second = writer_.add_mesh(display_mesh(mesh, shares_.of(mesh)), linear_color(kind.color));
  }

 private:
  GlbWriter& writer_;
  Shares shares_;
  std::map<std::pair<const geometry::TriangleMesh*, const char*>, std::size_t> numbers_;
};

void add_hand(const ViewHand& hand, std::size_t number, const Eigen::Isometry3d& X_OW, GlbWriter& writer,
              nlohmann::json& hands) {
  hands.push_back({{"name", hand.name}, {"has_fingers", hand.model != nullptr}});
  if (!hand.model) return;
  const std::span<const grasping::ChainLink> links = hand.model->chain.links();
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (!links[l].mesh) continue;
    const std::size_t mesh =
        writer.add_mesh(display_mesh(*links[l].mesh, links[l].mesh->triangles.size()), linear_color("skin"));
    const Eigen::Isometry3d X_OL = hand.X_WL.empty() ? Eigen::Isometry3d::Identity() : X_OW * hand.X_WL[l];
    writer.add_node(links[l].name, X_OL, mesh,
                    {{"name", links[l].name}, {"kind", "segment"}, {"hand", number}, {"link", l}});
  }
}

/// The words for the numbers of a grasp in a frame: by kind, by form, by bit of the segments that touch, and by what
/// they lack. The page has none of its own.
nlohmann::json grasp_words() {
  nlohmann::json kinds = nlohmann::json::array();
  for (std::int32_t kind = 0; kind < hands::kGraspTypes; ++kind)
    kinds.push_back(hands::name_of(static_cast<hands::GraspType>(kind)));
  nlohmann::json forms = nlohmann::json::array();
  for (std::int32_t form = 0; form < hands::kGraspForms; ++form)
    forms.push_back(hands::name_of(static_cast<hands::GraspForm>(form)));
  nlohmann::json segments = nlohmann::json::array();
  for (const grasping::SegmentMeaning& segment : grasping::TouchingSegments::meaning_of_bits())
    segments.push_back(segment.segment == grasping::HandSegment::kNone ? "" : grasping::words_of(segment));
  nlohmann::json lacks = nlohmann::json::array();
  for (std::int32_t lack = 0; lack < grasping::kGraspLacks; ++lack)
    lacks.push_back(grasping::words_of(static_cast<grasping::GraspLack>(lack)));
  return {{"kinds", kinds}, {"forms", forms}, {"segments", segments}, {"lacks", lacks}};
}

}  // namespace

std::string scene_model(const ViewScene& scene, std::size_t most_triangles) {
  const Eigen::Vector3d p_WO = scene.p_WO();
  const Eigen::Isometry3d X_OW(Eigen::Translation3d(-p_WO));
  const Shares shares(scene, most_triangles);
  GlbWriter writer;
  Meshes meshes(writer, shares);
  std::vector<std::string> parts;
  for (const ViewObject& object : scene.objects) {
    const Kind kind = kind_of(object);
    nlohmann::json extras = {{"name", object.name}, {"kind", kind.name}, {"triangles", object.mesh->triangles.size()}};
    if (object.part) {
      extras["part"] = *object.part;
      parts.resize(std::max(parts.size(), *object.part + 1));
      parts[*object.part] = object.name;
    }
    writer.add_node(object.name, X_OW * object.X_WB, meshes.number_of(*object.mesh, kind), extras);
  }
  nlohmann::json hands = nlohmann::json::array();
  for (std::size_t h = 0; h < scene.hands.size(); ++h)
    add_hand(scene.hands[h], h, X_OW, writer, hands);
  nlohmann::json extras = {{"title", scene.title},
                           {"origin_W_m", {p_WO.x(), p_WO.y(), p_WO.z()}},
                           {"parts", parts},
                           {"hands", hands},
                           {"has_loop", scene.has_loop},
                           {"grasp_words", grasp_words()},
                           {"triangles", shares.in_scene()}};
  return writer.finish(extras);
}

std::vector<std::shared_ptr<const geometry::TriangleMesh>> simplified_meshes(const ViewScene& scene,
                                                                             std::size_t most_triangles) {
  const Shares shares(scene, most_triangles);
  std::map<const geometry::TriangleMesh*, std::shared_ptr<const geometry::TriangleMesh>> made;
  std::vector<std::shared_ptr<const geometry::TriangleMesh>> meshes;
  for (const ViewObject& object : scene.objects) {
    std::shared_ptr<const geometry::TriangleMesh>& mesh = made[object.mesh.get()];
    const std::size_t most = shares.of(*object.mesh);
    if (!mesh && object.mesh->triangles.size() <= most) mesh = object.mesh;
    if (!mesh) mesh = std::make_shared<const geometry::TriangleMesh>(simplified(*object.mesh, most));
    meshes.push_back(mesh);
  }
  return meshes;
}

}  // namespace glissade::viewer
