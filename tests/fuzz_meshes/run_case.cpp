// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_case.h"

#include <filesystem>

#include "check_result.h"
#include "dcharts.h"
#include "pattern/drawing/write_pattern.h"
#include "run_stages.h"
#include "runner.h"
#include "selected_part.h"
#include "thread_count.h"

namespace dcharts::fuzz {
namespace {

constexpr FilterId kStages[] = {FilterId::kSegment, FilterId::kFill, FilterId::kStraighten,
                                FilterId::kMerge,   FilterId::kCut,  FilterId::kParameterize};

SurfaceChange Run(FilterId id, const SurfaceData& mesh, const Params& params) {
  Progress progress;
  return RunFilter(GetFilter(id), &mesh, params, progress);
}

std::string WrongStageByStage(const RandomCase& what, const SurfaceChange& atlas) {
  SurfaceData mesh = what.mesh;
  SurfaceChange last;
  for (FilterId id : kStages) {
    last = Run(id, mesh, what.params);
    test::Write(last, test::Kept::kAll, mesh);
  }
  return last.chart_ids == atlas.chart_ids && last.wedge_texcoords == atlas.wedge_texcoords
             ? ""
             : "stage by stage gives another atlas\n";
}

std::string WrongOnOneThread(const RandomCase& what, const SurfaceChange& change) {
  const test::Threads threads(1);
  const SurfaceChange again = Run(what.filter->id, what.mesh, what.params);
  return SameBytes(change, again) ? "" : "one thread gives other bytes\n";
}

// What the runner does for a pattern, with the pattern in between to look at.
std::string RunPattern(const RandomCase& what, Progress& progress) {
  return WithSentences([&] {
    CheckParams(*what.filter, what.params);
    const PatternResult result = MakePattern(what.mesh, what.params, progress);
    const std::string wrong = WrongInPattern(what.mesh, result);
    if (wrong.empty() && !what.params.output_file.empty())
      WritePattern(result.pattern, what.mesh, what.params);
    return wrong;
  });
}

std::string RunAndCheck(const RandomCase& what) {
  int calls = 0;
  bool cancelled = false;
  Progress progress([&](int, const char*) {
    cancelled = what.also == Also::kCancel && ++calls >= what.cancel_at;
    return !cancelled;
  });
  if (what.filter->id == FilterId::kPattern) return RunPattern(what, progress);
  const SurfaceChange change = RunFilter(*what.filter, &what.mesh, what.params, progress);
  if (cancelled) return "it was cancelled and went on\n";
  std::string wrong = what.params.selected_only
                          ? WrongInSelection(*what.filter, what.mesh, what.params, change)
                          : WrongInChange(*what.filter, what.mesh, what.params, change);
  if (what.also == Also::kAgain) wrong += WrongOnOneThread(what, change);
  if (what.also == Also::kStageByStage) wrong += WrongStageByStage(what, change);
  return wrong;
}

bool ParamsAreRefused(const RandomCase& what) {
  try {
    CheckParams(*what.filter, what.params);
  } catch (const Error&) {
    return true;
  }
  return false;
}

}  // namespace

Outcome RunCase(const RandomCase& what) {
  Outcome outcome;
  const SurfaceData before = what.mesh;
  try {
    outcome.wrong = RunAndCheck(what);
  } catch (const Cancelled& cancelled) {
    outcome.refusal = cancelled.what();
    if (what.also != Also::kCancel) outcome.wrong = "cancelled by nobody\n";
  } catch (const Error& error) {
    outcome.refusal = error.what();
    outcome.wrong = WrongInSentence(outcome.refusal);
    // A pattern may be refused for more than its mesh: it has a size and must have room.
    if (what.filter->id != FilterId::kPattern && !ParamsAreRefused(what) &&
        IsTakeable(what.params.selected_only ? test::SelectedPart(what.mesh) : what.mesh))
      outcome.wrong += "refused without need: " + outcome.refusal + "\n";
  } catch (const std::exception& error) {
    outcome.wrong = std::string("another exception: ") + error.what() + "\n";
  }
  if (!SameBytes(before, what.mesh)) outcome.wrong += "the input changed\n";
  if (!what.params.output_file.empty()) {
    std::error_code error;
    std::filesystem::remove(what.params.output_file, error);
    if (std::filesystem::exists(".dcharts-0.part")) outcome.wrong += "half a file is left\n";
  }
  return outcome;
}

}  // namespace dcharts::fuzz
