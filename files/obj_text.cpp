#include <glissade/files/obj_text.h>
#include <glissade/files/text.h>

namespace glissade::files {

void append_obj(std::string& text, const geometry::TriangleMesh& mesh, std::size_t first) {
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    text += 'v';
    for (const double coordinate : vertex)
      text += ' ' + exact_number(coordinate);
    text += '\n';
  }
  for (const geometry::Triangle& triangle : mesh.triangles) {
    text += 'f';
    for (const std::int32_t vertex : triangle)
      text += ' ' + std::to_string(first + static_cast<std::size_t>(vertex));
    text += '\n';
  }
}

}  // namespace glissade::files
