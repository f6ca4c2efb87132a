// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/selected_faces.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "common/errors.h"
#include "surface/charts.h"

namespace dcharts {
namespace {

template <class T>
std::vector<T> Taken(const std::vector<T>& of_all, const std::vector<int>& faces) {
  std::vector<T> taken;
  if (of_all.empty()) return taken;
  taken.reserve(faces.size());
  for (int f : faces) taken.push_back(of_all[f]);
  return taken;
}

template <class T>
void Spread(const std::vector<int>& faces, std::size_t face_count, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> of_all(face_count);
  for (std::size_t i = 0; i < faces.size(); ++i) of_all[faces[i]] = values[i];
  values = std::move(of_all);
}

// All vertices stay: one that no face needs takes no part.
SurfaceData PartOf(const SurfaceData& mesh, const std::vector<int>& faces) {
  SurfaceData part;
  part.vertices = mesh.vertices;
  part.vertex_quality = mesh.vertex_quality;
  part.faces = Taken(mesh.faces, faces);
  part.face_quality = Taken(mesh.face_quality, faces);
  part.wedge_texcoords = Taken(mesh.wedge_texcoords, faces);
  part.wedge_texture_index = Taken(mesh.wedge_texture_index, faces);
  part.seams = Taken(mesh.seams, faces);
  return part;
}

// The smallest numbers that no face outside has, in place of 0, 1, 2... Faces without a quality get 0 from
// the host.
void Renumber(const SurfaceData& mesh, SurfaceChange& change) {
  std::set<int> others;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.selected[f] == 0)
      others.insert(mesh.face_quality.empty() ? 0 : ChartIdOfQuality(mesh.face_quality[f]));
  const int count = ChartCount(change.chart_ids);
  std::vector<int> number;
  for (int next = 0; static_cast<int>(number.size()) < count; ++next)
    if (others.count(next) == 0) number.push_back(next);
  for (std::size_t f = 0; f < change.chart_ids.size(); ++f) {
    int& id = change.chart_ids[f];
    if (id >= 0) id = number[id];
    change.colors[f] = ChartColor(id);
  }
}

}  // namespace

SurfaceChange OnSelectedFaces(const SurfaceData& mesh,
                              const std::function<SurfaceChange(const SurfaceData&)>& stage) {
  std::vector<int> faces;
  for (std::size_t f = 0; f < mesh.selected.size(); ++f)
    if (mesh.selected[f] != 0) faces.push_back(static_cast<int>(f));
  if (faces.empty() && !mesh.faces.empty())
    throw Error(
        "selected_only is on, but no face is selected: select faces first, for example with \"Conditional "
        "Face "
        "Selection\", or switch selected_only off.");
  SurfaceChange change = stage(PartOf(mesh, faces));
  if (!change.chart_ids.empty()) Renumber(mesh, change);
  Spread(faces, mesh.faces.size(), change.chart_ids);
  Spread(faces, mesh.faces.size(), change.colors);
  Spread(faces, mesh.faces.size(), change.wedge_texcoords);
  Spread(faces, mesh.faces.size(), change.seams);
  change.written = mesh.selected;
  return change;
}

}  // namespace dcharts
