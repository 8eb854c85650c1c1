// Moves a box down a step, from one plate to another, and prints its contacts: each one when it begins, and every 250
// ms the patches that a display would draw.

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <glissade/contact/sliding.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/geometry/mesh_generators.h>

int main() {
  using namespace glissade;
  const auto mesh = [](const geometry::TriangleMesh& m) { return std::make_shared<geometry::TriangleMesh>(m); };
  const auto block_O = std::make_shared<contact::ContactBody>(mesh(geometry::make_box({0.2, 0.2, 0.02}, 500)));
  const auto box_V = std::make_shared<contact::SlidingPart>(mesh(geometry::make_box({0.06, 0.04, 0.02}, 12)));
  const std::vector<contact::Obstacle> steps{
      {block_O, Eigen::Isometry3d(Eigen::Translation3d(-0.1, 0.0, -0.010)), "upper"},     // its top is at z = 0
      {block_O, Eigen::Isometry3d(Eigen::Translation3d(0.1001, 0.0, -0.015)), "lower"}};  // 5 mm below

  contact::Sliding sliding(steps, box_V, Eigen::Isometry3d(Eigen::Translation3d(-0.05, 0.0, 0.0105)));
  contact::ContactTracker tracker(sliding.margin());
  contact::ContactPatches patches(box_V->radius());
  for (int millisecond = 0; millisecond <= 1000; ++millisecond) {
    // The hand holds the box at the height of the lower step and pushes it along x.
    const Eigen::Isometry3d X_WG(Eigen::Translation3d(-0.05 + 1.3e-4 * millisecond, 0.0, 0.003));
    const contact::SlidingResult& result = sliding.advance(X_WG);
    for (const contact::TrackedContact& tracked : tracker.update(result)) {
      if (tracked.age > 0) continue;
      const contact::Contact& c = tracked.contact;
      std::printf("%4d ms  contact %lld: %s %d / %d of %s at (%.1f, %.1f, %.1f) mm\n", millisecond,
                  static_cast<long long>(tracked.id), std::string(name_of(c.kind)).c_str(), c.part_feature,
                  c.obstacle_feature, steps[static_cast<std::size_t>(c.obstacle)].name.c_str(), 1e3 * c.p_W.x(),
                  1e3 * c.p_W.y(), 1e3 * c.p_W.z());
    }
    if (millisecond % 250 != 0) continue;
    std::printf("%4d ms  %s\n", millisecond, std::string(name_of(result.state)).c_str());
    for (const contact::ContactPatch& patch : patches.merge(tracker.contacts())) {
      std::printf("         %d contacts with %s push with %.2f N at (%.1f, %.1f, %.1f) mm\n", patch.count,
                  steps[static_cast<std::size_t>(patch.obstacle)].name.c_str(), patch.force_on_part_W.norm(),
                  1e3 * patch.p_W.x(), 1e3 * patch.p_W.y(), 1e3 * patch.p_W.z());
    }
  }
}
