// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/report.h"

namespace dcharts {

/// A picture of the model's texture, row by row from its upper left corner.
struct TextureImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height; empty: it could not be read
};

/// A face's seams: bit i = edge (i, i+1) is a seam, bit kKeptSeamShift + i = it is one that charts are kept
/// to.
inline constexpr int kSeamBits = 7, kKeptSeamShift = 3,
                     kAllSeamBits = kSeamBits << kKeptSeamShift | kSeamBits;

/// A triangle mesh as plain arrays: what a host hands over. Only live elements, in the host's order.
struct SurfaceData {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 3>> faces;              ///< indices into vertices
  std::vector<double> vertex_quality;                 ///< per vertex, or empty when the host has none
  std::vector<double> face_quality;                   ///< per face, or empty when the host has none
  std::vector<std::array<float, 6>> wedge_texcoords;  ///< per face u0 v0 u1 v1 u2 v2, or empty
  std::vector<std::int16_t> wedge_texture_index;      ///< per face (that of its first corner), or empty
  std::vector<std::uint8_t> seams;                    ///< per face, or empty (no attribute), see kSeamBits
  std::vector<char> selected;                         ///< per face

  // Colours, read only where they are wanted.
  std::vector<TextureImage> textures;  ///< by wedge_texture_index
  std::vector<std::array<std::array<std::uint8_t, 3>, 3>>
      corner_colors;  ///< per face and corner RGB, or empty: it has none
};

/// A layer of triangles of its own, beside the user's mesh.
struct FlatLayer {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 3>> faces;            ///< indices into vertices
  std::vector<int> piece;                           ///< per face; goes to face quality
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< per face RGB
};

/// What a filter wants written. An empty array means: leave that as it is.
struct SurfaceChange {
  std::vector<char> written;                          ///< per face: it is written; empty = all are
  std::vector<int> chart_ids;                         ///< per face, -1 = unassigned; goes to face quality
  std::vector<std::array<std::uint8_t, 3>> colors;    ///< per face RGB
  std::vector<std::array<float, 6>> wedge_texcoords;  ///< per face; texture index 0
  std::vector<std::uint8_t> seams;                    ///< per face bit mask, see SurfaceData
  bool remove_seams = false;                          ///< an older seams attribute must go
  std::vector<std::array<std::array<double, 3>, 2>>
      seam_lines;    ///< for a new layer of edges; empty = no layer
  FlatLayer pieces;  ///< a pattern's, z = 0, mm; for a new layer; empty = no layer
  Report report;
};

}  // namespace dcharts
