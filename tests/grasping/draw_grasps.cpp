/// Draws the labelled grasps: draw_grasps GRASPS.yaml FOLDER [COUNT]. Writes FOLDER/NUMBER.ppm for each, or for the
/// first COUNT only, and prints a line with the number, the name and the reason of each.

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: draw_grasps GRASPS.yaml FOLDER [COUNT]\n";
    return 2;
  }
  try {
    const auto grasps = test_support::read_labelled_grasps(argv[1]);
    draw(grasps, argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : grasps.size(), argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
