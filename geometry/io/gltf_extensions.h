#pragma once

/// The extensions of a glTF document: which are read, which hold no geometry, and which may hold geometry and are not
/// read.

#include <string>

#include <nlohmann/json.hpp>

#include "io/gltf_document.h"

namespace glissade::geometry {

inline constexpr const char* kGltfDraco = "KHR_draco_mesh_compression";
inline constexpr const char* kGltfInstancing = "EXT_mesh_gpu_instancing";
inline constexpr const char* kGltfQuantization = "KHR_mesh_quantization";

/// Rejects a document that requires an extension which may hold geometry and is not read. Warns of required ones that
/// hold no geometry, and of all others that may change the geometry and are not read.
void check_extensions(GltfDocument& document);

/// Whether the document says that it uses the extension.
bool uses_extension(const GltfDocument& document, const char* name);

/// The names of those extensions of an object that may hold its geometry, in quotes; empty if there are none.
std::string extensions_with_geometry(const nlohmann::json& object);

}  // namespace glissade::geometry
