// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>

#include "planar/chart_mesh.h"
#include "planar/complex_plane.h"
#include "planar/stretch_energy.h"
#include "planar/vertex_block_system.h"
#include "planar/vertex_pull.h"

namespace dcharts {

enum class StepKind {
  kProjectedNewton,  ///< few steps once the map is fair
  kReweighted        ///< SLIM's, of the symmetric Dirichlet energy only: sure but slow
};

struct DescentOptions {
  StepKind step = StepKind::kProjectedNewton;
  int max_steps = 50;
  double tolerance = 1e-4;  ///< stop when a step can gain no more than this share of the energy
  double longest_step = 1;  ///< >= 1; Newton steps fall short on steep powers
  double enough = 0;        ///< stop when the energy has come down to this
  /// Stop before a step that could gain twice of what it promises and still be above this.
  double bound = std::numeric_limits<double>::infinity();
  const VertexPulls* pulls = nullptr;  ///< are part of the energy; may be null
};

/// Lowers the energy of `uv` without flipping a triangle and returns the energy reached. All areas must be
/// positive before; they are afterwards. `poll` is called once per step.
double Descend(const StretchEnergy& energy, const DescentOptions& options, const Triangles& triangles,
               const RestShapes& shapes, VertexBlockSystem& system, const std::function<void()>& poll,
               PlanePoints& uv);

}  // namespace dcharts
