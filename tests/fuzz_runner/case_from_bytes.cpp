// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_from_bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "byte_reader.h"
#include "odd_values.h"
#include "random.h"
#include "random_meshes.h"

namespace dcharts::fuzz {
namespace {

// Mostly on a small grid, where much coincides, lies in one plane or in one line.
double Coordinate(ByteReader& bytes) {
  constexpr int kAnyDouble = 100;
  const int b = bytes.Signed();
  if (b < kAnyDouble) return b / 8.0;
  return bytes.AnyDouble();
}

void SetParameters(ByteReader& bytes, RandomCase& made) {
  const auto& specs = made.filter->params;
  for (int n = bytes.Int(0, 6); n > 0 && !specs.empty(); --n) {
    const ParamSpec& spec = *specs[bytes.Byte() % specs.size()];
    if (IsFile(spec)) continue;
    const bool is_double = std::holds_alternative<double Params::*>(spec.field);
    double value = bytes.Byte();
    switch (bytes.Int(0, 3)) {
      case 0:  // a small number above the least
        value += std::isfinite(spec.min) ? spec.min : 0;
        break;
      case 1:
        value /= 64;
        break;
      case 2:
        value = value < 128 ? spec.min : spec.max;
        break;
      default:
        value = is_double ? bytes.AnyDouble() : -value;
    }
    constexpr double kLargest = std::numeric_limits<int>::max(), kSmallest = std::numeric_limits<int>::min();
    if (!is_double) value = std::isnan(value) ? 0 : std::clamp(std::floor(value), kSmallest, kLargest);
    if (std::holds_alternative<bool Params::*>(spec.field)) value = value > 0;
    SetValue(spec, value, made.params);
    made.changed_params += std::string(spec.name) + "=" + NumberText(value) + " ";
  }
}

// One of the shapes of fuzz_meshes to begin with, or nothing.
void BeginMesh(ByteReader& bytes, RandomCase& made) {
  made.shape = "bytes";
  const int faces = bytes.Int(0, 31);
  if (faces == 0) return;
  Random random(bytes.Byte());
  made.mesh = RandomShape(random, faces, made.shape);
}

void ChangeMesh(ByteReader& bytes, SurfaceData& mesh) {
  for (int n = bytes.Int(0, 31); n > 0; --n)
    mesh.vertices.push_back({Coordinate(bytes), Coordinate(bytes), Coordinate(bytes)});
  // An index may be one beyond the last.
  const int indices = static_cast<int>(mesh.vertices.size()) + 1;
  for (int n = bytes.Int(0, 31); n > 0; --n)
    mesh.faces.push_back({bytes.Byte() % indices, bytes.Byte() % indices, bytes.Byte() % indices});
  if (mesh.faces.empty() || mesh.vertices.empty()) return;
  for (int n = bytes.Int(0, 7); n > 0; --n)
    mesh.vertices[bytes.Byte() % mesh.vertices.size()][static_cast<std::size_t>(bytes.Int(0, 2))] =
        Coordinate(bytes);
  for (int n = bytes.Int(0, 7); n > 0; --n)
    mesh.faces[bytes.Byte() % mesh.faces.size()][static_cast<std::size_t>(bytes.Int(0, 2))] =
        bytes.Byte() % indices;
}

double Quality(ByteReader& bytes) {
  const int b = bytes.Signed();
  if (b >= 0) return b % 16;
  return b > -16 ? bytes.Of(kOdd) : b / 8.0;
}

void AddAttributes(ByteReader& bytes, SurfaceData& mesh) {
  enum { kQuality = 1, kVertexQuality = 2, kTexcoords = 4, kSeams = 8, kColors = 16, kSelected = 32 };
  const int which = bytes.Byte();
  if (which & kQuality)
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_quality.push_back(Quality(bytes));
  if (which & kVertexQuality)
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertex_quality.push_back(Quality(bytes));
  if (which & kTexcoords)
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      std::array<float, 6> uv{};
      for (float& x : uv) x = static_cast<float>(std::clamp(Coordinate(bytes), -1e38, 1e38));
      mesh.wedge_texcoords.push_back(uv);
      mesh.wedge_texture_index.push_back(bytes.Signed() / 32);
    }
  if (which & kSeams)
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) mesh.seams.push_back(bytes.Byte());
  if (which & kColors) {
    mesh.textures.push_back({1, 1, {bytes.Byte(), bytes.Byte(), bytes.Byte()}});
    mesh.corner_colors.resize(mesh.faces.size());
    for (auto& corners : mesh.corner_colors)
      for (auto& color : corners) color[0] = bytes.Byte();
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    mesh.selected.push_back((which & kSelected) != 0 ? bytes.Byte() % 2 : 1);
}

}  // namespace

RandomCase CaseFromBytes(const std::uint8_t* data, std::size_t size) {
  ByteReader bytes(data, size);
  RandomCase made;
  made.filter = &AllFilters()[bytes.Byte() % AllFilters().size()];
  // Other defaults than a user's: small textures are quick to pack.
  made.params.texture_size = 64;
  SetParameters(bytes, made);
  BeginMesh(bytes, made);
  ChangeMesh(bytes, made.mesh);
  AddAttributes(bytes, made.mesh);
  const int also = bytes.Byte();
  if (also >= 250) {
    made.also = Also::kCancel;
    made.cancel_at = 1 + bytes.Byte();
  } else if (also >= 240 && made.filter->id == FilterId::kTextureAtlas) {
    made.also = Also::kStageByStage;
  }
  if (made.filter->id == FilterId::kPattern) {
    if (!(made.params.size > 0)) made.params.size = 20 + 4 * bytes.Byte();
    // Pictures of the model, which DXF has not, take a hundred times as long as the rest.
    made.params.output_file = bytes.Byte() % 2 == 0 ? "" : "pattern.dxf";
  }
  return made;
}

}  // namespace dcharts::fuzz
