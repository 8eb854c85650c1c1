#include "io/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

/// Subjects of extensions that hold neither triangles nor places: looks, sounds, motions over time, and what is known
/// about things. The name of an extension begins with its vendor and its subject, as in KHR_texture_transform.
constexpr std::array<std::string_view, 19> kSubjectsWithoutGeometry{"animation",
                                                                    "audio",
                                                                    "environment",
                                                                    "feature_metadata",
                                                                    "image",
                                                                    "instance_features",
                                                                    "interactivity",
                                                                    "lights",
                                                                    "material",
                                                                    "mesh_features",
                                                                    "node_hoverability",
                                                                    "node_selectability",
                                                                    "packing",
                                                                    "single_root",
                                                                    "stk_metadata",
                                                                    "structural_metadata",
                                                                    "techniques",
                                                                    "texture",
                                                                    "xmp"};

constexpr WarningKind kRequired{"required extension that holds no geometry is ignored",
                                "required extensions that hold no geometry are ignored"};
constexpr WarningKind kIgnored{"use of an extension is ignored", "uses of extensions are ignored"};

bool holds_no_geometry(std::string_view name) {
  std::string subject(name.substr(name.find('_') + 1));
  std::transform(subject.begin(), subject.end(), subject.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::any_of(kSubjectsWithoutGeometry.begin(), kSubjectsWithoutGeometry.end(),
                     [&](std::string_view known) { return subject.starts_with(known); });
}

/// Compression is optional where the document also has what is compressed, and that is read.
bool is_compression(std::string_view name) {
  return name == kGltfDraco || name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression";
}

bool has_name(const json& names, const char* name) {
  return std::find(names.begin(), names.end(), json(name)) != names.end();
}

void check_required_extensions(GltfDocument& document) {
  if (!document.root().contains("extensionsRequired")) return;
  for (const json& extension : document.root().at("extensionsRequired")) {
    const auto name = extension.get<std::string>();
    if (name == kGltfQuantization || name == kGltfInstancing) continue;
    if (!holds_no_geometry(name)) {
      reject(document.path(), "the required extension '" + name + "' is not supported");
    }
    document.warnings().add(kRequired, one_line("'" + name + "'"));
  }
}

void warn_of_ignored_extensions(GltfDocument& document, const json& object, const std::string& where) {
  if (!object.contains("extensions")) return;
  for (const auto& [name, ignored] : object.at("extensions").items()) {
    if (holds_no_geometry(name) || is_compression(name) || name == kGltfInstancing) continue;
    document.warnings().add(kIgnored, one_line("'" + name + "' of " + where));
  }
}

}  // namespace

void check_extensions(GltfDocument& document) {
  check_required_extensions(document);
  warn_of_ignored_extensions(document, document.root(), "the document");
  for (const char* key : {"scenes", "nodes", "meshes", "skins", "accessors", "bufferViews", "buffers"}) {
    for (std::size_t i = 0; i < document.size(key); ++i) {
      const json& entry = document.root().at(key).at(i);
      const std::string where = std::string(key) + "[" + std::to_string(i) + "]";
      warn_of_ignored_extensions(document, entry, where);
      if (key != std::string("meshes")) continue;
      const json& primitives = entry.at("primitives");
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        warn_of_ignored_extensions(document, primitives.at(p), where + ".primitives[" + std::to_string(p) + "]");
      }
    }
  }
}

bool uses_extension(const GltfDocument& document, const char* name) {
  const json& root = document.root();
  return (root.contains("extensionsUsed") && has_name(root.at("extensionsUsed"), name)) ||
         (root.contains("extensionsRequired") && has_name(root.at("extensionsRequired"), name));
}

std::string extensions_with_geometry(const json& object) {
  std::string names;
  if (!object.contains("extensions")) return names;
  for (const auto& [name, ignored] : object.at("extensions").items()) {
    if (!holds_no_geometry(name)) names += (names.empty() ? "'" : ", '") + name + "'";
  }
  return names;
}

}  // namespace glissade::geometry
