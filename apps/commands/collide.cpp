#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/collide_method.h>
#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/load_or_build_tree.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/files/csv.h>
#include <glissade/files/pose_files.h>

namespace glissade::apps {

namespace {

constexpr const char* kCollideDescription =
    "Test two meshes for collision at one or many poses, and measure their distance";

constexpr const char* kCollideFooter =
    "Poses: columns x_m,y_m,z_m,qw,qx,qy,qz. Each row is the pose of mesh B in the frame of mesh A: a position in\n"
    "metres and a unit quaternion, w first. The length of the quaternion may deviate from 1 by up to 1e-3. Without\n"
    "--poses, the frames of A and B coincide.\n"
    "\n"
    "Output: one row per pose with the columns pose (counted from 0), colliding (0 or 1) and, with --pairs, pairs.\n"
    "Touching counts as colliding. With --tolerance-m T, meshes at a distance of at most T also count as colliding.\n"
    "With --distance, more columns have the exact distance, the nearest points in the frame of A, and the triangles\n"
    "of these points. Points and triangles are empty if the meshes intersect; then the distance is 0.\n"
    "\n"
    "--cache stores the DOP-trees (bounding-volume hierarchies) in the files A.dop-tree and B.dop-tree. Later runs\n"
    "read these files, which saves most of the time of building the trees. If a file is damaged or does not match its\n"
    "mesh, the command rewrites the file and reports this on standard error. If a file cannot be written, the command\n"
    "reports this on standard error and continues.\n"
    "\n"
    "Examples, with the files of 'glissade example':\n"
    "  glissade collide panel.obj motor.obj --distance\n"
    "  glissade collide panel.obj motor.obj --poses poses.csv\n"
    "  glissade collide panel.obj motor.obj --poses poses.csv --pairs --tolerance-m 0.001 --out near.csv\n"
    "  glissade collide panel.obj motor.obj --poses poses.csv --cache";

constexpr std::array<const char*, 9> kDistanceColumns{"distance_m", "ax_m", "ay_m",       "az_m",      "bx_m",
                                                      "by_m",       "bz_m", "triangle_a", "triangle_b"};

struct CollideOptions {
  std::string mesh_A;
  std::string mesh_B;
  std::optional<std::string> poses;
  std::string method = collide_method_names().front();
  std::string out = "-";
  bool cache = false;
  std::vector<double> scales;  // none, one for both, or one for each
  CollideQuestion question;
};

std::shared_ptr<const geometry::TriangleMesh> load(const std::string& path, double scale) {
  std::shared_ptr<const geometry::TriangleMesh> mesh = open_mesh(path, scale);
  const double size = size_of(*mesh);
  if (is_doubtful(size, scale)) warn(path + ": is " + told_size(size, scale, "--scale "));
  return mesh;
}

void add(const collision::MeshDistance& measured, CsvWriter& out) {
  out.add(measured.distance);
  if (measured.nearest) {
    const collision::ClosePair& nearest = *measured.nearest;
    out.add(nearest.p_A).add(nearest.p_B);
    out.add(std::int64_t{nearest.triangles.triangle_A}).add(std::int64_t{nearest.triangles.triangle_B});
  } else {
    for (std::size_t i = 1; i < kDistanceColumns.size(); ++i)
      out.add("");
  }
}

/// Whether any pose brings the meshes as near as ten times the size of the larger one.
bool any_is_near(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B,
                 const std::vector<Eigen::Isometry3d>& poses_AB) {
  const Eigen::AlignedBox3d a = geometry::bounds_of(mesh_A);
  const Eigen::AlignedBox3d b = geometry::bounds_of(mesh_B);
  constexpr double kFar = 10.0;  // sizes
  const double near = kFar * std::max(a.diagonal().norm(), b.diagonal().norm());
  return std::any_of(poses_AB.begin(), poses_AB.end(),
                     [&](const Eigen::Isometry3d& X_AB) { return (X_AB * b.center() - a.center()).norm() <= near; });
}

void check(const CollideQuestion& question) {
  if (!std::isfinite(question.tolerance) || question.tolerance < 0.0) {
    throw std::invalid_argument("--tolerance-m: must be a distance of at least 0, not " +
                                format_number(question.tolerance));
  }
}

int run(const CollideOptions& options) {
  check(options.question);
  const std::vector<Eigen::Isometry3d> poses_AB =
      options.poses ? read_poses(*options.poses) : std::vector{Eigen::Isometry3d::Identity()};
  const TreeFiles beside = options.cache ? TreeFiles{options.mesh_A, options.mesh_B} : TreeFiles{};
  const bool has_scales = !options.scales.empty();
  const auto mesh_A = load(options.mesh_A, has_scales ? options.scales.front() : 1.0);
  const auto mesh_B = load(options.mesh_B, has_scales ? options.scales.back() : 1.0);
  if (!any_is_near(*mesh_A, *mesh_B, poses_AB)) {
    const std::string meshes =
        "the meshes, " + rounded_text(size_of(*mesh_A)) + " m and " + rounded_text(size_of(*mesh_B)) + " m across, ";
    warn(options.poses
             ? *options.poses + ": no pose brings " + meshes + "near each other: are poses and meshes in metres?"
             : meshes + "stand far from each other: are both in metres?");
  }
  const CollideMethod method = make_collide_method(options.method, mesh_A, mesh_B, options.question, beside);

  std::vector<std::string> columns{"pose", "colliding"};
  if (options.question.count_pairs) columns.emplace_back("pairs");
  if (options.question.measure) columns.insert(columns.end(), kDistanceColumns.begin(), kDistanceColumns.end());
  CsvWriter out(options.out, columns);
  ProgressBar progress("poses", static_cast<std::int64_t>(poses_AB.size()));
  for (std::size_t i = 0; i < poses_AB.size(); ++i) {
    const CollideAnswer answer = method(poses_AB[i]);
    out.add(static_cast<std::int64_t>(i)).add(std::int64_t{answer.colliding});
    if (options.question.count_pairs) out.add(answer.pairs);
    if (options.question.measure) add(answer.distance, out);
    out.end_row();
    progress.update(static_cast<std::int64_t>(i) + 1);
  }
  out.close();
  return 0;
}

}  // namespace

void add_collide_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<CollideOptions>();
  CLI::App* command = app.add_subcommand("collide", kCollideDescription);
  command->footer(kCollideFooter);
  command->add_option("A", options->mesh_A, "Mesh file: OBJ, STL, PLY or glTF, in metres or with --scale")->required();
  command->add_option("B", options->mesh_B, "Second mesh file")->required();
  command->add_option("--poses", options->poses, "CSV file of the poses of B in the frame of A, see below");
  command
      ->add_option("--scale", options->scales,
                   "Metres per unit of the meshes: 0.001 for millimetres. Two numbers: one for A, one for B")
      ->expected(1, 2)
      ->check(positive());
  command->add_flag("--pairs", options->question.count_pairs, "Count the colliding pairs of triangles");
  command->add_flag("--distance", options->question.measure, "Measure the distance, and print the nearest points");
  command->add_option("--tolerance-m", options->question.tolerance, "Greatest distance (m) that counts as a collision")
      ->capture_default_str();
  command->add_option("--method", options->method, "Search with DOP-trees or, as a check, test all pairs of triangles")
      ->check(one_of(collide_method_names()))
      ->capture_default_str();
  command->add_option("--out", options->out, "CSV file for the output, - for standard output")->capture_default_str();
  command->add_flag("--cache", options->cache, kCacheHelp);
  add_strict_option(*command);
  add_quiet_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
