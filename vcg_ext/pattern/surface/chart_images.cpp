// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/surface/chart_images.h"

#include <algorithm>

namespace dcharts {

int ChartImages::ImageChart(const ChartIds& ids, int id) const {
  if (half_ == 0) return -1;
  int image = -1, faces = 0, image_faces = 0;
  for (int f = 0; f < 2 * half_; ++f) {
    if (ids[f] != id) continue;
    ++faces;
    if (image < 0) image = ids[ImageOf(f)];
    if (ids[ImageOf(f)] != image) return -1;
  }
  for (int other : ids) image_faces += other == image;
  return faces == image_faces ? image : -1;
}

void ChartImages::Pair(const ChartIds& ids) {
  if (half_ == 0) return;
  const int count = ChartCount(ids);
  constexpr int kNone = -1, kSeveral = -2;
  std::vector<int> image(count, kNone);
  for (int f = 0; f < 2 * half_; ++f) {
    int& chart = image[ids[f]];
    const int other = ids[ImageOf(f)];
    chart = chart == kNone || chart == other ? other : kSeveral;
  }
  follows_.assign(2 * half_, 0);
  for (int f = 0; f < 2 * half_; ++f) {
    const int other = image[ids[f]];
    follows_[f] = other >= 0 && other < ids[f] && image[other] == ids[f];
  }
}

void ChartImages::Copy(ChartIds& ids, SeamMask& seams, std::vector<FaceUv>& uv) const {
  if (half_ == 0) return;
  const int count = ChartCount(ids);
  for (int f = 0; f < 2 * half_; ++f) {
    if (!follows_[f]) continue;
    const int g = ImageOf(f);
    ids[f] = count + ids[g];
    // The image of face (a, b, c) is (a, c, b): its first and last edges change places.
    seams[f] = static_cast<std::uint8_t>((seams[g] & 1) << 2 | (seams[g] & 2) | (seams[g] & 4) >> 2);
    const FaceUv& t = uv[g];
    uv[f] = {-t[0], t[1], -t[4], t[5], -t[2], t[3]};
  }
}

int ChartImages::TakeApart(const SurfaceGraph<SurfaceMesh>& surface, int id, int neighbour, ChartIds& ids,
                           SeamMask& seams) const {
  bool keeps_first_half = true;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int g = surface.Neighbour(h);
    if (g >= 0 && ids[h / 3] == id && ids[g] == neighbour) keeps_first_half = h / 3 < half_;
  }
  const int new_id = ChartCount(ids);
  for (int f = 0; f < 2 * half_; ++f)
    if (ids[f] == id && (f < half_) != keeps_first_half) ids[f] = new_id;
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int g = surface.Neighbour(h);
    if (g >= 0 && ids[h / 3] == id && ids[g] == new_id) {
      SetSeam(seams, h);
      SetSeam(seams, surface.Opposite(h));
    }
  }
  return new_id;
}

}  // namespace dcharts
