#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include <glissade/files/did_you_mean.h>
#include <glissade/files/file_checks.h>
#include <glissade/files/pose_files.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>
#include <glissade/files/yaml_reader.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/study.h>

#include "file/pilot_reader.h"
#include "file/study_keys.h"
#include "file/target_reader.h"

namespace glissade::study {
namespace {

using files::in_quotes;

constexpr std::uintmax_t kLargestStudyFile = std::uintmax_t{1} << 24U;
constexpr double kMostSlides = 1e8;
constexpr double kLeastHalfWidth = 1e-4;  // of the interval of a rate; needs at most 9.7e7 slides
constexpr double kGreatestHalfWidth = 0.5;
constexpr double kLargestValue = 1e9;                // as coordinates
constexpr double kLargestSeed = 9007199254740992.0;  // all whole numbers up to it are doubles

/// Reads one study file.
class StudyReader {
 public:
  StudyReader(const std::filesystem::path& path)
      : yaml_(path.string()), source_(path.string()), folder_(path.parent_path()) {}

  Study read() {
    const YAML::Node root = yaml_.parse(files::read_text_file(source_, kLargestStudyFile));
    yaml_.check_keys(root, "study", kStudyKeys);
    study_.source = source_;
    read_scene(root);
    read_trajectories(root);
    if (root["sampling"])
      study_.sampling = static_cast<Sampling>(index_of(root["sampling"], "sampling", kSamplingNames));
    read_parameters(root);
    if (root["seed"]) study_.seed = static_cast<std::uint64_t>(whole(root["seed"], "seed", 0.0, kLargestSeed));
    read_slides(root);
    if (root["success"]) read_success(root["success"]);
    if (root["sliding"]) read_sliding(root["sliding"]);
    read_record(root["record"]);
    return std::move(study_);
  }

 private:
  std::string full_path(const std::string& path) const { return (folder_ / path).string(); }

  double whole(const YAML::Node& node, const std::string& key, double least, double greatest) const {
    const double number = yaml_.number(node, key);
    if (number == std::floor(number) && number >= least && number <= greatest) return number;
    yaml_.fail(node, key + ": must be a whole number from " + files::format_number(least) + " to " +
                         files::format_number(greatest) + ", not " + in_quotes(node.Scalar()));
  }

  double at_least(const YAML::Node& node, const std::string& key, double least) const {
    const double number = yaml_.number(node, key);
    if (number >= least) return number;
    yaml_.fail(node, key + ": must be at least " + files::format_number(least) + ", not " + in_quotes(node.Scalar()));
  }

  std::size_t index_of(const YAML::Node& node, const std::string& key, std::span<const std::string_view> names) const {
    const std::string name = yaml_.text(node, key);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    yaml_.fail(node, key + ": " + in_quotes(name) + " is unknown" +
                         files::did_you_mean(name, {names.begin(), names.end()}) + " (known: " + files::joined(names) +
                         ")");
  }

  void read_scene(const YAML::Node& root) {
    study_.scene = simulation::read_scene(full_path(yaml_.text(yaml_.required(root, "study", "scene"), "scene")));
    const YAML::Node part = yaml_.required(root, "study", "part");
    study_.part = yaml_.text(part, "part");
    try {
      if (study_.scene.find(study_.part).movable) return;
    } catch (const std::invalid_argument& error) {
      yaml_.fail(part, std::string("part: ") + error.what());
    }
    yaml_.fail(part, "part: the object " + in_quotes(study_.part) + " is not movable; a part needs 'movable: true'");
  }

  void add_trajectory(const YAML::Node& node) {
    const std::string name = yaml_.text(node, "trajectory");
    try {
      files::check_input(full_path(name));
      study_.trajectories_X_WG.push_back(files::read_trajectory(full_path(name)));
      study_.trajectory_names.push_back(name);
    } catch (const std::invalid_argument& error) {
      yaml_.fail(node, std::string("trajectory: ") + error.what());
    }
  }

  void read_trajectories(const YAML::Node& root) {
    const YAML::Node parameters = yaml_.required(root, "study", "parameters");
    if (!parameters.IsSequence() || parameters.size() == 0)
      yaml_.fail(parameters, "parameters: must be a list of parameters");
    const bool is_varied = std::any_of(parameters.begin(), parameters.end(), [](const YAML::Node& parameter) {
      return parameter.IsMap() && parameter["vary"] && parameter["vary"].IsScalar() &&
             parameter["vary"].Scalar() == "trajectory";
    });
    if (!is_varied) return add_trajectory(yaml_.required(root, "study", "trajectory"));
    if (root["trajectory"])
      yaml_.fail(root["trajectory"], "trajectory: a parameter varies the trajectory, so its values name the files");
  }

  void read_parameters(const YAML::Node& root) {
    Study bare;
    bare.records.fill(true);
    bare.strata = std::make_shared<const Strata>(std::vector<Stratum>(1), 2, 1);
    const std::vector<std::string> columns = columns_of(bare);
    std::set<std::string> names;
    std::set<std::string> varied;
    for (const YAML::Node& node : root["parameters"]) {
      study_.parameters.push_back(read_parameter(node, varied));
      const std::string& name = study_.parameters.back().name;
      if (!names.insert(name).second) yaml_.fail(node, "name: another parameter is called " + in_quotes(name));
      if (std::find(columns.begin(), columns.end(), name) != columns.end())
        yaml_.fail(node, "name: " + in_quotes(name) + " is the name of another column of the table");
      if (name.find_first_of(",\"\n\r") != std::string::npos)
        yaml_.fail(node, "name: must not contain a comma, a quote or a line break");
    }
  }

  Parameter read_parameter(const YAML::Node& node, std::set<std::string>& varied) {
    yaml_.check_keys(node, "parameter", kParameterKeys);
    const YAML::Node vary = yaml_.required(node, "parameter", "vary");
    Parameter parameter;
    std::vector<std::string> names;
    if (vary.IsSequence()) {
      for (const YAML::Node& target : vary)
        names.push_back(yaml_.text(target, "vary"));
    } else {
      names.push_back(yaml_.text(vary, "vary"));
    }
    if (names.empty()) yaml_.fail(vary, "vary: must name at least one thing to vary");
    for (const std::string& name : names) {
      try {
        parameter.targets.push_back(target_from(name, study_.scene, study_.part));
      } catch (const std::invalid_argument& error) {
        yaml_.fail(vary, std::string("vary: ") + error.what());
      }
      if (!varied.insert(name).second) yaml_.fail(vary, "vary: " + in_quotes(name) + " is varied twice");
    }
    parameter.name = node["name"] ? yaml_.text(node["name"], "name") : names.front();
    parameter.distribution = read_distribution(node);
    read_choices(node, parameter);
    check_range(node, parameter);
    read_steps(node, parameter);
    return parameter;
  }

  Distribution read_distribution(const YAML::Node& node) const {
    std::vector<std::string> given;
    for (const std::string_view key : kDistributionKeys) {
      if (node[std::string(key)]) given.emplace_back(key);
    }
    if (given.size() != 1) {
      yaml_.fail(node, "a parameter needs exactly one of " + files::joined(kDistributionKeys) + ", not " +
                           std::to_string(given.size()));
    }
    const YAML::Node values = node[given.front()];
    Distribution distribution = shape_of(given.front(), values);
    if (const YAML::Node within = node["within"]) {
      if (!std::holds_alternative<Normal>(distribution.shape)) yaml_.fail(within, "within: is for 'normal'");
      const Eigen::VectorXd bounds = yaml_.numbers(within, "within", 2);
      if (!(bounds[0] < bounds[1])) yaml_.fail(within, "within: the first bound must be below the second");
      distribution.within = Uniform{bounds[0], bounds[1]};
      const Normal& normal = std::get<Normal>(distribution.shape);
      constexpr double kFarthest = 6.0;  // standard deviations
      if (bounds[1] < normal.mean - kFarthest * normal.deviation ||
          bounds[0] > normal.mean + kFarthest * normal.deviation) {
        yaml_.fail(within, "within: hardly any value of the distribution lies between these bounds");
      }
    }
    return distribution;
  }

  Distribution shape_of(const std::string& key, const YAML::Node& values) const {
    if (key == "one_of") return {read_one_of(values)};
    const Eigen::VectorXd numbers = yaml_.numbers(values, key, key == "triangular" ? 3 : 2);
    for (const double number : numbers)
      check_size(values, key, number);
    if (key == "normal") {
      if (!(numbers[1] > 0.0)) yaml_.fail(values, "normal: the standard deviation must be positive");
      return {Normal{numbers[0], numbers[1]}};
    }
    const double last = numbers[numbers.size() - 1];
    if (!(numbers[0] < last)) yaml_.fail(values, key + ": the first number must be below the last");
    if (key == "uniform") return {Uniform{numbers[0], last}};
    if (!(numbers[0] <= numbers[1] && numbers[1] <= last))
      yaml_.fail(values, "triangular: the second number must lie between the other two");
    return {Triangular{numbers[0], numbers[1], last}};
  }

  void check_size(const YAML::Node& node, const std::string& key, double number) const {
    if (std::abs(number) <= kLargestValue) return;
    yaml_.fail(node, key + ": numbers must lie between -1e9 and 1e9, not " + files::format_number(number));
  }

  OneOf read_one_of(const YAML::Node& values) const {
    if (!values.IsSequence() || values.size() == 0) yaml_.fail(values, "one_of: must be a list of values");
    OneOf one_of;
    for (const YAML::Node& value : values) {
      one_of.names.push_back(yaml_.text(value, "one_of"));
      if (one_of.names.back().find_first_of(",\"\n\r") != std::string::npos)
        yaml_.fail(value, "one_of: a value must not contain a comma, a quote or a line break");
      if (const std::optional<double> number = files::parse_number(one_of.names.back()))
        one_of.numbers.push_back(*number);
    }
    for (const double number : one_of.numbers)
      check_size(values, "one_of", number);
    if (one_of.numbers.size() != one_of.names.size()) one_of.numbers.clear();
    return one_of;
  }

  /// Reads the files of trajectories and meshes, and checks names.
  void read_choices(const YAML::Node& node, Parameter& parameter) {
    const TargetKind kind = parameter.targets.front().kind;
    const bool takes_names =
        kind == TargetKind::kMesh || kind == TargetKind::kMetaphor || kind == TargetKind::kTrajectory;
    OneOf* one_of = std::get_if<OneOf>(&parameter.distribution.shape);
    if (!takes_names) {
      if (one_of != nullptr && one_of->numbers.empty())
        yaml_.fail(node["one_of"], "one_of: all values must be numbers");
      return;
    }
    if (one_of == nullptr || parameter.targets.size() > 1)
      yaml_.fail(node, "a parameter of names varies one thing alone, by 'one_of'");
    one_of->numbers.clear();
    for (const YAML::Node& value : node["one_of"]) {
      if (kind == TargetKind::kMetaphor) index_of(value, "one_of", contact::kMetaphorNames);
      if (kind == TargetKind::kTrajectory) add_trajectory(value);
      if (kind == TargetKind::kMesh) parameter.meshes.push_back(read_mesh(value, parameter.targets.front().object));
    }
  }

  simulation::SceneMesh read_mesh(const YAML::Node& value, std::size_t object) const {
    const simulation::SceneMesh::Origin& origin = study_.scene.objects[object].mesh.origin();
    try {
      files::check_input(full_path(value.Scalar()));
      return {full_path(value.Scalar()), origin.scale, origin.is_welded};
    } catch (const std::invalid_argument& error) {
      yaml_.fail(value, std::string("one_of: ") + error.what());
    }
  }

  void check_range(const YAML::Node& node, const Parameter& parameter) const {
    const OneOf* one_of = parameter.distribution.as_one_of();
    double least = parameter.distribution.bounds().least;
    if (one_of != nullptr) {
      if (one_of->numbers.empty()) return;
      least = *std::min_element(one_of->numbers.begin(), one_of->numbers.end());
    }
    for (const Target& target : parameter.targets) {
      if (target.kind == TargetKind::kFriction && least < 0.0)
        yaml_.fail(node, "the coefficient of friction must not be negative (for 'normal', give 'within')");
      const bool must_be_positive = target.kind == TargetKind::kScale || target.kind == TargetKind::kStiffness;
      if (must_be_positive && !(least > 0.0))
        yaml_.fail(node, "scales and stiffness must be positive (for 'normal', give 'within')");
      if (target.kind == TargetKind::kGoal && !study_.scene.X_WGoal)
        yaml_.fail(node, "the scene has no goal that could be varied");
      const bool changes_mesh =
          target.kind == TargetKind::kScale || target.kind == TargetKind::kShape || target.kind == TargetKind::kMesh;
      if (changes_mesh && !study_.scene.objects[target.object].giving_way.empty())
        yaml_.fail(node, "the mesh of an object with 'gives_way' cannot be varied");
    }
  }

  void read_steps(const YAML::Node& node, Parameter& parameter) const {
    const OneOf* one_of = parameter.distribution.as_one_of();
    const YAML::Node steps = node["steps"];
    if (steps && (study_.sampling != Sampling::kGrid || one_of != nullptr))
      yaml_.fail(steps, "steps: is for 'sampling: grid', and for distributions other than 'one_of'");
    if (study_.sampling != Sampling::kGrid) return;
    if (one_of != nullptr) {
      parameter.steps = static_cast<int>(one_of->names.size());
      return;
    }
    parameter.steps = static_cast<int>(whole(yaml_.required(node, "parameter of a grid", "steps"), "steps", 1.0, 1e6));
    if (!std::isfinite(parameter.distribution.bounds().least))
      yaml_.fail(node, "a grid needs bounds: give 'within' for 'normal'");
  }

  Pilot read_pilot_of(const YAML::Node& node) {
    study_.pilot = full_path(yaml_.text(node, "pilot"));
    try {
      return read_pilot(study_.pilot, study_.parameters);
    } catch (const std::invalid_argument& error) {
      yaml_.fail(node, std::string("pilot: ") + error.what());
    }
  }

  double read_half_width(const YAML::Node& node) const {
    const double half_width = yaml_.number(node, "half_width");
    if (half_width >= kLeastHalfWidth && half_width < kGreatestHalfWidth) return half_width;
    yaml_.fail(node, "half_width: must lie between " + files::format_number(kLeastHalfWidth) + " and " +
                         files::format_number(kGreatestHalfWidth) + ", not " + in_quotes(node.Scalar()));
  }

  void read_stratified(const YAML::Node& root) {
    const Pilot pilot = read_pilot_of(yaml_.required(root, "stratified study", "pilot"));
    const YAML::Node slides = root["slides"], half_width = root["half_width"];
    if (!slides == !half_width) yaml_.fail(root, "a stratified study needs either 'slides' or 'half_width'");
    std::vector<Distribution> distributions;
    for (const Parameter& parameter : study_.parameters)
      distributions.push_back(parameter.distribution);
    StrataPlan plan;
    if (slides) {
      plan.slides = static_cast<std::int64_t>(whole(slides, "slides", 2.0, kMostSlides));
      plan.strata = make_strata(distributions, pilot.slides, most_strata(plan.slides));
    } else {
      plan = plan_for(distributions, pilot.slides, read_half_width(half_width));
    }
    study_.slides = plan.slides;
    // No random numbers of the pilot come again, also if it was a stratified study.
    study_.strata = std::make_shared<const Strata>(std::move(plan.strata), plan.slides, study_.seed ^ pilot.hash);
  }

  void read_slides(const YAML::Node& root) {
    for (const char* key : {"pilot", "half_width"}) {
      if (root[key] && study_.sampling != Sampling::kStratified)
        yaml_.fail(root[key], std::string(key) + ": is for 'sampling: stratified'");
    }
    if (study_.sampling == Sampling::kStratified) return read_stratified(root);
    if (study_.sampling != Sampling::kGrid) {
      study_.slides =
          static_cast<std::int64_t>(whole(yaml_.required(root, "study", "slides"), "slides", 1.0, kMostSlides));
      return;
    }
    if (root["slides"]) yaml_.fail(root["slides"], "slides: a grid has as many slides as the steps give");
    double slides = 1.0;
    for (const Parameter& parameter : study_.parameters)
      slides *= parameter.steps;
    if (slides > kMostSlides)
      yaml_.fail(root, "the grid has " + files::format_number(slides) + " slides; at most 1e+08 are allowed");
    study_.slides = static_cast<std::int64_t>(slides);
  }

  void read_success(const YAML::Node& node) {
    yaml_.check_keys(node, "success", kSuccessKeys);
    Success& success = study_.success;
    const std::array<double*, kSuccessKeys.size()> values{&success.distance_m, &success.angle_deg, &success.force_N,
                                                          &success.torque_Nm, &success.clearance_m};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string key(kSuccessKeys[i]);
      if (node[key]) *values[i] = at_least(node[key], key, 0.0);
    }
  }

  void read_sliding(const YAML::Node& node) {
    yaml_.check_keys(node, "sliding", kSlidingKeys);
    if (const YAML::Node name = node["metaphor"])
      study_.metaphor = static_cast<contact::Metaphor>(index_of(name, "metaphor", contact::kMetaphorNames));
    if (const YAML::Node stiffness = node["stiffness_N_per_m"]) {
      study_.stiffness_N_per_m = yaml_.number(stiffness, "stiffness_N_per_m");
      if (!(study_.stiffness_N_per_m > 0.0)) yaml_.fail(stiffness, "stiffness_N_per_m: must be positive");
    }
    if (const YAML::Node friction = node["friction"])
      study_.rules.friction.sliding = study_.rules.friction.at_rest = at_least(friction, "friction", 0.0);
    if (node["spiral_search"]) study_.rules.spiral_search = yaml_.boolean(node["spiral_search"], "spiral_search");
    if (node["depenetrate"] && yaml_.boolean(node["depenetrate"], "depenetrate"))
      study_.rules.overlap = contact::OverlapRule::kDepenetrate;
  }

  void read_record(const YAML::Node& node) {
    study_.records.fill(!node);
    if (!node) return;
    if (!node.IsSequence()) yaml_.fail(node, "record: must be a list of " + files::joined(kRecordNames));
    for (const YAML::Node& name : node)
      study_.records[index_of(name, "record", kRecordNames)] = true;
    if (study_.success.clearance_m > 0.0 && !study_.has(Record::kClearance))
      yaml_.fail(node, "record: success depends on the clearance, so it must be recorded");
  }

  files::YamlReader yaml_;
  std::string source_;
  std::filesystem::path folder_;
  Study study_;
};

}  // namespace

Study read_study(const std::filesystem::path& path) {
  return StudyReader(path).read();
}

}  // namespace glissade::study
