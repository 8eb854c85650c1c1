#include "io/glb_writer.h"

#include <glissade/base/byte_order.h>

namespace glissade::geometry {

std::size_t GlbWriter::add_accessor(const std::string& bytes, std::uint64_t component, const char* type,
                                    std::size_t count) {
  document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
  const std::size_t view = document_["bufferViews"].size() - 1;
  document_["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  binary_ += bytes;
  return view;
}

std::string GlbWriter::written() {
  document_["asset"] = {{"version", "2.0"}};
  document_["buffers"] = nlohmann::json::array({{{"byteLength", binary_.size()}}});
  std::string text = document_.dump();
  text.append((4 - text.size() % 4) % 4, ' ');
  std::string result = "glTF";
  base::append_number(result, std::uint32_t{2});
  base::append_number(result, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary_.size()));
  base::append_number(result, static_cast<std::uint32_t>(text.size()));
  result += "JSON" + text;
  base::append_number(result, static_cast<std::uint32_t>(binary_.size()));
  result += std::string("BIN\0", 4) + binary_;
  return result;
}

}  // namespace glissade::geometry
