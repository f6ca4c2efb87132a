// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern_steps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pattern/allowance.h"
#include "pattern/build_pieces.h"
#include "pattern/congruence.h"
#include "pattern/equal_outlines.h"
#include "pattern/folds.h"
#include "pattern/grain.h"
#include "pattern/label_place.h"
#include "pattern/least_piece.h"
#include "pattern/match_points.h"
#include "pattern/net_triangles.h"
#include "pattern/outline.h"
#include "pattern/page_cuts.h"
#include "pattern/place_pieces.h"
#include "pattern/seam_graph.h"
#include "pattern/simplify_seams.h"
#include "pattern/tabs.h"
#include "pattern/texts.h"
#include "planar/distortion.h"

namespace dcharts {
namespace {

// Fabric is laid flat conformally with seams as long as on the model, which makes curved pieces too small in
// their middles: enlarged all alike, they have the model's area together.
void GiveModelArea(FlatCharts& charts) {
  double model = 0, flat = 0;
  for (const FlatChart& chart : charts.charts) {
    const StretchFigures figures = MeasureStretch(chart.mesh, chart.uv);
    model += figures.SurfaceArea();
    flat += figures.UvArea();
  }
  if (!(flat > 0)) return;
  const double factor = std::sqrt(model / flat);
  for (FlatChart& chart : charts.charts) chart.uv *= factor;
}

// Pieces that go onto a page whole, with their allowances or tabs.
void PartLargePieces(const Params& params, Progress& progress, FlatCharts& charts) {
  if (params.page == PageFormat::kSingleSheet || params.oversize != Oversize::kSplitPiece) return;
  const bool is_fabric = params.material == PatternMaterial::kFabric;
  // Packing turns pieces by steps, and corners of the allowance reach out: so a little less than the page.
  constexpr double kSpare = 4, kLeast = 20;  // mm
  const double around = kSpare + (is_fabric ? 2 * params.seam_allowance : params.tab_width);
  const Point2 page = (PrintableSize(params.page) - Point2::Constant(2 * around)).cwiseMax(kLeast);
  const int cuts = CutToPages(
      page, [&] { progress.Poll(); }, charts);
  if (cuts > 0)
    progress.Log("Pieces larger than a page were parted by " + std::to_string(cuts) + " straight cuts.");
}

// How much the sides of a seam may differ in length, as a share of the 3D length: paper doesn't give.
double MostEase(PatternMaterial material) { return material == PatternMaterial::kPaper ? 0.001 : 0.01; }

// The two sides of an edge that takes the place of several may differ a little; moving the corners makes up
// for that. Where it can't within the tolerance, they must differ less from the start.
Pattern SimplifiedPieces(const FlatCharts& charts, const SeamGraph& graph, const Params& params,
                         const std::function<void()>& poll) {
  const double promised = 0.8 * MostEase(params.material);
  constexpr double kForCollapse = 0.7;  // of the tolerance; the rest is for moving corners
  SimplifyOptions options;
  options.tolerance = kForCollapse * params.simplify_tolerance;
  Pattern pattern;
  for (const double most_ease : {0.1, 0.03, 0.01, 0.003, 0.0005}) {
    options.most_ease = most_ease;
    pattern = BuildPieces(charts, graph, SimplifySeams(charts, graph, options, poll));
    EqualizeOutlines((1 - kForCollapse) * params.simplify_tolerance, pattern);
    if (pattern.largest_ease <= promised) break;
  }
  return pattern;
}

void WarnOfSmallPieces(const Params& params, Pattern& pattern) {
  std::vector<int> small;
  for (const Piece& piece : pattern.pieces)
    if (piece.area < LeastPieceArea(params) || 2 * piece.label_radius < LeastPieceWidth(params))
      small.push_back(piece.id);
  if (small.empty()) return;
  const bool is_fabric = params.material == PatternMaterial::kFabric;
  pattern.warnings.push_back(std::string("Too small to ") + (is_fabric ? "sew" : "glue") +
                             " with ease: " + PieceList(small) + ". Make the object larger or " +
                             (is_fabric ? "seam_allowance" : "tab_width") + " smaller.");
}

std::string PointsOfOutlines(const Pattern& pattern) {
  std::string line = "Points of the outlines:";
  for (const Piece& piece : pattern.pieces) {
    std::size_t points = 0;
    for (const OutlineLoop& loop : piece.loops) points += loop.size();
    line += (piece.id > 0 ? ", " : " ") + piece.name + " " + std::to_string(points);
  }
  return line + ".";
}

}  // namespace

Pattern PatternOfCharts(FlatCharts charts, const Params& params, Progress& progress, double from, double to) {
  const auto poll = [&] { progress.Poll(); };
  if (params.material == PatternMaterial::kFabric) GiveModelArea(charts);
  PartLargePieces(params, progress, charts);
  progress.BeginStage("Simplifying outlines...", from, from + 0.2 * (to - from));
  const SeamGraph graph = SeamsOf(charts);
  Pattern pattern = SimplifiedPieces(charts, graph, params, poll);
  pattern.material = params.material;
  for (Piece& piece : pattern.pieces) {
    const std::vector<Polyline> outline = OutlineOf(piece);
    for (const Polyline& loop : outline)
      piece.net.vertices.insert(piece.net.vertices.end(), loop.begin(), loop.end());
    piece.net.triangles = NetTriangles(outline);
    const Circle label = LargestCircle(outline);
    piece.label_at = label.middle;
    piece.label_radius = label.radius;
    poll();
  }
  // Both outlines of a pair may be off by the tolerance.
  FindCongruentPieces(2 * params.simplify_tolerance, pattern);
  CountCopies(params.merge_congruent, pattern);
  AddMatchPoints(pattern);
  SetSewingOrder(pattern);
  if (params.material == PatternMaterial::kFabric) {
    SetGrain(charts, pattern);
    AddAllowances(params.seam_allowance, pattern);
  } else {
    constexpr double kRulingSpacing = 10;  // mm
    for (Piece& piece : pattern.pieces) {
      AddFolds(charts.charts[piece.id], params.fold_angle, piece);
      AddRulings(charts.charts[piece.id], params.fold_angle, kRulingSpacing, piece);
      poll();
    }
    AddTabs(params.tab_width, poll, pattern);
  }

  WarnOfSmallPieces(params, pattern);
  std::vector<int> uneven;
  for (const Seam& seam : pattern.seams)
    if (seam.ease > MostEase(params.material))
      for (const SeamSide& side : seam.sides) uneven.push_back(side.piece);
  if (!uneven.empty()) {
    std::sort(uneven.begin(), uneven.end());
    uneven.erase(std::unique(uneven.begin(), uneven.end()), uneven.end());
    pattern.warnings.push_back("Seams with sides of unequal length, see their ease: on " + PieceList(uneven) +
                               ".");
  }

  progress.BeginStage("Placing pieces...", from + 0.4 * (to - from), to);
  constexpr double kGap = 4;  // mm between pieces: room for scissors
  PlacePieces(params.page, params.rotate, kGap, poll, pattern);
  for (const std::string& warning : pattern.warnings) progress.Log(warning);
  progress.Log(PointsOfOutlines(pattern));
  return pattern;
}

}  // namespace dcharts
