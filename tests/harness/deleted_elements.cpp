// SPDX-License-Identifier: GPL-3.0-or-later
#include "deleted_elements.h"

#include <array>
#include <vector>

#include "test_mesh.h"

namespace harness {
namespace {

bool GoOn(const int /*percent*/, const char* /*text*/) { return true; }

/// Everything that a filter writes to a live face, as numbers.
using FaceResult = std::array<double, 14>;

std::vector<FaceResult> ResultOf(const CMeshO& mesh) {
  std::vector<FaceResult> result;
  for (const auto& face : mesh.face) {
    if (face.IsD()) continue;
    FaceResult r{double(face.cQ())};
    for (int k = 0; k < 4; ++k) r[1 + k] = face.cC()[k];
    for (int k = 0; k < 3; ++k) {
      r[5 + 3 * k] = face.cWT(k).U();
      r[6 + 3 * k] = face.cWT(k).V();
      r[7 + 3 * k] = face.cWT(k).N();
    }
    result.push_back(r);
  }
  return result;
}

}  // namespace

std::string DifferenceByDeleted(Plugin& plugin, QAction* filter) {
  MeshDocument with, without;
  CMeshO& mesh = AddTestMesh(with)->cm;
  CMeshO& compact = AddTestMesh(without)->cm;
  vcg::tri::Allocator<CMeshO>::CompactEveryVector(compact);
  if (mesh.face.size() == compact.face.size() || mesh.vert.size() == compact.vert.size())
    return "the test mesh has no deleted elements";
  const std::vector<FaceResult> before = ResultOf(mesh);
  for (MeshDocument* document : {&with, &without}) {
    const Outcome outcome = plugin.Apply(filter, plugin.Parameters(filter, *document), *document, &GoOn);
    if (!outcome.finished) return "the filter failed: " + outcome.message;
  }
  if (ResultOf(mesh) == before) return "the filter did nothing";
  return ResultOf(mesh) == ResultOf(compact) ? "" : "another result with deleted elements";
}

}  // namespace harness
