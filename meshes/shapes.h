// SPDX-License-Identifier: GPL-3.0-or-later
/// Test shapes with known facts. Every function returns vertices and faces only; faces are counter-clockwise
/// seen from outside (or from +z, for a sheet). All shapes are about 1 to 3 units in size, and made of well
/// shaped triangles, none degenerate. Throws std::invalid_argument when a count is below its stated minimum.
#pragma once

#include <string>
#include <vector>

#include "common/surface_data.h"

namespace dcharts::shapes {

/// Does the smooth shape flatten without stretch?
enum class Developable {
  kYes,        ///< in one piece, after at most a cut that opens it (plane, cylinder, cone)
  kPiecewise,  ///< each smooth face of it does (closed cylinder, cube)
  kNo
};

/// What is known of a shape without measuring it.
struct ShapeFacts {
  int components = 1;         ///< joined by shared vertices
  int genus = 0;              ///< number of handles; 0 for the Moebius strip, which has none
  int boundary_loops = 0;     ///< closed walks along edges with one face
  int euler = 2;              ///< vertices - edges + faces
  bool orientable = true;     ///< false: faces can't all agree in orientation
  bool manifold = true;       ///< false: an edge with three faces, or a vertex with two fans
  double area = 0;            ///< of the smooth shape
  double area_tolerance = 0;  ///< relative difference allowed to the mesh at its default resolution
  Developable developable = Developable::kNo;
};

struct Shape {
  std::string name;  ///< snake_case, also the file name
  std::string description;
  SurfaceData mesh;  ///< at the default resolution
  ShapeFacts facts;
};

/// All shapes below at their default resolution.
std::vector<Shape> AllShapes();
/// One of them. Throws std::invalid_argument for an unknown name.
Shape ShapeByName(const std::string& name);

// --- sheets
/// Unit square in z = 0 of n by m cells, two triangles each; n, m >= 1.
SurfaceData Grid(int n = 20, int m = 20);
/// Disk of radius 1 in z = 0 of `rings` rings of triangles; its rim is a polygon of 6 * rings corners; rings
/// >= 1.
SurfaceData Disk(int rings = 12);
/// Unit square in z = 0 with a round hole of radius 1/4 (a polygon of 4 * n corners) in its middle; edges of
/// about 1/n; n >= 8.
SurfaceData PlaneWithHole(int n = 24);
/// Part of the unit sphere within `angle` (radians, 0 < angle < pi) of the pole +z; rings >= 2.
SurfaceData SphericalCap(int rings = 12, double angle = 1.0);
/// z = (x^2 - y^2) / 2 over [-1, 1]^2, n by n cells; n >= 2.
SurfaceData SaddleRidge(int n = 24);
/// Strip with one half twist around the unit circle, 0.6 wide; the orientation of its faces jumps along one
/// line. n cells around, n >= 12.
SurfaceData MoebiusStrip(int n = 72);

// --- cylinders and cones: prisms and pyramids of n sides, whose flat sides make them exactly developable
/// Radius 1/2, height 1, without caps; n >= 3.
SurfaceData OpenCylinder(int n = 48);
/// The same with flat caps.
SurfaceData ClosedCylinder(int n = 48);
/// Frustum without caps: radius 1 at z = 0, radius 1/2 at z = 1; n >= 3.
SurfaceData OpenFrustum(int n = 48);
/// Cone with apex, without base: radius 1/2 at z = 0, apex at z = 1; n >= 3.
SurfaceData OpenCone(int n = 48);
/// The same with its base.
SurfaceData ClosedCone(int n = 48);

// --- closed surfaces
/// Unit cube, n by n cells on each side; n >= 1.
SurfaceData Cube(int n = 10);
/// Unit sphere: an icosahedron whose faces are split in n * n; n >= 1.
SurfaceData Sphere(int n = 12);
/// Tube of radius 0.4 around the unit circle in z = 0; n cells around the tube (n >= 6), about 2.5 n along
/// it.
SurfaceData Torus(int n = 24);
/// Two smoothly joined tori side by side, genus 2; `n` cells of the sampling grid over its length, n >= 32.
SurfaceData DoubleTorus(int n = 48);
/// A machined part: a plate with rounded corners (convex and concave), a rounded upper edge, a boss with a
/// bore and a fillet at its foot, and two bolt holes. Genus 3. n edges over the plate's length of 2 units, n
/// >= 24.
SurfaceData CadPart(int n = 48);
/// A teddy bear, 2 units high, genus 0. n cells of the sampling grid over its height, n >= 32.
SurfaceData Plush(int n = 40);
/// A chess bishop with a slit in its head, 2 units high, genus 0. n cells of the sampling grid over its
/// height, n >= 48.
SurfaceData Bishop(int n = 48);

// --- nasty ones
/// A sphere and a cube, apart from each other.
SurfaceData TwoComponents(int n = 6);
/// Two square sheets that share one vertex only.
SurfaceData BowTie(int n = 6);
/// Three square sheets that meet in one edge line, like a fin on a plate: edges with three faces.
SurfaceData NonManifoldFin(int n = 8);

}  // namespace dcharts::shapes
