// SPDX-License-Identifier: GPL-3.0-or-later
#include "mutations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "random_meshes.h"

namespace dcharts::fuzz {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d At(const SurfaceData& mesh, int v) { return Eigen::Vector3d(mesh.vertices[v].data()); }
void Move(SurfaceData& mesh, int v, const Eigen::Vector3d& p) { mesh.vertices[v] = {p.x(), p.y(), p.z()}; }
int Add(SurfaceData& mesh, const Eigen::Vector3d& p) {
  mesh.vertices.push_back({p.x(), p.y(), p.z()});
  return static_cast<int>(mesh.vertices.size()) - 1;
}
int AnyVertex(Random& random, const SurfaceData& mesh) {
  return static_cast<int>(random.Index(mesh.vertices.size()));
}
std::size_t AnyFace(Random& random, const SurfaceData& mesh) { return random.Index(mesh.faces.size()); }
// One, some or many of the faces.
double Share(Random& random) { return random.Log(0.005, 1); }

void FlipFaces(Random& random, SurfaceData& mesh) {
  const double share = Share(random);
  for (auto& face : mesh.faces)
    if (random.Chance(share)) std::swap(face[1], face[2]);
}

void DoubleFaces(Random& random, SurfaceData& mesh) {
  const double share = Share(random);
  const std::size_t count = mesh.faces.size();
  for (std::size_t f = 0; f < count; ++f) {
    if (!random.Chance(share)) continue;
    std::array<int, 3> face = mesh.faces[f];
    if (random.Chance(0.5)) std::swap(face[0], face[1]);
    mesh.faces.push_back(face);
  }
}

void TakeFacesAway(Random& random, SurfaceData& mesh) {
  const double share = Share(random);
  std::vector<std::array<int, 3>> kept;
  for (const auto& face : mesh.faces)
    if (!random.Chance(share)) kept.push_back(face);
  if (!kept.empty()) mesh.faces = kept;
}

void RepeatVertices(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(1, 4); n > 0; --n) {
    const auto face = mesh.faces[AnyFace(random, mesh)];
    mesh.faces.insert(mesh.faces.begin() + static_cast<std::ptrdiff_t>(AnyFace(random, mesh)),
                      {face[0], face[random.Index(2)], face[0]});
  }
}

void AddFins(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(1, 4); n > 0; --n) {
    const auto face = mesh.faces[AnyFace(random, mesh)];
    const std::size_t k = random.Index(3);
    const int a = face[k], b = face[(k + 1) % 3];
    for (int more = random.Int(1, 2); more > 0; --more) {
      const int tip = Add(mesh, At(mesh, a) + random.Vector());
      mesh.faces.push_back({a, b, tip});
    }
  }
}

void AddFacesAtRandom(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(1, 5); n > 0; --n)
    mesh.faces.push_back({AnyVertex(random, mesh), AnyVertex(random, mesh), AnyVertex(random, mesh)});
}

// Bow-ties, pinched tubes, folds on themselves.
void JoinVertices(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(1, 4); n > 0; --n) {
    const int from = AnyVertex(random, mesh), to = AnyVertex(random, mesh);
    for (auto& face : mesh.faces) std::replace(face.begin(), face.end(), from, to);
  }
}

void PutVerticesTogether(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(1, 6); n > 0; --n)
    mesh.vertices[AnyVertex(random, mesh)] = mesh.vertices[AnyVertex(random, mesh)];
}

void MakeNeedles(Random& random, SurfaceData& mesh) {
  const double share = Share(random), height = random.Chance(0.3) ? 0 : random.Log(1e-18, 1e-3);
  for (const auto& face : mesh.faces) {
    if (!random.Chance(share)) continue;
    const std::size_t k = random.Index(3);
    const int a = face[k], b = face[(k + 1) % 3], c = face[(k + 2) % 3];
    const double along = random.Chance(0.3) ? 0 : random.Real(0, 1);
    Move(mesh, a, At(mesh, b) + along * (At(mesh, c) - At(mesh, b)) + height * random.Vector());
  }
}

void MakeSpikes(Random& random, SurfaceData& mesh) {
  const double length = random.Log(1, 1e4);
  for (int n = random.Int(1, 4); n > 0; --n) {
    const int v = AnyVertex(random, mesh);
    Move(mesh, v, At(mesh, v) + length * random.Vector());
  }
}

void Shake(Random& random, SurfaceData& mesh) {
  const double by = random.Log(1e-12, 1);
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v)
    Move(mesh, v, At(mesh, v) + by * random.Vector());
}

void TearApart(Random& random, SurfaceData& mesh) {
  const double share = Share(random);
  for (auto& face : mesh.faces)
    for (int& v : face)
      if (random.Chance(share)) v = Add(mesh, At(mesh, v));
}

void AddUnreferenced(Random& random, SurfaceData& mesh) {
  for (int n = random.Int(1, 5); n > 0; --n) {
    constexpr double kOdd[] = {kNan, kInfinity, 1e300, 0};
    Add(mesh, random.Chance(0.5) ? Eigen::Vector3d::Constant(random.Of(kOdd)) : random.Vector());
  }
}

void SetNotFinite(Random& random, SurfaceData& mesh) {
  constexpr double kOdd[] = {kNan, kInfinity, -kInfinity};
  mesh.vertices[AnyVertex(random, mesh)][random.Index(3)] = random.Of(kOdd);
}

void AddShape(Random& random, SurfaceData& mesh) {
  std::string name;
  const SurfaceData other = RandomShape(random, static_cast<int>(random.Log(1, 60)), name);
  const double scale = random.Chance(0.5) ? 1 : random.Log(1e-6, 1e3);
  const Eigen::Vector3d offset =
      random.Chance(0.3) ? Eigen::Vector3d(0, 0, 0) : random.Log(0.1, 1e4) * random.Vector();
  const int first = static_cast<int>(mesh.vertices.size());
  for (const auto& p : other.vertices) Add(mesh, scale * Eigen::Vector3d(p.data()) + offset);
  for (const auto& face : other.faces)
    mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
}

void AddShrunkCopy(Random& random, SurfaceData& mesh) {
  const double scale = random.Real(-0.9, 0.99);  // below 0: mirrored
  const int first = static_cast<int>(mesh.vertices.size());
  for (int v = 0; v < first; ++v) Add(mesh, scale * At(mesh, v));
  const std::size_t count = mesh.faces.size();
  for (std::size_t f = 0; f < count; ++f) {
    const auto face = mesh.faces[f];
    mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
  }
}

void Squeeze(Random& random, SurfaceData& mesh) {
  const std::size_t d = random.Index(3);
  const double by = random.Chance(0.3) ? 0 : random.Log(1e-12, 1e3);
  for (auto& p : mesh.vertices) p[d] *= by;
}

void Scale(Random& random, SurfaceData& mesh) {
  const double by = random.Log(1e-20, 1e20);
  for (auto& p : mesh.vertices)
    for (double& x : p) x *= by;
}

void MoveFarAway(Random& random, SurfaceData& mesh) {
  const Eigen::Vector3d by = 1e6 * random.Vector();
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) Move(mesh, v, At(mesh, v) + by);
}

void RoundToFloat(Random&, SurfaceData& mesh) {
  for (auto& p : mesh.vertices)
    for (double& x : p)
      if (std::abs(x) < 1e38) x = static_cast<float>(x);
}

void Reorder(Random& random, SurfaceData& mesh) {
  for (std::size_t f = mesh.faces.size() - 1; f > 0; --f)
    std::swap(mesh.faces[f], mesh.faces[random.Index(f + 1)]);
  for (auto& face : mesh.faces) std::rotate(face.begin(), face.begin() + random.Int(0, 2), face.end());
}

void NameNoVertex(Random& random, SurfaceData& mesh) {
  const int beyond = static_cast<int>(mesh.vertices.size());
  const int odd[] = {-1, beyond, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
  mesh.faces[AnyFace(random, mesh)][random.Index(3)] = random.Of(odd);
}

struct Mutation {
  const char* name;
  void (*apply)(Random&, SurfaceData&);
  int weight;
};

constexpr Mutation kMutations[] = {{"flipped faces", FlipFaces, 3},
                                   {"double faces", DoubleFaces, 3},
                                   {"faces taken away", TakeFacesAway, 4},
                                   {"repeated vertices", RepeatVertices, 2},
                                   {"fins", AddFins, 3},
                                   {"faces at random", AddFacesAtRandom, 3},
                                   {"joined vertices", JoinVertices, 3},
                                   {"coincident vertices", PutVerticesTogether, 3},
                                   {"needles", MakeNeedles, 4},
                                   {"spikes", MakeSpikes, 2},
                                   {"shaken", Shake, 3},
                                   {"torn apart", TearApart, 2},
                                   {"unreferenced", AddUnreferenced, 2},
                                   {"not finite", SetNotFinite, 1},
                                   {"another shape", AddShape, 4},
                                   {"shrunk copy", AddShrunkCopy, 2},
                                   {"squeezed", Squeeze, 2},
                                   {"scaled", Scale, 3},
                                   {"far away", MoveFarAway, 2},
                                   {"floats", RoundToFloat, 6},
                                   {"reordered", Reorder, 2},
                                   {"no such vertex", NameNoVertex, 1}};

}  // namespace

void Mutate(Random& random, SurfaceData& mesh, std::string& name) {
  constexpr std::size_t kMost = 300;  // faces; more would take the time of other cases
  if (mesh.faces.empty() || mesh.faces.size() > kMost) return;
  const int total = std::accumulate(std::begin(kMutations), std::end(kMutations), 0,
                                    [](int sum, const Mutation& m) { return sum + m.weight; });
  int pick = random.Int(0, total - 1);
  for (const Mutation& mutation : kMutations) {
    pick -= mutation.weight;
    if (pick >= 0) continue;
    // What names no vertex can't be looked at by the others.
    if (name.find("no such vertex") != std::string::npos) return;
    mutation.apply(random, mesh);
    name += std::string(", ") + mutation.name;
    return;
  }
}

}  // namespace dcharts::fuzz
