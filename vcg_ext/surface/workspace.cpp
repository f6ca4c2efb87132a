// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/workspace.h"

#include <algorithm>
#include <cmath>

#include "common/freed_memory.h"
#include "surface/crease_weight.h"
#include "surface/denoised_normals.h"
#include "surface/fill.h"
#include "surface/texel_density.h"

namespace dcharts {

Workspace::Workspace(const SurfaceData& data, const std::function<void()>& poll)
    : data_(data), built_(BuildSurface(data, mesh_, poll)), surface_(mesh_) {
  poll();
  KeepFreedMemory();
  DenoiseNormals(surface_, poll);
}

void Workspace::KeepBorders(const Params& params, Progress& progress) {
  if (!params.KeepsBorders()) return;
  SeamMask kept = CreasesAbove(surface_, params.crease_angle);
  if (params.keep_seams) {
    if (HasTexcoords()) {
      const SeamMask seams = TextureSeams();
      for (size_t f = 0; f < kept.size(); ++f) kept[f] = static_cast<std::uint8_t>(kept[f] | seams[f]);
    } else {
      progress.Log("The mesh has no texture coordinates, so keep_seams finds no seams to keep.");
    }
  }
  surface_.Part(kept);
}

void Workspace::ReleaseBorders(SeamMask& seams) {
  if (surface_.Parted().empty()) return;
  const SeamMask kept = KeptBorders();
  ReleaseBorders();
  for (size_t f = 0; f < kept.size(); ++f) seams[f] = static_cast<std::uint8_t>(seams[f] | kept[f]);
  DropIneffectiveSeams(surface_, seams);
}

SeamMask Workspace::KeptBorders() const {
  SeamMask kept(surface_.FaceCount(), 0);
  for (const auto& [h, o] : surface_.Parted())
    for (int k : {h, o}) SetSeam(kept, k);
  return kept;
}

ChartIds Workspace::ReadCharts() const {
  ChartIds ids(surface_.FaceCount(), 0);
  if (!data_.face_quality.empty()) {
    auto quality = [&](int f) { return data_.face_quality[built_.source_face[f]]; };
    bool all_alike = true;
    for (int f = 1; f < surface_.FaceCount() && all_alike; ++f)
      all_alike = quality(f) == quality(0) || (std::isnan(quality(f)) && std::isnan(quality(0)));
    if (!all_alike)
      for (int f = 0; f < surface_.FaceCount(); ++f) ids[f] = ChartIdOfQuality(quality(f));
  }
  SplitAndCompact(surface_, ids);
  return ids;
}

ChartIds Workspace::ReadFilledCharts(Progress& progress) const {
  ChartIds ids = ReadCharts();
  const auto unassigned = std::count(ids.begin(), ids.end(), kUnassigned);
  if (unassigned > 0) {
    progress.Log(std::to_string(unassigned) +
                 " faces belong to no chart: filled as D-Charts: Fill does by default.");
    progress.BeginStage("Filling holes...", 0, 0.02);
    const Params defaults;
    HoleFiller<SurfaceMesh>(surface_, defaults, progress).Run(ids);
  }
  return ids;
}

bool Workspace::HasTexcoords() const {
  const auto& uv = data_.wedge_texcoords;
  if (uv.empty()) return false;
  for (const auto& t : uv)
    for (int i = 0; i < 3; ++i)
      if (!SameUv(t, i, uv.front(), 0)) return true;
  return false;
}

WedgeTexcoords Workspace::ReadTexcoords() const {
  WedgeTexcoords uv;
  for (int f : built_.source_face) uv.push_back(data_.wedge_texcoords[f]);
  return uv;
}

bool Workspace::ReadSeams(const ChartIds& ids, SeamMask& seams) {
  const auto drop_borders = [&] {  // a border is no seam
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h)
      if (surface_.Opposite(h) < 0) ClearSeam(seams, h);
  };
  if (!data_.seams.empty()) {
    SeamMask kept;
    seams.clear();
    for (int f : built_.source_face) {
      seams.push_back(data_.seams[f] & kSeamBits);
      kept.push_back(data_.seams[f] >> kKeptSeamShift & kSeamBits);
    }
    drop_borders();
    if (SeamsAgree(surface_, ids, seams)) {
      surface_.Part(kept);
      drop_borders();
      return true;
    }
  }
  if (!data_.wedge_texcoords.empty()) {
    const WedgeTexcoords uv = ReadTexcoords();
    if (LooksLikeTexcoords(uv)) {
      seams = SeamsOfTexcoords(surface_, uv);
      if (SeamsAgree(surface_, ids, seams)) return true;
    }
  }
  return false;
}

void Workspace::WarnOfReplacedTexcoords(Progress& progress) const {
  if (HasTexcoords() && data_.seams.empty())
    progress.Log(
        "The texture coordinates that the mesh had are replaced, and MeshLab has no undo: to keep them, make "
        "a copy with 'Duplicate Current Layer' before.");
}

std::vector<double> Workspace::ReadDensity(Progress& progress) const {
  return DensityByVertexQuality(data_, built_.source_face, progress);
}

SeamMask Workspace::TextureSeams() const {
  SeamMask seams = SeamsOfTexcoords(surface_, ReadTexcoords());
  if (!data_.wedge_texture_index.empty())
    for (int h = 0; h < surface_.HalfEdgeCount(); ++h) {
      const int g = surface_.Neighbour(h);
      if (g >= 0 && data_.wedge_texture_index[built_.source_face[h / 3]] !=
                        data_.wedge_texture_index[built_.source_face[g]])
        SetSeam(seams, h);
    }
  return seams;
}

void Workspace::WriteCharts(const ChartIds& ids, SurfaceChange& change) const {
  // Faces that take no part (repeated vertices) follow a face at one of their vertices.
  constexpr int kOpen = -2;
  change.chart_ids.assign(data_.faces.size(), kOpen);
  std::vector<int> at_vertex(data_.vertices.size(), kOpen);
  for (int f = 0; f < surface_.FaceCount(); ++f) {
    const int source = built_.source_face[f];
    change.chart_ids[source] = ids[f];
    for (int v : data_.faces[source])
      if (at_vertex[v] == kOpen) at_vertex[v] = ids[f];
  }
  for (size_t f = 0; f < data_.faces.size(); ++f) {
    int& id = change.chart_ids[f];
    for (int i = 0; i < 3 && id == kOpen; ++i) id = at_vertex[data_.faces[f][i]];
    if (id == kOpen) id = 0;
  }
  change.colors.clear();
  for (int id : change.chart_ids) change.colors.push_back(ChartColor(id));
}

void Workspace::WriteSeams(const SeamMask& seams, const SeamMask& kept, SurfaceChange& change) const {
  change.seams.assign(data_.faces.size(), 0);
  for (int f = 0; f < surface_.FaceCount(); ++f)
    change.seams[built_.source_face[f]] = static_cast<std::uint8_t>(seams[f] | kept[f] << kKeptSeamShift);
}

void Workspace::WriteTexcoords(const WedgeTexcoords& uv, SurfaceChange& change) const {
  change.wedge_texcoords.assign(data_.faces.size(), {});
  std::vector<char> written(data_.faces.size(), 0);
  std::vector<std::array<float, 2>> at_vertex(data_.vertices.size(), {0, 0});
  for (int f = 0; f < surface_.FaceCount(); ++f) {
    const int source = built_.source_face[f];
    change.wedge_texcoords[source] = uv[f];
    written[source] = 1;
    for (int i = 0; i < 3; ++i) at_vertex[data_.faces[source][i]] = {uv[f][2 * i], uv[f][2 * i + 1]};
  }
  for (size_t f = 0; f < data_.faces.size(); ++f)
    for (int i = 0; i < 3 && !written[f]; ++i)
      for (int d : {0, 1}) change.wedge_texcoords[f][2 * i + d] = at_vertex[data_.faces[f][i]][d];
}

void Workspace::WriteSeamLines(const SeamMask& seams, SurfaceChange& change) const {
  for (int h = 0; h < surface_.HalfEdgeCount(); ++h)
    if (surface_.Opposite(h) > h && IsSeam(seams, h)) {
      const auto& face = data_.faces[built_.source_face[h / 3]];
      change.seam_lines.push_back({data_.vertices[face[h % 3]], data_.vertices[face[Next(h) % 3]]});
    }
}

}  // namespace dcharts
