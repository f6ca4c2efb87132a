// SPDX-License-Identifier: GPL-3.0-or-later
/// Every filter is run again and again; each time another allocation fails. It must end with the sentence
/// that says so, or do without; nothing may end the program. Afterwards everything still works.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "failing_memory.h"
#include "runner.h"
#include "shapes.h"
#include "thread_count.h"

namespace dcharts {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  std::string sentence;  ///< empty: it came to its end
  SurfaceChange change;
};

bool operator==(const Outcome& a, const Outcome& b) {
  return a.sentence == b.sentence && a.change.chart_ids == b.change.chart_ids &&
         a.change.wedge_texcoords == b.change.wedge_texcoords && a.change.seams == b.change.seams &&
         a.change.pieces.vertices == b.change.pieces.vertices;
}

// `failing`: see StartCounting; becomes the number of allocations.
Outcome Run(const FilterSpec& filter, const SurfaceData& mesh, const Params& params, long& failing) {
  Outcome outcome;
  Progress progress;
  test::StartCounting(failing);
  try {
    outcome.change = RunFilter(filter, &mesh, params, progress);
  } catch (const Error& error) {
    test::StopCounting();
    outcome.sentence = error.what();
  }
  failing = test::StopCounting();
  return outcome;
}

// Which allocations fail: the first ones, and then more and more seldom.
std::vector<long> Chosen(long count, int runs) {
  std::vector<long> chosen;
  double at = 1;
  const double factor = std::pow(static_cast<double>(count), 1.0 / runs);
  for (int k = 0; k < runs / 2; ++k, at = std::max(at + 1, at * factor * factor))
    chosen.push_back(static_cast<long>(at));
  for (int k = 0; k < runs / 2; ++k) chosen.push_back(1 + count * k / (runs / 2));
  return chosen;
}

// Says what is wrong.
std::string Wrong(const FilterSpec& filter, const SurfaceData& mesh, const Params& params,
                  const fs::path& folder, int runs) {
  const auto files = [&] { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); };
  long count = 0;
  const Outcome expected = Run(filter, mesh, params, count);
  if (!expected.sentence.empty()) return expected.sentence;
  int refused = 0;
  for (long at : Chosen(count, runs)) {
    if (!params.output_file.empty()) fs::remove(params.output_file);
    long failing = at;
    const Outcome outcome = Run(filter, mesh, params, failing);
    if (outcome == expected) continue;
    const std::string where = "allocation " + std::to_string(at) + ": ";
    if (outcome.sentence.empty()) return where + "another result";
    if (outcome.sentence.find("not enough free memory") == std::string::npos) return where + outcome.sentence;
    if (files() != 0) return where + "a file is left";
    ++refused;
  }
  if (!params.output_file.empty()) fs::remove(params.output_file);
  if (refused < runs / 2) return "only " + std::to_string(refused) + " runs found no memory";
  count = 0;
  const bool works = Run(filter, mesh, params, count) == expected;
  if (!params.output_file.empty()) fs::remove(params.output_file);
  return works ? "" : "another result afterwards";
}

int RunAll(const fs::path& folder) {
  constexpr int kRuns = 60;
  const SurfaceData mesh = shapes::Torus(8);
  int failures = 0;
  for (const FilterSpec& filter : AllFilters())
    for (const char* ending : {"", ".svg", ".pdf", ".dxf"}) {
      const bool is_pattern = filter.id == FilterId::kPattern;
      if (!is_pattern && *ending != '\0') continue;
      Params params;
      params.size = 300;
      params.print_texture = is_pattern && *ending != '\0';
      if (*ending != '\0') params.output_file = (folder / ("pattern" + std::string(ending))).u8string();
      for (int threads : {1, 2}) {
        const test::Threads some(threads);
        const std::string wrong = Wrong(filter, mesh, params, folder, kRuns);
        failures += wrong.empty() ? 0 : 1;
        std::printf("%s %s%s on %d: %s\n", wrong.empty() ? "ok  " : "FAIL", filter.name, ending, threads,
                    wrong.c_str());
        std::fflush(stdout);
      }
    }
  return failures;
}

}  // namespace
}  // namespace dcharts

int main() {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "dcharts_out_of_memory";
  fs::remove_all(folder);
  fs::create_directory(folder);
  const int failures = dcharts::RunAll(folder);
  fs::remove_all(folder);
  return failures == 0 ? 0 : 1;
}
