#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/collide_method.h>
#include <glissade/apps/command.h>
#include <glissade/apps/csv.h>
#include <glissade/apps/load_or_build_tree.h>
#include <glissade/apps/poses_file.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/text.h>
#include <glissade/geometry/mesh_import.h>

namespace glissade::apps {

namespace {

constexpr const char* kCollideDescription =
    "Whether two meshes collide at each of many poses, and with how many pairs of triangles";

constexpr const char* kCollideFooter =
    "The poses file has the columns x_m,y_m,z_m,qw,qx,qy,qz: the pose of mesh B in the frame of mesh A, in metres and "
    "as\n"
    "a unit quaternion (w first; off by at most 1e-3). The answer has the columns pose (counted from 0), colliding (0 "
    "or 1)\n"
    "and, with --pairs, pairs. Touching counts as colliding; with --tolerance-m T, so does being not further apart "
    "than T.\n"
    "\n"
    "With --cache the trees are kept in the files A.dop-tree and B.dop-tree, which saves most of the time to build "
    "them.\n"
    "They belong to the content of the meshes: when that has changed, or a file is damaged, it is written anew and a "
    "line\n"
    "on standard error says so. A file that cannot be written is no failure.\n"
    "\n"
    "Examples:\n"
    "  glissade collide door.stl motor.obj --poses poses.csv\n"
    "  glissade collide door.stl motor.obj --poses poses.csv --pairs --tolerance-m 0.001 --out near.csv\n"
    "  glissade collide door.stl motor.obj --poses poses.csv --method brute-force\n"
    "  glissade collide door.stl motor.obj --poses poses.csv --cache";

struct CollideOptions {
  std::string mesh_A;
  std::string mesh_B;
  std::string poses;
  std::string method = collide_method_names().front();
  std::string out = "-";
  bool cache = false;
  CollideQuestion question;
};

std::shared_ptr<const geometry::TriangleMesh> load(const std::string& path) {
  return std::make_shared<const geometry::TriangleMesh>(geometry::import_mesh(path).mesh);
}

void check(const CollideQuestion& question) {
  if (!std::isfinite(question.tolerance) || question.tolerance < 0.0) {
    throw std::invalid_argument("--tolerance-m: must be a distance of at least 0, not " +
                                format_number(question.tolerance));
  }
}

int run(const CollideOptions& options) {
  check(options.question);
  const std::vector<Eigen::Isometry3d> poses_AB = read_poses(options.poses);
  const TreeFiles beside = options.cache ? TreeFiles{options.mesh_A, options.mesh_B} : TreeFiles{};
  const CollideMethod method =
      make_collide_method(options.method, load(options.mesh_A), load(options.mesh_B), options.question, beside);

  std::vector<std::string> columns{"pose", "colliding"};
  if (options.question.count_pairs) columns.emplace_back("pairs");
  CsvWriter out(options.out, columns);
  ProgressBar progress("poses", static_cast<std::int64_t>(poses_AB.size()));
  for (std::size_t i = 0; i < poses_AB.size(); ++i) {
    const CollideAnswer answer = method(poses_AB[i]);
    out.add(static_cast<std::int64_t>(i)).add(std::int64_t{answer.colliding});
    if (options.question.count_pairs) out.add(answer.pairs);
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
  command->add_option("A", options->mesh_A, "Mesh file: OBJ, STL, PLY or glTF, in metres")->required();
  command->add_option("B", options->mesh_B, "The other mesh file")->required();
  command->add_option("--poses", options->poses, "Poses of B in the frame of A, see below")->required();
  command->add_flag("--pairs", options->question.count_pairs, "Count the pairs of colliding triangles");
  command->add_option("--tolerance-m", options->question.tolerance, "Distance in metres that still counts")
      ->capture_default_str();
  command->add_option("--method", options->method, "How to find out")
      ->check(CLI::IsMember(collide_method_names()))
      ->capture_default_str();
  command->add_option("--out", options->out, "CSV file for the answer, - for standard output")->capture_default_str();
  command->add_flag("--cache", options->cache, kCacheHelp);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
