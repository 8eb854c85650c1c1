#include "io/gltf_accessors.h"

#include <algorithm>

#include <glissade/base/byte_order.h>

#include "io/gltf_extensions.h"
#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

/// Limit for elements that the file need not hold, because they are zeros. Those of other accessors are in the file.
constexpr std::uint64_t kMostZeros = 1'000'000;

std::size_t width_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 16;  // MAT4
}

double number_of(std::string_view bytes, std::size_t at, std::uint64_t component) {
  switch (component) {
    case kGltfInt8:
      return base::number_at<std::int8_t>(bytes, at);
    case kGltfUint8:
      return base::number_at<std::uint8_t>(bytes, at);
    case kGltfInt16:
      return base::number_at<std::int16_t>(bytes, at);
    case kGltfUint16:
      return base::number_at<std::uint16_t>(bytes, at);
    case kGltfUint32:
      return base::number_at<std::uint32_t>(bytes, at);
    default:
      return static_cast<double>(base::number_at<float>(bytes, at));
  }
}

}  // namespace

/// How the numbers of an element are written.
struct GltfAccessors::Format {
  std::uint64_t component;
  std::size_t width;  // numbers in an element
  std::size_t size;   // bytes of a number
  double largest;     // of the integers of this type
  bool are_fractions;

  std::size_t element_size() const { return width * size; }
  double number(std::string_view bytes, std::size_t at) const {
    const double value = number_of(bytes, at, component);
    return are_fractions ? std::max(value / largest, -1.0) : value;
  }
};

/// Element i begins at byte i · `stride`.
struct GltfAccessors::Elements {
  std::string_view bytes;
  std::size_t stride;

  void copy(std::size_t element, const Format& format, double* to) const {
    for (std::size_t i = 0; i < format.width; ++i) {
      to[i] = format.number(bytes, element * stride + i * format.size);
    }
  }
};

GltfAccessors::Format GltfAccessors::format(std::uint64_t component, std::size_t width, bool are_fractions,
                                            const std::string& where) const {
  switch (component) {
    case kGltfInt8:
      return {component, width, 1, 127, are_fractions};
    case kGltfUint8:
      return {component, width, 1, 255, are_fractions};
    case kGltfInt16:
      return {component, width, 2, 32767, are_fractions};
    case kGltfUint16:
      return {component, width, 2, 65535, are_fractions};
    case kGltfUint32:
      return {component, width, 4, 4294967295, are_fractions};
    case kGltfFloat:
      return {component, width, 4, 1, false};
    default:
      reject(document_.path(), where + ": the componentType " + std::to_string(component) + " is not known");
  }
}

std::uint64_t GltfAccessors::count(const json& accessor) const {
  return natural_at(document_.path(), document_.entry("accessors", accessor), "count",
                    "accessors[" + accessor.dump() + "]");
}

std::uint64_t GltfAccessors::component(const json& accessor) const {
  return natural_at(document_.path(), document_.entry("accessors", accessor), "componentType",
                    "accessors[" + accessor.dump() + "]");
}

bool GltfAccessors::has_values(const json& accessor) const {
  const json& entry = document_.entry("accessors", accessor);
  return entry.contains("bufferView") || entry.contains("sparse");
}

std::vector<double> GltfAccessors::numbers(const json& accessor, const std::string& type, GltfIntegers integers,
                                           std::optional<std::uint64_t> expected_count) {
  const json& entry = document_.entry("accessors", accessor);
  const std::string where = "accessors[" + accessor.dump() + "]";
  if (entry.at("type").get<std::string>() != type) reject(document_.path(), where + ": its type should be " + type);
  const bool says_fractions = entry.contains("normalized") && entry.at("normalized").get<bool>();
  const bool are_fractions =
      integers == GltfIntegers::kFractions || (integers == GltfIntegers::kAsAccessorSays && says_fractions);
  const Format format = this->format(component(accessor), width_of(type), are_fractions, where);
  const std::uint64_t count = this->count(accessor);
  if (expected_count && count != *expected_count) {
    reject(document_.path(), where + ": it has " + std::to_string(count) + " elements, but should have " +
                                 std::to_string(*expected_count));
  }
  std::vector<double> result;
  if (entry.contains("bufferView")) {
    const std::uint64_t begin = document_.natural_or(entry, "byteOffset", 0, where);
    const Elements given = elements(entry.at("bufferView"), begin, count, format.element_size(), where);
    document_.count(count, where);
    result.resize(count * format.width);
    for (std::size_t i = 0; i < count; ++i) {
      given.copy(i, format, &result[i * format.width]);
    }
  } else {
    if (!expected_count && count > kMostZeros) {
      reject(document_.path(), where + ": it has " + std::to_string(count) + " elements, but no bufferView; at most " +
                                   std::to_string(kMostZeros) + " zeros are accepted");
    }
    document_.count(count, where);
    result.resize(count * format.width);
  }
  if (entry.contains("sparse")) replace_sparse(entry.at("sparse"), count, format, where + ".sparse", result);
  return result;
}

GltfAccessors::Elements GltfAccessors::elements(const json& view, std::uint64_t begin, std::uint64_t count,
                                                std::size_t element_size, const std::string& where) {
  const json& entry = document_.entry("bufferViews", view);
  const std::string where_of_view = "bufferViews[" + view.dump() + "]";
  const std::size_t number = document_.index("buffers", entry.at("buffer"));
  const std::string extensions = extensions_with_geometry(entry);
  if (!extensions.empty() && !buffers_.has_content(number)) {
    reject(document_.path(), where_of_view + ": its data is only in its extension " + extensions +
                                 ", which is not supported; buffers[" + std::to_string(number) + "] has no content");
  }
  const std::string_view buffer = buffers_.content(number);
  const std::uint64_t view_begin = document_.natural_or(entry, "byteOffset", 0, where_of_view);
  const std::uint64_t view_size = natural_at(document_.path(), entry, "byteLength", where_of_view);
  if (view_begin > buffer.size() || view_size > buffer.size() - view_begin) {
    reject(document_.path(),
           where_of_view + " reaches beyond its buffer of " + std::to_string(buffer.size()) + " bytes");
  }
  std::uint64_t stride = document_.natural_or(entry, "byteStride", 0, where_of_view);
  if (stride == 0) stride = element_size;
  if (stride < element_size) {
    reject(document_.path(), where + ": its byteStride of " + std::to_string(stride) +
                                 " is less than the size of an element, " + std::to_string(element_size));
  }
  const bool fits = count == 0 || (begin <= view_size && element_size <= view_size - begin &&
                                   (count - 1) <= (view_size - begin - element_size) / stride);
  if (!fits) {
    reject(document_.path(), where + ": its " + std::to_string(count) + " elements do not lie within its view of " +
                                 std::to_string(view_size) + " bytes");
  }
  return {buffer.substr(view_begin, view_size).substr(std::min(begin, view_size)), stride};
}

void GltfAccessors::replace_sparse(const json& sparse, std::uint64_t count, const Format& format,
                                   const std::string& where, std::vector<double>& numbers) {
  const std::uint64_t replaced = natural_at(document_.path(), sparse, "count", where);
  const auto part = [&](const char* key, const Format& format_of_part) {
    const json& given = sparse.at(key);
    const std::string where_of_part = where + "." + key;
    return elements(given.at("bufferView"), document_.natural_or(given, "byteOffset", 0, where_of_part), replaced,
                    format_of_part.element_size(), where_of_part);
  };
  const std::uint64_t type = natural_at(document_.path(), sparse.at("indices"), "componentType", where + ".indices");
  if (type != kGltfUint8 && type != kGltfUint16 && type != kGltfUint32) {
    reject(document_.path(), where + ".indices must be of componentType 5121, 5123 or 5125");
  }
  const Format format_of_indices = this->format(type, 1, false, where);
  const Elements indices = part("indices", format_of_indices);
  const Elements values = part("values", format);
  std::vector<bool> is_replaced(count);
  for (std::uint64_t i = 0; i < replaced; ++i) {
    double index = 0;
    indices.copy(i, format_of_indices, &index);
    const auto element = static_cast<std::size_t>(index);
    if (element >= count) {
      reject(document_.path(), where + ": index " + std::to_string(i) + " is " + std::to_string(element) +
                                   ", but there are " + std::to_string(count) + " elements");
    }
    if (is_replaced[element]) {
      reject(document_.path(), where + ": it has two values for element " + std::to_string(element));
    }
    is_replaced[element] = true;
    values.copy(i, format, &numbers[element * format.width]);
  }
}

}  // namespace glissade::geometry
