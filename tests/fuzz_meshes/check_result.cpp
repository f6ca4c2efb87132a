// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_result.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <set>
#include <sstream>
#include <variant>
#include <vector>

#include "atlas_checks.h"
#include "pattern_checks.h"
#include "runner.h"
#include "selected_part.h"

namespace dcharts::fuzz {

using test::OfSelected;

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
  if (std::any_of(change.seams.begin(), change.seams.end(), [](int mask) { return mask > kAllSeamBits; }))
    wrong += "a seam mask with unknown bits\n";
  for (const auto& uv : change.wedge_texcoords)
    for (float x : uv)
      if (!std::isfinite(x)) return wrong + "a texcoord is not finite\n";
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
  return test::TotalArea(unit) > 1e-13;  // below, it is rounding that decides
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

std::string WrongInSelection(const FilterSpec& filter, const SurfaceData& mesh, const Params& params,
                             const SurfaceChange& change) {
  std::string wrong;
  if (change.written != mesh.selected) wrong += "other faces are written than are selected\n";
  SurfaceChange part = change;
  part.chart_ids = OfSelected(change.chart_ids, mesh);
  part.colors = OfSelected(change.colors, mesh);
  part.wedge_texcoords = OfSelected(change.wedge_texcoords, mesh);
  part.seams = OfSelected(change.seams, mesh);
  std::set<int> numbers(part.chart_ids.begin(), part.chart_ids.end());
  numbers.erase(-1);
  for (std::size_t f = 0; f < mesh.face_quality.size(); ++f)
    if (mesh.selected[f] == 0 && mesh.face_quality[f] == std::floor(mesh.face_quality[f]) &&
        std::abs(mesh.face_quality[f]) < 1e9 && numbers.count(static_cast<int>(mesh.face_quality[f])) > 0)
      return wrong + "a chart has the number of a face that is not selected\n";
  for (int& id : part.chart_ids)
    if (id >= 0) id = static_cast<int>(std::distance(numbers.begin(), numbers.find(id)));
  return wrong + WrongInChange(filter, test::SelectedPart(mesh), params, part);
}

std::string WrongInPattern(const SurfaceData& mesh, const PatternResult& result) {
  return WrongInFigures(result.report) + test::WrongInPattern(mesh, result.pattern);
}

std::string WrongInSentence(const std::string& sentence) {
  if (sentence.size() < 20 || sentence.back() != '.') return "no sentence: " + sentence + "\n";
  if (sentence.find("eport it") != std::string::npos || sentence.find("free memory") != std::string::npos)
    return sentence + "\n";
  if (sentence.find("-922337203685477") != std::string::npos)
    return "a number that overflowed: " + sentence + "\n";
  return "";
}

bool SameBytes(const SurfaceData& a, const SurfaceData& b) {
  return SameArray(a.vertices, b.vertices) && SameArray(a.faces, b.faces) &&
         SameArray(a.vertex_quality, b.vertex_quality) && SameArray(a.face_quality, b.face_quality) &&
         SameArray(a.wedge_texcoords, b.wedge_texcoords) &&
         SameArray(a.wedge_texture_index, b.wedge_texture_index) && SameArray(a.seams, b.seams) &&
         SameArray(a.selected, b.selected) && SameArray(a.corner_colors, b.corner_colors);
}

bool SameBytes(const SurfaceChange& a, const SurfaceChange& b) {
  return SameArray(a.written, b.written) && SameArray(a.chart_ids, b.chart_ids) &&
         SameArray(a.colors, b.colors) && SameArray(a.wedge_texcoords, b.wedge_texcoords) &&
         SameArray(a.seams, b.seams) && a.remove_seams == b.remove_seams &&
         SameArray(a.seam_lines, b.seam_lines);
}

}  // namespace dcharts::fuzz
