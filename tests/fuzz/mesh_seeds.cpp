#include "mesh_seeds.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "mesh_files.h"

namespace glissade::fuzz {
namespace {

using geometry::ascii_stl_facet;
using geometry::bytes_of;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::with_crlf;

std::string text_of(const Eigen::Vector3d& p) {
  return std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z());
}

geometry::TriangleMesh box() {
  return geometry::make_box({0.1, 0.2, 0.3}, 12);
}

geometry::TriangleMesh sphere() {
  return geometry::make_sphere(0.5, 60);
}

/// `relative` counts the corners backwards, and gives them texture coordinates and normals.
std::string obj_of(const geometry::TriangleMesh& mesh, bool relative) {
  std::string file = "# Türgriff\no Tür\xC3\xA9\n";
  for (const Eigen::Vector3d& p : mesh.vertices) {
    file += "v " + text_of(p) + (relative ? " 1.0\n" : "\n");
  }
  file += relative ? "vt 0 0\nvn 0 0 1\ns off\n" : "g \xE6\x89\x89\nusemtl steel\n";
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  for (const geometry::Triangle& triangle : mesh.triangles) {
    file += 'f';
    for (const std::int32_t corner : triangle) {
      file += " " + (relative ? std::to_string(corner - count) + "/1/1" : std::to_string(corner + 1));
    }
    file += '\n';
  }
  return file;
}

/// A concave hexagon, a square, a bow tie and a polygon with a doubled corner; in two objects.
std::string obj_of_polygons() {
  return "o first\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 \\\n4 5 6\nf 1 2 4 6 6\n"
         "o second\nv 3 0 1e-3\nv 5 0 -1E+0\nv 5 2 +.5\nv 3 2 0\nf -4 -3 -2 -1\nf 7//1 9//1 8//1 10//1\n";
}

std::string stl_of(const geometry::TriangleMesh& mesh) {
  std::string file = "solid Tür\n";
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t corner) { return text_of(mesh.vertices[static_cast<std::size_t>(t[corner])]); };
    file += ascii_stl_facet(at(0), at(1), at(2));
  }
  return file + "endsolid Tür\n";
}

std::string binary_stl_of(const geometry::TriangleMesh& mesh) {
  std::string file = "COLOR=\xff" + std::string(73, '\0') +
                     bytes_of<std::uint32_t>({static_cast<std::uint32_t>(mesh.triangles.size())});
  for (const geometry::Triangle& triangle : mesh.triangles) {
    file += bytes_of<float>({0, 0, 1});
    for (const std::int32_t corner : triangle) {
      for (const double coordinate : mesh.vertices[static_cast<std::size_t>(corner)]) {
        file += bytes_of<float>({static_cast<float>(coordinate)});
      }
    }
    file += std::string("\x1f\x7c", 2);
  }
  return file;
}

/// Binary, with floats or doubles and indices of the type `Index`; `index_type` is PLY's name for it.
template <class Number, class Index>
std::string binary_ply_of(const geometry::TriangleMesh& mesh, const std::string& number_type,
                          const std::string& index_type, bool is_big_endian) {
  std::string file = "ply\nformat binary_" + std::string(is_big_endian ? "big" : "little") +
                     "_endian 1.0\nobj_info Tür\nelement vertex " + std::to_string(mesh.vertices.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) {
    file += "property " + number_type + " " + axis + "\n";
  }
  file += "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar " + index_type +
          " vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& p : mesh.vertices) {
    for (const double coordinate : p) {
      file += bytes_of<Number>({static_cast<Number>(coordinate)}, is_big_endian);
    }
  }
  for (const geometry::Triangle& triangle : mesh.triangles) {
    file += '\3';
    for (const std::int32_t corner : triangle) {
      file += bytes_of<Index>({static_cast<Index>(corner)}, is_big_endian);
    }
  }
  return file;
}

/// Faces before vertices, polygons, an element without properties and lists that nobody needs.
std::string text_ply_of_polygons() {
  return "ply\nformat ascii 1.0\ncomment \xE6\x89\x89\nelement nothing 2000000000\nelement face 3\n"
         "property uchar red\nproperty list int16 uint8 vertex_index\nproperty list uint8 float texcoord\n"
         "element vertex 6\nproperty float64 z\nproperty int32 x\nproperty float32 y\nelement edge 1\n"
         "property list char char loop\nend_header\n"
         "255 6 0 1 2 3 4 5 2 0.5 .5\n0 4 0 1 3 5 0\n7 3 0 2 4 1 1e-3\n"
         "0 0 0\n0 2 0\n0 2 1\n0 1 1\n0 1 2\n1.5 0 2\n3 -1 0 1\n";
}

/// Statements that are skipped, with and without a warning.
std::string obj_dialect() {
  return "8 12\rusemtl C:\\\rcurv 0 1 1 2\rend\r" + geometry::kObj +
         "v nan 0 0 # unused\nv 0 0 0 1 red\nf 1\nf -1 2 \\\n# f 3\nfo 2 3 4 #\n";
}

/// Keywords in two words, facets outside of solids, lines of other programs, and no end.
std::string stl_dialect() {
  return "; made by hand\nfacet normal -1.#IND 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 end loop "
         "endfacet\n"
         "solid a\rSOLID b\rcolor 1 0 0\rfacet\routerloop\rvertex 0 0 0\rvertex 1 0 0\rvertex 0 0 1\rendfacet\r"
         "endsolidb solid facet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet";
}

/// Strips and faces, some too short, odd numbers that are not read, and comments in the body.
std::string ply_dialect() {
  return "ply\rformat ascii 1.0\rcomment\relement patch 1\rproperty list char double vertex_index\relement vertex 5\r"
         "property float nx\rproperty float x\rproperty float y\rproperty float z\relement face 3\r"
         "property list float double vertex_indices\relement tristrips 1\rproperty list int int vertex_indices\r"
         "end_header\r2 0 1\r-1.#IND 0 0 0\r? 1 0 0\rx 0 1 0\rcomment no vertex\r1.#QNAN 0 0 1\rnan nan inf 1e999\r0\r"
         "2 0 1\r3 0 1 2\r9 0 1 3 2 -1 0 -1 3 1\robj_info end\r";
}

std::vector<Seed> obj_seeds() {
  return {{"tetrahedron.obj", geometry::kObj},   {"box.obj", obj_of(box(), false)},
          {"relative.obj", obj_of(box(), true)}, {"crlf.obj", with_crlf(obj_of(sphere(), false))},
          {"polygons.obj", obj_of_polygons()},   {"byte_order_mark.obj", geometry::kByteOrderMark + obj_of_polygons()},
          {"dialect.obj", obj_dialect()}};
}

std::vector<Seed> stl_seeds() {
  return {{"tetrahedron.stl", geometry::kAsciiStl},
          {"dialect.stl", stl_dialect()},
          {"two_solids.stl", stl_of(box()) + with_crlf(stl_of(sphere()))},
          {"byte_order_mark.stl", geometry::kByteOrderMark + geometry::kAsciiStl},
          {"solid.stl", geometry::binary_stl("solid but binary")},
          {"box.stl", binary_stl_of(box())},
          {"sphere.stl", binary_stl_of(sphere())}};
}

std::vector<Seed> ply_seeds() {
  return {{"tetrahedron.ply", geometry::kAsciiPly},
          {"dialect.ply", ply_dialect()},
          {"polygons.ply", text_ply_of_polygons()},
          {"crlf.ply", geometry::kByteOrderMark + with_crlf(text_ply_of_polygons())},
          {"mixed_little.ply", geometry::binary_ply(false)},
          {"mixed_big.ply", geometry::binary_ply(true)},
          {"uint8.ply", binary_ply_of<float, std::uint8_t>(box(), "float", "uchar", false)},
          {"int16.ply", binary_ply_of<double, std::int16_t>(sphere(), "float64", "int16", true)},
          {"uint16.ply", binary_ply_of<float, std::uint16_t>(box(), "float32", "uint16", true)},
          {"uint32.ply", binary_ply_of<double, std::uint32_t>(box(), "double", "uint", false)}};
}

std::vector<std::string> obj_words() {
  return {"\nv ",  "\nvt ",     "\nvn ",     "\nvp ",     "\nf ",    "\nl ",    "\np ",     "\ng ",    "\no ",
          "\ns 1", "\nusemtl ", "\nmtllib ", "\ncstype ", "\ncurv ", "\nend\n", "\nlod 1",  "\ncall ", "\\\n",
          " # ",   "\nfo ",     "\r",        "1.#IND",    "//",      "/1/1",    "\nf 1 2 3"};
}

std::vector<std::string> stl_words() {
  return {"solid ", "facet normal 0 0 0", "outer loop", "vertex ",      "endloop", "endfacet", "endsolid",
          "SOLID",  "end loop",           "\r",         "facet normal", ";"};
}

std::vector<std::string> ply_words() {
  return {"ply\n",
          "format ascii 1.0\n",
          "format binary_little_endian 1.0\n",
          "format binary_big_endian 1.0\n",
          "element ",
          "element vertex ",
          "element face ",
          "property ",
          "list ",
          "property float x\n",
          "property list uchar int vertex_indices\n",
          "vertex_index",
          "comment ",
          "element tristrips 1\n",
          "\r",
          "char ",
          "uchar ",
          "short ",
          "ushort ",
          "int ",
          "uint ",
          "float ",
          "double ",
          "int8 ",
          "uint32 ",
          "float64 ",
          "end_header\n"};
}

std::vector<std::string> gltf_words() {
  return {"\"accessors\":",
          "\"asset\":",
          "\"attributes\":",
          "\"bufferView\":",
          "\"bufferViews\":",
          "\"buffer\":",
          "\"buffers\":",
          "\"byteLength\":",
          "\"byteOffset\":",
          "\"byteStride\":",
          "\"children\":",
          "\"count\":",
          "\"indices\":",
          "\"matrix\":",
          "\"max\":",
          "\"mesh\":",
          "\"meshes\":",
          "\"mode\":",
          "\"nodes\":",
          "\"normalized\":true",
          "\"POSITION\":",
          "\"NORMAL\":",
          "\"primitives\":",
          "\"rotation\":",
          "\"scale\":",
          "\"scene\":",
          "\"scenes\":",
          "\"sparse\":",
          "\"translation\":",
          "\"type\":",
          "\"uri\":",
          "\"data.bin\"",
          "../",
          "%2e%2e%2f",
          "file:",
          "5120",
          "5122",
          "\"KHR_mesh_quantization\"",
          "\"EXT_mesh_gpu_instancing\":",
          "\"KHR_draco_mesh_compression\":",
          "\"EXT_meshopt_compression\":",
          "\"extensions\":",
          "\"skin\":",
          "\"skins\":",
          "\"joints\":",
          "\"inverseBindMatrices\":",
          "\"JOINTS_0\":",
          "\"WEIGHTS_0\":",
          "\"targets\":",
          "\"weights\":",
          "\"values\":",
          "\"VEC4\"",
          "\"MAT4\"",
          "\"version\":",
          "\"2.0\"",
          "\"componentType\":",
          "5121",
          "5123",
          "5125",
          "5126",
          "\"VEC3\"",
          "\"SCALAR\"",
          "data:;base64,",
          "null",
          "true",
          "{},",
          "[],",
          "[0]",
          "\"\\n\"",
          "\"extensionsRequired\":",
          "JSON",
          std::string("BIN\0", 4)};
}

std::vector<std::string> words_of_format(const std::string& extension) {
  if (extension == ".obj") return obj_words();
  if (extension == ".stl") return stl_words();
  if (extension == ".ply") return ply_words();
  return gltf_words();
}

}  // namespace

std::vector<Seed> mesh_seeds(const std::string& extension) {
  if (extension == ".obj") return obj_seeds();
  if (extension == ".stl") return stl_seeds();
  if (extension == ".ply") return ply_seeds();
  return gltf_seeds(extension == ".glb");
}

std::vector<std::string> mesh_words(const std::string& extension) {
  const std::vector<std::string> numbers{"nan", "-inf", "1e9", "-1e9", "1e-45", "1e400", "-1", "2147483648", "0.1"};
  std::vector<std::string> words = words_of_format(extension);
  words.insert(words.end(), numbers.begin(), numbers.end());
  return words;
}

void repair_mesh_lengths(const std::string& extension, std::string& bytes) {
  const auto put = [&](std::size_t at, std::size_t number) {
    bytes.replace(at, 4, bytes_of<std::uint32_t>({static_cast<std::uint32_t>(number)}));
  };
  if (extension == ".glb" && bytes.size() >= 20) {
    bytes.replace(0, 4, "glTF");
    put(8, bytes.size());
    bytes.replace(16, 4, "JSON");
    const std::size_t binary = bytes.rfind(std::string("BIN\0", 4));
    if (binary != std::string::npos && binary >= 24) {
      put(12, binary - 4 - 20);
      put(binary - 4, bytes.size() - binary - 4);
    } else {
      put(12, bytes.size() - 20);
    }
  } else if (extension == ".stl" && bytes.find('\0') != std::string::npos && bytes.size() >= 84) {
    const std::size_t triangles = (bytes.size() - 84) / 50;
    bytes.resize(84 + 50 * triangles);
    put(80, triangles);
  }
}

}  // namespace glissade::fuzz
