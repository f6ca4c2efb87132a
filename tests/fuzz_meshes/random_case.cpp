// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_case.h"

#include "mutations.h"
#include "random.h"
#include "random_input.h"
#include "random_meshes.h"

namespace dcharts::fuzz {

RandomCase MakeRandomCase(std::uint64_t seed, std::uint64_t number) {
  // Neighbouring numbers must give unlike engines: the finalizer of SplitMix64.
  std::uint64_t mixed = seed * 0x9e3779b97f4a7c15 + number;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  Random random(mixed ^ (mixed >> 31));

  RandomCase made;
  // The two that do everything are called more often.
  constexpr FilterId kFilters[] = {FilterId::kSegment,      FilterId::kFill,         FilterId::kStraighten,
                                   FilterId::kMerge,        FilterId::kCut,          FilterId::kParameterize,
                                   FilterId::kTextureAtlas, FilterId::kTextureAtlas, FilterId::kTextureAtlas,
                                   FilterId::kPattern,      FilterId::kPattern,      FilterId::kMeasure};
  made.filter = &GetFilter(random.Of(kFilters));
  // Small ones find most and are quick.
  made.mesh = RandomShape(random, static_cast<int>(random.Log(1, random.Chance(0.8) ? 40 : 400)), made.shape);
  for (int mutations = random.Int(0, 4); mutations > 0; --mutations) Mutate(random, made.mesh, made.shape);
  AddAttributes(random, made.mesh);
  made.params = RandomParams(random, *made.filter, made.changed_params);
  if (random.Chance(0.05)) {
    made.also = Also::kCancel;
    made.cancel_at = static_cast<int>(random.Log(1, 200));
  } else if (random.Chance(0.03)) {
    made.also = Also::kAgain;
  } else if (made.filter->id == FilterId::kTextureAtlas && random.Chance(0.1)) {
    made.also = Also::kStageByStage;
  }
  if (made.filter->id == FilterId::kPattern) {
    // Meshes have any size, most patterns are to be of a size that can be made.
    if (!(made.params.size > 0) && random.Chance(0.9)) made.params.size = random.Log(20, 2000);
    constexpr const char* kFiles[] = {"", "", "pattern.svg", "pattern.pdf", "pattern.dxf"};
    made.params.output_file = random.Of(kFiles);
  }
  return made;
}

}  // namespace dcharts::fuzz
