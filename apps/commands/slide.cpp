#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/commands/slide_check.h>
#include <glissade/apps/commands/slide_side_by_side.h>
#include <glissade/apps/commands/slide_summary.h>
#include <glissade/apps/commands/slide_tables.h>
#include <glissade/apps/files/followed_trajectory.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/parts_inside.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/apps/view/slide_replay.h>
#include <glissade/contact/sliding.h>
#include <glissade/files/csv.h>
#include <glissade/files/file_checks.h>
#include <glissade/reference/sliding_method.h>

namespace glissade::apps {

namespace {

constexpr const char* kSlideDescription =
    "Move a part through a scene along a trajectory, offline and deterministically";

constexpr int kGoalNotReached = 3;

constexpr const char* kSlideFooter =
    "Trajectory: columns t_s,x_m,y_m,z_m,qw,qx,qy,qz, or roll_deg,pitch_deg,yaw_deg in place of the last four\n"
    "(rotations about the fixed axes x, then y, then z). Each row is a time and the pose X_WG of the ghost, i.e. the\n"
    "pose that the part would have if nothing were in the way. Times increase. Between rows, translation is linear\n"
    "and rotation follows the shorter arc at constant speed. The part starts at the first row. There it may touch\n"
    "other objects, and overlap them by its margin, a few micrometres. For deeper overlaps see --depenetrate.\n"
    "\n"
    "Output: one row per millisecond. A row has the time, the poses of the ghost and of the visible part (where the\n"
    "part is shown, never inside an obstacle), the wrench on the hand about the part's reference point (the centre of\n"
    "its bounding box, or its 'compliance_point_m') in world axes, the number of contacts with a force, and the state\n"
    "of the part. If no table goes to the standard output, a line there says whether the part reached its goal, and\n"
    "gives the greatest force on the hand. With several trajectories, a last line says how many of them reached the\n"
    "goal.\n"
    "\n"
    "Methods:\n"
    "  projection          the default: projects the wanted motion on the motions that the contacts allow, and takes\n"
    "                      a step only with a proof that its path is collision-free\n"
    "  paper               the method of the paper 'Natural Interaction in Virtual Environments', for comparison:\n"
    "                      bisects the motion to the contact, classifies the contact, and finds a new direction of\n"
    "                      motion. Each row has one more column, with the states of the state machine. A part must\n"
    "                      not touch another object at the start\n"
    "\n"
    "Contacts: --contacts writes one row per touching contact and millisecond. A row has the number of the contact,\n"
    "which stays the same as long as the contact lasts; the triangle and the feature (face, edge or vertex of the\n"
    "mesh) of part and obstacle; the contact point on each; the normal from obstacle to part; gap, force along the\n"
    "normal, age and friction. --patches writes one row per patch and millisecond. A patch unites the contacts with\n"
    "one obstacle that lie in one plane. A row has the number of contacts in the patch, the centre and the sum of\n"
    "their forces on the part, and the extent of the patch.\n"
    "\n"
    "Moving objects: an object of the scene with 'moves: FILE' (at most three objects) follows the trajectory in this\n"
    "file, on the same clock as --trajectory. Before the first row and after the last row of this file, the object\n"
    "stands still. The object pushes the part out of its way, and waits if the part cannot move out of the way.\n"
    "--moving writes one row per object and millisecond.\n"
    "\n"
    "Assembly check: several trajectories, --summary or --report make the output one row per trajectory. A row\n"
    "says whether the part reached the goal of the scene (without a goal: the last row of the trajectory), and how\n"
    "far from the goal the part ended. A row also has the greatest force and torque on the hand, the smallest\n"
    "clearance and its time, and the time with contact forces. If the part or a moving object is in another object at\n"
    "the start of a trajectory, the command prints a line on standard error instead of a row for this trajectory, and\n"
    "the exit code is 1. With --require-goal, the exit code is 3 if a trajectory does not bring the part to the goal.\n"
    "Rows are in the order of the trajectories, and each row is written as soon as it is known.\n"
    "\n"
    "Time: if finely tessellated curved faces lie within micrometres of each other, as in a screw thread, each\n"
    "simulated millisecond can take tens of milliseconds (seventy for a real bolt).\n"
    "\n"
    "For all columns, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples, with the files of 'glissade example':\n"
    "  glissade slide square_peg.yaml --part peg --trajectory square_peg_script.csv --out motion.csv --summary -\n"
    "  glissade slide square_peg.yaml --part peg --trajectory square_peg_*.csv --summary ways.csv --report ways";

struct SlideOptions {
  std::string scene;
  std::string part;
  std::vector<std::string> trajectories;
  SlidingChoice sliding;
  std::string method = "projection";
  SlideTableFiles tables;
  std::string summary;
  std::string report;
  bool requires_goal = false;
  double goal_tolerance_m = SlideCheckOptions{}.goal_tolerance_m;
  double goal_tolerance_deg = SlideCheckOptions{}.goal_tolerance_deg;

  bool is_check() const { return trajectories.size() > 1 || !summary.empty() || !report.empty(); }
};

reference::SlidingMethod parse_method(const std::string& name) {
  const auto method = reference::sliding_method_from_name(name);
  if (method) return *method;
  throw std::invalid_argument("--method: '" + name + "' is unknown; known are " +
                              joined(reference::kSlidingMethodNames));
}

/// Leads the part along the only trajectory, and writes its tables meanwhile, and its replay if there is one.
SlideCheck slide(const HapticScene& scene, FollowedTrajectory trajectory, const SlideCheckOptions& check_options,
                 const SlideOptions& options, SlideReplay* replay) {
  SlideTables tables(options.tables, scene, check_options.method);
  const std::int64_t ticks = trajectory.duration() / std::chrono::milliseconds(1);
  ProgressBar progress("sliding", std::max<std::int64_t>(1, ticks), simulated_time);
  std::int64_t done = 0;
  SlideCheck check = check_slide(scene, trajectory, options.trajectories.front(), check_options,
                                 [&](std::chrono::nanoseconds time, const reference::SlidingSimulation& sliding) {
                                   tables.write(time, sliding);
                                   if (replay != nullptr) replay->add(time, sliding);
                                   progress.update(done++);
                                 });
  tables.close();
  return check;
}

/// Whether a table goes to the standard output.
bool has_table_on_standard_output(const SlideOptions& options) {
  const SlideTableFiles& tables = options.tables;
  if (options.is_check() && options.summary.empty() && options.report.empty()) return true;
  return tables.motion == "-" || tables.contacts.contacts == "-" || tables.contacts.patches == "-" ||
         tables.moving == "-" || options.summary == "-";
}

/// Tells what the checks found, each as soon as it is there.
class Teller {
 public:
  Teller(const HapticScene& scene, const SlideCheckOptions& check_options, const SlideOptions& options)
      : scene_(scene), check_options_(check_options), options_(options) {
    if (!options.is_check() || (options.summary.empty() && !options.report.empty())) return;
    summary_.emplace(options.summary.empty() ? "-" : options.summary);
  }

  void tell(const SlideCheck& check) {
    if (summary_) summary_->add(check);
    if (check.problem) {
      std::cerr << "glissade: " << check.trajectory << ": " << *check.problem << '\n';
      exit_code_ = 1;
      ++impossible_;
      return;
    }
    if (check.measures.goal_reached) ++reached_;
    const double size_m = size_of(scene_.parts.front().part_V->tree.mesh());
    constexpr double kFar = 2.0;  // sizes of the part
    if (check.far_m > kFar * size_m) {
      warn(check.trajectory + ": the part, " + rounded_text(size_m) + " m across, stays more than " +
           rounded_text(check.far_m) + " m away from everything: are the trajectory and all poses in metres?");
    } else if (!check.doubt.empty()) {
      warn(check.trajectory + ": " + check.doubt);
    }
    if (!has_table_on_standard_output(options_)) {
      std::cout << check.trajectory << ": " << verdict(check, check_options_) << std::endl;
    }
    if (options_.requires_goal && !check.measures.goal_reached) {
      std::cerr << "glissade: " << check.trajectory << ": the " << name_of_goal(check)
                << " is not reached: the part ends " << rounded_text(1e3 * check.measures.goal_distance_m) << " mm and "
                << fixed_text(check.measures.goal_angle_deg, 2) << " degrees from it; allowed are "
                << goal_tolerance(check_options_) << '\n';
      if (exit_code_ == 0) exit_code_ = kGoalNotReached;
    }
  }

  /// How many of several trajectories reach the goal.
  void conclude(std::size_t trajectories) const {
    if (trajectories < 2 || has_table_on_standard_output(options_)) return;
    const std::size_t missed = trajectories - reached_ - impossible_;
    std::cout << trajectories << " trajectories: " << reached_ << " reach the goal, " << missed << " do not, "
              << impossible_ << " cannot be checked\n";
  }

  int exit_code() const { return exit_code_; }

 private:
  const HapticScene& scene_;
  const SlideCheckOptions& check_options_;
  const SlideOptions& options_;
  std::optional<SlideSummary> summary_;
  std::size_t reached_ = 0;
  std::size_t impossible_ = 0;
  int exit_code_ = 0;
};

/// The trajectory that a page of several shows in three dimensions. It is the first that misses the goal. If all reach
/// it, it is the one with the greatest force. None if none could be checked.
std::optional<std::size_t> most_telling(const std::vector<SlideCheck>& checks) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < checks.size(); ++i) {
    if (checks[i].problem) continue;
    if (!checks[i].measures.goal_reached) return i;
    if (!best || checks[i].measures.force_max_N > checks[*best].measures.force_max_N) best = i;
  }
  return best;
}

/// Leads the part along a trajectory once more, to look on.
void watch_again(const HapticScene& scene, const std::string& file, SlideCheckOptions options, SlideReplay& replay) {
  FollowedTrajectory trajectory(file);
  const std::int64_t ticks = trajectory.duration() / std::chrono::milliseconds(1);
  ProgressBar progress("watching " + file, std::max<std::int64_t>(1, ticks), simulated_time);
  std::int64_t done = 0;
  options.needs_summary = options.needs_curve = false;
  check_slide(scene, trajectory, file, options,
              [&](std::chrono::nanoseconds time, const reference::SlidingSimulation& sliding) {
                replay.add(time, sliding);
                progress.update(done++);
              });
}

void write_page(const HapticScene& scene, const std::vector<SlideCheck>& checks, const SlideCheckOptions& check_options,
                const SlideOptions& options, std::optional<SlideReplay> replay) {
  Report report = report_of(scene, checks, check_options);
  if (checks.size() > 1) {
    if (const std::optional<std::size_t> shown = most_telling(checks)) {
      const std::string& file = checks[*shown].trajectory;
      watch_again(scene, file, check_options, replay.emplace(scene));
      report.summary.emplace_back("in three dimensions", file);
      replay->finish(report, ", " + file);
    }
  } else if (!checks.front().problem) {
    replay->finish(report);
  }
  const std::string page = write_html_report(report, options.report);
  if (!has_table_on_standard_output(options)) std::cout << "report: " << page << '\n';
}

contact::SlidingOptions sliding_options(const SlideOptions& options) {
  return {.metaphor = metaphor_of(options.sliding), .rules = with_choice({}, options.sliding)};
}

/// Two outputs must not share a file, and one trajectory alone has tables of its motion.
void check_files(const SlideOptions& options) {
  const SlideTableFiles& tables = options.tables;
  const std::vector<std::pair<std::string, std::string>> of_one_motion{{"--out", tables.motion},
                                                                       {"--contacts", tables.contacts.contacts},
                                                                       {"--patches", tables.contacts.patches},
                                                                       {"--moving", tables.moving}};
  for (const auto& [option, file] : of_one_motion) {
    if (options.trajectories.size() == 1 || file.empty()) continue;
    throw std::invalid_argument(option + ": applies to one trajectory only; for several, use --summary and --report");
  }
  std::vector<std::pair<std::string, std::string>> outputs = of_one_motion;
  outputs.emplace_back("--summary", options.summary);
  outputs.emplace_back("--report", report_page(options.report));
  check_distinct(outputs);
}

int run(SlideOptions options) {
  SlideCheckOptions check_options{sliding_options(options), options.sliding, parse_method(options.method),
                                  options.goal_tolerance_m, options.goal_tolerance_deg};
  check_options.needs_summary = options.is_check();
  check_options.needs_curve = !options.report.empty();
  if (check_options.method == reference::SlidingMethod::kPaper && options.sliding.has_rules()) {
    throw std::invalid_argument("--method: paper does not support --friction, --spiral-search and --depenetrate");
  }
  if (!options.is_check() && options.tables.motion.empty()) options.tables.motion = "-";
  check_files(options);
  for (const std::string& file : options.trajectories) {
    if (options.is_check() && file.find_first_of(",\"\n\r") != std::string::npos) {
      throw std::invalid_argument("--trajectory: " + in_quotes(file) + " has a comma, quote or line break in its name");
    }
  }
  const Scene file = open_scene(options.scene);
  const SceneObject& part = file.find(options.part);
  const HapticScene scene = make_haptic_scene(file, {options.part});
  check_options.sliding.stiffness = stiffness_of(options.sliding, scene.parts.front().part_V->radius());
  if (check_options.method == reference::SlidingMethod::kPaper && !scene.moving.empty()) {
    throw std::invalid_argument("--method: paper does not support objects that move on their own, such as " +
                                scene.moving.front().name);
  }
  if (!part.movable) {
    throw std::invalid_argument("--part: the object " + in_quotes(options.part) + " in " + file.source +
                                " is not movable; a part needs 'movable: true'");
  }
  if (!options.tables.moving.empty() && scene.moving.empty()) {
    throw std::invalid_argument("--moving: no object moves on its own in " + scene.source);
  }
  if (options.tables.contacts.any() || !options.tables.moving.empty()) check_names_fit_csv(scene);
  if (!options.report.empty()) prepare_report_folder(options.report);
  for (const std::string& sentence : doubtful_sizes(file, scene))
    warn(sentence);
  std::vector<FollowedTrajectory> trajectories;
  for (const std::string& path : options.trajectories) {
    trajectories.emplace_back(path);
    for (const std::string& sentence : parts_inside(scene, std::span(&trajectories.back().first_pose(), 1)))
      warn(path + ": " + sentence);
  }
  Teller teller(scene, check_options, options);
  std::vector<SlideCheck> checks;
  std::optional<SlideReplay> replay;
  if (trajectories.size() > 1) {
    check_side_by_side(scene, std::move(trajectories), options.trajectories, check_options, [&](SlideCheck check) {
      teller.tell(check);
      checks.push_back(std::move(check));
    });
    teller.conclude(checks.size());
  } else {
    if (!options.report.empty()) replay.emplace(scene);
    checks.push_back(
        slide(scene, std::move(trajectories.front()), check_options, options, replay ? &*replay : nullptr));
    teller.tell(checks.front());
  }
  if (!options.report.empty()) write_page(scene, checks, check_options, options, std::move(replay));
  return teller.exit_code();
}

}  // namespace

void add_slide_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<SlideOptions>();
  CLI::App* command = app.add_subcommand("slide", kSlideDescription);
  command->footer(std::string(kSlideFooter) + kSlidingChoiceHelp + kSceneFileHelp);
  command->add_option("SCENE", options->scene, "Scene file (YAML)")->required();
  command->add_option("--part", options->part, "Name of the object in the hand")->required();
  command
      ->add_option(
          "--trajectory", options->trajectories,
          "Trajectory of the ghost (CSV), see below. Several files, one per trajectory, make an assembly check")
      ->required();
  add_sliding_options(*command, options->sliding);
  command->add_option("--method", options->method, "Sliding method, see below")->capture_default_str();
  command->add_option("--out", options->tables.motion,
                      "CSV file for the motion (default: standard output, or no file with --summary or --report)");
  command->add_option("--contacts", options->tables.contacts.contacts, "CSV file for the contacts, see below");
  command->add_option("--patches", options->tables.contacts.patches, "CSV file for patches of contacts, see below");
  command->add_option("--moving", options->tables.moving, "CSV file for the moving objects, see below");
  command->add_option("--summary", options->summary, "CSV file for the assembly check, - for standard output");
  command->add_option("--report", options->report,
                      "Folder for the assembly check as an HTML page, index.html, with the part in three dimensions");
  command->add_flag("--require-goal", options->requires_goal,
                    "Exit with code 3 if a trajectory does not bring the part to the goal");
  command
      ->add_option("--goal-tolerance-m", options->goal_tolerance_m,
                   "Greatest distance from the goal at which the goal counts as reached")
      ->capture_default_str()
      ->check(not_negative());
  command
      ->add_option("--goal-tolerance-deg", options->goal_tolerance_deg,
                   "Greatest angle from the goal at which the goal counts as reached")
      ->capture_default_str()
      ->check(not_negative());
  add_strict_option(*command);
  add_quiet_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
