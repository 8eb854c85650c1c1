/// The collision benchmarks.

#include "bench_program.h"
#include "benches.h"

namespace {

constexpr const char* kDescription =
    "Measure Glissade's collision queries beside FCL, ODE, Bullet and CGAL, on the same poses, in one thread (except\n"
    "for the benches build and threads).\n"
    "\n"
    "  zachmann     two copies of an object at all distances from 0 to just apart, boolean query\n"
    "  close        two copies of an object 0.1 %, 0.3 % and 1 % of the size apart, boolean query\n"
    "  shells       nested spheres and stacked bumpy plates, parallel and 2 % apart, boolean query\n"
    "  coherent     one part slides along another in small steps, boolean query\n"
    "  all-pairs    all intersecting pairs of triangles of two overlapping copies of an object\n"
    "  parts        meshes of --mesh, two copies and --pairs: yes or no, all pairs, distances, beside FCL and the\n"
    "               method of PQP\n"
    "  build        time and memory of building\n"
    "  hull         one convex hull turns and goes round another in small steps, boolean query\n"
    "  scene        10 to 1000 objects bounce about in a box: which pairs meet, frame by frame\n"
    "  threads      dense and sparse scenes and all pairs of large meshes, Glissade on 1, 2, 4 and 8 threads\n"
    "  realignment  realignment of a node of the tree, by offsets and by vertices\n"
    "\n"
    "An iteration is a pass over all poses or frames of a case. The counters query, frame, build and child are "
    "seconds\n"
    "for one of them; disagreements are answers that differ from Glissade's, which are exact.";

void register_benches(const glissade::bench::BenchOptions& options) {
  using namespace glissade::bench;
  const Suite suite = make_suite(options);
  register_zachmann(suite);
  register_close(suite);
  register_shells(suite);
  register_coherent(suite);
  register_all_pairs(suite);
  register_parts(suite);
  register_build(suite);
  register_hull(suite);
  register_scene(suite);
  register_threads(suite);
  register_realignment();
}

}  // namespace

int main(int argc, char** argv) {
  return glissade::bench::run_bench_program(argc, argv, kDescription, register_benches);
}
