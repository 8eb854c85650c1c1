/// Draws the labelled grasps: draw_grasps GRASPS.yaml FOLDER [COUNT]. Writes FOLDER/NUMBER.ppm for each, or for the
/// first COUNT only, and prints a line with the number, the name and the reason of each. Writes also FOLDER/hand.ppm,
/// the segments of the hand, and FOLDER/clasp.ppm, how a hand closes round a ball.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "grasp_picture.h"
#include "labelled_grasps.h"

namespace {

using namespace glissade;

void draw(const std::vector<test_support::LabelledGrasp>& grasps, std::size_t count,
          const std::filesystem::path& folder) {
  constexpr int kSize = 200;
  for (std::size_t i = 0; i < std::min(count, grasps.size()); ++i) {
    test_support::GraspTrial trial(grasps[i]);
    const grasping::Grasp grasp = trial.close();
    test_support::draw_grasp(trial, grasps[i], kSize).save(folder / (std::to_string(i + 1) + ".ppm"));
    std::cout << i + 1 << " | " << grasps[i].name << " | " << reason_of(grasp) << "\n";
  }
}

void draw_method(const std::vector<test_support::LabelledGrasp>& grasps, const std::filesystem::path& folder) {
  constexpr int kHandSize = 320;
  constexpr int kClaspSize = 220;
  constexpr std::array kTimes_ms{60, 200, 240, 300};
  Eigen::Matrix3d from_palm;  // x of the hand upwards, its palm towards the eye
  from_palm << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  Eigen::Matrix3d from_thumb;  // fingers to the left, the back of the hand up
  from_thumb << -1.0, 0.0, 0.0, 0.0, -0.34, 0.94, 0.0, 0.94, 0.34;
  test_support::draw_segments(*test_support::hand_model(), from_palm, kHandSize).save(folder / "hand.ppm");
  const auto ball = std::find_if(grasps.begin(), grasps.end(),
                                 [](const auto& grasp) { return grasp.name == "ball in the whole hand"; });
  if (ball == grasps.end()) throw std::invalid_argument("there is no ball in the whole hand among the grasps");
  const auto pictures = test_support::draw_clasping(*ball, kTimes_ms, from_thumb, kClaspSize);
  test_support::Picture strip = test_support::blank(kClaspSize * static_cast<int>(pictures.size()), kClaspSize);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    strip.paste(pictures[i], kClaspSize * static_cast<int>(i), 0);
  strip.save(folder / "clasp.ppm");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: draw_grasps GRASPS.yaml FOLDER [COUNT]\n";
    return 2;
  }
  try {
    const auto grasps = test_support::read_labelled_grasps(argv[1]);
    draw(grasps, argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : grasps.size(), argv[2]);
    draw_method(grasps, argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
