#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/command.h>
#include <glissade/apps/csv.h>
#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/text.h>
#include <glissade/apps/trajectory_file.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding.h>

namespace glissade::apps {

namespace {

constexpr const char* kDescription = "Lead a part through a scene along a trajectory, offline and deterministically";

constexpr const char* kFooter =
    "The trajectory has the columns t_s,x_m,y_m,z_m,qw,qx,qy,qz: the pose X_WG of the ghost, which is where the hand\n"
    "wants the part, at rising times; between rows it moves straight and turns evenly. The part starts at the first\n"
    "row's pose, which must be free. The answer has one row per millisecond: ghost pose, visible pose, the wrench on\n"
    "the hand at the part's origin in world axes, the number of contacts that push, and the state of the sliding.\n"
    "\n"
    "Metaphors:\n"
    "  force-feedback      rigid grasp: the device holds the hand back, the part catches up at a limited speed\n"
    "  rubber-band         the part hangs on the ghost by its middle; only what it touches turns it, no torque\n"
    "  rubber-band-spring  rubber band and spiral spring: the part catches up at once\n"
    "  incremental         the part repeats each motion of the ghost from where it is; what is refused is forgotten\n"
    "\n"
    "Example:\n"
    "  glissade slide door.yaml --part motor --trajectory hand.csv --out motion.csv";

struct Options {
  std::string scene;
  std::string part;
  std::string trajectory;
  std::string metaphor = "force-feedback";
  std::string out = "-";
};

haptics::Metaphor parse_metaphor(const std::string& name) {
  const auto metaphor = haptics::metaphor_from_name(name);
  if (metaphor) return *metaphor;
  std::string known;
  for (const std::string_view one : haptics::kMetaphorNames)
    known += (known.empty() ? "" : ", ") + std::string(one);
  throw std::invalid_argument("--metaphor: '" + name + "' is unknown; known are " + known);
}

std::vector<std::string> columns() {
  return {"t_s", "gx_m", "gy_m", "gz_m", "gqw",  "gqx",  "gqy",   "gqz",   "vx_m",  "vy_m",     "vz_m", "vqw",
          "vqx", "vqy",  "vqz",  "fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm", "contacts", "state"};
}

void add_pose(CsvWriter& out, const Eigen::Isometry3d& X) {
  Eigen::Quaterniond q(X.linear());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  out.add(X.translation().x()).add(X.translation().y()).add(X.translation().z());
  out.add(q.w()).add(q.x()).add(q.y()).add(q.z());
}

void add_row(CsvWriter& out, double time_s, const haptics::Sliding& sliding) {
  const haptics::SlidingResult& result = sliding.result();
  const Eigen::Vector3d& p_Vref = sliding.part().p_Vref();
  const haptics::Wrench wrench = haptics::about_point(haptics::spring_wrench(sliding.stiffness(), sliding.error()),
                                                      result.X_WT * p_Vref, result.X_WV.translation());
  out.add(time_s);
  add_pose(out, result.X_WG);
  add_pose(out, result.X_WV);
  // Adding zero turns a negative zero into the plain one.
  for (int i = 0; i < 3; ++i)
    out.add(wrench.f[i] + 0.0);
  for (int i = 0; i < 3; ++i)
    out.add(wrench.t[i] + 0.0);
  out.add(std::int64_t{result.pushing}).add(haptics::name_of(result.state));
  out.end_row();
}

std::unique_ptr<haptics::Sliding> start(const HapticScene& scene, const Eigen::Isometry3d& X_WV_start,
                                        haptics::Metaphor metaphor, const std::string& trajectory) {
  try {
    return std::make_unique<haptics::Sliding>(scene.obstacles, scene.part_V, X_WV_start,
                                              haptics::SlidingOptions{.metaphor = metaphor});
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(trajectory + ": " + error.what() + ", the pose of the first row");
  }
}

/// At most a day: some 20 GB of rows, and more is a slip of the unit of t_s.
void check_duration(const devices::PoseTrajectory& trajectory, const std::string& file) {
  constexpr std::chrono::hours kLongest{24};
  if (trajectory.duration() <= kLongest) return;
  const double duration_s = std::chrono::duration<double>(trajectory.duration()).count();
  throw std::invalid_argument(file + ": lasts " + format_number(duration_s) + " s, longer than a day (86400 s)");
}

int run(const Options& options) {
  const haptics::Metaphor metaphor = parse_metaphor(options.metaphor);
  const HapticScene scene = make_haptic_scene(read_scene(options.scene), options.part);
  const devices::PoseTrajectory trajectory = read_trajectory(options.trajectory);
  check_duration(trajectory, options.trajectory);
  const auto sliding = start(scene, trajectory.pose_at(trajectory.first_time()), metaphor, options.trajectory);

  using std::chrono::milliseconds;
  const std::int64_t ticks = trajectory.duration() / milliseconds(1);
  CsvWriter out(options.out, columns());
  ProgressBar progress("sliding", ticks + 1);
  for (std::int64_t i = 0; i <= ticks; ++i) {
    const std::chrono::nanoseconds time = trajectory.first_time() + i * milliseconds(1);
    sliding->advance(trajectory.pose_at(time));
    add_row(out, std::chrono::duration<double>(time).count(), *sliding);
    progress.update(i + 1);
  }
  out.close();
  return 0;
}

}  // namespace

void add_slide_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("slide", kDescription);
  command->footer(kFooter);
  command->add_option("SCENE", options->scene, "Scene file (YAML)")->required();
  command->add_option("--part", options->part, "Name of the object in the hand")->required();
  command->add_option("--trajectory", options->trajectory, "Poses of the ghost over time (CSV), see below")->required();
  command->add_option("--metaphor", options->metaphor, "How hand and part are tied")->capture_default_str();
  command->add_option("--out", options->out, "CSV file for the answer, - for standard output")->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
