// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_mesh.h"

#include <cmath>

namespace harness {
namespace {

constexpr double kTurn = 6.283185307179586;

/// A grid of `around` by `along` cells; the last column joins the first, the last row too when `closed`.
template <class Position>
void AddGrid(CMeshO& mesh, int around, int along, bool closed, const Position& position) {
  const int rows = closed ? along : along + 1;
  const size_t first = mesh.vert.size();
  auto v = vcg::tri::Allocator<CMeshO>::AddVertices(mesh, size_t(around) * rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < around; ++i, ++v) v->P() = position(double(i) / around, double(j) / along);
  }
  const auto corner = [&](int i, int j) {
    return &mesh.vert[first + size_t(j % rows) * around + i % around];
  };
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      vcg::tri::Allocator<CMeshO>::AddFace(mesh, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
      vcg::tri::Allocator<CMeshO>::AddFace(mesh, corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  }
}

/// A sequence of numbers without a pattern that a filter would write: 0..996, the same every time.
class Arbitrary {
 public:
  int operator()() { return state_ = (state_ * 31 + 17) % 997; }

 private:
  int state_ = 5;
};

void FillWithArbitraryValues(MeshModel& model) {
  CMeshO& mesh = model.cm;
  Arbitrary next;
  auto of_vertex = vcg::tri::Allocator<CMeshO>::GetPerVertexAttribute<Scalarm>(mesh, "of the user");
  auto of_face = vcg::tri::Allocator<CMeshO>::GetPerFaceAttribute<Scalarm>(mesh, "of the user");
  for (auto& v : mesh.vert) {
    v.Q() = Scalarm(next() / 7.0);
    v.C() = vcg::Color4b(next() % 256, next() % 256, next() % 256, 255);
    if (next() % 3 == 0) v.SetS();
    of_vertex[v] = Scalarm(next());
  }
  for (auto& f : mesh.face) {
    f.Q() = Scalarm(next() / 3.0);
    f.C() = vcg::Color4b(next() % 256, next() % 256, next() % 256, 200);
    for (int k = 0; k < 3; ++k) {
      f.WT(k).U() = float(next() / 500.0 - 1.0);
      f.WT(k).V() = float(next() / 500.0 - 1.0);
      f.WT(k).N() = short(next() % 3);
    }
    if (next() % 3 == 0) f.SetS();
    of_face[f] = Scalarm(next());
  }
  mesh.textures.push_back("of_the_user.png");
}

}  // namespace

MeshModel* AddTestMesh(MeshDocument& document) {
  MeshModel* model = document.addNewMesh("", "test mesh");
  CMeshO& mesh = model->cm;
  vcg::tri::Allocator<CMeshO>::AddVertices(mesh, 2);
  AddGrid(mesh, 8, 16, true, [](double u, double v) {
    const double r = 1.0 + 0.4 * std::cos(kTurn * u);
    return Point3m(r * std::cos(kTurn * v), r * std::sin(kTurn * v), 0.4 * std::sin(kTurn * u));
  });
  AddGrid(mesh, 8, 8, false, [](double u, double v) {
    const double r = 0.3 + 0.15 * std::sin(kTurn * v / 2);
    return Point3m(2.5 + r * std::cos(kTurn * u), r * std::sin(kTurn * u), v);
  });
  model->updateDataMask(MeshModel::MM_FACEQUALITY | MeshModel::MM_FACECOLOR | MeshModel::MM_WEDGTEXCOORD |
                        MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
  FillWithArbitraryValues(*model);
  for (int v : {0, 1}) vcg::tri::Allocator<CMeshO>::DeleteVertex(mesh, mesh.vert[v]);
  for (int f : {3, 4, 200}) vcg::tri::Allocator<CMeshO>::DeleteFace(mesh, mesh.face[f]);
  mesh.Tr.SetScale(2, 3, 1);
  vcg::tri::UpdateBounding<CMeshO>::Box(mesh);
  vcg::tri::UpdateNormal<CMeshO>::PerVertexNormalizedPerFace(mesh);
  return model;
}

}  // namespace harness
