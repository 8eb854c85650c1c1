#include "labelled_grasps.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include <glissade/shapes/shape_catalog.h>

namespace glissade::test_support {
namespace {

using Eigen::Vector3d;
using grasping::GraspForm;
using grasping::GraspType;
using grasping::Posture;

constexpr double kDegree = std::numbers::pi / 180.0;

Vector3d vector_of(const YAML::Node& node) {
  const auto numbers = node.as<std::array<double, 3>>();
  return {numbers[0], numbers[1], numbers[2]};
}

/// The flex values that a key sets, in its order.
std::vector<std::string> values_of(const std::string& key) {
  if (key == "thumb") return {"thumb_roll", "thumb_mcp", "thumb_ip", "thumb_index_abduction"};
  if (key == "spread") return {"middle_index_abduction", "ring_middle_abduction", "little_ring_abduction"};
  if (key == "arch") return {"palm_arch"};
  if (key == "wrist") return {"wrist_flexion", "wrist_abduction"};
  return {key + "_mcp", key + "_pip", key + "_dip"};
}

/// Sets the values, in degrees, of one part of the hand.
void bend(Posture& posture, const std::string& key, const std::vector<double>& degrees) {
  const std::vector<std::string> names = values_of(key);
  if (degrees.size() != names.size()) throw std::invalid_argument("'" + key + "' has another number of values");
  const auto values = hand_chain()->values();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.name == names[i]; });
    if (found == values.end()) throw std::invalid_argument("a hand has no '" + key + "'");
    posture.values[static_cast<std::size_t>(found - values.begin())] = degrees[i] * kDegree;
  }
}

void bend(Posture& posture, const YAML::Node& parts) {
  for (const auto& part : parts) {
    const auto key = part.first.as<std::string>();
    if (key != "fingers") bend(posture, key, part.second.as<std::vector<double>>());
  }
}

/// The whole hand: `fingers` sets all four, what else is there comes after it.
Posture posture_of(const Posture& before, const YAML::Node& parts) {
  if (!parts.IsDefined()) return before;
  Posture posture = before;
  if (parts["fingers"]) {
    for (const char* finger : {"index", "middle", "ring", "little"})
      bend(posture, finger, parts["fingers"].as<std::vector<double>>());
  }
  bend(posture, parts);
  hand_chain()->clamp(posture.values);
  return posture;
}

template <class Kind>
Kind named(const std::string& name, int count) {
  for (int i = 0; i < count; ++i) {
    if (name_of(static_cast<Kind>(i)) == name) return static_cast<Kind>(i);
  }
  throw std::invalid_argument("'" + name + "' is no label");
}

LabelledGrasp grasp_of(const YAML::Node& node) {
  LabelledGrasp grasp;
  Vector3d turn_deg = Vector3d::Zero();
  Vector3d press = Vector3d::Zero();
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    const YAML::Node& value = entry.second;
    if (key == "name")
      grasp.name = value.as<std::string>();
    else if (key == "object")
      grasp.object = value.as<std::string>();
    else if (key == "at_mm")
      grasp.X_WB.translation() = 1e-3 * vector_of(value);
    else if (key == "turn_deg")
      turn_deg = vector_of(value);
    else if (key == "press_mm")
      press = 1e-3 * vector_of(value);
    else if (key == "up")
      grasp.up_W = vector_of(value).normalized();
    else if (key == "type")
      grasp.type = named<GraspType>(value.as<std::string>(), 4);
    else if (key == "form")
      grasp.form = named<GraspForm>(value.as<std::string>(), 7);
    else if (key == "reason")
      grasp.reason = value.as<std::string>();
    else if (key != "start" && key != "close")
      throw std::invalid_argument("unknown key '" + key + "'");
  }
  const Vector3d turn = kDegree * turn_deg;
  grasp.X_WB.linear() =
      (Eigen::AngleAxisd(turn.z(), Vector3d::UnitZ()) * Eigen::AngleAxisd(turn.y(), Vector3d::UnitY()) *
       Eigen::AngleAxisd(turn.x(), Vector3d::UnitX()))
          .toRotationMatrix();
  grasp.start = posture_of(open_hand(), node["start"]);
  grasp.close = posture_of(grasp.start, node["close"]);
  grasp.close.X_WR.translation() += press;
  return grasp;
}

}  // namespace

std::vector<LabelledGrasp> read_labelled_grasps(const std::filesystem::path& file) {
  std::vector<LabelledGrasp> grasps;
  for (const YAML::Node& node : YAML::LoadFile(file)) {
    try {
      grasps.push_back(grasp_of(node));
    } catch (const std::exception& error) {
      throw std::invalid_argument(node["name"].as<std::string>("?") + ": " + error.what());
    }
  }
  return grasps;
}

Posture target_at(const LabelledGrasp& grasp, int ms) {
  constexpr int kPressing_ms = 100;
  constexpr int kClosing_ms = 200;
  Posture pressed = grasp.start;
  pressed.X_WR = grasp.close.X_WR;
  if (ms < kPressing_ms) return between(grasp.start, pressed, static_cast<double>(ms) / kPressing_ms);
  return between(pressed, grasp.close, std::min(1.0, static_cast<double>(ms - kPressing_ms) / kClosing_ms));
}

GraspTrial::GraspTrial(const LabelledGrasp& grasp)
    : grasp_(grasp),
      object_(std::make_shared<const geometry::TriangleMesh>(shapes::make_shape(grasp.object, {}))),
      hand_(*object_, grasp.X_WB),
      analysis_(*hand_model()) {}

const grasping::Grasp& GraspTrial::close() {
  for (int ms = 0; ms <= kClosed_ms; ++ms) {
    advance(target_at(grasp_, ms));
    if (ms == 0 && hand_.clasp.state() != grasping::ClaspState::kClasping)
      throw std::invalid_argument(grasp_.name + ": the start is not free");
  }
  return analysis_.grasp();
}

const grasping::Grasp& GraspTrial::advance(const Posture& target) {
  hand_.clasp.advance(target);
  return analysis_.update(hand_.clasp.contacts(), 1.0, grasp_.up_W);
}

LooseGraspTrial::LooseGraspTrial(const LabelledGrasp& grasp, const std::vector<contact::Obstacle>& fixed)
    : grasp_(grasp),
      object_(std::make_shared<const geometry::TriangleMesh>(shapes::make_shape(grasp.object, {}))),
      simulation_(fixed, {{.part_V = std::make_shared<const contact::SlidingPart>(object_), .X_WV_start = grasp.X_WB}},
                  {hand_model()}, {.up_W = grasp.up_W}) {}

bool LooseGraspTrial::close() {
  for (int ms = 0; ms <= kClosed_ms; ++ms)
    advance(target_at(grasp_, ms));
  return holds();
}

void LooseGraspTrial::advance(const Posture& target) {
  simulation_.advance(std::array{std::optional<Posture>(target)});
}

bool LooseGraspTrial::collides() const {
  const reference::GridCheck check({{object_, simulation_.parts().result(0).X_WV}});
  const Posture& posture = simulation_.posture(0);
  std::vector<Eigen::Isometry3d> X_WL(hand_chain()->links().size());
  hand_chain()->poses(posture.X_WR, posture.values, X_WL);
  for (std::size_t link = 0; link < X_WL.size(); ++link) {
    const auto& mesh = hand_chain()->links()[link].mesh;
    if (mesh != nullptr && check.collides(*mesh, X_WL[link])) return true;
  }
  return false;
}

}  // namespace glissade::test_support
