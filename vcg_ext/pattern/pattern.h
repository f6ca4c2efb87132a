// SPDX-License-Identifier: GPL-3.0-or-later
/// A pattern: the flat pieces of a model with all that a person needs to sew or fold them (Section 4). Plain
/// data, made by MakePattern (dcharts.h) and drawn by the writers. All lengths are millimetres of the
/// finished object, angles are radians unless a name says degrees. The right side of the fabric, and the
/// printed side of the paper, is the outside of the model: a piece is seen from there, its outer loop
/// counterclockwise.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/params.h"
#include "common/report.h"

namespace dcharts {

using Point2 = Eigen::Vector2d;
using Point3 = Eigen::Vector3d;
using Polyline = std::vector<Point2>;

/// A corner of a piece's net outline (the stitch line of fabric, the edge of folded paper), and the outline's
/// edge that starts there.
struct OutlinePoint {
  Point2 at{0, 0};           ///< piece coordinates
  int seam = -1;             ///< of the edge that starts here: index into Pattern::seams; every edge has one
  int side = 0;              ///< which of the seam's sides the edge is on
  double arc = 0;            ///< 3D arc length of this point along that seam, from the seam's start
  Point3 on_model{0, 0, 0};  ///< where it is on the finished model
};

/// A closed loop: the last point's edge goes to the first. Piece on the left: the outer loop runs
/// counterclockwise, holes clockwise.
using OutlineLoop = std::vector<OutlinePoint>;

/// The fine triangles of a piece before its outline was simplified: what texture lies where. They reach
/// beyond the net outline by at most simplify_tolerance (clip them).
struct FlatMesh {
  std::vector<Point2> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< corners in the order of the corners of `face`
  std::vector<int> face;                      ///< per triangle: its face in the SurfaceData
};

/// The triangulation of the net outline, without further points: the layer a host shows.
struct NetMesh {
  std::vector<Point2> vertices;  ///< the points of all loops, in order
  std::vector<std::array<int, 3>> triangles;
};

/// A dart or another slit: a seam with both sides in this piece that meet in a tip.
struct Dart {
  int seam = -1;          ///< index into Pattern::seams
  int loop = 0, tip = 0;  ///< index of the tip's outline point
  double opening = 0;     ///< angle at the tip between the legs
  double depth = 0;       ///< length of the longer leg, mm
};

/// A sharp bend of the paper. Drawn dashed (valley) or dash-dotted (mountain), with its angle.
struct Fold {
  Polyline line;             ///< piece coordinates
  double angle_degrees = 0;  ///< by how much the paper bends: 0 flat, 90 a cube's edge; mean along the line
  bool mountain = true;      ///< the ridge is on the printed side
};

/// A straight line of a curved part along which the paper does not bend; drawn lightly.
struct Ruling {
  Point2 from, to;
};

/// A flap of paper to put glue on, outside the net outline, glued below the other side of its seam.
struct Tab {
  int seam = -1, side = 0;
  Polyline outline;  ///< first and last point lie on the net outline: between them is the fold, not cut
};

/// How a piece lies on a sheet: p -> R(angle) p + offset.
struct PiecePlacement {
  int page = 0;  ///< always 0 on the single sheet; -1: larger than the page, to be tiled on pages of its own
  double angle = 0;
  Point2 offset{0, 0};  ///< mm, y upwards, from the page's (or sheet's) lower left corner

  Point2 operator()(const Point2& p) const;
};

struct Piece {
  int id = 0;                      ///< its place in Pattern::pieces; shown as id + 1
  std::string name;                ///< "Piece 3"
  std::vector<OutlineLoop> loops;  ///< net outline; the first is the outer one
  double area = 0;                 ///< of the net outline, mm^2
  double model_area = 0;           ///< of its part of the model, mm^2
  FlatMesh flat;
  NetMesh net;

  /// Where scissors go: fabric: the net outline widened by the seam allowance; paper: the net outline and its
  /// tabs. Closed loops, the first is the outer one.
  std::vector<Polyline> cut;

  std::vector<Dart> darts;
  std::vector<Fold> folds;      ///< paper only
  std::vector<Ruling> rulings;  ///< paper only
  std::vector<Tab> tabs;        ///< paper only

  Point2 grain{0, 1};       ///< unit vector, fabric only
  Point2 label_at{0, 0};    ///< the middle of the largest circle in the net outline
  double label_radius = 0;  ///< and its radius

  int group = 0;          ///< congruent pieces have the same: the id of the first of them
  bool mirrored = false;  ///< it is the mirror image of the group's first
  bool drawn = true;      ///< false: merge_congruent, and another of the group is drawn
  int copies = 1;         ///< how often a drawn piece is to be cut as drawn
  int mirror_copies = 0;  ///< and how often mirrored: "cut 1 + 1 mirrored"

  PiecePlacement on_sheet;  ///< all pieces on one sheet (layer, SVG, DXF)
  PiecePlacement on_page;   ///< pages of Pattern::page_size (PDF)
};

/// One side of a seam: a run of edges of a piece's outline.
struct SeamSide {
  int piece = 0, loop = 0;
  int first = 0;  ///< outline point where the run begins, in the loop's own direction
  int edges = 0;  ///< number of edges; they may run over the loop's end
  bool backwards =
      false;          ///< the loop's direction is against the seam's: then the run begins at the seam's end
  double length = 0;  ///< on this piece, mm
};

enum class NotchKind { kSingle, kDouble };

/// Points on both sides of a seam that are to meet, at equal 3D arc length.
struct MatchPoint {
  int number = 0;  ///< from 1 up, each number once in a pattern
  double arc = 0;  ///< from the seam's start
  NotchKind kind = NotchKind::kSingle;
  std::vector<Point2> at;       ///< per side, piece coordinates, on the net outline
  std::vector<Point2> outward;  ///< per side, unit vector away from the piece
};

/// What is sewn or glued together. Begins and ends where three pieces meet, at a dart's tip, or at the
/// model's border; a closed seam begins anywhere.
struct Seam {
  int id = 0;                   ///< its place in Pattern::seams; shown as id + 1
  std::vector<SeamSide> sides;  ///< two; one at a border of the model, more at an edge with more faces
  double length = 0;            ///< 3D length on the finished model, mm
  double ease = 0;  ///< largest difference of a side's length to another's, over the 3D length: 0.01 is 1 %
  bool closed = false;
  bool is_dart = false;
  std::vector<MatchPoint> match_points;
  int order = 0;         ///< 1, 2...: when to sew it; 0 for a border
  bool opening = false;  ///< sewn last: to turn and to stuff the toy

  bool IsBorder() const { return sides.size() == 1; }
};

struct Pattern {
  PatternMaterial material = PatternMaterial::kFabric;
  std::vector<Piece> pieces;
  std::vector<Seam> seams;
  std::vector<int> piece_of_face;     ///< per face of the SurfaceData, -1: none
  double scale = 1;                   ///< mm per unit of the mesh
  double allowance = 0;               ///< mm, 0 for paper
  Point2 sheet_size{0, 0};            ///< mm, of the single sheet
  Point2 page_size{0, 0};             ///< mm, zero for a single sheet; margins are within
  double page_margin = 0;             ///< mm, free on each side of a page
  int page_count = 0;                 ///< pages with whole pieces; tiles come after them
  double total_seam_length = 0;       ///< mm, without borders
  double largest_ease = 0;            ///< of all seams
  std::vector<std::string> warnings;  ///< sentences for the user, also logged
};

struct PatternResult {
  Pattern pattern;
  Report report;
};

}  // namespace dcharts
