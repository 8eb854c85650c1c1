/// Models of the labelled grasps, of which scripts/draw_grasps makes figures: grasp_models GRASPS.yaml FOLDER [COUNT].
/// Writes FOLDER/NUMBER.glb for each grasp, or for the first COUNT only; FOLDER/hand.glb, the open hand;
/// FOLDER/clasp_MS.glb, a hand that closes round a ball (hand 0) and its target (hand 1); and FOLDER/figures.json,
/// which tells of each model the links that touch, and of the hand the links of each kind.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <glissade/viewer/scene_model.h>
#include <glissade/viewer/view_scene.h>

#include "labelled_grasps.h"

namespace {

using namespace glissade;
using nlohmann::json;

void save(const viewer::ViewScene& scene, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << viewer::scene_model(scene, scene.triangles());
  if (!out.flush()) throw std::invalid_argument(file.string() + " cannot be written");
}

viewer::ViewHand hand_at(const grasping::Posture& posture, const std::string& name) {
  const std::shared_ptr<const grasping::HandModel>& model = test_support::hand_model();
  std::vector<Eigen::Isometry3d> X_WL(model->chain.links().size());
  model->chain.poses(posture.X_WR, posture.values, X_WL);
  return {name, model, X_WL};
}

viewer::ViewScene scene_of(const test_support::GraspTrial& trial, const test_support::LabelledGrasp& grasp) {
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(trial.object());
  return {.title = grasp.name,
          .objects = {{.name = grasp.object, .mesh = mesh, .X_WB = grasp.X_WB}},
          .hands = {hand_at(trial.hand().clasp.posture(), "hand")},
          .has_loop = false};
}

json touching_links(const test_support::GraspTrial& trial) {
  json links = json::array();
  const std::span<const char> touching = trial.hand().clasp.touching();
  for (std::size_t link = 0; link < touching.size(); ++link) {
    if (touching[link] != 0) links.push_back(link);
  }
  return links;
}

json write_grasp(const test_support::LabelledGrasp& grasp, const std::string& name,
                 const std::filesystem::path& folder) {
  test_support::GraspTrial trial(grasp);
  trial.close();
  save(scene_of(trial, grasp), folder / (name + ".glb"));
  const Eigen::Vector3d& up = grasp.up_W;
  return {{"name", name}, {"touching", touching_links(trial)}, {"up_W", {up.x(), up.y(), up.z()}}};
}

json write_hand(const std::filesystem::path& folder) {
  save({.title = "hand", .hands = {hand_at(test_support::open_hand(), "hand")}, .has_loop = false},
       folder / "hand.glb");
  json links = {{"inner", json::array()}, {"middle", json::array()}, {"outer", json::array()}};
  const auto& meaning = test_support::hand_model()->meaning;
  for (std::size_t link = 0; link < meaning.size(); ++link) {
    if (meaning[link].segment == grasping::HandSegment::kInner) links["inner"].push_back(link);
    if (meaning[link].segment == grasping::HandSegment::kMiddle) links["middle"].push_back(link);
    if (meaning[link].segment == grasping::HandSegment::kOuter) links["outer"].push_back(link);
  }
  return {{"name", "hand"}, {"links", links}};
}

json write_clasping(const test_support::LabelledGrasp& grasp, const std::filesystem::path& folder) {
  constexpr std::array kTimes_ms{60, 200, 240, 300};
  json moments = json::array();
  test_support::GraspTrial trial(grasp);
  for (int ms = 0; ms <= kTimes_ms.back(); ++ms) {
    const grasping::Posture target = test_support::target_at(grasp, ms);
    trial.advance(target);
    if (std::ranges::find(kTimes_ms, ms) == kTimes_ms.end()) continue;
    viewer::ViewScene scene = scene_of(trial, grasp);
    scene.hands.push_back(hand_at(target, "target"));
    const std::string name = "clasp_" + std::to_string(ms);
    save(scene, folder / (name + ".glb"));
    moments.push_back({{"name", name}, {"touching", touching_links(trial)}});
  }
  return moments;
}

void write_models(const std::vector<test_support::LabelledGrasp>& grasps, std::size_t count,
                  const std::filesystem::path& folder) {
  json figures = {{"grasps", json::array()}, {"hand", write_hand(folder)}};
  for (std::size_t i = 0; i < std::min(count, grasps.size()); ++i)
    figures["grasps"].push_back(write_grasp(grasps[i], std::to_string(i + 1), folder));
  const auto ball = std::ranges::find(grasps, "ball in the whole hand", &test_support::LabelledGrasp::name);
  if (ball == grasps.end()) throw std::invalid_argument("there is no ball in the whole hand among the grasps");
  figures["clasp"] = write_clasping(*ball, folder);
  std::ofstream(folder / "figures.json") << figures.dump(1) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: grasp_models GRASPS.yaml FOLDER [COUNT]\n";
    return 2;
  }
  try {
    const auto grasps = test_support::read_labelled_grasps(argv[1]);
    write_models(grasps, argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : grasps.size(), argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
