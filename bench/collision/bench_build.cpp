// See `register_build` in benches.h.

#include <memory>

#include <malloc.h>
#include <tbb/global_control.h>

#include "benches.h"
#include "register_bench.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

double allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

Subject on_one_thread(Subject subject) {
  subject.name += "-one-thread";
  subject.build = [build = subject.build](const geometry::TriangleMesh& mesh) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    return build(mesh);
  };
  return subject;
}

void measure_build(benchmark::State& state, const Subject& subject, const geometry::TriangleMesh& mesh) {
  const double bytes_before = allocated_bytes();
  std::unique_ptr<Model> model = subject.build(mesh);  // also warms up
  const double bytes = allocated_bytes() - bytes_before;
  for (auto _ : state) {
    state.PauseTiming();
    model.reset();
    state.ResumeTiming();
    model = subject.build(mesh);
  }
  const auto triangles = static_cast<double>(mesh.triangles.size());
  state.counters["build"] = seconds_each(1);
  state.counters["triangles"] = triangles;
  state.counters["bytes_per_triangle"] = bytes / triangles;
}

}  // namespace

void register_build(const Suite& suite) {
  for (const SuiteMesh& mesh : suite.meshes) {
    for (const Subject& subject : {glissade_subject(), on_one_thread(glissade_subject()), fcl_subject(), ode_subject(),
                                   bullet_subject(), cgal_subject()}) {
      register_bench("build/" + mesh.name + "/" + subject.name, [subject, pair = mesh.pair](benchmark::State& state) {
        measure_build(state, subject, *(*pair)->mesh_A);
      })->UseRealTime();
    }
  }
}

}  // namespace glissade::bench
