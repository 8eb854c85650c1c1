#include "io/gltf_document.h"

#include <algorithm>

#include "io/gltf_buffers.h"
#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

/// Levels of nesting: glTF needs about ten. The limit protects the stack, because the JSON library's functions recurse.
constexpr int kDeepestNesting = 100;

constexpr const char* kQuantization = "KHR_mesh_quantization";

}  // namespace

json parsed_gltf(const std::filesystem::path& path, std::string_view text) {
  const auto check_depth = [&](int depth, json::parse_event_t event, const json&) {
    const bool goes_deeper = event == json::parse_event_t::array_start || event == json::parse_event_t::object_start;
    if (goes_deeper && depth >= kDeepestNesting) {
      reject(path, "Its JSON is nested more than " + std::to_string(kDeepestNesting) + " deep");
    }
    return true;
  };
  try {
    return json::parse(text, check_depth);
  } catch (const json::parse_error& error) {
    reject(path, "This is not JSON, or truncated: byte " + std::to_string(error.byte) + " makes no sense");
  } catch (const json::out_of_range&) {
    reject(path, "A number in its JSON is beyond every double");
  }
}

GltfDocument::GltfDocument(const std::filesystem::path& path, const json& root, std::string_view binary)
    : path_(path), root_(root), buffers_(gltf_buffers(path, root, binary)) {}

void GltfDocument::check_version() const {
  const std::string version = root_.at("asset").at("version").get<std::string>();
  if (!version.starts_with("2.")) reject(path_, "asset.version is not 2.x, but this reads glTF 2");
  if (!root_.contains("extensionsRequired")) return;
  for (const json& extension : root_.at("extensionsRequired")) {
    const auto name = extension.get<std::string>();
    const bool is_known = name == kQuantization || name.starts_with("KHR_materials_") ||
                          name.starts_with("KHR_texture_") || name.starts_with("KHR_lights_") ||
                          name.starts_with("EXT_texture_");
    if (!is_known) reject(path_, "The required extension '" + name + "' is not supported");
  }
}

bool GltfDocument::allows_quantized_positions() const {
  if (!root_.contains("extensionsRequired")) return false;
  const json& required = root_.at("extensionsRequired");
  return std::find(required.begin(), required.end(), json(kQuantization)) != required.end();
}

bool GltfDocument::is_normalized(const json& index) const {
  const json& accessor = entry("accessors", index);
  return accessor.contains("normalized") && accessor.at("normalized").get<bool>();
}

const json& GltfDocument::entry(const char* key, const json& index) const {
  const std::size_t size = root_.contains(key) ? root_.at(key).size() : 0;
  if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= size) {
    // A value that is not a number may be of any length, so only its type is shown.
    const std::string shown = index.is_number() ? index.dump() : std::string(index.type_name());
    reject(path_, std::string(key) + "[" + shown + "] is out of range, there are " + std::to_string(size));
  }
  return root_.at(key).at(index.get<std::size_t>());
}

std::uint64_t GltfDocument::natural_or(const json& object, const char* key, std::uint64_t otherwise,
                                       const std::string& where) const {
  return object.contains(key) ? natural_at(path_, object, key, where) : otherwise;
}

std::uint64_t GltfDocument::component(const json& index) const {
  return natural_at(path_, entry("accessors", index), "componentType", "accessors[" + index.dump() + "]");
}

GltfDocument::Elements GltfDocument::elements(const json& index, const std::string& type,
                                              std::size_t element_size) const {
  const json& accessor = entry("accessors", index);
  const std::string where = "accessors[" + index.dump() + "]";
  if (accessor.contains("sparse") || !accessor.contains("bufferView")) {
    reject(path_, where + ": sparse accessors are not supported");
  }
  if (accessor.at("type").get<std::string>() != type) reject(path_, where + ": its type should be " + type);
  const json& view = entry("bufferViews", accessor.at("bufferView"));
  const std::string where_of_view = "bufferViews[" + accessor.at("bufferView").dump() + "]";
  entry("buffers", view.at("buffer"));
  const std::string& buffer = buffers_.at(view.at("buffer").get<std::size_t>());
  const std::uint64_t view_begin = natural_or(view, "byteOffset", 0, where_of_view);
  const std::uint64_t view_size = natural_at(path_, view, "byteLength", where_of_view);
  if (view_begin > buffer.size() || view_size > buffer.size() - view_begin) {
    reject(path_, where_of_view + " reaches beyond its buffer of " + std::to_string(buffer.size()) + " bytes");
  }
  const std::uint64_t begin = natural_or(accessor, "byteOffset", 0, where);
  const std::uint64_t stride = natural_or(view, "byteStride", element_size, where_of_view);
  const std::uint64_t count = natural_at(path_, accessor, "count", where);
  if (stride < element_size || stride > 252) reject(path_, where + ": its byteStride is out of range");
  const bool fits = count >= 1 && begin <= view_size && element_size <= view_size - begin &&
                    (count - 1) <= (view_size - begin - element_size) / stride;
  if (!fits) {
    reject(path_, where + ": its " + std::to_string(count) + " elements do not lie within its view of " +
                      std::to_string(view_size) + " bytes");
  }
  return {buffer, static_cast<std::size_t>(view_begin + begin), static_cast<std::size_t>(stride),
          static_cast<std::size_t>(count)};
}

}  // namespace glissade::geometry
