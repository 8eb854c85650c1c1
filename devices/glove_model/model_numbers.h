#pragma once

/// All numbers of a `GloveModel`, with their keys in files and their ranges.

#include <string>
#include <string_view>
#include <vector>

#include <glissade/devices/glove_model.h>

namespace glissade::devices {

/// The parts of a file.
enum class ModelSection {
  kRoot,
  kWrist,
  kGroundedWrist,
  kHoldingWrist,
  kIdealFingers,
  kWearer,
  kActuator,
  kServo,
  kString,
  kSensor,
  kLink
};

struct ModelNumber {
  ModelSection section;
  std::string_view key;
  double* value;
  double least;
  double most;
  bool is_required;  ///< in a file that has the section
};

/// The numbers of `model`, in the order of docs/glove_models.md.
std::vector<ModelNumber> numbers_of(GloveModel& model);

/// The key of a section, such as "fingers.servo". Empty for the root.
std::string_view key_of(ModelSection section) noexcept;

/// Whether a model of this kind has the section.
bool has_section(const GloveModel& model, ModelSection section) noexcept;

/// The names of the kinds of fingers, in the order of `FingerKind`.
inline constexpr std::array<std::string_view, 7> kFingerKinds{"absent",      "ideal",      "tracked", "torque",
                                                              "joint-limit", "curl-limit", "brake"};

/// What is wrong with the model apart from single numbers, as a sentence. Empty if nothing is.
std::string contradiction_in(const GloveModel& model);

/// "must lie between 0 and 1, not 2".
std::string out_of_range(const ModelNumber& number, double value);

}  // namespace glissade::devices
