#pragma once

/// The elements of glTF accessors: plain, normalized or sparse.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/gltf_buffers.h"
#include "io/gltf_document.h"

namespace glissade::geometry {

/// Values of componentType.
inline constexpr std::uint64_t kGltfInt8 = 5120;
inline constexpr std::uint64_t kGltfUint8 = 5121;
inline constexpr std::uint64_t kGltfInt16 = 5122;
inline constexpr std::uint64_t kGltfUint16 = 5123;
inline constexpr std::uint64_t kGltfUint32 = 5125;
inline constexpr std::uint64_t kGltfFloat = 5126;

/// What the integers of an accessor stand for: themselves, fractions of the largest one, or whichever of both the
/// accessor says.
enum class GltfIntegers { kPlain, kFractions, kAsAccessorSays };

/// The accessors of a document, which must outlive it. All functions throw as those of `GltfDocument`; `accessor` is
/// the number of an accessor in the document.
class GltfAccessors {
 public:
  GltfAccessors(GltfDocument& document, GltfBuffers& buffers) : document_(document), buffers_(buffers) {}

  std::uint64_t count(const nlohmann::json& accessor) const;
  std::uint64_t component(const nlohmann::json& accessor) const;

  /// Whether the document itself has values for the accessor. Without them it is all zeros, unless an extension has
  /// them.
  bool has_values(const nlohmann::json& accessor) const;

  /// All elements, one after the other; `type` is the type that they must have, such as "VEC3". Rejects another count
  /// than `expected_count`.
  std::vector<double> numbers(const nlohmann::json& accessor, const std::string& type, GltfIntegers integers,
                              std::optional<std::uint64_t> expected_count = std::nullopt);

 private:
  struct Format;
  struct Elements;

  Format format(std::uint64_t component, std::size_t width, bool are_fractions, const std::string& where) const;
  /// `count` elements from byte `begin` of a buffer view.
  Elements elements(const nlohmann::json& view, std::uint64_t begin, std::uint64_t count, std::size_t element_size,
                    const std::string& where);
  void replace_sparse(const nlohmann::json& sparse, std::uint64_t count, const Format& format, const std::string& where,
                      std::vector<double>& numbers);

  GltfDocument& document_;
  GltfBuffers& buffers_;
};

}  // namespace glissade::geometry
