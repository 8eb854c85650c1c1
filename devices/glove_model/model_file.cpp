#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <glissade/devices/glove_model.h>
#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>
#include <glissade/files/yaml_reader.h>

#include "glove_model/model_numbers.h"
#include "glove_model/presets.h"

namespace glissade::devices {
namespace {

using files::YamlReader;

/// Reads one file. Every section is read once, with all its numbers.
class ModelFile {
 public:
  ModelFile(const std::string& text, const std::string& source) : reader_(source), root_(reader_.parse(text)) {
    numbers_ = numbers_of(model_);
  }

  GloveModel read() {
    check_keys(root_, "the file", {"name", "summary", "seed", "wrist", "fingers", "link"}, {ModelSection::kRoot});
    model_.name = reader_.text(reader_.required(root_, "the file", "name"), "name");
    model_.summary = reader_.text(reader_.required(root_, "the file", "summary"), "summary");
    if (const YAML::Node seed = root_["seed"]) model_.seed = seed_of(seed);
    read_numbers(root_, ModelSection::kRoot);
    read_wrist(reader_.required(root_, "the file", "wrist"));
    read_fingers(reader_.required(root_, "the file", "fingers"));
    if (const YAML::Node link = root_["link"]) read_section(link, ModelSection::kLink);
    const std::string contradiction = contradiction_in(model_);
    if (!contradiction.empty()) reader_.fail(root_, contradiction);
    return model_;
  }

 private:
  void check_keys(const YAML::Node& map, const std::string& what, std::vector<std::string_view> known,
                  const std::vector<ModelSection>& sections) const {
    for (const ModelNumber& number : numbers_) {
      const bool belongs = std::find(sections.begin(), sections.end(), number.section) != sections.end();
      if (belongs && has_section(model_, number.section)) known.push_back(number.key);
    }
    reader_.check_keys(map, what, known);
  }

  void read_numbers(const YAML::Node& map, ModelSection section) {
    if (!has_section(model_, section)) return;
    for (const ModelNumber& number : numbers_) {
      if (number.section != section) continue;
      const std::string key(number.key);
      if (!number.is_required && !map[key]) continue;
      const std::string what = section == ModelSection::kRoot ? "the file" : std::string(key_of(section));
      const YAML::Node node = reader_.required(map, what, key);
      const double value = reader_.number(node, key);
      if (value < number.least || value > number.most) reader_.fail(node, key + ": " + out_of_range(number, value));
      *number.value = value;
    }
  }

  void read_section(const YAML::Node& map, ModelSection section) {
    check_keys(map, std::string(key_of(section)), {}, {section});
    read_numbers(map, section);
  }

  void read_wrist(const YAML::Node& wrist) {
    reader_.check_map(wrist, "wrist");
    const std::size_t kind = choice(wrist, "wrist", {"tracker", "grounded", "half-spaces"});
    model_.wrist.is_grounded = kind > 0;
    model_.wrist.holds_half_spaces = kind == 2;
    using enum ModelSection;
    check_keys(wrist, "wrist", {"kind"}, {kWrist, kGroundedWrist, kHoldingWrist});
    for (const ModelSection section : {kWrist, kGroundedWrist, kHoldingWrist})
      read_numbers(wrist, section);
  }

  void read_fingers(const YAML::Node& fingers) {
    reader_.check_map(fingers, "fingers");
    const std::vector<std::string_view> kinds(kFingerKinds.begin(), kFingerKinds.end());
    model_.fingers = static_cast<FingerKind>(choice(fingers, "fingers", kinds));
    using enum ModelSection;
    std::vector<std::string_view> known{"kind"};
    for (const ModelSection section : {kWearer, kActuator, kServo, kString, kSensor}) {
      if (has_section(model_, section)) known.push_back(name_of(section));
    }
    check_keys(fingers, "fingers", known, {kIdealFingers});
    read_numbers(fingers, kIdealFingers);
    for (const ModelSection section : {kWearer, kSensor}) {
      if (const YAML::Node map = fingers[std::string(name_of(section))]) read_section(map, section);
    }
    if (has_section(model_, kActuator)) read_actuator(reader_.required(fingers, "fingers", "actuator"));
    for (const ModelSection section : {kServo, kString}) {
      if (has_section(model_, section))
        read_section(reader_.required(fingers, "fingers", std::string(name_of(section))), section);
    }
  }

  void read_actuator(const YAML::Node& actuator) {
    check_keys(actuator, "fingers.actuator", {"joints"}, {ModelSection::kActuator});
    read_numbers(actuator, ModelSection::kActuator);
    const YAML::Node joints = reader_.required(actuator, "fingers.actuator", "joints");
    if (joints.IsScalar() && joints.Scalar() == "all") {
      model_.actuator.is_driven.fill(true);
      return;
    }
    if (!joints.IsSequence()) reader_.fail(joints, "joints: must be 'all' or a list of joints");
    for (const YAML::Node& joint : joints) {
      const std::string name = reader_.text(joint, "joints");
      const auto* const found = std::find(hands::kJointNames.begin(), hands::kJointNames.end(), name);
      if (found == hands::kJointNames.end())
        reader_.fail(joint, "joints: " + files::in_quotes(name) +
                                " is no joint (known: " + files::joined(hands::kJointNames) + ")");
      model_.actuator.is_driven[static_cast<std::size_t>(found - hands::kJointNames.begin())] = true;
    }
  }

  /// The last part of the key.
  static std::string_view name_of(ModelSection section) {
    const std::string_view key = key_of(section);
    return key.substr(key.find('.') + 1);
  }

  std::size_t choice(const YAML::Node& map, const std::string& what, const std::vector<std::string_view>& kinds) const {
    const YAML::Node node = reader_.required(map, what, "kind");
    const std::string kind = reader_.text(node, "kind");
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end())
      reader_.fail(node, "kind: must be one of " + files::joined(kinds) + ", not " + files::in_quotes(kind));
    return static_cast<std::size_t>(found - kinds.begin());
  }

  std::uint64_t seed_of(const YAML::Node& node) const {
    const double seed = reader_.number(node, "seed");
    if (seed < 0.0 || seed > 1e15 || seed != std::floor(seed))
      reader_.fail(node, "seed: must be a whole number from 0 to 1e15");
    return static_cast<std::uint64_t>(seed);
  }

  YamlReader reader_;
  YAML::Node root_;
  GloveModel model_;
  std::vector<ModelNumber> numbers_;
};

}  // namespace

GloveModel parse_glove_model(const std::string& text, const std::string& source) {
  return ModelFile(text, source).read();
}

GloveModel read_glove_model(const std::string& preset_or_path) {
  for (const PresetFile& preset : preset_files()) {
    if (preset.name == preset_or_path)
      return parse_glove_model(std::string(preset.text), std::string(preset.name) + ".yaml");
  }
  if (!std::filesystem::exists(preset_or_path)) {
    std::vector<std::string> known;
    for (const std::string_view name : glove_presets())
      known.emplace_back(name);
    throw std::invalid_argument(files::in_quotes(preset_or_path) + " is neither a file nor a preset" +
                                files::did_you_mean(preset_or_path, known) + " (presets: " + files::joined(known) +
                                ")");
  }
  return parse_glove_model(files::read_text_file(preset_or_path), preset_or_path);
}

std::vector<std::string_view> glove_presets() {
  std::vector<std::string_view> names;
  for (const PresetFile& preset : preset_files())
    names.push_back(preset.name);
  return names;
}

}  // namespace glissade::devices
