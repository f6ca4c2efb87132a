// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ostream>

#include "shapes.h"

namespace dcharts::test {

/// A shape, coarse enough to be run many times.
struct Coarse {
  const char* name;
  SurfaceData (*make)();
};
inline std::ostream& operator<<(std::ostream& out, const Coarse& shape) { return out << shape.name; }

inline const Coarse kCoarse[] = {
    {"grid", [] { return shapes::Grid(8, 6); }},
    {"disk", [] { return shapes::Disk(5); }},
    {"plane_with_hole", [] { return shapes::PlaneWithHole(10); }},
    {"spherical_cap", [] { return shapes::SphericalCap(6, 1.4); }},
    {"saddle_ridge", [] { return shapes::SaddleRidge(10); }},
    {"moebius_strip", [] { return shapes::MoebiusStrip(30); }},
    {"cylinder", [] { return shapes::OpenCylinder(16); }},
    {"closed_cylinder", [] { return shapes::ClosedCylinder(16); }},
    {"frustum", [] { return shapes::OpenFrustum(16); }},
    {"open_cone", [] { return shapes::OpenCone(16); }},
    {"closed_cone", [] { return shapes::ClosedCone(16); }},
    {"cube", [] { return shapes::Cube(4); }},
    {"sphere", [] { return shapes::Sphere(5); }},
    {"torus", [] { return shapes::Torus(10); }},
    {"double_torus", [] { return shapes::DoubleTorus(32); }},
    {"cad_part", [] { return shapes::CadPart(24); }},
    {"plush", [] { return shapes::Plush(32); }},
    {"two_components", [] { return shapes::TwoComponents(3); }},
    {"bow_tie", [] { return shapes::BowTie(4); }},
    {"non_manifold_fin", [] { return shapes::NonManifoldFin(4); }},
};

}  // namespace dcharts::test
