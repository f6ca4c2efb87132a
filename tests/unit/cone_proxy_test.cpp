// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/cone_proxy.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "common/pi.h"

namespace dcharts {
namespace {

struct Patch {
  std::vector<double> areas;
  std::vector<Eigen::Vector3d> normals;

  NormalMoments Moments() const {
    NormalMoments moments;
    for (size_t k = 0; k < areas.size(); ++k) moments.Add(areas[k], normals[k]);
    return moments;
  }
  double MeanError(const ConeProxy& proxy) const {
    double sum = 0, area = 0;
    for (size_t k = 0; k < areas.size(); ++k) {
      sum += areas[k] * FittingError(proxy, normals[k]);
      area += areas[k];
    }
    return sum / area;
  }
  // The least error for this axis: the best cosine is the mean of N.n.
  double LeastErrorWithAxis(const Eigen::Vector3d& axis) const {
    double mean = 0, area = 0;
    for (size_t k = 0; k < areas.size(); ++k) {
      mean += areas[k] * axis.dot(normals[k]);
      area += areas[k];
    }
    return MeanError({axis, mean / area});
  }
};

// Normals at `angle` from `axis`, all around or along a part of the circle, with unequal areas.
Patch ConePatch(const Eigen::Vector3d& axis, double angle, int count, double part = 1) {
  const Eigen::Vector3d n = axis.normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  Patch patch;
  for (int k = 0; k < count; ++k) {
    const double phi = 2 * kPi * part * k / count;
    patch.normals.push_back(std::cos(angle) * n + std::sin(angle) * (std::cos(phi) * u + std::sin(phi) * v));
    patch.areas.push_back(1 + k % 3);
  }
  return patch;
}

Eigen::Vector3d RandomUnit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Patch RandomPatch(unsigned seed, int count, double spread) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> area(0.1, 2);
  const Eigen::Vector3d middle = RandomUnit(random);
  Patch patch;
  for (int k = 0; k < count; ++k) {
    patch.normals.push_back((middle + spread * RandomUnit(random)).normalized());
    patch.areas.push_back(area(random));
  }
  return patch;
}

TEST(ConeProxy, FittingErrorIsEquationOne) {
  const ConeProxy proxy{Eigen::Vector3d::UnitZ(), 0.25};
  EXPECT_DOUBLE_EQ(FittingError(proxy, Eigen::Vector3d::UnitZ()), 0.75 * 0.75);
  EXPECT_DOUBLE_EQ(FittingError(proxy, Eigen::Vector3d::UnitX()), 0.25 * 0.25);
  EXPECT_DOUBLE_EQ(FittingError({Eigen::Vector3d::UnitZ(), -1}, Eigen::Vector3d::UnitZ()), 4);
}

TEST(ConeProxy, FaceWithoutAreaFitsEverything) {
  EXPECT_EQ(FittingError({Eigen::Vector3d::UnitZ(), 1}, Eigen::Vector3d::Zero()), 0);
}

TEST(ConeProxy, PlaneHasItsNormalAsAxis) {
  Patch patch;
  const Eigen::Vector3d normal = Eigen::Vector3d(1, -2, 0.5).normalized();
  for (int k = 0; k < 5; ++k) {
    patch.areas.push_back(k + 0.5);
    patch.normals.push_back(normal);
  }
  double error = -1;
  const ConeProxy proxy = FitCone(patch.Moments(), &error);
  EXPECT_NEAR(proxy.axis.dot(normal), 1, 1e-12);
  EXPECT_NEAR(proxy.cos_angle, 1, 1e-12);
  EXPECT_NEAR(error, 0, 1e-12);
}

TEST(ConeProxy, OneFaceIsAPlane) {
  NormalMoments moments;
  moments.Add(1e-9, Eigen::Vector3d::UnitY());
  EXPECT_NEAR(FittingError(FitCone(moments), Eigen::Vector3d::UnitY()), 0, 1e-12);
  EXPECT_NEAR(FittingError(FitCone(moments), Eigen::Vector3d::UnitX()), 1, 1e-9);
}

TEST(ConeProxy, CylinderHasItsAxisAndARightAngle) {
  for (double part : {1.0, 0.5, 0.1}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 1, -0.7).normalized();
    const Patch patch = ConePatch(axis, kPi / 2, 24, part);
    double error = -1;
    const ConeProxy proxy = FitCone(patch.Moments(), &error);
    EXPECT_NEAR(std::abs(proxy.axis.dot(axis)), 1, 1e-9) << part;
    EXPECT_NEAR(proxy.cos_angle, 0, 1e-7) << part;
    EXPECT_NEAR(error, 0, 1e-12) << part;
    for (const auto& n : patch.normals) EXPECT_NEAR(FittingError(proxy, n), 0, 1e-12);
  }
}

TEST(ConeProxy, ConeHasItsAxisAndAngle) {
  for (double angle : {0.2, 0.8, 1.3, 2.0}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(-1, 0.2, 0.4).normalized();
    double error = -1;
    const ConeProxy proxy = FitCone(ConePatch(axis, angle, 40, 0.7).Moments(), &error);
    // The axis may point either way; the angle goes with it.
    EXPECT_NEAR(std::abs(proxy.axis.dot(axis)), 1, 1e-9) << angle;
    EXPECT_NEAR(proxy.cos_angle * (proxy.axis.dot(axis) > 0 ? 1 : -1), std::cos(angle), 1e-9) << angle;
    EXPECT_NEAR(error, 0, 1e-12) << angle;
  }
}

TEST(ConeProxy, TwoPlanesAreACylinder) {
  Patch patch;
  patch.areas = {1, 1};
  patch.normals = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const ConeProxy proxy = FitCone(patch.Moments());
  EXPECT_NEAR(FittingError(proxy, patch.normals[0]), 0, 1e-12);
  EXPECT_NEAR(FittingError(proxy, patch.normals[1]), 0, 1e-12);
}

// On a whole sphere every axis is as good: the mean of (N.n)^2 is 1/3.
TEST(ConeProxy, SphereHasErrorOneThird) {
  Patch patch;
  const int rings = 60;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 60; ++j) {
      const double theta = kPi * (i + 0.5) / rings, phi = 2 * kPi * j / 60;
      patch.normals.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      patch.areas.push_back(std::sin(theta));
    }
  double error = -1;
  FitCone(patch.Moments(), &error);
  EXPECT_NEAR(error, 1.0 / 3, 1e-3);
  EXPECT_NEAR(CylinderError(patch.Moments()), 1.0 / 3, 1e-3);
}

TEST(ConeProxy, MomentsAreAdditive) {
  const Patch patch = RandomPatch(5, 40, 0.8);
  NormalMoments left, right;
  for (size_t k = 0; k < patch.areas.size(); ++k)
    (k % 3 == 0 ? left : right).Add(patch.areas[k], patch.normals[k]);
  left.Add(right);
  const NormalMoments whole = patch.Moments();
  EXPECT_NEAR(left.area, whole.area, 1e-12);
  EXPECT_LT((left.first - whole.first).norm(), 1e-12);
  EXPECT_LT((left.second - whole.second).norm(), 1e-12);
}

TEST(ConeProxy, ReportedErrorIsTheMeanFittingError) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Patch patch = RandomPatch(seed, 30, 0.1 + 0.1 * seed);
    double error = -1;
    const ConeProxy proxy = FitCone(patch.Moments(), &error);
    EXPECT_NEAR(proxy.axis.norm(), 1, 1e-12);
    EXPECT_NEAR(error, patch.MeanError(proxy), 1e-10);
  }
}

TEST(ConeProxy, ClosedFormIsTheMinimumOverAxes) {
  std::mt19937 random(17);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Patch patch = RandomPatch(seed, 25, 0.2 + 0.2 * seed);
    double least = -1;
    const ConeProxy best = FitCone(patch.Moments(), &least);
    for (int trial = 0; trial < 500; ++trial) {
      EXPECT_GE(patch.LeastErrorWithAxis(RandomUnit(random)), least - 1e-12);
      const Eigen::Vector3d near = (best.axis + 0.01 * RandomUnit(random)).normalized();
      EXPECT_GE(patch.LeastErrorWithAxis(near), least - 1e-12);
    }
  }
}

TEST(ConeProxy, CylinderErrorIsTheMinimumOverAxes) {
  std::mt19937 random(19);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Patch patch = RandomPatch(seed, 25, 0.2 + 0.2 * seed);
    const double least = CylinderError(patch.Moments());
    double smallest = 1e30;
    for (int trial = 0; trial < 3000; ++trial) {
      const double error = patch.MeanError({RandomUnit(random), 0});
      EXPECT_GE(error, least - 1e-12);
      smallest = std::min(smallest, error);
    }
    EXPECT_NEAR(smallest, least, 0.02);  // and no bound far below what can be had
  }
}

TEST(ConeProxy, CylinderErrorOfKnownShapes) {
  EXPECT_NEAR(CylinderError(ConePatch({1, 2, 3}, kPi / 2, 30, 0.4).Moments()), 0, 1e-12);
  NormalMoments plane;
  plane.Add(2, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(CylinderError(plane), 0, 1e-12);
  // A whole cone of half the right angle: the axis leaves cos^2 = 1/2, an axis across it sin^2 / 2 = 1/4.
  EXPECT_NEAR(CylinderError(ConePatch({0, 0, 1}, kPi / 4, 36).Moments()), 0.25, 1e-9);
}

TEST(ConeProxy, AreaFactorChangesNothing) {
  const Patch patch = RandomPatch(3, 30, 0.6);
  Patch scaled = patch;
  for (double& a : scaled.areas) a *= 1e-12;
  double error = 0, scaled_error = 0;
  const ConeProxy p = FitCone(patch.Moments(), &error), q = FitCone(scaled.Moments(), &scaled_error);
  EXPECT_NEAR(error, scaled_error, 1e-12);
  EXPECT_NEAR(std::abs(p.axis.dot(q.axis)), 1, 1e-9);
}

TEST(ConeProxy, NoFacesGiveAUnitAxis) {
  const ConeProxy proxy = FitCone(NormalMoments());
  EXPECT_NEAR(proxy.axis.norm(), 1, 1e-12);
  EXPECT_TRUE(std::isfinite(proxy.cos_angle));
  EXPECT_TRUE(std::isfinite(CylinderError(NormalMoments())));
}

}  // namespace
}  // namespace dcharts
