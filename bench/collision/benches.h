#pragma once

/// The benches of collision_bench. Each registers its benchmarks, named BENCH/CASE/SUBJECT. Slow subjects take a sample
/// of the poses, as the case `CASE-sample`.

#include "suite.h"

namespace glissade::bench {

/// Two copies of an object at Zachmann's poses (paper §2.1.2): for random orientations and axes of approach, distances
/// from 0 up to the separation of the bounding boxes. Figure 3 of the paper. Also a pair of spheres three radii apart,
/// and, unless quick, Glissade at a million triangles.
void register_zachmann(const Suite& suite);

/// Two copies of an object at distances of 0.1 %, 0.3 % and 1 % of the size.
void register_close(const Suite& suite);

/// Parallel surfaces 2 % of half the size apart, the worst case of every bounding-volume hierarchy: nested spheres and
/// stacked bumpy plates.
void register_shells(const Suite& suite);

/// A part slides along another in small steps, at several gaps and colliding: queries with and without memory of the
/// last query.
void register_coherent(const Suite& suite);

/// All intersecting pairs of triangles of two overlapping copies of an object.
void register_all_pairs(const Suite& suite);

/// Meshes of the user, two copies or pairs of a list: yes or no at Zachmann's poses and at gaps of 0.1 % and 1 % of the
/// size, all pairs, and distances at 0.1 %, 1 % and 10 %, also while sliding. Beside FCL and PQP's published method
/// only. The case is QUESTION:PART.
void register_parts(const Suite& suite);

/// Time and memory of building, including a copy of the mesh. Bytes are those allocated by malloc.
void register_build(const Suite& suite);

/// Separation tests of two convex hulls: one turns and circles the other in steps of 0.05 to 5 degrees, at gaps of 1e-2
/// to 1e-6 of the size and at a depth of 1e-3.
void register_hull(const Suite& suite);

/// 10 to 1,000 objects fly about in a box: the colliding pairs in every frame. Figure 5 of the paper, in one thread.
/// Also one moving object among 10 and among 1,000 objects at rest.
void register_scene(const Suite& suite);

/// Glissade on several threads beside one: a dense and a sparse scene, and all pairs of triangles of two large meshes.
void register_threads(const Suite& suite);

/// Realignment of a node by three weighted offsets (paper §2.1, eq. 1) beside the projection of all its vertices
/// (§2.1.1).
void register_realignment();

}  // namespace glissade::bench
