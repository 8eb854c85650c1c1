#pragma once

// Mesh files written by code, for the tests of the importer.

#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace glissade::geometry {

/// A folder that is gone at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> next{0};
    path_ = std::filesystem::temp_directory_path() /
            ("glissade_meshes_" + std::to_string(getpid()) + "_" + std::to_string(next++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// The bytes of numbers, lowest first or highest first.
template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers, bool is_big_endian = false) {
  std::string result;
  for (const Number number : numbers) {
    std::string raw(sizeof(Number), '\0');
    std::memcpy(raw.data(), &number, sizeof(Number));
    const bool must_turn = is_big_endian != (std::endian::native == std::endian::big);
    result += must_turn ? std::string(raw.rbegin(), raw.rend()) : raw;
  }
  return result;
}

/// Text with CR LF at the ends of its lines.
inline std::string with_crlf(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') result += '\r';
    result += c;
  }
  return result;
}

/// Three bytes that some programs write before a text.
inline const std::string kByteOrderMark = "\xEF\xBB\xBF";

/// A tetrahedron in every format, with its corner i + 1 at distance one along axis i.
inline const std::string kObj =
    "# tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

inline const std::string kAsciiPly =
    "ply\nformat ascii 1.0\ncomment tetrahedron\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

inline std::string binary_ply(bool is_big_endian) {
  const bool big = is_big_endian;
  std::string file = "ply\nformat binary_" + std::string(big ? "big" : "little") +
                     "_endian 1.0\nelement vertex 4\nproperty double x\nproperty uchar red\nproperty double y\n"
                     "property double z\nproperty list uchar float weights\nelement face 4\nproperty short tag\n"
                     "property list ushort uint vertex_index\nelement edge 1\nproperty int a\nend_header\n";
  const std::vector<std::vector<double>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& p : points) {
    file += bytes_of<double>({p[0]}, big) + "\xff" + bytes_of<double>({p[1], p[2]}, big);
    file += '\2' + bytes_of<float>({0.5F, 0.5F}, big);
  }
  const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const auto& f : faces) {
    file += bytes_of<std::int16_t>({-7}, big) + bytes_of<std::uint16_t>({3}, big);
    file += bytes_of<std::uint32_t>({f[0], f[1], f[2]}, big);
  }
  return file + bytes_of<std::int32_t>({42}, big);
}

inline std::string ascii_stl_facet(const std::string& a, const std::string& b, const std::string& c) {
  return "  facet normal 0 0 nan\n    outer loop\n      vertex " + a + "\n      vertex " + b + "\n      vertex " + c +
         "\n    endloop\n  endfacet\n";
}

inline const std::string kAsciiStl = "solid a name with words\n" + ascii_stl_facet("0 0 0", "0 1 0", "1 0 0") +
                                     ascii_stl_facet("0 0 0", "1 0 0", "0 0 1e0") +
                                     ascii_stl_facet("0 0 0", "0 0 1.0", "0 1 0") +
                                     ascii_stl_facet("1.00 0 0", "0 1 0", "0 0 1") + "endsolid a name with words\n";

inline std::string binary_stl(const std::string& header_begin) {
  std::string file = header_begin + std::string(80 - header_begin.size(), ' ') + bytes_of<std::uint32_t>({4});
  const std::vector<std::vector<float>> facets{{0, 0, 0, 0, 1, 0, 1, 0, 0},
                                               {0, 0, 0, 1, 0, 0, 0, 0, 1},
                                               {0, 0, 0, 0, 0, 1, 0, 1, 0},
                                               {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  for (const auto& facet : facets) {
    file += std::string(12, '\0');
    for (const float value : facet) {
      file += bytes_of<float>({value});
    }
    file += std::string(2, '\0');
  }
  return file;
}

/// 48 bytes of positions and 24 of indices.
inline std::string gltf_binary() {
  return bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         bytes_of<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

/// A document whose one buffer is `buffer` (an entry of "buffers").
inline std::string gltf(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"children":[1],"translation":[0,0,0]},{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("materials":[{"name":"steel"}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},)"
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
         R"("buffers":[)" +
         buffer + "]}";
}

inline std::string glb(std::string text, const std::string& binary) {
  text.append((4 - text.size() % 4) % 4, ' ');
  const auto size = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
  const std::uint32_t total = 12 + 8 + size(text) + 8 + size(binary);
  return "glTF" + bytes_of<std::uint32_t>({2, total, size(text)}) + "JSON" + text +
         bytes_of<std::uint32_t>({size(binary)}) + std::string("BIN\0", 4) + binary;
}

inline std::string tetrahedron_glb() {
  return glb(gltf(R"({"byteLength":72})"), gltf_binary());
}

/// `text` with the first `from` replaced by `to`.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace glissade::geometry
