#pragma once

/// The benchmarks, by the names of the command line. Each adds its rows to the results.

#include "bench_options.h"
#include "interleaved_passes.h"
#include "results.h"

namespace glissade::bench {

/// Name of the next two in the results.
constexpr const char* kZachmannName = "zachmann";

/// Two copies of an object at Zachmann's poses (paper §2.1.2): for random orientations and axes of approach, distances
/// from 0 up to the separation of the bounding boxes; the time is averaged over all. Figure 3 of the paper.
void run_zachmann(const BenchOptions& options, Results& results);

/// Cases of the same bench that do not count for its ratios: a pair of spheres three radii apart, and, unless quick,
/// Glissade at a million triangles, with the growth of its time from a thousand on (geometric mean over the shapes).
void run_extremes(const BenchOptions& options, Results& results);

/// Two copies of an object at distances of 0.1 %, 0.3 % and 1 % of the size.
void run_close(const BenchOptions& options, Results& results);

/// Parallel surfaces 2 % of half the size apart, the worst case of every bounding-volume hierarchy: nested spheres and
/// stacked bumpy plates.
void run_shells(const BenchOptions& options, Results& results);

/// A part of 0.1 m slides along another in steps of 0.01 mm and 0.005 degrees, at several gaps and colliding: queries
/// with and without memory of the last query.
void run_coherent(const BenchOptions& options, Results& results);

/// Separation tests of two convex hulls: one turns and circles the other in steps of 0.05 to 5 degrees, at gaps of 1e-2
/// to 1e-6 of the size and at a depth of 1e-3.
void run_hull(const BenchOptions& options, Results& results);

/// All intersecting pairs of triangles of two overlapping copies of an object.
void run_all_pairs(const BenchOptions& options, Results& results);

/// Meshes of the user, two copies or pairs of a list: yes or no at Zachmann's poses and at gaps of 0.1 % and 1 % of the
/// size, all pairs, and distances at 0.1 %, 1 % and 10 %, also while sliding. Beside FCL and PQP's published method
/// only. The case is the question and the name of the part. Nothing without `--mesh`.
void run_parts(const BenchOptions& options, Results& results);

/// Time and memory of building, including a copy of the mesh. Bytes are those allocated by malloc.
void run_build(const BenchOptions& options, Results& results);

/// 10 to 1,000 objects fly about in a box: the colliding pairs in every frame. Figure 5 of the paper, in one thread.
/// Also one moving object among 10 and among 1,000 objects at rest.
void run_scene(const BenchOptions& options, Results& results);

/// Glissade on several threads beside one: a dense and a sparse scene, and all pairs of triangles of two large meshes.
void run_threads(const BenchOptions& options, Results& results);

PassLimits pass_limits(const BenchOptions& options);

}  // namespace glissade::bench
