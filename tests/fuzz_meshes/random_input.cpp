// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "odd_values.h"

namespace dcharts::fuzz {
namespace {

// The first corner, where there is one.
std::array<double, 3> Place(const SurfaceData& mesh, std::size_t f) {
  const int v = mesh.faces[f][0];
  if (v < 0 || v >= static_cast<int>(mesh.vertices.size())) return {0, 0, 0};
  return mesh.vertices[v];
}

std::vector<double> Charts(Random& random, const SurfaceData& mesh) {
  const int kind = random.Int(0, 4), count = random.Int(1, 12);
  const double same = random.Of(kOdd), odd = random.Chance(0.5) ? 0 : random.Log(0.01, 0.5);
  const Eigen::Vector3d direction = random.Vector();
  std::vector<double> quality;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto p = Place(mesh, f);
    const double along = direction.dot(Eigen::Vector3d(p[0], p[1], p[2]));
    const double ids[] = {same, static_cast<double>(random.Int(0, count)),
                          static_cast<double>(f * count / mesh.faces.size()),
                          std::floor(std::fmod(std::abs(along), 1e6) * count / 4), static_cast<double>(f)};
    quality.push_back(random.Chance(odd) ? random.Of(kOdd) : ids[kind]);
  }
  return quality;
}

void AddTexcoords(Random& random, SurfaceData& mesh) {
  const int kind = random.Int(0, 3);
  const double odd = random.Chance(0.5) ? 0 : random.Log(0.01, 0.5), jump = random.Log(0.001, 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::array<float, 6> uv{};
    for (std::size_t k = 0; k < 6; ++k) {
      const int v = mesh.faces[f][k / 2];
      if (kind == 0) uv[k] = static_cast<float>(random.Real(-1, 2));
      if (kind == 1 && v >= 0 && v < static_cast<int>(mesh.vertices.size()))
        uv[k] = static_cast<float>(mesh.vertices[v][k % 2] + random.Chance(jump));
      if (kind == 2) uv[k] = static_cast<float>(v);
      if (random.Chance(odd)) uv[k] = static_cast<float>(std::clamp(random.Of(kOdd), -1e38, 1e38));
    }
    mesh.wedge_texcoords.push_back(uv);
    mesh.wedge_texture_index.push_back(static_cast<std::int16_t>(random.Chance(0.1) ? random.Int(-2, 3) : 0));
  }
}

void AddColors(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(0, 3); n > 0; --n) {
    TextureImage texture;
    texture.width = random.Int(1, 9);
    texture.height = random.Int(1, 9);
    if (random.Chance(0.8))
      for (int k = 3 * texture.width * texture.height; k > 0; --k)
        texture.rgb.push_back(static_cast<std::uint8_t>(random.Int(0, 255)));
    mesh.textures.push_back(texture);
  }
  if (random.Chance(0.5)) return;
  mesh.corner_colors.resize(mesh.faces.size());
  for (auto& corners : mesh.corner_colors)
    for (auto& color : corners)
      for (auto& part : color) part = static_cast<std::uint8_t>(random.Int(0, 255));
}

constexpr int kLargestInt = std::numeric_limits<int>::max(), kSmallestInt = std::numeric_limits<int>::min();

double RandomValue(Random& random, const ParamSpec& spec) {
  const bool whole = std::holds_alternative<int Params::*>(spec.field);
  if (std::holds_alternative<bool Params::*>(spec.field)) return random.Int(0, 1);
  if (random.Chance(0.005)) {  // outside its range
    if (IsEnum(spec)) return random.Chance(0.5) ? -1 : spec.max + 1;
    if (whole) return random.Chance(0.5) ? kSmallestInt : std::min(spec.max, kLargestInt - 1.0) + 1;
    return random.Of(kOdd);
  }
  const double largest = std::min(spec.max, whole ? static_cast<double>(kLargestInt) : 1e30);
  if (random.Chance(0.1)) return spec.min_exclusive ? 1e-300 : spec.min;
  if (random.Chance(0.1)) return largest;
  double value = random.Real(spec.min, std::min(largest, spec.min + 20));
  if (random.Chance(0.3)) value = spec.min + random.Log(1e-6, std::max(1.0, largest - spec.min));
  return whole || IsEnum(spec) ? std::min(std::floor(value), largest) : std::min(value, largest);
}

}  // namespace

void AddAttributes(Random& random, SurfaceData& mesh) {
  if (random.Chance(0.5)) mesh.face_quality = Charts(random, mesh);
  if (random.Chance(0.2))
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      mesh.vertex_quality.push_back(random.Chance(0.1) ? random.Of(kOdd) : random.Real(-1, 4));
  if (random.Chance(0.3)) AddTexcoords(random, mesh);
  if (random.Chance(0.2))
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      mesh.seams.push_back(static_cast<std::uint8_t>(random.Chance(0.3) ? random.Int(0, 255) : 0));
  if (random.Chance(0.2)) AddColors(random, mesh);
  const double selected = random.Chance(0.1) ? 0 : random.Real(0, 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    mesh.selected.push_back(random.Chance(selected) ? 1 : 0);
}

Params RandomParams(Random& random, const FilterSpec& filter, std::string& text) {
  Params params;
  const double changed = random.Chance(0.3) ? 0 : random.Real(0, 0.6);
  for (const ParamSpec* spec : filter.params) {
    if (IsFile(*spec) || !random.Chance(changed)) continue;
    const double value = RandomValue(random, *spec);
    SetValue(*spec, value, params);
    text += std::string(text.empty() ? "" : " ") + spec->name + "=" + NumberText(value);
  }
  // Two that must fit each other would be refused most of the time.
  if (params.padding > params.texture_size / 4 && params.texture_size >= 16 && random.Chance(0.95)) {
    params.padding = params.texture_size / 4;
    text += " padding=" + std::to_string(params.padding);
  }
  return params;
}

}  // namespace dcharts::fuzz
