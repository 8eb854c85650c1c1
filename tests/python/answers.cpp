// Answers of the library in C++, for the tests of the module for Python:
//   python_answers queries POSES OUT    a small sphere beside a torus, at each pose X_AB: as 6 doubles, whether they
//                                       intersect, their distance, the triangles of the closest points, and the
//                                       median times (s) of all the first answers and of all the second
//   python_answers slide GHOSTS OUT     a box on a plate follows each pose: X_WV, row by row, and the force on the hand
// POSES and GHOSTS are matrices of 16 doubles, row by row.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/simulation/simulation.h>

namespace {

using namespace glissade;
using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

std::vector<Eigen::Isometry3d> read_poses(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<Eigen::Isometry3d> poses(bytes.size() / sizeof(Matrix));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Matrix matrix;
    std::copy_n(bytes.data() + i * sizeof(Matrix), sizeof(Matrix), reinterpret_cast<char*>(matrix.data()));
    poses[i].matrix() = matrix;
  }
  return poses;
}

class Output {
 public:
  explicit Output(const char* path) : file_(path, std::ios::binary) {}
  void put(double value) { file_.write(reinterpret_cast<const char*>(&value), sizeof(value)); }

 private:
  std::ofstream file_;
};

/// The median of five runs.
double seconds_of(const auto& work) {
  std::array<double, 5> times;
  for (double& time : times) {
    const auto start = std::chrono::steady_clock::now();
    work();
    time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::ranges::sort(times);
  return times[2];
}

void answer_queries(const std::vector<Eigen::Isometry3d>& X_AB, Output& out) {
  const collision::DopTree torus(std::make_shared<geometry::TriangleMesh>(geometry::make_torus(0.08, 0.03, 50'000)));
  const collision::DopTree sphere(std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.04, 50'000)));
  collision::QueryWorkspace workspace;
  std::vector<char> meets(X_AB.size());
  std::vector<collision::MeshDistance> distances(X_AB.size());
  const double of_meets = seconds_of([&] {
    for (std::size_t i = 0; i < X_AB.size(); ++i)
      meets[i] = intersects(torus, sphere, X_AB[i], workspace);
  });
  const double of_distances = seconds_of([&] {
    for (std::size_t i = 0; i < X_AB.size(); ++i)
      distances[i] = distance(torus, sphere, X_AB[i], workspace);
  });
  for (std::size_t i = 0; i < X_AB.size(); ++i) {
    const auto& nearest = distances[i].nearest;
    out.put(meets[i]);
    out.put(distances[i].distance);
    out.put(nearest ? nearest->triangles.triangle_A : -1);
    out.put(nearest ? nearest->triangles.triangle_B : -1);
    out.put(of_meets);
    out.put(of_distances);
  }
}

void answer_slide(const std::vector<Eigen::Isometry3d>& X_WG, Output& out) {
  simulation::Simulation simulation({.objects = {{"plate", geometry::make_plate({0.4, 0.4}, 200)},
                                                 {"box", geometry::make_box({0.1, 0.06, 0.04}, 1200),
                                                  Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.030)), true}}});
  for (const Eigen::Isometry3d& ghost : X_WG) {
    simulation.advance(ghost);
    const Matrix X_WV = simulation.X_WV(0).matrix();
    for (const double value : X_WV.reshaped<Eigen::RowMajor>())
      out.put(value);
    for (const double value : simulation.wrench(0).f)
      out.put(value);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  Output out(argv[3]);
  (argv[1] == std::string("slide") ? answer_slide : answer_queries)(read_poses(argv[2]), out);
}
