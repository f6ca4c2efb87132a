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
  // The one that does everything is called more often, the one that takes most of the time less.
  constexpr FilterId kFilters[] = {
      FilterId::kSegment,      FilterId::kSegment,      FilterId::kFill,         FilterId::kFill,
      FilterId::kStraighten,   FilterId::kStraighten,   FilterId::kMerge,        FilterId::kMerge,
      FilterId::kCut,          FilterId::kCut,          FilterId::kParameterize, FilterId::kParameterize,
      FilterId::kTextureAtlas, FilterId::kTextureAtlas, FilterId::kTextureAtlas, FilterId::kTextureAtlas,
      FilterId::kPattern,      FilterId::kMeasure,      FilterId::kMeasure};
  made.filter = &GetFilter(random.Of(kFilters));
  // Small ones find most and are quick.
  const double kind = random.Real(0, 1);
  const double most = kind < 0.9 ? 16 : kind < 0.99 ? 60 : 400;
  made.mesh = RandomShape(random, static_cast<int>(random.Log(1, most)), made.shape);
  for (int mutations = random.Int(0, 4); mutations > 0; --mutations) Mutate(random, made.mesh, made.shape);
  AddAttributes(random, made.mesh);
  made.params = RandomParams(random, *made.filter, made.changed_params);
  // Fine cells make packing slow.
  if (made.params.texture_size == Params().texture_size && random.Chance(0.9)) made.params.texture_size = 128;
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
    // Pictures of the model, which DXF has not, are slow.
    constexpr const char* kFiles[] = {"", "pattern.dxf"};
    made.params.output_file =
        random.Chance(0.03) ? (random.Chance(0.5) ? "pattern.svg" : "pattern.pdf") : random.Of(kFiles);
  }
  return made;
}

}  // namespace dcharts::fuzz
