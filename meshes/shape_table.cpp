// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/pi.h"
#include "shapes.h"

namespace dcharts::shapes {
namespace {

constexpr double kExact = 1e-12;

ShapeFacts Sheet(int boundary_loops, int euler, double area, double tolerance, Developable developable) {
  ShapeFacts facts;
  facts.boundary_loops = boundary_loops;
  facts.euler = euler;
  facts.area = area;
  facts.area_tolerance = tolerance;
  facts.developable = developable;
  return facts;
}

ShapeFacts Closed(int genus, double area, double tolerance, Developable developable) {
  ShapeFacts facts = Sheet(0, 2 - 2 * genus, area, tolerance, developable);
  facts.genus = genus;
  return facts;
}

}  // namespace

std::vector<Shape> AllShapes() {
  const double side_of_cone = kPi * 0.5 * std::sqrt(1.25);
  std::vector<Shape> shapes;
  const auto add = [&](const char* name, const char* description, SurfaceData mesh, const ShapeFacts& facts) {
    shapes.push_back({name, description, std::move(mesh), facts});
  };
  add("grid", "unit square", Grid(), Sheet(1, 1, 1, kExact, Developable::kYes));
  add("disk", "flat disk", Disk(), Sheet(1, 1, kPi, 0.01, Developable::kYes));
  add("plane_with_hole", "unit square with a round hole", PlaneWithHole(),
      Sheet(2, 0, 1 - kPi / 16, 0.001, Developable::kYes));
  add("spherical_cap", "part of a sphere", SphericalCap(),
      Sheet(1, 1, 2 * kPi * (1 - std::cos(1.0)), 0.01, Developable::kNo));
  // Integral of sqrt(1 + x^2 + y^2) over [-1, 1]^2.
  add("saddle_ridge", "hyperbolic paraboloid", SaddleRidge(), Sheet(1, 1, 5.12316, 0.005, Developable::kNo));
  // Integral of |dS/du x dS/dv| over the strip, by quadrature.
  ShapeFacts moebius = Sheet(1, 0, 3.78439, 0.005, Developable::kNo);
  moebius.orientable = false;
  add("moebius_strip", "band with one half twist", MoebiusStrip(), moebius);
  add("cylinder", "cylinder without caps", OpenCylinder(), Sheet(2, 0, kPi, 0.002, Developable::kYes));
  add("closed_cylinder", "cylinder with caps", ClosedCylinder(),
      Closed(0, 1.5 * kPi, 0.005, Developable::kPiecewise));
  add("frustum", "cone without tip and base", OpenFrustum(),
      Sheet(2, 0, 1.5 * kPi * std::sqrt(1.25), 0.005, Developable::kYes));
  add("open_cone", "cone with apex, without base", OpenCone(),
      Sheet(1, 1, side_of_cone, 0.005, Developable::kYes));
  add("closed_cone", "cone with apex and base", ClosedCone(),
      Closed(0, side_of_cone + kPi / 4, 0.005, Developable::kPiecewise));
  add("cube", "unit cube", Cube(), Closed(0, 6, kExact, Developable::kPiecewise));
  add("sphere", "unit sphere", Sphere(), Closed(0, 4 * kPi, 0.01, Developable::kNo));
  add("torus", "ring", Torus(), Closed(1, 4 * kPi * kPi * 0.4, 0.01, Developable::kNo));
  // The areas of the next four are those of meshes with sixteen times as many faces.
  add("double_torus", "two joined rings", DoubleTorus(), Closed(2, 11.179, 0.01, Developable::kNo));
  add("cad_part", "machined part with bore, boss, bolt holes and fillets", CadPart(),
      Closed(3, 7.539, 0.01, Developable::kNo));
  add("plush", "teddy bear", Plush(), Closed(0, 7.375, 0.01, Developable::kNo));
  add("bishop", "chess bishop with a slit in its head", Bishop(), Closed(0, 4.236, 0.015, Developable::kNo));
  ShapeFacts two = Closed(0, 4 * kPi + 6, 0.02, Developable::kNo);
  two.components = 2;
  two.euler = 4;
  add("two_components", "a sphere and a cube", TwoComponents(), two);
  ShapeFacts bow_tie = Sheet(1, 1, 2, kExact, Developable::kYes);
  bow_tie.manifold = false;
  add("bow_tie", "two squares that share a vertex", BowTie(), bow_tie);
  ShapeFacts fin = Sheet(1, 1, 3, kExact, Developable::kPiecewise);
  fin.manifold = false;
  add("non_manifold_fin", "three squares that share a line", NonManifoldFin(), fin);
  return shapes;
}

Shape ShapeByName(const std::string& name) {
  for (Shape& shape : AllShapes())
    if (shape.name == name) return std::move(shape);
  throw std::invalid_argument("There is no shape named " + name + ".");
}

}  // namespace dcharts::shapes
