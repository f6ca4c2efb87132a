// SPDX-License-Identifier: GPL-3.0-or-later
/// A host's mesh to plain arrays and back. Templates over the host's MeshModel and CMeshO, whose headers come
/// first.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <QImage>

#include <vcg/complex/complex.h>

#include "common/errors.h"
#include "common/surface_data.h"

namespace dcharts {

/// Per-face attribute of the host's scalar type: the edges of a face that are seams, as a bit mask (see
/// SurfaceData).
inline const char* const kSeamsAttribute = "dcharts_seams";

/// True when the layer is not shown as its coordinates are: it has a matrix.
template <class Mesh>
bool HasMatrix(const Mesh& mesh) {
  return mesh.Tr != std::decay_t<decltype(mesh.Tr)>::Identity();
}

/// Reads what the filters need, with the layer's matrix applied: what the user sees, and what MeshLab's own
/// measures are of. Deleted elements are left out; quality, texture coordinates and seams stay
/// empty where the mesh has none.
template <class Mesh>
SurfaceData ReadSurface(Mesh& mesh) {
  using Scalar = typename Mesh::ScalarType;
  using Alloc = vcg::tri::Allocator<Mesh>;
  SurfaceData data;

  std::vector<int> index(mesh.vert.size(), -1);  // place in the host's vector -> index among live vertices
  const bool has_vertex_quality = vcg::tri::HasPerVertexQuality(mesh);
  const bool has_matrix = HasMatrix(mesh);
  const auto matrix = vcg::Matrix44d::Construct(mesh.Tr);
  data.vertices.reserve(mesh.vn);
  for (std::size_t i = 0; i < mesh.vert.size(); ++i) {
    if (mesh.vert[i].IsD()) continue;
    index[i] = static_cast<int>(data.vertices.size());
    auto p = vcg::Point3d::Construct(mesh.vert[i].cP());
    if (has_matrix) p = matrix * p;
    data.vertices.push_back({p[0], p[1], p[2]});
    if (has_vertex_quality) data.vertex_quality.push_back(mesh.vert[i].cQ());
  }

  const bool has_quality = vcg::tri::HasPerFaceQuality(mesh);
  const bool has_texcoords = vcg::tri::HasPerWedgeTexCoord(mesh);
  auto seams = Alloc::template FindPerFaceAttribute<Scalar>(mesh, kSeamsAttribute);
  const bool has_seams = Alloc::template IsValidHandle<Scalar>(mesh, seams);
  data.faces.reserve(mesh.fn);
  for (const auto& face : mesh.face) {
    if (face.IsD()) continue;
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = index[vcg::tri::Index(mesh, face.cV(k))];
    data.faces.push_back(corners);
    data.selected.push_back(face.IsS() ? 1 : 0);
    if (has_quality) data.face_quality.push_back(face.cQ());
    if (has_texcoords) {
      std::array<float, 6> uv;
      for (int k = 0; k < 3; ++k) {
        uv[2 * k] = static_cast<float>(face.cWT(k).U());
        uv[2 * k + 1] = static_cast<float>(face.cWT(k).V());
      }
      data.wedge_texcoords.push_back(uv);
      data.wedge_texture_index.push_back(face.cWT(0).N());
    }
    if (has_seams) {
      const Scalar mask = seams[face];
      data.seams.push_back(mask >= 0 && mask <= kAllSeamBits ? static_cast<std::uint8_t>(std::lround(mask))
                                                             : std::uint8_t{0});
    }
  }
  return data;
}

/// Reads the model's colours as well: textures, and the colours of vertices or else of faces, where they are
/// not all the same. Host::Texture(model, name) is the QImage of a texture.
template <class Host, class Model>
void ReadColors(const Model& model, SurfaceData& data) {
  const auto& mesh = model.cm;
  for (const std::string& name : mesh.textures) {
    const QImage image = Host::Texture(model, name).convertToFormat(QImage::Format_RGB888);
    TextureImage texture{image.width(), image.height(), {}};
    for (int y = 0; y < image.height(); ++y)
      texture.rgb.insert(texture.rgb.end(), image.constScanLine(y),
                         image.constScanLine(y) + 3 * image.width());
    data.textures.push_back(std::move(texture));
  }
  for (const bool of_vertices : {true, false}) {
    if (!of_vertices && !vcg::tri::HasPerFaceColor(mesh)) break;
    std::vector<std::array<std::array<std::uint8_t, 3>, 3>> colors;
    bool all_same = true;
    for (const auto& face : mesh.face) {
      if (face.IsD()) continue;
      colors.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const vcg::Color4b color = of_vertices ? face.cV(k)->cC() : face.cC();
        colors.back()[k] = {color[0], color[1], color[2]};
        all_same = all_same && colors.back()[k] == colors.front()[0];
      }
    }
    if (all_same) continue;
    data.corner_colors = std::move(colors);
    break;
  }
}

/// Writes a change to the mesh it was computed for, in two steps. The constructor gets all the memory that is
/// needed (optional components, the seams attribute); Commit then writes and can't fail. Without Commit the
/// destructor takes back what was added.
template <class Model>
class SurfaceWriter {
 public:
  /// Throws Error when the arrays do not fit the mesh, and std::bad_alloc.
  SurfaceWriter(Model& model, const SurfaceChange& change) : model_(model), change_(change) {
    const std::size_t faces = static_cast<std::size_t>(model.cm.fn);
    CheckSize(change.chart_ids.size(), faces);
    CheckSize(change.colors.size(), faces);
    CheckSize(change.wedge_texcoords.size(), faces);
    CheckSize(change.seams.size(), faces);
    CheckSize(change.written.size(), faces);
    try {
      Enable(!change.chart_ids.empty(), Model::MM_FACEQUALITY);
      Enable(!change.colors.empty(), Model::MM_FACECOLOR);
      Enable(!change.wedge_texcoords.empty(), Model::MM_WEDGTEXCOORD);
      if (!change.seams.empty() && !Alloc::template IsValidHandle<Scalar>(model_.cm, FindSeams())) {
        Alloc::DeletePerFaceAttribute(model_.cm, kSeamsAttribute);  // one of another type, if any
        Alloc::template AddPerFaceAttribute<Scalar>(model_.cm, kSeamsAttribute);
        added_seams_ = true;
      }
    } catch (...) {
      TakeBack();
      throw;
    }
  }
  SurfaceWriter(const SurfaceWriter&) = delete;
  SurfaceWriter& operator=(const SurfaceWriter&) = delete;
  ~SurfaceWriter() {
    if (!committed_) TakeBack();
  }

  void Commit() {
    committed_ = true;
    auto seams = FindSeams();
    std::size_t next = 0;  // index among live faces
    for (auto& face : model_.cm.face) {
      if (face.IsD()) continue;
      const std::size_t i = next++;
      if (!change_.written.empty() && change_.written[i] == 0) continue;
      if (!change_.chart_ids.empty()) face.Q() = static_cast<Scalar>(change_.chart_ids[i]);
      if (!change_.colors.empty()) {
        const auto& rgb = change_.colors[i];
        face.C() = vcg::Color4b(rgb[0], rgb[1], rgb[2], 255);
      }
      if (!change_.wedge_texcoords.empty()) {
        for (int k = 0; k < 3; ++k) {
          face.WT(k).U() = change_.wedge_texcoords[i][2 * k];
          face.WT(k).V() = change_.wedge_texcoords[i][2 * k + 1];
          face.WT(k).N() = 0;
        }
      }
      if (!change_.seams.empty()) seams[face] = static_cast<Scalar>(change_.seams[i]);
    }
    if (change_.remove_seams) Alloc::DeletePerFaceAttribute(model_.cm, kSeamsAttribute);
  }

 private:
  using Mesh = std::remove_reference_t<decltype(std::declval<Model&>().cm)>;
  using Scalar = typename Mesh::ScalarType;
  using Alloc = vcg::tri::Allocator<Mesh>;

  static void CheckSize(std::size_t size, std::size_t faces) {
    if (size != 0 && size != faces)
      throw Error("D-Charts made a result that does not fit the mesh. Please report it.");
  }

  auto FindSeams() { return Alloc::template FindPerFaceAttribute<Scalar>(model_.cm, kSeamsAttribute); }

  void Enable(bool wanted, int component) {
    if (!wanted || model_.hasDataMask(component)) return;
    enabled_ |= component;
    model_.updateDataMask(component);
  }

  void TakeBack() {
    model_.clearDataMask(enabled_);
    if (added_seams_) Alloc::DeletePerFaceAttribute(model_.cm, kSeamsAttribute);
  }

  Model& model_;
  const SurfaceChange& change_;
  int enabled_ = 0;
  bool added_seams_ = false;
  bool committed_ = false;
};

/// Fills an empty layer with one edge per seam line, each with end points of its own.
template <class Mesh>
void FillSeamLayer(const std::vector<std::array<std::array<double, 3>, 2>>& lines, Mesh& layer) {
  using Scalar = typename Mesh::ScalarType;
  auto vertex = vcg::tri::Allocator<Mesh>::AddVertices(layer, 2 * lines.size());
  auto edge = vcg::tri::Allocator<Mesh>::AddEdges(layer, lines.size());
  for (const auto& line : lines) {
    for (int k = 0; k < 2; ++k) {
      vertex->P() = {Scalar(line[k][0]), Scalar(line[k][1]), Scalar(line[k][2])};
      edge->V(k) = &*vertex;
      ++vertex;
    }
    ++edge;
  }
}

/// Fills an empty layer with a pattern's pieces: the piece's number is the face quality.
template <class Model>
void FillPieceLayer(const FlatLayer& pieces, Model& layer) {
  auto& mesh = layer.cm;
  using Mesh = std::remove_reference_t<decltype(mesh)>;
  using Scalar = typename Mesh::ScalarType;
  layer.updateDataMask(Model::MM_FACEQUALITY | Model::MM_FACECOLOR);
  auto vertex = vcg::tri::Allocator<Mesh>::AddVertices(mesh, pieces.vertices.size());
  for (const auto& p : pieces.vertices) (vertex++)->P() = {Scalar(p[0]), Scalar(p[1]), Scalar(p[2])};
  auto face = vcg::tri::Allocator<Mesh>::AddFaces(mesh, pieces.faces.size());
  for (std::size_t f = 0; f < pieces.faces.size(); ++f, ++face) {
    for (int k = 0; k < 3; ++k) face->V(k) = &mesh.vert[pieces.faces[f][k]];
    face->Q() = static_cast<Scalar>(pieces.piece[f]);
    const auto& rgb = pieces.colors[f];
    face->C() = vcg::Color4b(rgb[0], rgb[1], rgb[2], 255);
  }
}

}  // namespace dcharts
