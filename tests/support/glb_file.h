#pragma once

/// Binary glTF as the viewer writes it, read by the rules of the format.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace glissade::test_support {

inline std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

struct Glb {
  nlohmann::json json;
  std::string binary;
};

/// The two chunks of the file.
inline Glb read_glb(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word_at(bytes, 4), 2u);
  EXPECT_EQ(word_at(bytes, 8), bytes.size());
  const std::size_t json_size = word_at(bytes, 12);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(json_size % 4, 0u);
  const std::size_t second = 20 + json_size;
  EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(second + 8 + word_at(bytes, second), bytes.size());
  return {nlohmann::json::parse(bytes.substr(20, json_size)), bytes.substr(second + 8)};
}

inline Eigen::Isometry3d pose_of(const nlohmann::json& node) {
  const auto& p = node["translation"];
  const auto& q = node["rotation"];
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
}

/// The bounding box of a node's mesh, in the frame of the scene.
inline Eigen::AlignedBox3d bounds_of(const Glb& glb, const nlohmann::json& node) {
  const nlohmann::json& grid = glb.json["nodes"][node["children"][0].get<std::size_t>()];
  const nlohmann::json& primitive = glb.json["meshes"][grid["mesh"].get<std::size_t>()]["primitives"][0];
  const nlohmann::json& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  const nlohmann::json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < accessor["count"]; ++i) {
    std::array<std::uint16_t, 3> p{};
    const std::size_t offset = view["byteOffset"].get<std::size_t>() + i * view["byteStride"].get<std::size_t>();
    std::memcpy(p.data(), glb.binary.data() + offset, sizeof p);
    const Eigen::Vector3d lower(grid["translation"][0], grid["translation"][1], grid["translation"][2]);
    box.extend(pose_of(node) * (lower + grid["scale"][0].get<double>() * Eigen::Vector3d(p[0], p[1], p[2])));
  }
  return box;
}

}  // namespace glissade::test_support
