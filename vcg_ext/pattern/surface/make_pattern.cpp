// SPDX-License-Identifier: GPL-3.0-or-later
#include "dcharts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "pattern/pattern.h"
#include "pattern/pattern_steps.h"
#include "pattern/surface/charts_for_pattern.h"
#include "pattern/surface/smooth_seams.h"
#include "pattern/surface/symmetric_mesh.h"
#include "pattern/surface/symmetry.h"
#include "pattern/texts.h"
#include "surface/cut.h"
#include "surface/make_charts.h"
#include "surface/straighten.h"
#include "surface/workspace.h"

namespace dcharts {
namespace {

// What the material asks of the charts.
Params ForMaterial(const Params& params) {
  Params material = params;
  if (params.material == PatternMaterial::kFabric) {
    // Conformal maps change lengths where those of least stretch don't: such charts must be flatter.
    constexpr double kFlatter = 0.3;
    material.method = FlattenMethod::kConformal;
    if (params.max_stretch > 0) material.max_stretch = 1 + kFlatter * (params.StretchBound() - 1);
  } else {
    // Paper does not stretch. What little a chart still has is taken up by folding.
    constexpr double kStrict = 1.0002;
    material.method = FlattenMethod::kStretchMinimizing;
    material.max_stretch = std::min(params.StretchBound(), kStrict);
    material.max_dart_percent = std::max(params.max_dart_percent, Params().max_dart_percent);
  }
  return material;
}

// The longest side of the box of the vertices that faces use.
double LongestSide(const SurfaceData& mesh) {
  double longest = 0;
  for (size_t d = 0; d < 3; ++d) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& face : mesh.faces)
      for (int v : face) {
        low = std::min(low, mesh.vertices[v][d]);
        high = std::max(high, mesh.vertices[v][d]);
      }
    longest = std::max(longest, high - low);
  }
  return longest;
}

double LongestSide(const SurfaceGraph<SurfaceMesh>& surface) {
  Eigen::Vector3d low = surface.Position(0, 0), high = low;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    low = low.cwiseMin(surface.Position(surface.Vertex(h)));
    high = high.cwiseMax(surface.Position(surface.Vertex(h)));
  }
  return (high - low).maxCoeff();
}

// A model that is its own mirror image gets pieces in mirrored pairs.
void MakeSymmetric(const SurfaceGraph<SurfaceMesh>& surface, const Params& params, double done,
                   Progress& progress, const MirrorPlane& mirror, ChartIds& ids, SeamMask& seams,
                   KnownFlattenings& known) {
  progress.BeginStage("Mirroring charts...", done, done);
  const bool keep_above = HasShorterSeamsAbove(surface, mirror, ids);
  const auto mirror_charts = [&](double bound, ChartIds& charts) {
    return MirrorCharts(surface, mirror, keep_above, bound, progress, charts);
  };
  ChartIds mirrored = ids;
  if (!mirror_charts(params.StretchBound(), mirrored)) return;
  StraightenBorders(surface, params, progress, mirrored);
  // Cut, which may part charts, and mirrored again with all the cuts. Images of charts stretch a little more
  // than they: they are not to be parted for that.
  Params looser = params, uncut = params;
  constexpr double kLooser = 1.3;
  if (params.max_stretch > 0) looser.max_stretch = 1 + kLooser * (params.StretchBound() - 1);
  uncut.max_stretch = uncut.max_dart_percent = 0;
  ChartIds cut = mirrored;
  SeamMask cut_seams, new_seams;
  KnownFlattenings flat;
  ChartCutter<SurfaceMesh>(surface, looser, progress).Run(cut, cut_seams, flat);
  mirrored = cut;
  if (!mirror_charts(looser.StretchBound(), mirrored)) return;
  ChartCutter<SurfaceMesh>(surface, uncut, progress).Run(mirrored, new_seams, flat);
  MirrorDarts(surface, mirror, keep_above, cut, cut_seams, mirrored, new_seams);
  DropIneffectiveSeams(surface, new_seams);
  SplitAndCompact(surface, mirrored, &new_seams);
  flat = KnownFlattenings();
  ids = std::move(mirrored);
  seams = std::move(new_seams);
  known = std::move(flat);
  progress.Log("The model is symmetric: its pieces are made in mirrored pairs.");
}

// All but scale and piece_of_face. `symmetric`: the mesh, where it is its own mirror image.
PatternResult PatternOfMesh(const SurfaceData& mesh, const SymmetricMesh* symmetric, const Params& params,
                            double scale, Progress& progress) {
  const Workspace work(mesh);
  const auto& surface = work.Surface();
  PatternResult result;
  ChartIds ids;
  SeamMask seams;
  KnownFlattenings known;
  constexpr double kChartsShare = 0.6, kFlatShare = 0.75;
  MakeCharts(surface, params, kChartsShare, progress, ids, seams, known, result.report);
  if (symmetric != nullptr)
    MakeSymmetric(surface, params, kChartsShare, progress, ExactMirrorPlane(*symmetric, surface), ids, seams,
                  known);
  progress.BeginStage("Flattening charts...", kChartsShare, kFlatShare);
  const auto flatten = [&](const SurfaceData& data, const Workspace& ready, const KnownFlattenings& flat) {
    const double to_mm = scale * LongestSide(data) / LongestSide(ready.Surface());
    ChartsForPattern charts(ready.Surface(), params, to_mm, progress);
    charts.Flatten(ids, seams, flat);
    return charts.Take(ids, seams, data, scale, ready.SourceFaces());
  };
  FlatCharts charts;
  if (params.material == PatternMaterial::kFabric) {
    const SurfaceData smooth = WithSmoothSeams(mesh, surface, seams);
    charts = flatten(smooth, Workspace(smooth), KnownFlattenings());
  } else {
    charts = flatten(mesh, work, known);
  }
  result.pattern = PatternOfCharts(std::move(charts), params, progress, kFlatShare, 1);
  result.report.seam_length = SeamLength(surface, seams);
  return result;
}

void FillPieceOfFace(size_t face_count, Pattern& pattern) {
  pattern.piece_of_face.assign(face_count, -1);
  for (const Piece& piece : pattern.pieces)
    for (int f : piece.flat.face) pattern.piece_of_face[f] = piece.id;
}

// From the faces of a symmetric mesh to those of the one it was made of.
void ToSourceFaces(const SurfaceData& mesh, const SymmetricMesh& symmetric, const MirrorPlane& mirror,
                   const std::vector<int>& source_face, Pattern& pattern) {
  const std::vector<int> piece_of_symmetric = pattern.piece_of_face;
  for (Piece& piece : pattern.pieces)
    for (int& f : piece.flat.face) f = symmetric.source_face[f];
  FillPieceOfFace(mesh.faces.size(), pattern);
  // The faces of the other half that are nobody's nearest image are where their own image's image is.
  std::vector<int> image_in_symmetric(mesh.faces.size(), -1);
  for (int f = 0; f < symmetric.half; ++f) image_in_symmetric[symmetric.source_face[f]] = f + symmetric.half;
  for (size_t f = 0; f < source_face.size(); ++f) {
    int& piece = pattern.piece_of_face[source_face[f]];
    const int g = mirror.image[f];
    if (piece >= 0 || g < 0 || image_in_symmetric[source_face[g]] < 0) continue;
    piece = piece_of_symmetric[image_in_symmetric[source_face[g]]];
  }
  // And what is left is in between: with a neighbour.
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<int> at_vertex(mesh.vertices.size(), -1);
    for (size_t f = 0; f < mesh.faces.size(); ++f)
      for (int v : mesh.faces[f])
        if (pattern.piece_of_face[f] >= 0) at_vertex[v] = pattern.piece_of_face[f];
    for (size_t f = 0; f < mesh.faces.size(); ++f)
      for (int v : mesh.faces[f])
        if (pattern.piece_of_face[f] < 0 && at_vertex[v] >= 0) {
          pattern.piece_of_face[f] = at_vertex[v];
          changed = true;
        }
  }
}

}  // namespace

PatternResult MakePattern(const SurfaceData& mesh, const Params& params, Progress& progress) {
  const Params material = ForMaterial(params);
  const Workspace work(mesh);
  constexpr double kMillimetresPerInch = 25.4;
  const double unit = params.units == LengthUnit::kInch ? kMillimetresPerInch : 1;
  const double model_side = LongestSide(mesh);
  const double side = params.size > 0 ? params.size * unit : model_side * unit;
  constexpr double kSmallest = 1, kLargest = 1e5;  // mm
  if (!(side >= kSmallest && side <= kLargest))
    throw Error("The finished object would be " + LengthText(side) +
                " long. Give the size that it is to have in `size`, from 1 mm to 100 m.");
  const double scale = side / model_side;

  // A symmetric model becomes exactly so, for pieces in mirrored pairs. Its texture would not fit that, a
  // number of charts that was asked for might not be met, and paper is to keep the model as it is.
  std::optional<MirrorPlane> mirror;
  if (params.material == PatternMaterial::kFabric && params.target_charts == 0 && !params.print_texture)
    mirror = FindMirrorPlane(work.Surface());
  PatternResult result;
  if (mirror) {
    const SymmetricMesh symmetric = MakeSymmetricMesh(mesh, work.Surface(), work.SourceFaces(), *mirror);
    result = PatternOfMesh(symmetric.mesh, &symmetric, material, scale, progress);
    FillPieceOfFace(symmetric.mesh.faces.size(), result.pattern);
    ToSourceFaces(mesh, symmetric, *mirror, work.SourceFaces(), result.pattern);
  } else {
    result = PatternOfMesh(mesh, nullptr, material, scale, progress);
    FillPieceOfFace(mesh.faces.size(), result.pattern);
  }
  result.pattern.scale = scale;
  Report& report = result.report;
  report.charts = static_cast<int>(result.pattern.pieces.size());
  report.unassigned_faces = 0;
  report.darts = 0;
  for (const Piece& piece : result.pattern.pieces) *report.darts += static_cast<int>(piece.darts.size());
  return result;
}

}  // namespace dcharts
