// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_table.h"

#include <initializer_list>
#include <locale>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace dcharts {

namespace {

// Short, as every line counts on a screen with the many parameters of the atlas.
const char* const kPaper =
    "<br><i>Dan Julius, Vladislav Kraevoy, Alla Sheffer</i>: \"D-Charts\", Eurographics 2005";

std::vector<ParamSpec> MakeParams() {
  return {
      // --- segmentation and hole filling
      {"chart_count", "Initial charts",
       "Number of seeds that charts are grown from. Charts are added and joined later, so the result may "
       "have more or "
       "fewer. A larger number gives smaller, flatter charts and longer seams. 0 lets the filter find the "
       "number.",
       &Params::chart_count, 0},
      {"max_fitting_error", "Largest fitting error",
       "How far a face may lean away from its chart's cone while the chart grows: the squared difference of "
       "two "
       "cosines, without unit. 0.2 is about 56 degrees for a plane and 26 for a cylinder. Larger values give "
       "fewer "
       "charts with more stretch. Straightening by Shortest Path keeps to it too; Graph Cut does not need "
       "it.",
       &Params::max_fitting_error, 0, 4, true},
      {"fitting_weight", "Weight of fitting (alpha)",
       "Exponent of the fitting error in the cost of adding a face to a chart, without unit. Larger values "
       "give "
       "flatter, more ragged charts; 0 ignores the fitting error in the cost.",
       &Params::fitting_weight, 0, 10},
      {"compactness_weight", "Weight of compactness (beta)",
       "Exponent of the compactness in the cost of adding a face to a chart, without unit. Larger values "
       "give rounder "
       "charts and shorter seams; 0 ignores compactness.",
       &Params::compactness_weight, 0, 10},
      {"straightness_weight", "Weight of straight borders (gamma)",
       "Exponent of the border length that a face adds in the cost of adding it to a chart, without unit. "
       "Larger "
       "values give smoother borders; 0 ignores border length.",
       &Params::straightness_weight, 0, 10},
      {"max_iterations", "Most iterations",
       "Bound on the number of Lloyd iterations, which grow all charts anew from better seeds. A larger "
       "bound only "
       "matters where the iterations have not settled before.",
       &Params::max_iterations, 1, 10000},
      {"reassigned_percent", "Stop below reassigned faces (%)",
       "The iterations stop when fewer faces than this have changed their chart, in percent of all faces. "
       "Larger values "
       "stop sooner; 0 goes on until nothing changes or the bound on the iterations is reached.",
       &Params::reassigned_percent, 0, 100},
      {"seed_candidates", "Seed candidates",
       "A chart's new seed is the most central of this many of its best-fitting faces. Larger numbers move "
       "seeds to "
       "the chart's centre, smaller ones to its best-fitting face.",
       &Params::seed_candidates, 1},
      {"seed_percent", "Seed candidates (% of the chart)",
       "The same count in percent of the chart's faces; the larger of the two counts is used. Keeps large "
       "meshes from "
       "many iterations. 0 uses the plain number alone.",
       &Params::seed_percent, 0, 100},
      {"small_hole_percent", "Small holes (% of the area)",
       "A hole between charts up to this share of the surface area, in percent, is filled by growing its "
       "neighbours "
       "over it; a larger hole gets charts of its own. Larger values give fewer charts with more stretch; 0 "
       "gives "
       "every hole charts of its own.",
       &Params::small_hole_percent, 0, 100},
      // --- what charts are kept to
      {"keep_seams", "Keep texture seams",
       "Where the mesh's texture coordinates jump, charts end. Where such a seam ends inside a chart, the "
       "chart "
       "is cut along it.",
       &Params::keep_seams},
      {"crease_angle", "Keep creases above (degrees)",
       "Charts end at edges that bend by more than this, in degrees. Where a crease ends inside a chart, the "
       "chart is cut along it. Smaller values keep more creases; 180 keeps none, 0 every edge that bends.",
       &Params::crease_angle, 0, 180},
      {"selected_only", "Only selected faces",
       "Only the selected faces take part, as if there were no others, and only they are written. Their "
       "charts "
       "get numbers that no other face has.",
       &Params::selected_only},
      // --- the finished atlas
      {"target_charts", "Number of charts",
       "Number of charts in the finished atlas, reached exactly where the mesh allows it. Fewer charts have "
       "shorter seams and more stretch. 0 makes as few as the largest stretch allows.",
       &Params::target_charts, 0},
      {"max_stretch", "Largest stretch of a chart",
       "Bound on the L2 stretch of every chart of the finished atlas, without unit; 1 is no stretch. A chart "
       "above it gets darts, then is split. Larger values give fewer charts. The number of charts asked for "
       "goes before it. 0 sets no bound.",
       &Params::max_stretch, 0, 1000},
      // --- straightening
      {"straighten_by",
       "Straighten by",
       "How borders between charts are straightened. Graph Cut finds, near each border, the one that fits "
       "both charts best and is short, and keeps to creases. Shortest Path takes the shortest way over "
       "faces that fit both sides, as the paper does, and a minimal cut for borders that are closed circles.",
       &Params::straighten_by,
       0,
       1,
       false,
       {"Graph Cut", "Shortest Path"}},
      // --- merging
      {"merge_by",
       "Merge by",
       "What tells whether two neighbouring charts are joined. Trial Flattening lays both flat together and "
       "takes first the pair that adds the least stretch for the seam it saves. Boundary Region looks at how "
       "well the faces along their border fit a cylinder, as the paper does.",
       &Params::merge_by,
       0,
       1,
       false,
       {"Trial Flattening", "Boundary Region"}},
      {"seam_weight", "Weight of short seams",
       "Of Trial Flattening: how much a shorter seam counts against more stretch, without unit. Larger "
       "values "
       "give shorter seams and more stretch; 0 looks at stretch alone.",
       &Params::seam_weight, 0, 1000},
      {"merge_threshold", "Merge threshold (eta)",
       "Of Boundary Region: two neighbouring charts are joined when the region along their border fits a "
       "cylinder with a mean "
       "fitting error below this, without unit. Larger values give fewer charts with more stretch; 0.00001 "
       "keeps "
       "mechanical parts "
       "strictly developable: charts that are not are halved first, unless target_charts is given or "
       "max_stretch "
       "is 0; 0 joins none.",
       &Params::merge_threshold, 0, 4},
      // --- cuts
      {"dart_by",
       "Darts by",
       "What tells where a dart, a cut that ends inside a chart, is made. Measured Stretch lays the chart "
       "flat and cuts from its border to where the stretch is worst, where that helps. Fitting Error cuts to "
       "the regions that fit the chart's cone badly, as the paper does.",
       &Params::dart_by,
       0,
       1,
       false,
       {"Measured Stretch", "Fitting Error"}},
      {"dart_fitting_error", "Fitting error that gets a dart",
       "Of Fitting Error: a dart, a cut that ends inside the chart, is made from the border to each region "
       "whose fitting error "
       "is above "
       "this, without unit. Larger values give fewer darts and more stretch; 0 aims at every face that does "
       "not fit "
       "exactly.",
       &Params::dart_fitting_error, 0, 4},
      {"max_dart_percent", "Longest dart (% of the chart's size)",
       "A dart may be this long, in percent of its chart's size, which is the diagonal of its bounding box. "
       "Larger values "
       "give longer seams and less stretch; 0 makes no darts.",
       &Params::max_dart_percent, 0, 1000},
      {"cut_to_disk", "Cut charts to disks",
       "Also cut charts whose border has several loops, such as a ring, so that every chart has exactly one. "
       "Otherwise "
       "such a loop is cut only where the chart would not lie flat without it.",
       &Params::cut_to_disk},
      {"seam_layer", "Add a layer of seam lines",
       "Add a layer with the edges along which the surface is cut, to look at. The mesh stays the current "
       "layer.",
       &Params::seam_layer},
      // --- flattening and packing
      {"method",
       "Flattening",
       "How charts are laid flat. Stretch-minimizing keeps lengths as far as possible, so that every part "
       "gets "
       "its share of the texture. Conformal (ABF++) keeps angles as far as possible, so that patterns are "
       "not "
       "sheared, but where a chart is curved parts get more of the texture than others; a chart that has no "
       "conformal map without folds is flattened with least stretch, and the log says so.",
       &Params::method,
       0,
       1,
       false,
       {"Stretch-minimizing", "Conformal (ABF++)"}},
      {"texture_size", "Texture size (texels)",
       "Side of the square texture for which charts are packed, in texels. Decides, with the padding, how "
       "far charts "
       "stay apart; texture coordinates are between 0 and 1 whatever it is.",
       &Params::texture_size, 16, 65536},
      {"padding", "Padding (texels)",
       "Free texels between charts, and half as many along the texture's edge, so that filtering does not "
       "mix their "
       "colours; at most "
       "a quarter of the texture size. Larger values leave less room for the charts; 0 lets charts touch.",
       &Params::padding, 0, 16384},
      {"rotate", "Turn charts",
       "Charts may be turned to pack them more tightly. Off keeps them as flattened.", &Params::rotate},
      {"density_by",
       "Texels by",
       "How large charts are beside each other. Uniform gives all the same texels per length of the surface. "
       "Vertex Quality gives a chart texels per length in proportion to the mean quality of its vertices: "
       "where it is 2 twice as many as where it is 1. Negative and infinite values count "
       "as 0, a chart gets at least a hundredth of what the best one gets, and where no vertex has a quality "
       "above 0 all get the same. The stretch figures see the texture as a whole, so they grow with the "
       "differences.",
       &Params::density_by,
       0,
       1,
       false,
       {"Uniform", "Vertex Quality"}},
      // --- patterns
      {"material",
       "Material",
       "What the pattern is for. Fabric is sewn and stuffed: pieces get a seam allowance, notches and a "
       "grain "
       "arrow. Paper is cut, folded and glued: pieces do not stretch, and get glue tabs and fold lines.",
       &Params::material,
       0,
       1,
       false,
       {"Fabric", "Paper"}},
      {"size", "Longest side",
       "Longest side of the finished object's bounding box, along the axes, in the unit chosen. 0 takes the "
       "mesh's own coordinates.",
       &Params::size, 0, 100000},
      {"units",
       "Unit",
       "Unit of the longest side, and of the mesh's coordinates where that is 0. All other lengths are mm.",
       &Params::units,
       0,
       1,
       false,
       {"mm", "inch"}},
      {"seam_allowance", "Seam allowance (mm)",
       "Of fabric: how far outside the stitch line to cut, in mm. Larger values are easier to sew and take "
       "more fabric; 0 cuts at the stitch line.",
       &Params::seam_allowance, 0, 100},
      {"tab_width", "Width of glue tabs (mm)",
       "Of paper: width of the tabs to put glue on, one at each seam, in mm. They are narrower where there "
       "is no room. 0 makes none.",
       &Params::tab_width, 0, 100},
      {"simplify_tolerance", "Simplify outlines (mm)",
       "How far a simplified outline may be from the exact one, in mm; both sides of a seam are simplified "
       "together. Larger values give fewer corners; 0 keeps all.",
       &Params::simplify_tolerance, 0, 100},
      {"fold_angle", "Folds sharper than (degrees)",
       "Of paper: where it bends by more than this, in degrees, a fold line with its angle is drawn. Larger "
       "values give fewer folds; 0 draws one at every edge that bends at all.",
       &Params::fold_angle, 0, 180},
      {"merge_congruent", "Draw equal pieces once",
       "Pieces of the same shape, or its mirror image, are drawn once, with the number to cut.",
       &Params::merge_congruent},
      {"print_texture", "Print the model's colours",
       "Draws the model's texture, or the colours of its vertices or faces, into the pieces of the file.",
       &Params::print_texture},
      {"page",
       "Page",
       "Pages of a PDF. SVG and DXF are always a single sheet.",
       &Params::page,
       0,
       4,
       false,
       {"Single sheet", "A4", "A3", "A0", "Letter"}},
      {"oversize",
       "Piece larger than the page",
       "What becomes of a piece that is larger than the page. Tile draws it over several pages that overlap, "
       "to be glued together. Split Piece makes it several pieces with seams between them.",
       &Params::oversize,
       0,
       1,
       false,
       {"Tile", "Split Piece"}},
      {"output_file", "File to write",
       "The drawing for printer, cutter or plotter, with all notation: SVG, PDF or DXF by its ending. A "
       "relative name is relative to the working directory. Empty writes none and only adds the layer. "
       "In the window of MeshLab 2020.09 choose it with the button: a name typed there is not taken.",
       &Params::output_file},
  };
}

// The parameters of these names, in this order.
std::vector<const ParamSpec*> Pick(std::initializer_list<std::string_view> names) {
  std::vector<const ParamSpec*> picked;
  for (std::string_view name : names)
    for (const ParamSpec& spec : AllParams())
      if (name == spec.name) picked.push_back(&spec);
  if (picked.size() != names.size())
    throw std::logic_error("a filter names a parameter that is not in the table");
  return picked;
}

std::vector<FilterSpec> MakeFilters() {
  const unsigned charts = kWritesQuality | kWritesColor;
  const unsigned atlas = charts | kWritesTexcoords;
  const unsigned texture = kMenuTexture;
  const unsigned coloring = kMenuTexture | kMenuFaceColoring;
  return {
      {FilterId::kSegment, "D-Charts: Segment", "dcharts_segment",
       "Groups the faces into charts that are nearly developable, that is, can be laid flat with little "
       "stretch. Charts "
       "grow from seeds, each around a cone that fits its normals, and grow again from better seeds until "
       "they settle "
       "(Lloyd iterations). Faces that fit no chart stay unassigned; D-Charts: Fill is the next step. "
       "Writes the chart number to the face quality (0, 1, 2...; -1 is unassigned) and a colour per chart to "
       "the face "
       "colour.",
       "Section 3.1", charts, coloring,
       Pick({"chart_count", "max_fitting_error", "fitting_weight", "compactness_weight",
             "straightness_weight", "max_iterations", "reassigned_percent", "seed_candidates", "seed_percent",
             "target_charts", "max_stretch", "keep_seams", "crease_angle", "selected_only"})},
      {FilterId::kFill, "D-Charts: Fill", "dcharts_fill",
       "Gives every face that is in no chart to one: small holes are grown over by the charts around them, "
       "large ones "
       "get charts of their own. Reads charts from the face quality, whoever wrote them: a value below 0 or "
       "more than "
       "0.01 off a whole number is unassigned. Writes face quality and face colour.",
       "Section 3.2", charts, coloring,
       Pick({"max_fitting_error", "fitting_weight", "compactness_weight", "straightness_weight",
             "small_hole_percent", "keep_seams", "crease_angle", "selected_only"})},
      {FilterId::kStraighten, "D-Charts: Straighten", "dcharts_straighten",
       "Straightens the borders between charts where faces fit both sides. No chart is added or lost. Reads "
       "charts from the face quality. Writes face quality and face colour.",
       "Section 3.3", charts, coloring,
       Pick({"straighten_by", "max_fitting_error", "keep_seams", "crease_angle", "selected_only"})},
      {FilterId::kMerge, "D-Charts: Merge", "dcharts_merge",
       "Joins neighbouring charts that can be laid flat together. Reads charts from the face quality. Writes "
       "face quality and face colour.",
       "Section 3.3", charts, coloring,
       Pick({"target_charts", "max_stretch", "merge_by", "seam_weight", "merge_threshold", "keep_seams",
             "crease_angle", "selected_only"})},
      {FilterId::kCut, "D-Charts: Cut", "dcharts_cut",
       "Cuts charts so that they can lie flat: handles and closed surfaces are opened, and darts run from "
       "the border to "
       "regions that fit badly. Reads charts from the face quality. Writes the seams as the per-face "
       "attribute "
       "dcharts_seams and as provisional texture coordinates that are discontinuous exactly at the seams; "
       "D-Charts: "
       "Parameterize is the next step. Vertices and faces stay as they are.",
       "Section 3.3", atlas, texture,
       Pick({"target_charts", "max_stretch", "dart_by", "dart_fitting_error", "max_dart_percent",
             "cut_to_disk", "seam_layer", "keep_seams", "crease_angle", "selected_only"})},
      {FilterId::kParameterize, "D-Charts: Parameterize", "dcharts_parameterize",
       "Flattens each chart with as little stretch or change of angles as possible and without flipped "
       "faces, cuts away what "
       "would overlap, "
       "and packs all charts into the unit square. Reads charts from the face quality, and seams from the "
       "attribute or "
       "the texture coordinates that D-Charts: Cut left; without them it makes the cuts it needs. Writes "
       "texture "
       "coordinates per wedge, texture index 0, and charts again where one had to be split. The texture "
       "itself is up to "
       "other filters.",
       "Sections 2, 4 and 5", atlas, texture,
       Pick({"target_charts", "max_stretch", "method", "texture_size", "padding", "rotate", "density_by",
             "selected_only"})},
      {FilterId::kTextureAtlas, "D-Charts: Texture Atlas", "dcharts_texture_atlas",
       "The six D-Charts stages in one. Writes face quality (the chart), face colour and wedge texture "
       "coordinates.",
       "Sections 2 to 5", atlas, coloring,
       Pick({"chart_count",
             "max_fitting_error",
             "fitting_weight",
             "compactness_weight",
             "straightness_weight",
             "max_iterations",
             "reassigned_percent",
             "seed_candidates",
             "seed_percent",
             "small_hole_percent",
             "target_charts",
             "max_stretch",
             "straighten_by",
             "merge_by",
             "seam_weight",
             "merge_threshold",
             "dart_by",
             "dart_fitting_error",
             "max_dart_percent",
             "cut_to_disk",
             "seam_layer",
             "method",
             "texture_size",
             "padding",
             "rotate",
             "density_by",
             "keep_seams",
             "crease_angle",
             "selected_only"})},
      {FilterId::kPattern, "D-Charts: Pattern", "dcharts_pattern",
       "A pattern to sew or to fold: flat pieces in mm, at the size of the finished object, as a layer and "
       "as "
       "a file. The mesh itself stays as it is.",
       "Section 4", kWritesNothing, texture,
       Pick({"material",
             "size",
             "units",
             "seam_allowance",
             "tab_width",
             "page",
             "oversize",
             "output_file",
             "merge_congruent",
             "print_texture",
             "target_charts",
             "max_stretch",
             "fold_angle",
             "simplify_tolerance",
             "chart_count",
             "max_fitting_error",
             "fitting_weight",
             "compactness_weight",
             "straightness_weight",
             "merge_by",
             "seam_weight",
             "merge_threshold",
             "dart_by",
             "dart_fitting_error",
             "max_dart_percent",
             "keep_seams",
             "crease_angle"})},
      {FilterId::kMeasure,
       "D-Charts: Measure",
       "dcharts_measure",
       "Measures the charts and texture coordinates that the mesh has, whoever made them: number of charts, "
       "stretch (L2 "
       "and Linf, 1 is best), shear, length of the seams over the square root of the area, flipped and "
       "overlapping "
       "faces, and how well the texture is used. With texture coordinates a chart is a set of faces joined "
       "by equal "
       "ones; without them charts are read from the face quality, and only they are measured. Has no "
       "parameters and "
       "changes nothing; see the log.",
       "Section 5",
       kWritesNothing,
       kMenuTexture | kMenuMeasure,
       {}},
  };
}

}  // namespace

const std::vector<ParamSpec>& AllParams() {
  static const std::vector<ParamSpec> params = MakeParams();
  return params;
}

const std::vector<FilterSpec>& AllFilters() {
  static const std::vector<FilterSpec> filters = MakeFilters();
  return filters;
}

bool IsAdvanced(const FilterSpec& filter, const ParamSpec& param) {
  static const std::set<std::string_view> of_atlas = {
      "fitting_weight",     "compactness_weight", "straightness_weight", "max_iterations",
      "reassigned_percent", "seed_candidates",    "seed_percent",        "small_hole_percent",
      "merge_threshold",    "dart_fitting_error", "keep_seams",          "crease_angle"};
  static const std::set<std::string_view> of_pattern = {
      "chart_count",        "max_fitting_error",   "fitting_weight",
      "compactness_weight", "straightness_weight", "merge_by",
      "seam_weight",        "merge_threshold",     "dart_by",
      "dart_fitting_error", "max_dart_percent",    "simplify_tolerance",
      "keep_seams",         "crease_angle"};
  if (filter.id == FilterId::kTextureAtlas) return of_atlas.count(param.name) > 0;
  return filter.id == FilterId::kPattern && of_pattern.count(param.name) > 0;
}

const FilterSpec& GetFilter(FilterId id) {
  for (const FilterSpec& spec : AllFilters())
    if (spec.id == id) return spec;
  throw std::logic_error("unknown filter id");
}

double ValueOf(const ParamSpec& spec, const Params& params) {
  return std::visit(
      [&](auto field) -> double {
        if constexpr (std::is_same_v<std::decay_t<decltype(params.*field)>, std::string>)
          throw std::logic_error("a file name is no number");
        else
          return static_cast<double>(params.*field);
      },
      spec.field);
}

void SetValue(const ParamSpec& spec, double value, Params& params) {
  std::visit(
      [&](auto field) {
        using Value = std::decay_t<decltype(params.*field)>;
        if constexpr (std::is_enum_v<Value>)
          params.*field = static_cast<Value>(static_cast<int>(value));
        else if constexpr (std::is_same_v<Value, bool>)
          params.*field = value != 0;
        else if constexpr (std::is_same_v<Value, std::string>)
          throw std::logic_error("a number is no file name");
        else
          params.*field = static_cast<Value>(value);
      },
      spec.field);
}

std::string ChoiceText(const ParamSpec& spec, const Params& params) {
  return spec.choices.at(static_cast<std::size_t>(ValueOf(spec, params)));
}

std::string RangeText(const ParamSpec& spec) {
  if (std::holds_alternative<bool Params::*>(spec.field)) return "true or false";
  if (IsFile(spec)) return "a name that ends in .svg, .pdf or .dxf, or empty";
  if (IsEnum(spec)) {
    std::string text;
    for (std::size_t i = 0; i < spec.choices.size(); ++i) {
      if (i > 0) text += i + 1 < spec.choices.size() ? ", " : " or ";
      text += std::string("'") + spec.choices[i] + "'";
    }
    return text;
  }
  const bool bounded = spec.max < std::numeric_limits<double>::infinity();
  if (spec.min_exclusive)
    return "above " + NumberText(spec.min) + (bounded ? " and at most " + NumberText(spec.max) : "");
  if (bounded) return "between " + NumberText(spec.min) + " and " + NumberText(spec.max);
  return NumberText(spec.min) + " or more";
}

std::string TooltipText(const ParamSpec& spec) {
  std::string text = spec.tooltip;
  if (std::holds_alternative<bool Params::*>(spec.field))
    return text + " Default: " + (ValueOf(spec, Params()) != 0 ? "on." : "off.");
  if (IsFile(spec)) return text + " It is " + RangeText(spec) + ". Default: empty.";
  if (IsEnum(spec))
    return text + " One of: " + RangeText(spec) + ". Default: '" + ChoiceText(spec, Params()) + "'.";
  return text + " Range: " + RangeText(spec) + ". Default: " + NumberText(ValueOf(spec, Params())) + ".";
}

std::string HelpText(const FilterSpec& spec) {
  return std::string(spec.summary) + kPaper + " (" + spec.reference + ").";
}

std::string NumberText(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(10);
  out << value;
  return out.str();
}

}  // namespace dcharts
