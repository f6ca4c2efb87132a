// SPDX-License-Identifier: GPL-3.0-or-later
#include "without_memory.h"

#include "failing_memory.h"
#include "snapshot.h"
#include "test_mesh.h"

namespace harness {
namespace {

// vcg's callback is a plain function, so its state is global.
int g_calls = 0;
int g_last = 0;  // 0: not known yet
long g_failing = 0;

bool Callback(const int /*percent*/, const char* /*text*/) {
  if (++g_calls == g_last) dcharts::test::StartCounting(g_failing);
  return true;
}

void AddBareMesh(MeshDocument& document) {
  AddTestMesh(document)->clearDataMask(MeshModel::MM_FACEQUALITY | MeshModel::MM_FACECOLOR |
                                       MeshModel::MM_WEDGTEXCOORD);
}

Outcome Run(Plugin& plugin, QAction* filter, MeshDocument& document) {
  RichParameterList parameters = plugin.Parameters(filter, document);
  parameters.setValue("seam_layer", BoolValue(true));
  g_calls = 0;
  return plugin.Apply(filter, parameters, document, &Callback);
}

}  // namespace

std::string ChangeWithoutMemory(Plugin& plugin, QAction* filter) {
  qputenv("OMP_NUM_THREADS", "1");  // with more, callbacks differ in number from run to run
  MeshDocument first;
  AddBareMesh(first);
  g_last = 0;
  if (!Run(plugin, filter, first).finished) return "the filter failed";
  g_last = g_calls;
  int refused = 0;
  for (g_failing = 1;; ++g_failing) {
    MeshDocument document;
    AddBareMesh(document);
    const Snapshot before = TakeSnapshot(document);
    const Outcome outcome = Run(plugin, filter, document);
    const long count = dcharts::test::StopCounting();
    if (outcome.finished && count < g_failing) break;
    if (outcome.finished) continue;
    const std::string where = "allocation " + std::to_string(g_failing) + ": ";
    if (outcome.message.find("not enough free memory") == std::string::npos) return where + outcome.message;
    const std::string difference = Difference(before, TakeSnapshot(document));
    if (!difference.empty()) return where + "changed: " + difference;
    ++refused;
  }
  return refused > 0 ? "" : "no run was without memory";
}

}  // namespace harness
