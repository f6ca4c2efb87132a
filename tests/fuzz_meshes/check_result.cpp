// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_result.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>
#include <variant>
#include <vector>

#include "atlas_checks.h"
#include "pattern_fixture.h"
#include "runner.h"

namespace dcharts::fuzz {
namespace {

template <class T>
bool SameArray(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

std::string WrongInFigures(const Report& report) {
  std::string wrong;
  for (const auto& [name, value] : Figures(report)) {
    const double number = std::visit([](auto n) { return static_cast<double>(n); }, value);
    if (std::isnan(number) || number < 0) wrong += name + " is " + NumberText(number) + "\n";
  }
  return wrong;
}

std::string WrongInCharts(const FilterSpec& filter, const SurfaceData& mesh, const SurfaceChange& change) {
  std::ostringstream wrong;
  if (change.chart_ids.size() != mesh.faces.size() || change.colors.size() != mesh.faces.size())
    return "arrays of the wrong size\n";
  const std::set<int> ids(change.chart_ids.begin(), change.chart_ids.end());
  const int least = filter.id == FilterId::kSegment ? -1 : 0;
  if (*ids.begin() < least) wrong << "an id below " << least << "\n";
  const int charts = static_cast<int>(ids.size()) - (*ids.begin() == -1);
  if (*ids.rbegin() != charts - 1) wrong << "ids are not 0..n-1\n";
  if (change.report.charts != charts) wrong << "report.charts is not the number of charts\n";
  return wrong.str();
}

std::string WrongInCut(const SurfaceData& mesh, const SurfaceChange& change) {
  if (change.seams.size() != mesh.faces.size() || change.wedge_texcoords.size() != mesh.faces.size())
    return "arrays of the wrong size\n";
  std::string wrong;
  if (std::any_of(change.seams.begin(), change.seams.end(), [](int mask) { return mask > 7; }))
    wrong += "a seam mask above 7\n";
  for (const auto& uv : change.wedge_texcoords)
    for (float x : uv)
      if (!std::isfinite(x)) return wrong + "a texcoord is not finite\n";
  return wrong;
}

bool Finite(const std::vector<Polyline>& lines) {
  for (const Polyline& line : lines)
    for (const Point2& p : line)
      if (!p.allFinite()) return false;
  return true;
}

std::string WrongInPiece(const Piece& piece, const SurfaceData& mesh) {
  std::string wrong;
  if (piece.loops.empty() || !Finite(OutlineOf(piece))) return "an outline is not there or not finite\n";
  if (!(piece.area > 0) || !std::isfinite(piece.area)) wrong += "area\n";
  if (!(piece.model_area >= 0) || !std::isfinite(piece.model_area)) wrong += "model area\n";
  if (test::OutlinesCross(piece)) wrong += "the outline crosses itself\n";
  if (piece.cut.empty() || !Finite(piece.cut)) wrong += "no cut line, or not finite\n";
  for (const Tab& tab : piece.tabs)
    if (!Finite({tab.outline})) wrong += "a tab is not finite\n";
  for (const Fold& fold : piece.folds)
    if (!Finite({fold.line}) || !std::isfinite(fold.angle_degrees)) wrong += "a fold is not finite\n";
  if (!Finite({piece.flat.vertices, piece.net.vertices})) wrong += "a flat mesh is not finite\n";
  if (!Finite({{piece.grain, piece.label_at, piece.on_sheet.offset, piece.on_page.offset}}))
    wrong += "grain, label or place is not finite\n";
  for (int f : piece.flat.face)
    if (f < 0 || f >= static_cast<int>(mesh.faces.size())) return wrong + "a flat triangle of no face\n";
  return wrong;
}

std::string WrongInSeam(const Seam& seam, const Pattern& pattern) {
  if (seam.sides.empty()) return "no side\n";
  std::string wrong;
  for (const SeamSide& side : seam.sides) {
    if (side.piece < 0 || side.piece >= static_cast<int>(pattern.pieces.size()))
      return "a side of no piece\n";
    const auto& loops = pattern.pieces[static_cast<std::size_t>(side.piece)].loops;
    if (side.loop < 0 || side.loop >= static_cast<int>(loops.size())) return "a side of no loop\n";
    const int size = static_cast<int>(loops[static_cast<std::size_t>(side.loop)].size());
    if (side.first < 0 || side.first >= size || side.edges < 1 || side.edges > size)
      return "a side of no run\n";
    if (side.edges != seam.sides.front().edges) wrong += "sides have other numbers of edges\n";
    if (!std::isfinite(side.length)) wrong += "a side's length is not finite\n";
  }
  if (!std::isfinite(seam.length) || !std::isfinite(seam.ease)) wrong += "length or ease is not finite\n";
  for (const MatchPoint& match : seam.match_points)
    if (match.at.size() != seam.sides.size() || !Finite({match.at, match.outward})) wrong += "match points\n";
  return wrong;
}

}  // namespace

bool IsTakeable(const SurfaceData& mesh) {
  double largest = 0;
  test::Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const auto& face : mesh.faces)
    for (int v : face) {
      if (v < 0 || v >= static_cast<int>(mesh.vertices.size())) return false;
      for (std::size_t d = 0; d < 3; ++d) {
        const double x = mesh.vertices[v][d];
        if (!std::isfinite(x)) return false;
        low[d] = std::min(low[d], x);
        high[d] = std::max(high[d], x);
      }
    }
  for (std::size_t d = 0; d < 3; ++d) largest = std::max(largest, high[d] - low[d]);
  if (mesh.faces.empty() || !(largest > 0)) return false;
  // In the unit box, where areas keep within the range of double.
  SurfaceData unit = mesh;
  for (auto& p : unit.vertices)
    for (std::size_t d = 0; d < 3; ++d) p[d] = (p[d] - low[d]) / largest;
  return test::TotalArea(unit) > 1e-25;
}

std::string WrongInChange(const FilterSpec& filter, const SurfaceData& mesh, const Params& params,
                          const SurfaceChange& change) {
  std::string wrong = WrongInFigures(change.report);
  switch (filter.id) {
    case FilterId::kMeasure:
      if (!change.chart_ids.empty() || !change.colors.empty() || !change.wedge_texcoords.empty() ||
          !change.seams.empty() || change.remove_seams)
        wrong += "Measure writes\n";
      return wrong;
    case FilterId::kParameterize:
    case FilterId::kTextureAtlas:
      return wrong +
             test::WrongInAtlas(mesh, change, filter.id == FilterId::kTextureAtlas && params.cut_to_disk);
    case FilterId::kCut:
      return wrong + WrongInCharts(filter, mesh, change) + WrongInCut(mesh, change);
    default:
      if (!change.wedge_texcoords.empty() || !change.seams.empty() || !change.remove_seams)
        wrong += "texcoords or seams where none are made\n";
      return wrong + WrongInCharts(filter, mesh, change);
  }
}

std::string WrongInPattern(const SurfaceData& mesh, const PatternResult& result) {
  const Pattern& pattern = result.pattern;
  std::string wrong = WrongInFigures(result.report);
  if (pattern.pieces.empty()) return wrong + "no pieces\n";
  if (pattern.piece_of_face.size() != mesh.faces.size()) wrong += "piece_of_face has another size\n";
  for (const Piece& piece : pattern.pieces) {
    const std::string of_piece = WrongInPiece(piece, mesh);
    if (!of_piece.empty()) wrong += piece.name + ": " + of_piece;
  }
  for (const Seam& seam : pattern.seams) {
    const std::string of_seam = WrongInSeam(seam, pattern);
    if (!of_seam.empty()) wrong += "seam " + std::to_string(seam.id + 1) + ": " + of_seam;
  }
  return wrong;
}

std::string WrongInSentence(const std::string& sentence) {
  if (sentence.size() < 20 || sentence.back() != '.') return "no sentence: " + sentence + "\n";
  if (sentence.find("eport it") != std::string::npos || sentence.find("free memory") != std::string::npos)
    return sentence + "\n";
  return "";
}

bool SameBytes(const SurfaceData& a, const SurfaceData& b) {
  return SameArray(a.vertices, b.vertices) && SameArray(a.faces, b.faces) &&
         SameArray(a.vertex_quality, b.vertex_quality) && SameArray(a.face_quality, b.face_quality) &&
         SameArray(a.wedge_texcoords, b.wedge_texcoords) &&
         SameArray(a.wedge_texture_index, b.wedge_texture_index) && SameArray(a.seams, b.seams) &&
         SameArray(a.corner_colors, b.corner_colors);
}

bool SameBytes(const SurfaceChange& a, const SurfaceChange& b) {
  return SameArray(a.chart_ids, b.chart_ids) && SameArray(a.colors, b.colors) &&
         SameArray(a.wedge_texcoords, b.wedge_texcoords) && SameArray(a.seams, b.seams) &&
         a.remove_seams == b.remove_seams && SameArray(a.seam_lines, b.seam_lines);
}

}  // namespace dcharts::fuzz
