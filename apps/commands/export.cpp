#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/files/obj_file.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/record/recorded_moment.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>
#include <glissade/viewer/scene_model.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

namespace {

constexpr const char* kExportDescription = "Write the meshes of a scene at one moment, for other programs";

constexpr const char* kExportFooter =
    "The ending of FILE selects the format:\n"
    "  .obj  Wavefront OBJ: a group for each object, in double precision\n"
    "  .glb  binary glTF: a node for each object, with its vertices on a grid of 65,536 steps across the object\n"
    "Both formats are in metres and have the axes of the world. Nothing is simplified.\n"
    "\n"
    "Without --log, objects have their initial poses. With --at, objects that move on their own have the poses of\n"
    "their trajectory ('moves') at this time. With --log, parts and hands with fingers have their visible poses at\n"
    "this time, counted from the first tick of the recording. SCENE is then optional, and must be the recorded scene.\n"
    "\n"
    "Examples, with the files of 'glissade example':\n"
    "  glissade export car_door.yaml --out door.obj\n"
    "  glissade demo --offline --seconds 4 --record moment.lcmlog && glissade export --log moment.lcmlog --at 0.2 "
    "--out moment.glb";

struct ExportOptions {
  std::string scene;
  std::string log;
  std::optional<double> at_s;
  std::string out;
};

/// The times that a trajectory may have.
std::chrono::nanoseconds time_of(double at_s) {
  constexpr double kGreatest_s = 1e9;
  if (!(std::abs(at_s) <= kGreatest_s)) throw std::invalid_argument("--at: must be within ±1e9 s");
  return std::chrono::nanoseconds(std::llround(at_s * 1e9));
}

viewer::ViewScene scene_at(std::optional<std::chrono::nanoseconds> time, const std::string& scene_file) {
  const Scene file = open_scene(scene_file);
  for (const std::string& sentence : doubtful_objects(file))
    warn(sentence);
  viewer::ViewScene scene{.title = file.source};
  for (const SceneObject& object : file.objects) {
    viewer::ViewObject& shown =
        scene.objects.emplace_back(viewer::ViewObject{object.name, object.mesh.shared(), object.X_WB});
    if (object.motion && time) shown.X_WB = object.motion->script_X_WB.pose_at(*time);
  }
  return scene;
}

std::string bytes_of(viewer::ViewScene scene, const std::string& ending) {
  if (ending == ".obj") return obj_text(scene);
  scene.p_WO_chosen = Eigen::Vector3d::Zero();
  return viewer::scene_model(scene, std::numeric_limits<std::size_t>::max());
}

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream file = open_output(path);
  file << bytes;
  file.close();
  if (!file) throw std::runtime_error(path + ": not everything could be written");
}

std::string counted(std::size_t count, const std::string& name) {
  return std::to_string(count) + " " + name + (count == 1 ? "" : "s");
}

/// How much is in the file, in words.
std::string content_of(const viewer::ViewScene& scene) {
  std::size_t triangles = 0;
  for (const viewer::ViewObject& object : scene.objects)
    triangles += object.mesh->triangles.size();
  std::size_t hands = 0;
  for (const viewer::ViewHand& hand : scene.hands) {
    if (!hand.model) continue;
    ++hands;
    for (const grasping::ChainLink& link : hand.model->chain.links())
      triangles += link.mesh ? link.mesh->triangles.size() : 0;
  }
  const std::string with_hands = hands > 0 ? ", " + counted(hands, "hand") : "";
  return counted(scene.objects.size(), "object") + with_hands + ", " + counted(triangles, "triangle");
}

int run(const ExportOptions& options) {
  const std::string ending = std::filesystem::path(options.out).extension().string();
  if (ending != ".obj" && ending != ".glb") {
    throw std::invalid_argument("--out: the ending of " + in_quotes(options.out) +
                                " is unknown; known are .obj and .glb");
  }
  if (options.log.empty() && options.scene.empty()) throw std::invalid_argument("SCENE is required without --log");
  std::optional<std::chrono::nanoseconds> time;
  if (options.at_s) time = time_of(*options.at_s);
  const viewer::ViewScene scene =
      options.log.empty() ? scene_at(time, options.scene)
                          : recorded_moment(options.log, options.scene, time.value_or(std::chrono::nanoseconds(0)));
  write_file(options.out, bytes_of(scene, ending));
  std::cout << options.out << ": " << content_of(scene) << '\n';
  return 0;
}

}  // namespace

void add_export_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", kExportDescription);
  command->footer(std::string(kExportFooter) + kSceneFileHelp);
  command->add_option("SCENE", options->scene, "Scene file (YAML); optional with --log");
  command->add_option("--log", options->log, "Recording of a run, from 'glissade record' or 'demo --record'");
  command->add_option("--at", options->at_s, "Time in seconds, see below");
  command->add_option("--out", options->out, "File to write, .obj or .glb")->required();
  add_strict_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
