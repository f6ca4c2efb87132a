// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/surface_mesh.h"

#include <vcg/complex/allocate.h>

#include <cmath>

#include "common/errors.h"
#include "surface/face_order.h"

namespace dcharts {
namespace {

void CheckInput(const SurfaceData& data) {
  if (data.vertices.empty() && data.faces.empty())
    throw Error("The mesh is empty: open or create a triangle mesh first.");
  if (data.faces.empty())
    throw Error(
        "The mesh has no faces (it is a point cloud): make a surface first, for example with "
        "\"Surface Reconstruction: Ball Pivoting\".");
  for (const auto& face : data.faces)
    for (int v : face) {
      if (v < 0 || v >= static_cast<int>(data.vertices.size()))
        throw Error("A face refers to a vertex that does not exist: save the mesh and load it again.");
      for (double x : data.vertices[v])
        if (!std::isfinite(x))
          throw Error(
              "A vertex has a coordinate that is not a number or infinite: remove such vertices first, for "
              "example with \"Conditional Vertex Selection\" and \"Delete Selected Vertices\".");
    }
}

bool HasRepeatedVertex(const std::array<int, 3>& face) {
  return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

}  // namespace

BuiltSurface BuildSurface(const SurfaceData& data, SurfaceMesh& mesh, const std::function<void()>& poll) {
  CheckInput(data);
  poll();
  BuiltSurface built;
  built.source_face.reserve(data.faces.size());
  for (int f = 0; f < static_cast<int>(data.faces.size()); ++f)
    if (!HasRepeatedVertex(data.faces[f])) built.source_face.push_back(f);
  SortForMemory(data, built.source_face);
  poll();

  // Two steps, so that neither the box nor the area leaves the range of double.
  vcg::Box3d box;
  for (int f : built.source_face)
    for (int v : data.faces[f]) {
      const auto& p = data.vertices[v];
      box.Add(vcg::Point3d(p[0], p[1], p[2]));
    }
  const char* kZeroArea =
      "The surface has no area: all its faces are degenerate. Remove them with \"Remove Zero Area Faces\" "
      "or check the model.";
  if (built.source_face.empty() || !(box.Diag() > 0)) throw Error(kZeroArea);
  const vcg::Point3d centre = box.min + (box.max - box.min) * 0.5;
  const double size = std::max({box.DimX(), box.DimY(), box.DimZ()});
  auto unit_box = [&](int v) {
    const auto& p = data.vertices[v];
    return (vcg::Point3d(p[0], p[1], p[2]) - centre) / size;
  };
  double area = 0;
  for (int f : built.source_face) {
    const vcg::Point3d a = unit_box(data.faces[f][0]);
    area += ((unit_box(data.faces[f][1]) - a) ^ (unit_box(data.faces[f][2]) - a)).Norm() / 2;
  }
  constexpr double kRounding = 1e-15;  // what faces without area may seem to have in the unit box
  if (!(area > kRounding)) throw Error(kZeroArea);
  const double scale = 1 / std::sqrt(area);
  poll();

  mesh.Clear();
  auto vertex = vcg::tri::Allocator<SurfaceMesh>::AddVertices(mesh, data.vertices.size());
  std::vector<bool> used(data.vertices.size(), false);
  for (int f : built.source_face)
    for (int v : data.faces[f]) used[v] = true;
  for (size_t v = 0; v < data.vertices.size(); ++v, ++vertex)
    // An unreferenced vertex may hold anything, NaN too; it takes no part.
    vertex->P() = used[v] ? unit_box(static_cast<int>(v)) * scale : vcg::Point3d(0, 0, 0);
  auto face = vcg::tri::Allocator<SurfaceMesh>::AddFaces(mesh, built.source_face.size());
  for (int f : built.source_face) {
    for (int i = 0; i < 3; ++i) face->V(i) = &mesh.vert[data.faces[f][i]];
    ++face;
  }
  poll();
  vcg::tri::UpdateTopology<SurfaceMesh>::FaceFace(mesh);
  poll();
  return built;
}

}  // namespace dcharts
