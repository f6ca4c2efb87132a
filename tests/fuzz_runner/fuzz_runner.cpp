// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer on the filter runner: bytes become a filter, its parameters and a mesh; the result is checked
// like those of fuzz_meshes. A broken promise prints what is wrong and aborts, so that libFuzzer keeps the
// bytes.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "case_from_bytes.h"
#include "run_case.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const dcharts::fuzz::RandomCase made = dcharts::fuzz::CaseFromBytes(data, size);
  const dcharts::fuzz::Outcome outcome = dcharts::fuzz::RunCase(made);
  if (outcome.wrong.empty()) return 0;
  std::fprintf(stderr, "%s of %zu faces (%s) %s\n  %s", made.filter->python_name, made.mesh.faces.size(),
               made.shape.c_str(), made.changed_params.c_str(), outcome.wrong.c_str());
  std::abort();
}
