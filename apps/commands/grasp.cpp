#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/scene_warnings.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/files/hand_trajectory_file.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/apps/scene/start_overlap.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/grasp_outcome.h>
#include <glissade/apps/view/grasp_report.h>
#include <glissade/contact/spring.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/files/csv.h>
#include <glissade/files/file_checks.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/finger_forces.h>

namespace glissade::apps {

namespace {

constexpr std::chrono::milliseconds kTick{1};
constexpr std::array<std::string_view, haptics::kFingers> kFingerNames{"thumb", "index", "middle", "ring", "little"};

constexpr const char* kGraspDescription =
    "Let hands grasp and move the objects of a scene, offline and deterministically";

constexpr const char* kGraspFooter =
    "Hand trajectory: columns t_s,x_m,y_m,z_m,qw,qx,qy,qz, the pose of the hand root (the end of the forearm at the\n"
    "wrist), then 22 angles, thumb_roll_rad to wrist_abduction_rad, in the order of a CyberGlove. Each file is for\n"
    "one hand. The visible hand follows as far as objects allow: it never penetrates objects, and closes tight round\n"
    "them. Contacts, not gestures, decide whether a hand grasps a movable object. The grasped object moves with the\n"
    "palm, slides along obstacles, and stays where the hand lets go. A touch without a grasp pushes the object.\n"
    "\n"
    "Hand: a YAML file with the keys side (left or right), length_m and breadth_m; by default a right hand of 0.183 m\n"
    "and 0.084 m. A single file applies to all hands.\n"
    "\n"
    "Output: one row per millisecond and hand. A row has the visible posture, the touching segments, the type of\n"
    "grasp (none, push, precision, power), the grasped object with its pose, and the forces of the fingertips.\n"
    "--objects writes one row per millisecond and movable object with its pose and the wrench on the hands. If no\n"
    "table goes to the standard output, a summary there says for each hand how long it held an object, or why it held\n"
    "nothing, and for each part how far it ended from its start.\n"
    "For all columns, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples, with the files of 'glissade example':\n"
    "  glissade grasp ball_and_tray.yaml --hand-trajectory ball_and_tray_hand.csv --out hand.csv\n"
    "  glissade grasp grasp_mug.yaml --hand-trajectory grasp_mug_hand.csv --out hand.csv\n"
    "  glissade grasp ball_and_tray.yaml --hand-trajectory ball_and_tray_hand.csv --friction 0.3 --objects moved.csv\n"
    "  glissade grasp ball_and_tray.yaml --hand-trajectory ball_and_tray_hand.csv --out hand.csv --report grasp";

struct GraspOptions {
  std::string scene;
  std::vector<std::string> trajectories;
  std::vector<std::string> hands;
  SlidingChoice sliding;
  std::string out;
  std::string objects;
  std::string report;

  /// The file of the table of the hands; "-": standard output; empty: none.
  std::string hand_table() const { return out.empty() && objects.empty() && report.empty() ? "-" : out; }
};

std::vector<std::string> hand_columns() {
  std::vector<std::string> columns{"t_s", "hand", "state", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  for (const std::string& column : joint_columns())
    columns.push_back(column);
  for (const char* column : {"touching", "grasp", "form", "object", "ox_m", "oy_m", "oz_m", "oqw", "oqx", "oqy", "oqz",
                             "thumb_tip_N", "index_tip_N", "middle_tip_N", "ring_tip_N", "little_tip_N"})
    columns.emplace_back(column);
  return columns;
}

std::vector<std::string> object_columns() {
  return {"t_s", "object", "x_m",  "y_m",  "z_m",  "qw",    "qx",    "qy",
          "qz",  "state",  "fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"};
}

std::vector<std::shared_ptr<const grasping::HandModel>> make_hands(const GraspOptions& options) {
  const std::size_t count = options.trajectories.size();
  if (options.hands.size() > 1 && options.hands.size() != count) {
    throw std::invalid_argument("--hand: " + std::to_string(options.hands.size()) + " files for " +
                                std::to_string(count) + " hands; give one for all, or one for each");
  }
  std::vector<std::shared_ptr<const grasping::HandModel>> hands;
  for (std::size_t h = 0; h < count; ++h) {
    if (options.hands.empty()) {
      hands.push_back(h == 0 ? std::make_shared<const grasping::HandModel>(grasping::make_hand()) : hands.front());
      continue;
    }
    const std::string& file = options.hands[std::min(h, options.hands.size() - 1)];
    try {
      hands.push_back(std::make_shared<const grasping::HandModel>(grasping::make_hand(read_hand_shape(file))));
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      throw std::invalid_argument(message.starts_with(file) ? message : file + ": " + message);
    }
  }
  return hands;
}

/// The rows of one run.
class GraspTables {
 public:
  GraspTables(const HapticScene& scene, const grasping::GraspSimulation& simulation,
              const std::vector<std::shared_ptr<const grasping::HandModel>>& hands, const GraspOptions& options)
      : scene_(scene), simulation_(simulation), hands_(hands) {
    if (const std::string file = options.hand_table(); !file.empty())
      hand_rows_ = std::make_unique<CsvWriter>(file, hand_columns());
    for (const std::shared_ptr<const grasping::HandModel>& hand : hands)
      fingertips_.emplace_back(haptics::finger_hand(*hand), devices::simulated_glove_descriptor());
    if (!options.objects.empty()) object_rows_ = std::make_unique<CsvWriter>(options.objects, object_columns());
  }

  void write(double time_s, const std::vector<std::optional<grasping::Posture>>& targets) {
    for (std::size_t h = 0; hand_rows_ != nullptr && h < simulation_.hand_count(); ++h)
      write_hand(time_s, h, *targets[h]);
    if (object_rows_ == nullptr) return;
    for (std::size_t p = 0; p < simulation_.part_count(); ++p)
      write_object(time_s, p);
  }

  void close() {
    if (hand_rows_) hand_rows_->close();
    if (object_rows_) object_rows_->close();
  }

 private:
  void write_hand(double time_s, std::size_t h, const grasping::Posture& target) {
    const grasping::Posture& posture = simulation_.posture(h);
    const grasping::Grasp& grasp = simulation_.grasp(h);
    hand_rows_->add(time_s)
        .add(static_cast<std::int64_t>(h))
        .add(hands::name_of(simulation_.activity(h)))
        .add(posture.X_WR);
    for (const double value : posture.values)
      hand_rows_->add(value);
    const std::vector<std::string> touching = touching_segments(h);
    std::string names;  // such as "palm index_distal"
    for (const std::string& name : touching)
      names += (names.empty() ? "" : " ") + name;
    hand_rows_->add(names).add(name_of(grasp.type)).add(name_of(grasp.form));
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    if (grasp.object < 0) {
      hand_rows_->add("");
    } else {
      const auto body = static_cast<std::size_t>(grasp.object);
      hand_rows_->add(scene_.body_names[body]);
      X_WO = body < scene_.obstacles.size() ? scene_.obstacles[body].X_WO
                                            : simulation_.parts().result(body - scene_.obstacles.size()).X_WV;
    }
    hand_rows_->add(X_WO);
    hands::JointValues angles;
    std::copy(target.values.begin(), target.values.end(), angles.begin());
    const std::array<double, haptics::kFingers> forces =
        fingertips_[h].update(angles, haptics::answer_of(simulation_, h));
    for (std::size_t finger = 0; finger < haptics::kFingers; ++finger) {
      const std::string tip = std::string(kFingerNames[finger]) + "_distal";
      const bool touches = std::find(touching.begin(), touching.end(), tip) != touching.end();
      hand_rows_->add(touches ? forces[finger] : 0.0);
    }
    hand_rows_->end_row();
  }

  /// The names of the segments that touch.
  std::vector<std::string> touching_segments(std::size_t h) const {
    const std::span<const char> touching = simulation_.clasp(h).touching();
    std::vector<std::string> names;
    for (std::size_t link = 0; link < touching.size(); ++link) {
      if (touching[link] != 0) names.push_back(hands_[h]->chain.links()[link].name);
    }
    return names;
  }

  void write_object(double time_s, std::size_t p) {
    const contact::MultiPartSliding& parts = simulation_.parts();
    const contact::SlidingResult& result = parts.result(p);
    const contact::Wrench wrench = contact::contact_wrench(parts.result(p), parts.p_Vref(p));
    object_rows_->add(time_s).add(scene_.body_names[scene_.obstacles.size() + p]).add(result.X_WV);
    object_rows_->add(contact::name_of(result.state));
    // Adding zero turns a negative zero into the plain one.
    for (int i = 0; i < 3; ++i)
      object_rows_->add(wrench.f[i] + 0.0);
    for (int i = 0; i < 3; ++i)
      object_rows_->add(wrench.t[i] + 0.0);
    object_rows_->end_row();
  }

  const HapticScene& scene_;
  const grasping::GraspSimulation& simulation_;
  const std::vector<std::shared_ptr<const grasping::HandModel>>& hands_;
  std::vector<haptics::FingertipForces> fingertips_;
  std::unique_ptr<CsvWriter> hand_rows_;
  std::unique_ptr<CsvWriter> object_rows_;
};

grasping::GraspSimulation start(const HapticScene& scene,
                                const std::vector<std::shared_ptr<const grasping::HandModel>>& hands,
                                const grasping::GraspRules& rules, const SlidingChoice& choice) {
  const std::vector<contact::HeldPart> parts = held_parts(scene, choice);
  try {
    return {scene.obstacles, parts, hands, rules};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scene.source + ": " + error.what() + overlap_advice(scene, !choice.depenetrate));
  }
}

/// Warns of angles beyond those of any joint, and of a root that never comes near an object.
void warn_of_units(const std::string& file, const HandTrajectory& trajectory, const Scene& scene,
                   const HapticScene& haptic_scene) {
  constexpr double kNoJoint_rad = 2.0 * std::numbers::pi;
  constexpr double kFar_m = 2.0;
  constexpr int kMoments = 200;
  if (trajectory.greatest_angle() > kNoJoint_rad) {
    warn(file + ": angles of joints up to " + rounded_text(trajectory.greatest_angle()) + " rad: degrees?");
  }
  double nearest_m = std::numeric_limits<double>::infinity();
  Eigen::AlignedBox3d positions;
  for (const SceneObject& object : scene.objects) {
    if (object.motion) return;  // it may come to the hand
    const Eigen::AlignedBox3d box_B = geometry::bounds_of(*object.mesh);
    const Eigen::Isometry3d X_BW = object.X_WB.inverse(Eigen::Isometry);
    for (int i = 0; i <= kMoments; ++i) {
      const std::chrono::nanoseconds time = trajectory.first_time() + i * trajectory.duration() / kMoments;
      const Eigen::Vector3d p_WR = trajectory.posture_at(time).X_WR.translation();
      nearest_m = std::min(nearest_m, box_B.exteriorDistance(X_BW * p_WR));
      positions.extend(p_WR);
    }
  }
  if (nearest_m > kFar_m) {
    warn(file + ": the hand stays more than " + rounded_text(nearest_m) +
         " m away from everything: are its poses and those of the objects in metres?");
  } else if (const std::string doubt = doubt_of_positions(positions, haptic_scene); !doubt.empty()) {
    warn(file + ": " + doubt);
  }
}

void print(const std::vector<std::pair<std::string, std::string>>& rows) {
  for (const auto& [name, value] : rows)
    std::cout << std::left << std::setw(16) << name << "  " << value << '\n';
}

int run(const GraspOptions& options) {
  check_distinct(
      {{"--out", options.hand_table()}, {"--objects", options.objects}, {"--report", report_page(options.report)}});
  if (!options.report.empty()) prepare_report_folder(options.report);
  std::vector<HandTrajectory> trajectories;
  for (const std::string& file : options.trajectories)
    check_duration(trajectories.emplace_back(read_hand_trajectory(file)).duration(), file);
  const std::vector<std::shared_ptr<const grasping::HandModel>> hands = make_hands(options);
  const Scene scene_file = open_scene(options.scene);
  const HapticScene scene = make_haptic_scene(scene_file, movable_objects(scene_file));
  warn_of_scene(scene_file, scene);
  for (std::size_t i = 0; i < trajectories.size(); ++i)
    warn_of_units(options.trajectories[i], trajectories[i], scene_file, scene);
  for (const std::string& name : scene.body_names)
    check_name_fits_csv(scene, name);
  grasping::GraspRules rules;
  rules.sliding = with_choice({}, options.sliding);
  grasping::GraspSimulation simulation = start(scene, hands, rules, options.sliding);

  std::chrono::nanoseconds first = trajectories.front().first_time();
  std::chrono::nanoseconds last = trajectories.front().last_time();
  for (const HandTrajectory& trajectory : trajectories) {
    first = std::min(first, trajectory.first_time());
    last = std::max(last, trajectory.last_time());
  }
  const std::int64_t ticks = (last - first) / kTick;
  GraspTables tables(scene, simulation, hands, options);
  GraspOutcome outcome(scene, simulation, hands);
  std::optional<GraspReport> report;
  if (!options.report.empty()) report.emplace(scene, simulation, hands, ticks + 1);
  ProgressBar progress("grasping", ticks + 1);
  std::vector<std::optional<grasping::Posture>> targets(hands.size());
  for (std::int64_t tick = 0; tick <= ticks; ++tick) {
    const std::chrono::nanoseconds time = first + tick * kTick;
    for (std::size_t h = 0; h < hands.size(); ++h)
      targets[h] = trajectories[h].posture_at(time);
    simulation.advance(targets, tick == 0 ? 0.0 : 1.0);
    const double time_s = std::chrono::duration<double>(time).count();
    tables.write(time_s, targets);
    outcome.add(time_s, targets);
    if (report) report->add(time);
    progress.update(tick + 1);
  }
  tables.close();
  for (std::size_t h = 0; h < hands.size(); ++h) {
    if (const std::string waiting = outcome.waiting(h); !waiting.empty()) {
      warn(options.trajectories[h] + ": the hand " + waiting);
    }
  }
  std::vector<std::pair<std::string, std::string>> rows = outcome.rows();
  if (report) {
    Report page = report->finish(outcome);
    page.summary.emplace_back("rules", words_of(options.sliding));
    rows.emplace_back("report", write_html_report(page, options.report));
  }
  if (options.hand_table() != "-" && options.objects != "-") print(rows);
  return 0;
}

}  // namespace

void add_grasp_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<GraspOptions>();
  CLI::App* command = app.add_subcommand("grasp", kGraspDescription);
  command->footer(std::string(kGraspFooter) + kSlidingChoiceHelp + kSceneFileHelp);
  command->add_option("SCENE", options->scene, "Scene file (YAML)")->required();
  command
      ->add_option("--hand-trajectory", options->trajectories,
                   "Trajectory of a hand (CSV), see below; one for each hand")
      ->required();
  command->add_option("--hand", options->hands, "Hand file (YAML), see below");
  add_sliding_options(*command, options->sliding);
  command->add_option("--out", options->out,
                      "CSV file for the hands (default: standard output, or no file with --objects or --report)");
  command->add_option("--objects", options->objects, "CSV file for the movable objects, see below");
  command
      ->add_option("--report", options->report,
                   "Folder for a page, index.html, with hands and objects in three dimensions, and plots")
      ->take_last();
  add_strict_option(*command);
  add_quiet_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
