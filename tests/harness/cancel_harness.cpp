// SPDX-License-Identifier: GPL-3.0-or-later
/// Cancels every filter of a plugin at every callback, lets it refuse a mesh, and checks that the document
/// keeps every byte, also without memory; and that deleted elements of a mesh don't matter.
/// usage: cancel_harness PLUGIN_FILE
/// Prints a line per filter; exit code 0 when all is well, 1 with the reasons otherwise.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include <QCoreApplication>

#include "deleted_elements.h"
#include "host_api.h"
#include "snapshot.h"
#include "test_mesh.h"
#include "without_memory.h"

namespace harness {
namespace {

// vcg's callback is a plain function, so its state is global.
int g_calls = 0;
int g_cancel_at = 0;  // 0 = never

bool Callback(const int /*percent*/, const char* /*text*/) { return ++g_calls != g_cancel_at; }

/// `seam_layer` turns that parameter on where the filter has it. A pattern is made 300 mm long: as small as
/// the test mesh is, pieces would be narrower than the seam allowance.
RichParameterList ParametersOf(const Plugin& plugin, QAction* filter, const MeshDocument& document,
                               bool seam_layer) {
  RichParameterList parameters = plugin.Parameters(filter, document);
  if (seam_layer && parameters.hasParameter("seam_layer")) parameters.setValue("seam_layer", BoolValue(true));
  if (parameters.hasParameter("size")) parameters.setValue("size", FloatValue(300));
  return parameters;
}

/// Where to cancel after callback `at` of about `total`: each of the first and of the last, and between them,
/// where a filter calls back hundreds of times, ever fewer.
int NextToCancelAt(int at, int total) {
  constexpr int kEach = 40;
  if (at < kEach || at >= total - kEach) return at + 1;
  return std::min(at + 1 + at / kEach, total - kEach);
}

/// How often the filter calls back on this document, which gets its result.
int CountCallbacks(Plugin& plugin, QAction* filter, bool seam_layer, MeshDocument& document) {
  g_cancel_at = g_calls = 0;
  const Outcome outcome =
      plugin.Apply(filter, ParametersOf(plugin, filter, document, seam_layer), document, &Callback);
  return outcome.finished ? g_calls : 0;
}

/// Runs one filter on the document, cancelled at callback after callback, until it finishes. Returns the
/// reason of a failure, or an empty string with the filter's result left in the document. `total`: about how
/// many callbacks there are.
std::string CancelEverywhere(Plugin& plugin, QAction* filter, bool seam_layer, int total,
                             MeshDocument& document) {
  const RichParameterList parameters = ParametersOf(plugin, filter, document, seam_layer);
  const Snapshot before = TakeSnapshot(document);
  for (g_cancel_at = 1;; g_cancel_at = NextToCancelAt(g_cancel_at, total)) {
    g_calls = 0;
    const Outcome outcome = plugin.Apply(filter, parameters, document, &Callback);
    const std::string where = "cancelled at callback " + std::to_string(g_cancel_at) + ": ";
    if (outcome.finished) {
      if (g_calls >= g_cancel_at) return where + "the filter went on and finished";
      if (g_cancel_at == 1) return "the filter never calls back";
      return "";
    }
    if (g_calls < g_cancel_at) return "the filter failed: " + outcome.message;
    if (g_calls > g_cancel_at) return where + "the filter called back again";
    if (outcome.message.empty()) return where + "no message for the user";
    const std::string difference = Difference(before, TakeSnapshot(document));
    if (!difference.empty()) return where + "changed: " + difference;
  }
}

/// Lets the filter fail, and returns what is wrong after that. The document keeps every byte, those too that
/// no Python or file shows: components that are switched on, marks, attributes.
std::string FailureThatChanges(Plugin& plugin, QAction* filter, MeshDocument& document) {
  g_cancel_at = 0;
  const auto fails = [&](const RichParameterList& parameters) -> std::string {
    const Snapshot before = TakeSnapshot(document);
    const Outcome outcome = plugin.Apply(filter, parameters, document, &Callback);
    if (outcome.finished) return "what must be refused was not";
    if (outcome.message.empty()) return "refused without a message for the user";
    const std::string difference = Difference(before, TakeSnapshot(document));
    return difference.empty() ? "" : "refused (" + outcome.message + "), but changed: " + difference;
  };
  RichParameterList parameters = ParametersOf(plugin, filter, document, false);
  for (auto& face : document.mm()->cm.face) {
    if (face.IsD()) continue;
    const Scalarm x = face.V(0)->P().X();
    face.V(0)->P().X() = std::numeric_limits<Scalarm>::quiet_NaN();
    const std::string problem = fails(parameters);
    face.V(0)->P().X() = x;
    if (!problem.empty()) return problem;
    break;
  }
  // A pattern can turn out to be impossible when most of the work is done.
  if (!parameters.hasParameter("seam_allowance")) return "";
  parameters.setValue("size", FloatValue(10));
  parameters.setValue("seam_allowance", FloatValue(100));
  return fails(parameters);
}

/// Positions, faces, normals, selection and the user's attributes stay even when a filter finishes. The names
/// are those of the snapshot.
std::string ChangeOfUsersOwn(const Snapshot& before, const Snapshot& after) {
  for (const char* part :
       {"current layer", "layer 0: vertex positions", "layer 0: vertex normals", "layer 0: vertex colors",
        "layer 0: vertex quality", "layer 0: vertex attribute of the user", "layer 0: faces",
        "layer 0: face attribute of the user", "layer 0: face normals", "layer 0: selection counts",
        "layer 0: element counts", "layer 0: label", "layer 0: bounding box", "layer 0: transform"}) {
    if (before.at(part) != after.at(part)) return std::string("finished, but changed: ") + part;
  }
  return "";
}

/// A filter that writes texcoords writes texture index 0: the test mesh has others. Deleted faces keep
/// theirs.
std::string WrongTextureIndex(const Snapshot& before, MeshDocument& document) {
  const std::string texcoords = "layer 0: wedge texcoords";
  if (before.at(texcoords) == TakeSnapshot(document).at(texcoords)) return "";
  for (const auto& face : document.mm()->cm.face)
    for (int k = 0; k < 3; ++k)
      if (!face.IsD() && face.cWT(k).N() != 0) return "finished, but there are texture indices other than 0";
  return "";
}

/// All filters in the plugin's order, each on what the ones before left: the stages get charts and seams to
/// read.
int RunAll(Plugin& plugin, bool seam_layer) {
  MeshDocument document, twin;
  AddTestMesh(document);
  AddTestMesh(twin);
  int failures = 0;
  for (QAction* filter : plugin.Filters()) {
    const int total = CountCallbacks(plugin, filter, seam_layer, twin);
    if (seam_layer && !plugin.Parameters(filter, document).hasParameter("seam_layer")) {
      CountCallbacks(plugin, filter, seam_layer, document);  // cancelled in the other round
      continue;
    }
    const Snapshot before = TakeSnapshot(document);
    std::string problem = FailureThatChanges(plugin, filter, document);
    if (problem.empty()) problem = CancelEverywhere(plugin, filter, seam_layer, total, document);
    if (problem.empty()) problem = ChangeOfUsersOwn(before, TakeSnapshot(document));
    if (problem.empty()) problem = WrongTextureIndex(before, document);
    failures += problem.empty() ? 0 : 1;
    std::printf("%s %s%s: %s\n", problem.empty() ? "ok  " : "FAIL", qUtf8Printable(filter->text()),
                seam_layer ? " with seam_layer" : "",
                problem.empty() ? (std::to_string(g_calls) + " callbacks").c_str() : problem.c_str());
  }
  return failures;
}

/// `check` says in words what is wrong with a filter.
int RunOne(Plugin& plugin, const char* filter_name, const char* what,
           std::string (*check)(Plugin&, QAction*)) {
  for (QAction* filter : plugin.Filters()) {
    if (filter->text() != filter_name) continue;
    const std::string problem = check(plugin, filter);
    std::printf("%s %s: %s\n", problem.empty() ? "ok  " : "FAIL", what, problem.c_str());
    return problem.empty() ? 0 : 1;
  }
  std::printf("FAIL there is no %s\n", filter_name);
  return 1;
}

}  // namespace
}  // namespace harness

int main(int argc, char** argv) {
  QCoreApplication application(argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: cancel_harness PLUGIN_FILE\n");
    return 2;
  }
  try {
    harness::Plugin plugin(QString::fromLocal8Bit(argv[1]));
    const int failures =
        harness::RunAll(plugin, false) + harness::RunAll(plugin, true) +
        harness::RunOne(plugin, "D-Charts: Texture Atlas", "deleted elements", harness::DifferenceByDeleted) +
        harness::RunOne(plugin, "D-Charts: Cut", "without memory", harness::ChangeWithoutMemory);
    return failures == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::printf("FAIL %s\n", error.what());
    return 1;
  }
}
