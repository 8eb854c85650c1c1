#include <algorithm>
#include <cstdint>
#include <utility>

#include <glissade/apps/record/mcap_entities.h>
#include <glissade/apps/record/mcap_values.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/viewer/scene_model.h>

namespace glissade::apps {

namespace {

using Json = nlohmann::json;

// Sizes in metres: what matters is as large as a finger, also in a large scene.
constexpr double kContactDiameter = 0.005;
constexpr double kNormalLength = 0.03;
constexpr double kForceLengthPerNewton = 0.01;
constexpr double kLeastForce = 1e-3;  // N

/// Without anything to draw yet. It is there until another one of this id, or a deletion, comes.
Json empty_entity(const std::string& id, const std::string& frame, const char* kind, std::chrono::nanoseconds time) {
  Json entity{{"timestamp", time_json(time)},
              {"frame_id", frame},
              {"id", id},
              {"lifetime", time_json({})},
              {"frame_locked", true},
              {"metadata", Json::array({{{"key", "kind"}, {"value", kind}}})}};
  for (const char* primitives : {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"})
    entity[primitives] = Json::array();
  return entity;
}

Json triangles_json(const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X, Json color) {
  Json points = Json::array();
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    points.push_back(vector_json(vertex));
  Json indices = Json::array();
  for (const auto& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle)
      indices.push_back(vertex);
  }
  return {{"pose", pose_json(X)},
          {"points", std::move(points)},
          {"color", std::move(color)},
          {"colors", Json::array()},
          {"indices", std::move(indices)}};
}

/// Stands above the object at its start.
Json name_json(const viewer::ViewObject& object, const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X_FB) {
  Eigen::AlignedBox3d box_W;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    box_W.extend(object.X_WB * vertex);
  Eigen::Vector3d p_W = box_W.center();
  p_W.z() = box_W.max().z() + 0.05 * box_W.diagonal().norm();
  const Eigen::Vector3d p_F = X_FB * object.X_WB.inverse(Eigen::Isometry) * p_W;
  constexpr double kPixels = 14.0;
  return {{"pose", pose_json(Eigen::Isometry3d(Eigen::Translation3d(p_F)))},
          {"billboard", true},
          {"font_size", kPixels},
          {"scale_invariant", true},
          {"color", color_json("axis")},
          {"text", object.name}};
}

/// A fixed object stands in the world, any other one in the frame of its part.
Json object_entity(const viewer::ViewObject& object, const geometry::TriangleMesh& mesh,
                   std::chrono::nanoseconds time) {
  const char* const kind = !object.part ? "fixed" : object.moves_on_its_own ? "moving" : "part";
  const char* const color = object.part && !object.moves_on_its_own ? "held" : kind;
  const Eigen::Isometry3d X_FB = object.part ? Eigen::Isometry3d::Identity() : object.X_WB;
  Json entity = empty_entity(object.name, object.part ? numbered("part", *object.part) : kWorldFrame, kind, time);
  entity["triangles"].push_back(triangles_json(mesh, X_FB, color_json(color)));
  entity["texts"].push_back(name_json(object, mesh, X_FB));
  return entity;
}

Json mesh_entity(const std::string& id, const std::string& frame, const char* kind, const geometry::TriangleMesh& mesh,
                 Json color, std::chrono::nanoseconds time) {
  Json entity = empty_entity(id, frame, kind, time);
  entity["triangles"].push_back(triangles_json(mesh, Eigen::Isometry3d::Identity(), std::move(color)));
  return entity;
}

Json sphere_json(const Eigen::Vector3d& p_W) {
  return {{"pose", pose_json(Eigen::Isometry3d(Eigen::Translation3d(p_W)))},
          {"size", vector_json(Eigen::Vector3d::Constant(kContactDiameter))},
          {"color", color_json("contact")}};
}

/// From a point along a vector, which is not zero.
Json arrow_json(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W, const char* color) {
  constexpr double kLongestHead = 0.02;
  const double length = v_W.norm();
  const double head = std::min(0.3 * length, kLongestHead);
  const Eigen::Isometry3d X_WA =
      Eigen::Translation3d(p_W) * Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), v_W);
  return {{"pose", pose_json(X_WA)}, {"shaft_length", length - head}, {"shaft_diameter", 0.2 * head},
          {"head_length", head},     {"head_diameter", 0.6 * head},   {"color", color_json(color)}};
}

/// Contacts or patches.
template <typename Contact>
void add_contacts(const devices::HapticState& state, std::span<const Contact> contacts, Json& entity) {
  for (const Contact& contact : contacts) {
    const devices::HapticPartState& part = state.parts.at(static_cast<std::size_t>(contact.part));
    const Eigen::Vector3d p_W = part.X_WV * contact.p_V.template cast<double>();
    const Eigen::Vector3d n_W = contact.n_W.template cast<double>();
    entity["spheres"].push_back(sphere_json(p_W));
    entity["arrows"].push_back(arrow_json(p_W, kNormalLength * n_W, "contact"));
  }
}

}  // namespace

std::string segment_frame(std::size_t hand, const std::string& link) {
  return numbered("hand", hand) + "_" + link;
}

Json scene_update(const viewer::ViewScene& scene, std::size_t most_triangles, std::chrono::nanoseconds time) {
  const auto meshes = viewer::simplified_meshes(scene, most_triangles);
  Json entities = Json::array();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const viewer::ViewObject& object = scene.objects[i];
    entities.push_back(object_entity(object, *meshes[i], time));
    if (!object.part || object.moves_on_its_own) continue;
    const std::string frame = numbered("ghost", *object.part);
    entities.push_back(
        mesh_entity(object.name + " (ghost)", frame, "ghost", *meshes[i], color_json("held", 0.25), time));
  }
  for (std::size_t h = 0; h < scene.hands.size(); ++h) {
    if (!scene.hands[h].model) continue;
    for (const grasping::ChainLink& link : scene.hands[h].model->chain.links()) {
      const std::string frame = segment_frame(h, link.name);
      if (link.mesh) entities.push_back(mesh_entity(frame, frame, "segment", *link.mesh, color_json("skin"), time));
    }
  }
  constexpr int kAll = 1;  // objects of the run before
  const Json deletion{{"timestamp", time_json(time)}, {"type", kAll}, {"id", ""}};
  return {{"deletions", Json::array({deletion})}, {"entities", std::move(entities)}};
}

Json contacts_update(const devices::HapticState& state, std::span<const std::optional<Eigen::Isometry3d>> X_WH) {
  Json entity = empty_entity("contacts", kWorldFrame, "contacts", state.time);
  const auto contact_count = static_cast<std::size_t>(state.contact_count);
  const auto patch_count = static_cast<std::size_t>(state.patch_count);
  if (contact_count > 0) {
    add_contacts(state, std::span(state.contacts).first(contact_count), entity);
  } else {
    add_contacts(state, std::span(state.patches).first(patch_count), entity);
  }
  for (std::size_t h = 0; h < static_cast<std::size_t>(state.hand_count); ++h) {
    const devices::HapticHandState& hand = state.hands[h];
    if (hand.force_W.norm() < kLeastForce) continue;
    std::optional<Eigen::Vector3d> p_W;
    if (X_WH[h]) p_W = X_WH[h]->translation();
    if (hand.part >= 0) {
      const devices::HapticPartState& part = state.parts.at(static_cast<std::size_t>(hand.part));
      p_W = part.X_WV * part.p_Vref;
    }
    if (p_W) entity["arrows"].push_back(arrow_json(*p_W, kForceLengthPerNewton * hand.force_W, "force"));
  }
  return {{"deletions", Json::array()}, {"entities", Json::array({std::move(entity)})}};
}

}  // namespace glissade::apps
