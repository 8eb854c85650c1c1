#include "io/gltf_document.h"

#include <utility>

#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

/// Levels of nesting: glTF needs about ten. The limit protects the stack, because the JSON library's functions recurse.
constexpr int kDeepestNesting = 100;

}  // namespace

json parsed_gltf(const std::filesystem::path& path, std::string_view text) {
  const auto check_depth = [&](int depth, json::parse_event_t event, const json&) {
    const bool goes_deeper = event == json::parse_event_t::array_start || event == json::parse_event_t::object_start;
    if (goes_deeper && depth >= kDeepestNesting) {
      reject(path, "its JSON is nested more than " + std::to_string(kDeepestNesting) + " deep");
    }
    return true;
  };
  try {
    return json::parse(text, check_depth);
  } catch (const json::parse_error& error) {
    reject(path, "this is not JSON, or truncated: byte " + std::to_string(error.byte) + " makes no sense");
  } catch (const json::out_of_range&) {
    reject(path, "a number in its JSON is beyond every double");
  }
}

GltfDocument::GltfDocument(const std::filesystem::path& path, const json& root, MeshWarnings warnings)
    : path_(path), root_(root), warnings_(std::move(warnings)) {
  const std::string version = root_.at("asset").at("version").get<std::string>();
  if (!version.starts_with("2.")) reject(path_, "asset.version is not 2.x, but this reads glTF 2");
}

std::size_t GltfDocument::index(const char* key, const json& number) const {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= size(key)) {
    // A value that is not a number may be of any length, so only its type is shown.
    const std::string shown = number.is_number() ? number.dump() : std::string(number.type_name());
    reject(path_, std::string(key) + "[" + shown + "] is out of range, there are " + std::to_string(size(key)));
  }
  return number.get<std::size_t>();
}

std::uint64_t GltfDocument::natural_or(const json& object, const char* key, std::uint64_t otherwise,
                                       const std::string& where) const {
  return object.contains(key) ? natural_at(path_, object, key, where) : otherwise;
}

void GltfDocument::count(std::uint64_t number, const std::string& where) {
  constexpr std::uint64_t kMost = 200'000'000;
  if (number > kMost - counted_) {
    reject(path_,
           where + ": up to here there are more than " + std::to_string(kMost) + " points, corners and other elements");
  }
  counted_ += number;
}

}  // namespace glissade::geometry
