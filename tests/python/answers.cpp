// Answers of the library in C++, for the tests of the module for Python:
//   python_answers queries POSES OUT    a small sphere beside a torus, at each pose X_AB: as 10 doubles, whether they
//                                       intersect, their distance, and triangles and coordinates of the closest points
//   python_answers slide GHOSTS OUT     a box on a plate follows each pose: X_WV, row by row, and the force on the hand
// POSES and GHOSTS are matrices of 16 doubles, row by row.
#include <cstddef>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/simulation/simulation.h>

#include "pose_matrices.h"

namespace {

using namespace glissade;

class Output {
 public:
  explicit Output(const char* path) : file_(path, std::ios::binary) {}
  void put(double value) { file_.write(reinterpret_cast<const char*>(&value), sizeof(value)); }

 private:
  std::ofstream file_;
};

const Eigen::Vector3d kNone = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

void answer_queries(const std::vector<Eigen::Isometry3d>& X_AB, Output& out) {
  const collision::DopTree torus(std::make_shared<geometry::TriangleMesh>(geometry::make_torus(0.08, 0.03, 50'000)));
  const collision::DopTree sphere(std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.04, 50'000)));
  collision::QueryWorkspace workspace;
  for (const Eigen::Isometry3d& X : X_AB) {
    out.put(intersects(torus, sphere, X, workspace));
    const collision::MeshDistance answer = distance(torus, sphere, X, workspace);
    out.put(answer.distance);
    out.put(answer.nearest ? answer.nearest->triangles.triangle_A : -1);
    out.put(answer.nearest ? answer.nearest->triangles.triangle_B : -1);
    for (const Eigen::Vector3d& p :
         {answer.nearest ? answer.nearest->p_A : kNone, answer.nearest ? answer.nearest->p_B : kNone})
      for (const double coordinate : p)
        out.put(coordinate);
  }
}

void answer_slide(const std::vector<Eigen::Isometry3d>& X_WG, Output& out) {
  simulation::Simulation simulation({.objects = {{"plate", geometry::make_plate({0.4, 0.4}, 200)},
                                                 {"box", geometry::make_box({0.1, 0.06, 0.04}, 1200),
                                                  Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.030)), true}}});
  for (const Eigen::Isometry3d& ghost : X_WG) {
    simulation.advance(ghost);
    const test_support::PoseMatrix X_WV = simulation.X_WV(0).matrix();
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
  (argv[1] == std::string("slide") ? answer_slide : answer_queries)(test_support::read_poses(argv[2]), out);
}
