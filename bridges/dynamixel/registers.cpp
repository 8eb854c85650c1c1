#include "dynamixel/registers.h"

#include <algorithm>
#include <cmath>

#include <glissade/base/assert.h>

namespace glissade::bridges::dynamixel {
namespace {

constexpr double per_minute(double turns) {
  return turns * 2.0 * std::numbers::pi / 60.0;
}

constexpr double kBacklash_rad = 0.33 * std::numbers::pi / 180.0;

constexpr std::array<ServoModel, 4> kServoModels{
    {{"XL330-M288", 1200, 0.52, 1.47, per_minute(103), 288.4, 1.75, kBacklash_rad},
     {"XL330-M077", 1190, 0.215, 1.47, per_minute(383), 77.5, 1.75, kBacklash_rad},
     {"XC330-M288", 1240, 0.93, 1.80, per_minute(81), 288.35, 2.352, kBacklash_rad},
     {"XC330-M181", 1230, 0.60, 1.80, per_minute(129), 180.62, 2.352, kBacklash_rad}}};

template <class Predicate>
std::optional<ServoModel> find_model_if(Predicate is_it) {
  const auto* const found = std::find_if(kServoModels.begin(), kServoModels.end(), is_it);
  if (found == kServoModels.end()) return std::nullopt;
  return *found;
}

std::int64_t largest_count(const Register& of) {
  const int bits = 8 * of.size - (of.is_signed ? 1 : 0);
  return (std::int64_t{1} << bits) - 1;
}

}  // namespace

std::int64_t decode_register(const Register& of, std::string_view bytes) {
  GLISSADE_ASSERT(bytes.size() == of.size);
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[i - 1]);
  const std::int64_t largest = largest_count(of);
  const auto number = static_cast<std::int64_t>(value);
  return of.is_signed && number > largest ? number - 2 * (largest + 1) : number;
}

std::string encode_register(const Register& of, std::int64_t value) {
  const std::int64_t largest = largest_count(of);
  auto rest = static_cast<std::uint64_t>(std::clamp(value, of.is_signed ? -largest - 1 : 0, largest));
  std::string bytes;
  for (int i = 0; i < of.size; ++i, rest >>= 8)
    bytes.push_back(static_cast<char>(rest & 0xFFU));
  return bytes;
}

std::int64_t to_counts(const Register& of, double value) noexcept {
  const double largest = static_cast<double>(largest_count(of));
  return static_cast<std::int64_t>(std::clamp(std::round(value / of.unit), -largest, largest));
}

std::optional<ServoModel> find_model(std::string_view name) {
  return find_model_if([name](const ServoModel& model) { return model.name == name; });
}

std::optional<ServoModel> find_model(std::uint16_t number) {
  return find_model_if([number](const ServoModel& model) { return model.number == number; });
}

std::string model_names() {
  std::string names;
  for (const ServoModel& model : kServoModels)
    names += (names.empty() ? "" : ", ") + std::string(model.name);
  return names;
}

}  // namespace glissade::bridges::dynamixel
