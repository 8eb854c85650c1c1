#pragma once

/// Warnings of sizes that are probably an error in units: CAD systems write millimetres, and this program reads metres.

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::apps {

/// The largest side of the bounding box, metres.
double size_of(const geometry::TriangleMesh& mesh);

/// "60 m across", and what may be wrong for an option or a key, if the size is doubtful: "60 m across: millimetres?
/// --scale 0.001". `scale` is the present one.
std::string told_size(double size_m, double scale, const std::string& option);
/// Whether `told_size` doubts this size: more than a car has, or less than a millimetre though a scale was given.
bool is_doubtful(double size_m, double scale);

/// One sentence for each doubtful object. A mesh file is doubtful if it is larger than a car, or is scaled to less than
/// a millimetre. A movable object is doubtful if no hand could hold it, because it is larger than 2 m.
std::vector<std::string> doubtful_objects(const Scene& file);

/// The same, and a sentence for each part that is thousands of times as large as all obstacles, or as small. `file` is
/// what `scene` was made of.
std::vector<std::string> doubtful_sizes(const Scene& file, const HapticScene& scene);

/// What is doubtful in a trajectory with these positions (metres): that it leads much farther than everything in the
/// scene reaches. Empty if nothing is.
std::string doubt_of_positions(const Eigen::AlignedBox3d& positions, const HapticScene& scene);

}  // namespace glissade::apps
