// A hundred balls oscillate while the collision thread finds the colliding pairs. The loop that moves the balls never
// waits for that thread.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <thread>
#include <vector>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/geometry/mesh_generators.h>

int main() {
  using namespace glissade;
  const auto mesh = std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.05, 2000));
  const auto tree = std::make_shared<collision::DopTree>(mesh);  // one for all balls
  const auto hull = std::make_shared<collision::ConvexHull>(*mesh);

  // The pose of ball i in a given millisecond.
  const auto place = [](int i, int millisecond) {
    const int row = i / 10;
    const double swing = 0.03 * std::sin(0.02 * millisecond + i);
    return Eigen::Isometry3d(Eigen::Translation3d(0.12 * (i % 10) + swing, 0.12 * row, 0.0));
  };

  collision::World world;
  std::vector<collision::ObjectId> balls;
  for (int i = 0; i < 100; ++i)
    balls.push_back(world.add({tree, hull, place(i, 0)}));
  world.disable_pair(balls[0], balls[1]);  // these two are glued together

  realtime::SteadyClock clock;
  collision::CollisionThread thread(world, clock);
  std::size_t most = 0;
  collision::FrameReport sum;
  std::int64_t frames = 0;
  for (int millisecond = 0; millisecond < 500; ++millisecond) {
    for (int i = 0; i < 100; ++i)
      world.move(balls[static_cast<std::size_t>(i)], place(i, millisecond));
    if (thread.reader().update()) {  // a new frame
      const collision::FrameResult& frame = thread.reader().frame();
      most = std::max(most, frame.meeting.size());
      sum += frame.report;
      ++frames;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const auto us_each = [&](std::chrono::nanoseconds time) {
    return 1e-3 * static_cast<double>(time.count()) / static_cast<double>(frames);
  };
  std::cout << "Up to " << most << " pairs of balls meet at once. A frame took " << us_each(sum.total) << " us:\n"
            << "  moved objects        " << us_each(sum.queue.time) << " us\n"
            << "  neighboring pairs    " << us_each(sum.neighbor_finding.time) << " us\n"
            << "  separating planes    " << us_each(sum.separating_planes.time) << " us\n"
            << "  triangles            " << us_each(sum.exact.time) << " us\n";
  return most > 0 ? 0 : 1;
}
