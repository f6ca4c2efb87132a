// SPDX-License-Identifier: GPL-3.0-or-later
// Runs every filter on random meshes with random attributes and parameters and checks what is promised: see
// Usage. Prints a line for each failure, with what makes it again, and a table of what was refused.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include "random_case.h"
#include "run_case.h"

namespace {

using dcharts::fuzz::Outcome;
using dcharts::fuzz::RandomCase;

struct Options {
  unsigned long long seed = 1, first = 0, cases = 1000;
  double slow = 0, seconds = 0;
  std::string off_file;
};

[[noreturn]] void Usage() {
  std::fputs(
      "usage: fuzz_meshes [--seed N] [--cases N] [--first N] [--only N] [--seconds S] [--slow S] [--off "
      "FILE]\n"
      "  --cases N    cases to run, from --first N on; --only N is one of them\n"
      "  --seconds S  stop after this time\n"
      "  --slow S     a case that takes more seconds of processor time is a failure, one that takes a "
      "hundred "
      "times\n"
      "               as long on the clock ends the run\n"
      "  --off FILE   writes the mesh of the last case begun\n",
      stderr);
  std::exit(2);
}

Options ReadOptions(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; i += 2) {
    if (i + 1 >= count) Usage();
    const std::string name = arguments[i];
    const char* value = arguments[i + 1];
    const auto number = std::strtoull(value, nullptr, 10);
    if (name == "--seed") {
      options.seed = number;
    } else if (name == "--cases") {
      options.cases = number;
    } else if (name == "--first") {
      options.first = number;
    } else if (name == "--only") {
      options.first = number;
      options.cases = 1;
    } else if (name == "--seconds") {
      options.seconds = std::strtod(value, nullptr);
    } else if (name == "--slow") {
      options.slow = std::strtod(value, nullptr);
    } else if (name == "--off") {
      options.off_file = value;
    } else {
      Usage();
    }
  }
  return options;
}

void WriteOff(const dcharts::SurfaceData& mesh, const std::string& path) {
  std::ofstream out(path);
  out.precision(17);
  out << "OFF\n" << mesh.vertices.size() << " " << mesh.faces.size() << " 0\n";
  for (const auto& p : mesh.vertices) out << p[0] << " " << p[1] << " " << p[2] << "\n";
  for (const auto& face : mesh.faces) out << "3 " << face[0] << " " << face[1] << " " << face[2] << "\n";
}

// Of all threads.
double ProcessorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Ends the program when a case doesn't end. No thread of its own when there is no limit.
class Watchdog {
 public:
  explicit Watchdog(double limit) : limit_(limit) {
    if (limit > 0) thread_ = std::thread([this] { Watch(); });
  }
  ~Watchdog() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  void Begin(unsigned long long number) {
    number_ = number;
    since_ = Now();
  }

 private:
  void Watch() {
    while (!stop_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (since_ > 0 && Now() - since_ > limit_) {
        std::printf("case %llu does not end\n", number_.load());
        std::fflush(stdout);
        std::abort();
      }
    }
  }

  double limit_;
  std::atomic<bool> stop_{false};
  std::atomic<unsigned long long> number_{0};
  std::atomic<double> since_{0};
  std::thread thread_;
};

struct Tally {
  int cases = 0, refused = 0, failures = 0;
  double seconds = 0, slowest = 0;
  unsigned long long slowest_case = 0;
};

// Numbers and quoted names are left out, so that the same reason is counted once.
std::string Reason(const std::string& sentence) {
  std::string reason;
  bool quoted = false;
  for (char c : sentence) {
    if (c == '\'') quoted = !quoted;
    const bool digit = c >= '0' && c <= '9';
    if (quoted || (digit && !reason.empty() && reason.back() == '#')) continue;
    reason += digit ? '#' : c;
  }
  return reason;
}

}  // namespace

int main(int count, char** arguments) {
  const Options options = ReadOptions(count, arguments);
  std::map<std::string, Tally> tallies;
  std::map<std::string, int> reasons;
  const double start = Now();
  int failures = 0;
  // Pattern files go where nobody else writes.
  std::error_code error;
  const auto folder =
      std::filesystem::temp_directory_path() /
      ("fuzz_meshes_" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
  const std::string off_file =
      options.off_file.empty() ? "" : std::filesystem::absolute(options.off_file).string();
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  {
    Watchdog watchdog(100 * options.slow);
    for (unsigned long long number = options.first; number < options.first + options.cases; ++number) {
      if (options.seconds > 0 && Now() - start > options.seconds) break;
      const RandomCase what = dcharts::fuzz::MakeRandomCase(options.seed, number);
      if (!off_file.empty()) WriteOff(what.mesh, off_file);
      watchdog.Begin(number);
      const double began = ProcessorTime();
      Outcome outcome = dcharts::fuzz::RunCase(what);
      const double seconds = ProcessorTime() - began;
      if (options.slow > 0 && seconds > options.slow)
        outcome.wrong += "took " + std::to_string(seconds) + " s\n";
      Tally& tally = tallies[what.filter->python_name];
      ++tally.cases;
      tally.seconds += seconds;
      if (!outcome.refusal.empty()) {
        ++tally.refused;
        ++reasons[Reason(outcome.refusal)];
      }
      if (seconds > tally.slowest) {
        tally.slowest = seconds;
        tally.slowest_case = number;
      }
      if (outcome.wrong.empty()) continue;
      ++tally.failures;
      ++failures;
      std::printf("--seed %llu --only %llu: %s of %zu faces (%s) %s\n  %s", options.seed, number,
                  what.filter->python_name, what.mesh.faces.size(), what.shape.c_str(),
                  what.changed_params.c_str(), outcome.wrong.c_str());
      std::fflush(stdout);
    }
  }
  std::filesystem::current_path(std::filesystem::temp_directory_path());
  std::filesystem::remove_all(folder, error);
  for (const auto& [name, tally] : tallies)
    std::printf("%-22s %7d cases, %6d refused, %d failures, mean %.3f s, slowest %.2f s (case %llu)\n",
                name.c_str(), tally.cases, tally.refused, tally.failures, tally.seconds / tally.cases,
                tally.slowest, tally.slowest_case);
  for (const auto& [reason, times] : reasons) std::printf("%7d refused: %s\n", times, reason.c_str());
  return failures > 0 ? 1 : 0;
}
