// SPDX-License-Identifier: GPL-3.0-or-later
#include "dcharts.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>

#include "surface/atlas_figures.h"
#include "surface/choose_segmentation.h"
#include "surface/cut.h"
#include "surface/fill.h"
#include "surface/lloyd.h"
#include "surface/make_charts.h"
#include "surface/merge.h"
#include "surface/parameterize.h"
#include "surface/straighten.h"
#include "surface/trial_merge.h"
#include "surface/workspace.h"

namespace dcharts {

// Compiled here once for each vcglib.
template class Lloyd<SurfaceMesh>;
template class HoleFiller<SurfaceMesh>;
template class GraphCutStraightener<SurfaceMesh>;
template class ShortestPathStraightener<SurfaceMesh>;
template class Merger<SurfaceMesh>;
template class TrialMerger<SurfaceMesh>;
template class ChartCutter<SurfaceMesh>;
template class Parameterizer<SurfaceMesh>;

namespace {

/// A stage's place in the progress bar and its seconds in the report.
class Stage {
 public:
  Stage(const char* name, const char* text, double from, double to, Progress& progress, Report& report)
      : report_(report), place_(report.stage_seconds.size()), start_(std::chrono::steady_clock::now()) {
    report.stage_seconds.push_back({name, 0});  // now: a destructor must not need memory
    progress.BeginStage(text, from, to);
  }
  ~Stage() {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    if (place_ < report_.stage_seconds.size()) report_.stage_seconds[place_].second = passed.count();
  }

 private:
  Report& report_;
  std::size_t place_;
  std::chrono::steady_clock::time_point start_;
};

// What a workspace calls while it is made.
std::function<void()> WhileReading(Progress& progress) {
  progress.BeginStage("Reading the mesh...", 0, 0);
  return [&progress] { progress.Poll(); };
}

void ReportCharts(const Workspace& work, const ChartIds& ids, const SeamMask& seams, Report& report) {
  report.charts = ChartCount(ids);
  report.unassigned_faces = static_cast<int>(std::count(ids.begin(), ids.end(), kUnassigned));
  report.seam_length = SeamLength(work.Surface(), seams);
}

// What Segment, Fill, Straighten and Merge have in common.
SurfaceChange ChartsWritten(Workspace& work, const ChartIds& ids, SurfaceChange change) {
  work.WriteCharts(ids, change);
  change.remove_seams = true;
  SeamMask borders = ChartBorders(work.Surface(), ids);
  work.ReleaseBorders(borders);
  ReportCharts(work, ids, borders, change.report);
  return change;
}

void MergeCharts(const SurfaceGraph<SurfaceMesh>& surface, const Params& params, Progress& progress,
                 ChartIds& ids, KnownFlattenings& known) {
  if (params.merge_by == MergeMethod::kTrialFlattening)
    TrialMerger<SurfaceMesh>(surface, params, progress).Run(ids, known);
  else
    Merger<SurfaceMesh>(surface, params, progress).Run(ids);
}

void FinishAtlas(Workspace& work, ChartIds& ids, SeamMask& seams, const KnownFlattenings& known,
                 const Params& params, Progress& progress, double from, SurfaceChange& change) {
  WedgeTexcoords uv;
  {
    Stage stage("parameterize", "Flattening charts...", from, 0.97, progress, change.report);
    uv = Parameterizer<SurfaceMesh>(work.Surface(), params, known, progress)
             .Run(ids, seams,
                  params.density_by == DensityBy::kVertexQuality ? work.ReadDensity(progress)
                                                                 : std::vector<double>());
    progress.Poll();
    DropSeamsNotIn(uv, work.Surface(), seams);
    work.ReleaseBorders(seams);
  }
  Stage stage("measure", "Measuring...", 0.97, 1, progress, change.report);
  work.WriteCharts(ids, change);
  work.WriteTexcoords(uv, change);
  progress.Poll();
  work.WarnOfReplacedTexcoords(progress);
  change.remove_seams = true;
  ReportCharts(work, ids, seams, change.report);
  progress.Poll();
  if (params.target_charts > 0 && ChartCount(ids) != params.target_charts)
    progress.Log(std::to_string(params.target_charts) + " charts were asked for, the atlas has " +
                 std::to_string(ChartCount(ids)) + ".");
  MeasureAtlas(work.Surface(), ids, uv, progress, change.report);
}

}  // namespace

SurfaceChange Segment(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  work.KeepBorders(params, progress);
  SurfaceChange change;
  Segmentation result;
  {
    Stage stage("segment", "Growing charts...", 0, 1, progress, change.report);
    result = SegmentationChooser<SurfaceMesh>(work.Surface(), params, progress).Run();
  }
  change.report.iterations = result.iterations;
  return ChartsWritten(work, result.ids, std::move(change));
}

SurfaceChange Fill(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  work.KeepBorders(params, progress);
  SurfaceChange change;
  ChartIds ids = work.ReadCharts();
  {
    Stage stage("fill", "Filling holes...", 0, 1, progress, change.report);
    HoleFiller<SurfaceMesh>(work.Surface(), params, progress).Run(ids);
  }
  return ChartsWritten(work, ids, std::move(change));
}

SurfaceChange Straighten(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  work.KeepBorders(params, progress);
  SurfaceChange change;
  ChartIds ids = work.ReadFilledCharts(progress);
  {
    Stage stage("straighten", "Straightening boundaries...", 0.02, 1, progress, change.report);
    StraightenBorders(work.Surface(), params, progress, ids);
  }
  return ChartsWritten(work, ids, std::move(change));
}

SurfaceChange Merge(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  work.KeepBorders(params, progress);
  SurfaceChange change;
  ChartIds ids = work.ReadFilledCharts(progress);
  {
    Stage stage("merge", "Merging charts...", 0.02, 1, progress, change.report);
    KnownFlattenings known;
    MergeCharts(work.Surface(), params, progress, ids, known);
  }
  return ChartsWritten(work, ids, std::move(change));
}

SurfaceChange Cut(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  work.KeepBorders(params, progress);
  SurfaceChange change;
  ChartIds ids = work.ReadFilledCharts(progress);
  SeamMask seams;
  KnownFlattenings known;
  {
    Stage stage("cut", "Cutting darts...", 0.02, 1, progress, change.report);
    change.report.darts =
        ChartCutter<SurfaceMesh>(work.Surface(), params, progress).Run(ChartsFor::kAtlas, ids, seams, known);
  }
  const SeamMask kept = work.KeptBorders();
  work.ReleaseBorders(seams);
  work.WriteCharts(ids, change);
  work.WriteSeams(seams, kept, change);
  work.WriteTexcoords(ProvisionalTexcoords(work.Surface(), seams), change);
  work.WarnOfReplacedTexcoords(progress);
  if (params.seam_layer) work.WriteSeamLines(seams, change);
  ReportCharts(work, ids, seams, change.report);
  return change;
}

SurfaceChange Parameterize(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  SurfaceChange change;
  ChartIds ids = work.ReadFilledCharts(progress);
  SeamMask seams;
  KnownFlattenings known;
  if (!work.ReadSeams(ids, seams)) {
    progress.Log("No seams that fit the charts: cut as D-Charts: Cut does by default.");
    Stage stage("cut", "Cutting darts...", 0.02, 0.1, progress, change.report);
    const Params defaults;
    change.report.darts = ChartCutter<SurfaceMesh>(work.Surface(), defaults, progress)
                              .Run(ChartsFor::kAtlas, ids, seams, known);
  }
  FinishAtlas(work, ids, seams, known, params, progress, 0.1, change);
  return change;
}

void MakeCharts(const SurfaceGraph<SurfaceMesh>& surface, const Params& params, ChartsFor use, double share,
                Progress& progress, ChartIds& ids, SeamMask& seams, KnownFlattenings& known, Report& report) {
  {
    Stage stage("segment", "Growing charts...", 0, 0.25 * share, progress, report);
    Segmentation result = SegmentationChooser<SurfaceMesh>(surface, params, progress).Run();
    ids = std::move(result.ids);
    report.iterations = result.iterations;
  }
  {
    Stage stage("fill", "Filling holes...", 0.25 * share, 0.275 * share, progress, report);
    HoleFiller<SurfaceMesh>(surface, params, progress).Run(ids);
  }
  {
    Stage stage("straighten", "Straightening boundaries...", 0.275 * share, 0.3125 * share, progress, report);
    StraightenBorders(surface, params, progress, ids);
  }
  {
    Stage stage("merge", "Merging charts...", 0.3125 * share, 0.875 * share, progress, report);
    MergeCharts(surface, params, progress, ids, known);
  }
  Stage stage("cut", "Cutting darts...", 0.875 * share, share, progress, report);
  report.darts = ChartCutter<SurfaceMesh>(surface, params, progress).Run(use, ids, seams, known);
}

SurfaceChange TextureAtlas(const SurfaceData& mesh, const Params& params, Progress& progress) {
  Workspace work(mesh, WhileReading(progress));
  work.KeepBorders(params, progress);
  SurfaceChange change;
  ChartIds ids;
  SeamMask seams;
  KnownFlattenings known;
  constexpr double kShare = 0.8;
  MakeCharts(work.Surface(), params, ChartsFor::kAtlas, kShare, progress, ids, seams, known, change.report);
  FinishAtlas(work, ids, seams, known, params, progress, kShare, change);
  if (params.seam_layer) work.WriteSeamLines(seams, change);
  return change;
}

SurfaceChange Measure(const SurfaceData& mesh, const Params&, Progress& progress) {
  const Workspace work(mesh, WhileReading(progress));
  SurfaceChange change;
  Stage stage("measure", "Measuring...", 0, 1, progress, change.report);
  if (!work.HasTexcoords()) {
    progress.Log("The mesh has no wedge texture coordinates: only its charts are measured.");
    const ChartIds charts = work.ReadCharts();
    ReportCharts(work, charts, ChartBorders(work.Surface(), charts), change.report);
    return change;
  }
  const SeamMask seams = work.TextureSeams();
  const WedgeTexcoords uv = work.ReadTexcoords();
  ChartIds ids(work.Surface().FaceCount(), 0);
  SplitAndCompact(work.Surface(), ids, &seams);
  ReportCharts(work, ids, seams, change.report);
  int outside = 0;
  for (const auto& t : uv)
    outside += std::any_of(t.begin(), t.end(), [](float x) { return !(x >= 0 && x <= 1); });
  if (outside > 0) progress.Log(std::to_string(outside) + " faces have texture coordinates outside [0,1].");
  MeasureAtlas(work.Surface(), ids, WithFiniteTexcoords(uv), progress, change.report);
  return change;
}

}  // namespace dcharts
