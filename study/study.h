#pragma once

/// A study: a part slides many times through a scene. In each slide, the parameters of the study have other values.

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/simulation/scene.h>
#include <glissade/study/distribution.h>
#include <glissade/study/strata.h>

namespace glissade::study {

/// What a parameter changes.
enum class TargetKind : std::uint8_t {
  kPath,        ///< displaces the whole path of the ghost, the pose that the part would have if nothing were in the way
  kStart,       ///< displaces the start of the path, and less and less up to its end
  kEnd,         ///< displaces the end of the path, and less and less up to its start
  kGoal,        ///< displaces the goal
  kPose,        ///< displaces an object
  kScale,       ///< scales the mesh of an object
  kShape,       ///< a parameter of the shape of an object
  kMesh,        ///< the mesh of an object
  kCompliance,  ///< the compliance point of the part
  kFriction,
  kStiffness,
  kMetaphor,
  kTrajectory,
};

struct Target {
  TargetKind kind{};
  std::size_t object = 0;  ///< number of the object in the scene
  /// Of displacements and scales: x, y, z, roll, pitch, yaw. `kAllAxes` scales along all axes.
  int axis = 0;
  std::string shape_parameter{};

  static constexpr int kAllAxes = -1;
};

/// The names of the axes of a displacement, in file and table.
inline constexpr std::array<std::string_view, 6> kAxisNames{"x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg"};

struct Parameter {
  std::string name;
  std::vector<Target> targets;  ///< all get the same value
  Distribution distribution;
  int steps = 0;                                ///< number of values, for the grid
  std::vector<simulation::SceneMesh> meshes{};  ///< for `kMesh`, by index of `OneOf`
};

enum class Sampling : std::uint8_t { kRandom, kLatinHypercube, kSobol, kStratified, kGrid };
inline constexpr std::array<std::string_view, 5> kSamplingNames{"random", "latin-hypercube", "sobol", "stratified",
                                                                "grid"};

/// What counts as success. The part must end near the goal. The other limits must hold during the whole slide.
struct Success {
  double distance_m = 0.3e-3;
  double angle_deg = 0.5;
  double force_N = std::numeric_limits<double>::infinity();
  double torque_Nm = std::numeric_limits<double>::infinity();
  double clearance_m = 0.0;  ///< the least clearance must not be smaller
};

/// The columns that a row may have besides its parameters and the outcome.
enum class Record : std::uint8_t { kForces, kClearance, kTime, kJam, kWork, kLastPose };
inline constexpr std::array<std::string_view, 6> kRecordNames{"forces", "clearance", "time",
                                                              "jam",    "work",      "last_pose"};

struct Study {
  std::string source;  ///< name of the file
  simulation::Scene scene;
  std::string part;
  std::vector<std::string> trajectory_names;                ///< as in the file
  std::vector<geometry::PoseTrajectory> trajectories_X_WG;  ///< of the ghost
  std::vector<Parameter> parameters;
  Sampling sampling = Sampling::kSobol;
  std::int64_t slides = 0;
  std::uint64_t seed = 1;
  std::filesystem::path pilot{};           ///< folder with the results of a pilot, for `kStratified`
  std::shared_ptr<const Strata> strata{};  ///< for `kStratified`
  Success success{};
  contact::Metaphor metaphor = contact::Metaphor::kForceFeedback;
  double stiffness_N_per_m = contact::kUsualStiffness_N_per_m;
  contact::SlidingRules rules{};
  std::array<bool, kRecordNames.size()> records{};

  bool has(Record record) const { return records[static_cast<std::size_t>(record)]; }
};

/// Reads a study, its scene and all files that they name. docs/studies.md has all keys. Throws std::invalid_argument
/// for every deviation from the format. The message is one line with the file, the line and the key or value. May block
/// on the disk. Thread-safe.
Study read_study(const std::filesystem::path& path);

/// A hash of all that the slides of a study have in common: meshes, poses, trajectories, rules and the version of
/// Glissade. `bodies` are those of the scene, and of the scene with each mesh that a parameter may choose.
std::uint64_t hash_of(const Study& study, std::span<const simulation::SceneBodies> bodies);

}  // namespace glissade::study
