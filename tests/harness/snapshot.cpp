// SPDX-License-Identifier: GPL-3.0-or-later
#include "snapshot.h"

#include <cstring>
#include <type_traits>

namespace harness {
namespace {

template <class T>
void Append(std::string& bytes, const T& value) {
  static_assert(std::is_arithmetic<T>::value, "only numbers: padding has no defined value");
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

template <class Point>
void AppendPoint(std::string& bytes, const Point& p, int size) {
  for (int i = 0; i < size; ++i) Append(bytes, p[i]);
}

template <class Attributes>
void AddAttributes(Snapshot& parts, const std::string& name, const Attributes& attributes, size_t count) {
  int unnamed = 0;
  for (const vcg::PointerToAttribute& attribute : attributes) {
    const std::string own =
        attribute._name.empty() ? "unnamed " + std::to_string(unnamed++) : attribute._name;
    std::string& bytes = parts[name + " attribute " + own];
    if (count == 0) continue;
    // Not At(i): vcglib refuses that for attributes of a whole mesh.
    bytes.assign(static_cast<const char*>(attribute._handle->DataBegin()),
                 count * attribute._handle->SizeOf());
  }
}

void AddVertices(Snapshot& parts, const std::string& layer, CMeshO& mesh) {
  auto& vertices = mesh.vert;
  Append(parts[layer + "enabled vertex components"],
         vertices.IsMarkEnabled() | vertices.IsTexCoordEnabled() << 1 | vertices.IsVFAdjacencyEnabled() << 2 |
             vertices.IsRadiusEnabled() << 3 | vertices.IsCurvatureDirEnabled() << 4);
  for (auto& v : vertices) {
    AppendPoint(parts[layer + "vertex positions"], v.cP(), 3);
    AppendPoint(parts[layer + "vertex normals"], v.cN(), 3);
    AppendPoint(parts[layer + "vertex colors"], v.cC(), 4);
    Append(parts[layer + "vertex quality"], v.cQ());
    Append(parts[layer + "vertex flags"], v.cFlags());
    if (vertices.IsMarkEnabled()) Append(parts[layer + "vertex marks"], v.cIMark());
    if (vertices.IsTexCoordEnabled()) {
      AppendPoint(parts[layer + "vertex texcoords"], v.cT().P(), 2);
      Append(parts[layer + "vertex texture index"], v.cT().N());
    }
  }
}

void AddFaces(Snapshot& parts, const std::string& layer, CMeshO& mesh) {
  auto& faces = mesh.face;
  Append(parts[layer + "enabled face components"],
         faces.IsQualityEnabled() | faces.IsColorEnabled() << 1 | faces.IsMarkEnabled() << 2 |
             faces.IsWedgeTexCoordEnabled() << 3 | faces.IsFFAdjacencyEnabled() << 4 |
             faces.IsVFAdjacencyEnabled() << 5 | faces.IsCurvatureDirEnabled() << 6);
  for (auto& f : faces) {
    for (int k = 0; k < 3; ++k) Append(parts[layer + "faces"], f.cV(k) - &mesh.vert[0]);
    AppendPoint(parts[layer + "face normals"], f.cN(), 3);
    Append(parts[layer + "face flags"], f.cFlags());
    if (faces.IsQualityEnabled()) Append(parts[layer + "face quality"], f.cQ());
    if (faces.IsColorEnabled()) AppendPoint(parts[layer + "face colors"], f.cC(), 4);
    if (faces.IsMarkEnabled()) Append(parts[layer + "face marks"], f.cIMark());
    for (int k = 0; k < 3; ++k) {
      if (faces.IsWedgeTexCoordEnabled()) {
        AppendPoint(parts[layer + "wedge texcoords"], f.cWT(k).P(), 2);
        Append(parts[layer + "wedge texture index"], f.cWT(k).N());
      }
      if (faces.IsFFAdjacencyEnabled()) {
        const auto* neighbour = f.cFFp(k);
        Append(parts[layer + "face adjacency"], neighbour == nullptr ? -1 : neighbour - &faces[0]);
      }
    }
  }
}

void AddLayer(Snapshot& parts, MeshModel& model) {
  CMeshO& mesh = model.cm;
  const std::string layer = "layer " + std::to_string(model.id()) + ": ";
  parts[layer + "label"] = model.label().toStdString();
  Append(parts[layer + "data mask"], model.dataMask());
  for (const size_t n : {size_t(mesh.vn), size_t(mesh.fn), size_t(mesh.en), mesh.vert.size(),
                         mesh.face.size(), mesh.edge.size()}) {
    Append(parts[layer + "element counts"], n);
  }
  Append(parts[layer + "selection counts"], mesh.sfn);
  Append(parts[layer + "selection counts"], mesh.svn);
  AppendPoint(parts[layer + "bounding box"], mesh.bbox.min, 3);
  AppendPoint(parts[layer + "bounding box"], mesh.bbox.max, 3);
  for (int i = 0; i < 16; ++i) Append(parts[layer + "transform"], mesh.Tr.V()[i]);
  for (const std::string& texture : mesh.textures) parts[layer + "textures"] += texture + '\n';
  AddVertices(parts, layer, mesh);
  AddFaces(parts, layer, mesh);
  AddAttributes(parts, layer + "vertex", mesh.vert_attr, mesh.vert.size());
  AddAttributes(parts, layer + "face", mesh.face_attr, mesh.face.size());
  AddAttributes(parts, layer + "mesh", mesh.mesh_attr, 1);
}

}  // namespace

Snapshot TakeSnapshot(MeshDocument& document) {
  Snapshot parts;
  Append(parts["current layer"], document.mm() == nullptr ? -1 : document.mm()->id());
  for (MeshModel* model = document.nextMesh(); model != nullptr; model = document.nextMesh(model)) {
    AddLayer(parts, *model);
  }
  return parts;
}

std::string Difference(const Snapshot& before, const Snapshot& after) {
  std::string names;
  const auto add = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const auto& part : before) {
    const auto other = after.find(part.first);
    if (other == after.end() || other->second != part.second) add(part.first);
  }
  for (const auto& part : after) {
    if (before.find(part.first) == before.end()) add(part.first);
  }
  return names;
}

}  // namespace harness
