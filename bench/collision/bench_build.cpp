// See `run_build` in benches.h.

#include <chrono>
#include <cstdio>
#include <memory>

#include <malloc.h>
#include <tbb/global_control.h>

#include "benches.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kBuildName = "build";
constexpr std::int64_t kLargestMesh = 1'000'000;  // Glissade only

double allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

struct Figures {
  double ns = 0.0;
  double bytes = 0.0;
};

Figures build_once(const Subject& subject, const geometry::TriangleMesh& mesh) {
  const double bytes_before = allocated_bytes();
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Model> model = subject.build(mesh);
  const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
  return {ns, allocated_bytes() - bytes_before};
}

Subject on_one_thread(Subject subject) {
  subject.name += "-one-thread";
  subject.build = [build = subject.build](const geometry::TriangleMesh& mesh) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    return build(mesh);
  };
  return subject;
}

void run(const SuiteMesh& suite_mesh, const std::vector<Subject>& subjects, int rounds, Results& results) {
  const geometry::TriangleMesh mesh = suite_mesh.make();
  const auto triangles = static_cast<double>(mesh.triangles.size());
  std::vector<std::vector<double>> times(subjects.size());
  std::vector<double> bytes(subjects.size());
  for (int round = 0; round <= rounds; ++round) {  // round 0 warms up
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const Figures figures = build_once(subjects[i], mesh);
      if (round > 0) times[i].push_back(figures.ns);
      bytes[i] = figures.bytes;
    }
  }
  std::fprintf(stderr, "%s %s:", kBuildName, suite_mesh.name.c_str());
  results.add({kBuildName, suite_mesh.name, subjects[0].name, "triangles", triangles, "1"});
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const double ns = median(times[i]);
    results.add({kBuildName, suite_mesh.name, subjects[i].name, "time", ns, "ns"});
    results.add({kBuildName, suite_mesh.name, subjects[i].name, "bytes_per_triangle", bytes[i] / triangles, "B"});
    std::fprintf(stderr, " %s %.3g ms, %.0f B/triangle;", subjects[i].name.c_str(), 1e-6 * ns, bytes[i] / triangles);
  }
  std::fputc('\n', stderr);
}

}  // namespace

void run_build(const BenchOptions& options, Results& results) {
  const std::vector<Subject> ours{glissade_subject(), on_one_thread(glissade_subject())};
  const int rounds = options.quick ? 3 : 5;
  for (const SuiteMesh& mesh : suite_meshes(options.suite, options.suite.triangles))
    run(mesh, join({ours, peers()}), rounds, results);
  results.add_ratios(kBuildName, kPeers);
  if (options.quick) return;
  Suite shapes = options.suite;
  shapes.files.clear();
  for (const SuiteMesh& mesh : suite_meshes(shapes, {kLargestMesh}))
    run(mesh, ours, 1, results);
}

}  // namespace glissade::bench
