// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/chart_images.h"

#include <algorithm>

namespace dcharts {

int ChartImages::ImageChart(const ChartIds& ids, int id) const {
  if (!IsSymmetric()) return -1;
  int image = -1, faces = 0, image_faces = 0;
  for (int f = 0; f < static_cast<int>(ids.size()); ++f) {
    if (ids[f] != id) continue;
    ++faces;
    if (image < 0) image = ids[halves_.ImageOf(f)];
    if (ids[halves_.ImageOf(f)] != image) return -1;
  }
  for (int other : ids) image_faces += other == image;
  return faces == image_faces ? image : -1;
}

void ChartImages::Pair(const ChartIds& ids) {
  if (!IsSymmetric()) return;
  const int count = ChartCount(ids), faces = static_cast<int>(ids.size());
  constexpr int kNone = -1, kSeveral = -2;
  std::vector<int> image(count, kNone);
  for (int f = 0; f < faces; ++f) {
    int& chart = image[ids[f]];
    const int other = ids[halves_.ImageOf(f)];
    chart = chart == kNone || chart == other ? other : kSeveral;
  }
  role_.assign(faces, Role::kAlone);
  for (int f = 0; f < faces; ++f) {
    const int other = image[ids[f]];
    if (other < 0 || image[other] != ids[f]) continue;
    if (other == ids[f]) role_[f] = Role::kOwnImage;
    if (other < ids[f]) role_[f] = Role::kFollows;
  }
}

void ChartImages::Copy(ChartIds& ids, SeamMask& seams, std::vector<FaceUv>& uv) const {
  if (!IsSymmetric()) return;
  const int count = ChartCount(ids);
  for (int f = 0; f < static_cast<int>(ids.size()); ++f) {
    if (!Follows(f)) continue;
    const int g = halves_.ImageOf(f);
    ids[f] = count + ids[g];
    // The image of face (a, b, c) is (a, c, b): its first and last edges change places.
    seams[f] = static_cast<std::uint8_t>((seams[g] & 1) << 2 | (seams[g] & 2) | (seams[g] & 4) >> 2);
    const FaceUv& t = uv[g];
    uv[f] = {-t[0], t[1], -t[4], t[5], -t[2], t[3]};
  }
}

void ChartImages::PartAtPlane(const SurfaceGraph<SurfaceMesh>& surface, int id, int new_id, ChartIds& ids,
                              SeamMask& seams) {
  for (int f = 0; f < surface.FaceCount(); ++f) {
    if (ids[f] != id) continue;
    for (int h = 3 * f; h < 3 * f + 3; ++h)
      if (halves_.IsOnPlane(surface, h)) SetSeam(seams, h);
    role_[f] = halves_.IsInFirst(f) ? Role::kAlone : Role::kFollows;
    if (!halves_.IsInFirst(f)) ids[f] = new_id;
  }
}

int ChartImages::TakeApart(const SurfaceGraph<SurfaceMesh>& surface, int id, int neighbour, ChartIds& ids,
                           SeamMask& seams) const {
  bool keeps_first_half = true;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int g = surface.Neighbour(h);
    if (g >= 0 && ids[h / 3] == id && ids[g] == neighbour) keeps_first_half = halves_.IsInFirst(h / 3);
  }
  const int new_id = ChartCount(ids);
  for (int f = 0; f < surface.FaceCount(); ++f) {
    if (ids[f] != id) continue;
    for (int h = 3 * f; h < 3 * f + 3; ++h)
      if (halves_.IsOnPlane(surface, h)) SetSeam(seams, h);
  }
  for (int f = 0; f < surface.FaceCount(); ++f)
    if (ids[f] == id && halves_.IsInFirst(f) != keeps_first_half) ids[f] = new_id;
  return new_id;
}

}  // namespace dcharts
