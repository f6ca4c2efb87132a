// SPDX-License-Identifier: GPL-3.0-or-later
/// print_texture: the model's own colours in its pieces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/pi.h"
#include "pattern/drawing/piece_texture.h"
#include "pattern/drawing/placed_piece.h"
#include "pattern_fixture.h"
#include "shapes.h"

namespace dcharts {
namespace {

using namespace test;
using Rgb = std::array<int, 3>;

constexpr double kSize = 40;  // mm, of the square sheet that is the model

// Red grows to the right, green upwards.
TextureImage Slopes() {
  TextureImage image;
  image.width = 128;
  image.height = 64;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int value : {2 * x, 4 * (image.height - 1 - y), 40})
        image.rgb.push_back(static_cast<std::uint8_t>(value));
  return image;
}

struct Printed {
  SurfaceData mesh = shapes::Grid(6, 6);
  Pattern pattern;

  Printed() {
    for (auto& v : mesh.vertices)
      for (double& x : v) x *= kSize;
    pattern = FinePattern(ChartsOf(
        mesh, [](const Point3&) { return 0; }, FromAbove));
  }

  Picture Print(double angle = 0) const {
    PiecePlacement placement;
    placement.angle = angle;
    placement.offset = {100, 200};
    return PieceTexture(mesh, Place(pattern, pattern.pieces[0], placement));
  }

  // The colour at a point of the sheet.
  static Rgb At(const Picture& picture, const Point2& p) {
    const int x = static_cast<int>((p.x() - picture.at.x()) / picture.size.x() * picture.width);
    const int y = static_cast<int>((1 - (p.y() - picture.at.y()) / picture.size.y()) * picture.height);
    Rgb color{};
    for (int c = 0; c < 3; ++c) color[c] = picture.rgb[3 * (static_cast<size_t>(y) * picture.width + x) + c];
    return color;
  }
};

void SetTexcoords(SurfaceData& mesh, double times) {
  for (const auto& face : mesh.faces) {
    mesh.wedge_texcoords.emplace_back();
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 2; ++d)
        mesh.wedge_texcoords.back()[2 * k + d] =
            static_cast<float>(times * mesh.vertices[face[k]][d] / kSize);
    mesh.wedge_texture_index.push_back(0);
  }
}

TEST(PatternTexture, AnImageLiesAsOnTheModel) {
  Printed printed;
  SetTexcoords(printed.mesh, 1);
  printed.mesh.textures = {Slopes()};
  const Picture picture = printed.Print();
  ASSERT_GT(picture.width, 0);
  EXPECT_EQ(picture.rgb.size(), 3u * picture.width * picture.height);
  EXPECT_EQ(picture.clip.size(), 1u);
  for (const double u : {0.1, 0.5, 0.9})
    for (const double v : {0.2, 0.6, 0.95}) {
      const Rgb color = Printed::At(picture, {100 + u * kSize, 200 + v * kSize});
      EXPECT_NEAR(color[0], 255 * u, 5);
      EXPECT_NEAR(color[1], 255 * v, 8);
      EXPECT_EQ(color[2], 40);
    }
}

TEST(PatternTexture, ATurnedPieceTurnsItsImage) {
  Printed printed;
  SetTexcoords(printed.mesh, 1);
  printed.mesh.textures = {Slopes()};
  const Picture picture = printed.Print(kPi / 2);
  // What was to the right is above: u runs upwards, v to the left.
  const Rgb color = Printed::At(picture, {100 - 0.25 * kSize, 200 + 0.75 * kSize});
  EXPECT_NEAR(color[0], 255 * 0.75, 5);
  EXPECT_NEAR(color[1], 255 * 0.25, 8);
}

TEST(PatternTexture, ItRepeatsBeyondItsEdges) {
  Printed printed;
  SetTexcoords(printed.mesh, 2);
  printed.mesh.textures = {Slopes()};
  const Picture picture = printed.Print();
  const Rgb once = Printed::At(picture, {100 + 0.2 * kSize, 200 + 0.3 * kSize}),
            again = Printed::At(picture, {100 + 0.7 * kSize, 200 + 0.8 * kSize});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(once[c], again[c], 8);
}

TEST(PatternTexture, WithoutAnImageCornersHaveColors) {
  Printed printed;
  SetTexcoords(printed.mesh, 1);
  printed.mesh.textures = {TextureImage()};  // could not be read
  for (const auto& face : printed.mesh.faces) {
    printed.mesh.corner_colors.emplace_back();
    for (int k = 0; k < 3; ++k)
      printed.mesh.corner_colors.back()[k] = {
          static_cast<std::uint8_t>(200 * printed.mesh.vertices[face[k]][0] / kSize), 10, 20};
  }
  const Rgb color = Printed::At(printed.Print(), {100 + 0.5 * kSize, 200 + 0.4 * kSize});
  EXPECT_NEAR(color[0], 100, 4);
  EXPECT_EQ(color[1], 10);
  EXPECT_EQ(color[2], 20);
}

TEST(PatternTexture, NoColorsNoPicture) { EXPECT_EQ(Printed().Print().width, 0); }

}  // namespace
}  // namespace dcharts
