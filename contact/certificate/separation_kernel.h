#pragma once

/// The vector code of lasting separations: directions that separate eight pairs of triangles at both ends of a path.
/// The same bits with every instruction set.

#include <array>

#include <Eigen/Core>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::contact {

using NumbersOfPairs = std::array<double, geometry::kPairsToMeasure>;

/// Maps the coordinates x of a part's corners to those of the obstacle's frame: A x + t.
struct CornerMap {
  Eigen::Matrix3d A;
  Eigen::Vector3d t;  ///< metres
};

/// A path of a part, in the frame of the obstacle, which stays.
struct PathOfPart {
  CornerMap begin;
  CornerMap end;
  /// Maps a direction at the beginning to that at the end if it turns with the part.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  bool turns = false;  ///< the part turns at all
  double gap;          ///< metres by which a direction fixed to the obstacle must separate at both ends
  double gap_turning;  ///< metres: the same for one that turns with the part
};

/// Eight pairs on a path, in the frame of the obstacle; and the best direction found for each.
struct alignas(64) PairsOnPath {
  geometry::TrianglesToMeasure begin;  ///< the obstacle's triangles, and the part's
  geometry::TrianglesToMeasure end;
  geometry::VectorsOfPairs motion;  ///< of the part's centre: a unit vector, or zero
  geometry::VectorsOfPairs n;       ///< unit, from the obstacle to the part, at the beginning; zero if none was found
  NumbersOfPairs gap_at_begin;      ///< metres, along n
  NumbersOfPairs gap_at_end;
  NumbersOfPairs paths;               ///< how many such paths n serves for; negative if it does not for this one
  NumbersOfPairs may_turn_with_part;  ///< 1 or 0
  NumbersOfPairs turns_with_part;     ///< 1 if n does, 0 if it is fixed to the obstacle
  NumbersOfPairs turning;             ///< metres, along a direction that turns; minus infinity if none was tried
};

/// Sets all of `pairs` but `may_turn_with_part`, for triangles of the obstacle, and of the part in its own frame. n is
/// the best of the normals of both triangles, the one between, and these across the motion; each fixed to either body.
void separate_by_normals(const geometry::TrianglesToMeasure& triangles, const PathOfPart& path, PairsOnPath& pairs);

/// For pairs whose direction serves for fewer than `enough` paths, also tries the one from point to point, and this one
/// across the motion.
void separate_by_points(const geometry::ClosestPoints& points, const PathOfPart& path, double enough,
                        PairsOnPath& pairs);

/// For pairs whose direction does not serve for this path, tries the one that turns evenly from the closest points at
/// the beginning to those at the end.
void separate_by_turning(const geometry::ClosestPoints& begin, const geometry::ClosestPoints& end, PairsOnPath& pairs);

}  // namespace glissade::contact
