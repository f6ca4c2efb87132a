// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <string>

namespace dcharts {

/// How a chart is laid flat.
enum class FlattenMethod {
  kStretchMinimizing,  ///< least stretch [SGSH02]: what a texture wants
  kConformal           ///< least change of angles, ABF++ [SLMB05]
};

/// How the border between two charts is straightened.
enum class StraightenMethod {
  kGraphCut,     ///< the cheapest cut through a band around it, of edge lengths and fitting errors
  kShortestPath  ///< as in the paper
};

/// What tells whether two charts may be merged.
enum class MergeMethod {
  kTrialFlattening,  ///< the stretch of both together
  kBoundaryRegion    ///< how well the faces along their border fit a cylinder, as in the paper
};

/// What tells where a chart needs a dart.
enum class DartMethod {
  kMeasuredStretch,  ///< the worst stretch of the flattened chart
  kFittingError      ///< how badly faces fit the chart's proxy, as in the paper
};

/// What the texel density of a chart follows.
enum class DensityBy {
  kUniform,       ///< nothing: it is the same for all charts
  kVertexQuality  ///< the mean quality of its vertices
};

/// What a pattern is made of.
enum class PatternMaterial {
  kFabric,  ///< sewn and stuffed: pieces are laid flat conformally
  kPaper    ///< cut, folded and glued: pieces must not stretch
};

/// The unit of `size`, and of the mesh where size is 0.
enum class LengthUnit { kMm, kInch };

/// The pages of a printed pattern.
enum class PageFormat { kSingleSheet, kA4, kA3, kA0, kLetter };

/// What becomes of a piece that is larger than the page.
enum class Oversize {
  kTile,       ///< it goes over several pages that are glued together
  kSplitPiece  ///< it becomes several pieces with a seam between them
};

/// Every parameter of the pipeline, with its default (written here and nowhere else), unit and range.
/// A name means the same in every stage. Section numbers are those of D-Charts (Julius, Kraevoy, Sheffer
/// 2005).
struct Params {
  // --- segmentation (3.1) and hole filling (3.2)
  int chart_count = 0;  ///< initial seeds, >= 0; 0 = find the number
  double max_fitting_error =
      0.2;  ///< F_max, bound of Eq. 1 while growing; 0 < F_max <= 4, no unit (squared cosine)
  double fitting_weight = 1.0;      ///< alpha of Eq. 2, 0..10
  double compactness_weight = 1.4;  ///< beta of Eq. 2, 0..10
  double straightness_weight = 1;   ///< gamma of Eq. 2, 0..10
  int max_iterations = 100;         ///< bound on the Lloyd iterations, 1..10000
  double reassigned_percent =
      5.0;                    ///< stop when fewer faces than this changed chart, percent of the faces, 0..100
  int seed_candidates = 10;   ///< k: a new seed is the most central of the k best-fitting faces, >= 1
  double seed_percent = 1.0;  ///< k as a percentage of the chart's faces (the larger count is used), 0..100
  double small_hole_percent =
      1.0;  ///< holes up to this share of the surface area are grown over, percent, 0..100

  // --- what charts are kept to
  bool keep_seams = false;     ///< borders in the texture coordinates stay borders of charts
  double crease_angle = 180;   ///< edges that bend more sharply stay borders of charts, degrees, 0..180
  bool selected_only = false;  ///< only the selected faces take part

  // --- the finished atlas: a stage uses what concerns it
  int target_charts = 0;      ///< number of charts in the finished atlas, >= 0; 0 = as many as it takes
  double max_stretch = 1.01;  ///< bound on the L2 stretch of every chart at its own scale, >= 1, or 0: none

  // --- straightening (3.3)
  StraightenMethod straighten_by = StraightenMethod::kGraphCut;

  // --- merging (3.3)
  MergeMethod merge_by = MergeMethod::kTrialFlattening;
  double seam_weight = 1;  ///< of seam length against stretch where merges are chosen, 0..1000
  double merge_threshold =
      0.01;  ///< eta, bound on the boundary region's mean fitting error to a cylinder, 0..4

  // --- cuts (3.3)
  DartMethod dart_by = DartMethod::kMeasuredStretch;
  double dart_fitting_error = 0.2;  ///< darts run to regions whose fitting error (Eq. 1) is above this, 0..4
  double max_dart_percent =
      100.0;  ///< longest dart, percent of its chart's bounding box diagonal, 0..1000; 0 = no darts
  bool cut_to_disk = false;  ///< cut every boundary loop open, so that each chart is a disk
  bool seam_layer = false;   ///< add a layer of seam lines

  // --- flattening and packing (2, 4, 5)
  FlattenMethod method =
      FlattenMethod::kStretchMinimizing;       ///< of finished charts; trials always have the first
  int texture_size = 1024;                     ///< side of the square texture, texels, 16..65536
  int padding = 2;                             ///< free texels between charts, 0..texture_size / 4
  bool rotate = true;                          ///< charts may be turned for packing
  DensityBy density_by = DensityBy::kUniform;  ///< how large charts are beside each other

  // --- patterns (4)
  PatternMaterial material = PatternMaterial::kFabric;
  LengthUnit units = LengthUnit::kMm;
  double size = 0;                  ///< longest side of the finished object's axis-aligned box, in `units`,
                                    ///< 0..100000; 0 = as the mesh is
  double seam_allowance = 7;        ///< of fabric, mm, 0..100
  double tab_width = 6;             ///< of paper, mm, 0..100; 0 = no tabs
  double simplify_tolerance = 0.5;  ///< how far a simplified outline may be from the exact one, mm, 0..100
  double fold_angle = 15;           ///< paper that bends more sharply gets a fold line, degrees, 0..180
  bool merge_congruent = false;     ///< pieces of the same shape are drawn once
  bool print_texture = false;       ///< the model's colours are drawn into the pieces
  PageFormat page = PageFormat::kSingleSheet;
  Oversize oversize = Oversize::kTile;
  std::string output_file;  ///< .svg, .pdf or .dxf; empty = no file

  /// There may be lines that charts are kept to.
  bool KeepsBorders() const { return keep_seams || crease_angle < 180; }
  /// What max_stretch stands for: the bound, infinity where there is none.
  double StretchBound() const {
    return max_stretch > 0 ? std::max(1.0, max_stretch) : std::numeric_limits<double>::infinity();
  }
};

}  // namespace dcharts
