// SPDX-License-Identifier: Apache-2.0
// association_peers FILE CODE [THREADS]: one cylinder through the points of FILE (x y z as
// doubles), what it took as a JSON line. CODE: gaussian, minimum_zone, minimum_circumscribed,
// maximum_inscribed (the engine, without starting values) or ceres (one residual a point by
// AutoDiff, from the true cylinder about the z axis).
#include <ceres/ceres.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "trueaxis/association.hpp"

namespace {

using trueaxis::Point3;

/// p: x0, y0, l, m, radius of a cylinder about the z axis.
struct CylinderDistance {
  Point3 at;
  template <typename T>
  bool operator()(const T* p, T* residual) const {
    using std::sqrt;
    const T n = sqrt(1.0 - p[2] * p[2] - p[3] * p[3]);
    const T x = at[0] - p[0], y = at[1] - p[1], s = x * p[2] + y * p[3] + at[2] * n;
    residual[0] = sqrt(x * x + y * y + at[2] * at[2] - s * s) - p[4];
    return true;
  }
};

double by_ceres(const std::vector<Point3>& points, double& radius) {
  double p[5] = {0.0, 0.0, 0.0, 0.0, 20.0};
  ceres::Problem problem;
  for (const Point3& point : points)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CylinderDistance, 1, 5>(new CylinderDistance{point}),
        nullptr, p);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-13;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  radius = p[4];
  return std::sqrt(2.0 * summary.final_cost / static_cast<double>(points.size()));
}

double processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::ifstream file(argv[1], std::ios::binary | std::ios::ate);
  std::vector<Point3> points(static_cast<std::size_t>(file.tellg()) / sizeof(Point3));
  file.seekg(0);
  for (Point3& point : points)
    for (double& value : point) {
      char bytes[sizeof value];
      file.read(bytes, sizeof bytes);
      std::copy_n(bytes, sizeof bytes, reinterpret_cast<char*>(&value));
    }
  const std::string code = argv[2];
  const auto criterion =
      std::ranges::find(trueaxis::criterion_names, code) - trueaxis::criterion_names.begin();
  const int threads = argc > 3 ? std::atoi(argv[3]) : 0;
  double wall = 1e300, processor = 1e300, rms = 0.0, zone = 0.0, radius = 0.0;
  const int turns = code == "ceres" ? 1 : 5;
  for (int turn = 0; turn < turns; ++turn) {
    const auto start = std::chrono::steady_clock::now();
    const double before = processor_s();
    if (code == "ceres") {
      rms = by_ceres(points, radius);
    } else {
      const auto got =
          trueaxis::associate(points, trueaxis::Element::cylinder,
                              static_cast<trueaxis::Criterion>(criterion), {.threads = threads});
      rms = got.rms_mm, zone = got.zone_mm, radius = got.feature.radius_mm;
    }
    processor = std::min(processor, processor_s() - before);
    wall = std::min(
        wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf(
      "{\"wall\": %.6f, \"processor\": %.6f, \"rms\": %.17g, \"zone\": %.17g, "
      "\"radius\": %.17g}\n",
      wall, processor, rms, zone, radius);
}
