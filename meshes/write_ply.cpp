// SPDX-License-Identifier: GPL-3.0-or-later
#include "write_ply.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace dcharts::shapes {
namespace {

void AppendLittleEndian(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

}  // namespace

void WritePly(const SurfaceData& mesh, const std::string& path) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& vertex : mesh.vertices)
    for (double coordinate : vertex) {
      const float rounded = static_cast<float>(coordinate) + 0.0f;  // no negative zero
      std::uint32_t bits = 0;
      std::memcpy(&bits, &rounded, sizeof bits);
      AppendLittleEndian(bytes, bits);
    }
  for (const auto& face : mesh.faces) {
    bytes.push_back(3);
    for (int v : face) AppendLittleEndian(bytes, static_cast<std::uint32_t>(v));
  }
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error("Can't write " + path + ".");
}

}  // namespace dcharts::shapes
