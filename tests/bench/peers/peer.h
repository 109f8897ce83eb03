// What the adapters of other meshers have in common: their arguments, the volume, the search for a number of vertices,
// the mesh and the report that `deliso run` reads (experiments/runs/command_mesher.h).
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "surface/mesh/io/mesh_io.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/io/volume_file.h"
#include "volume/scalar_grid.h"

namespace deliso::peers {

struct Arguments {
  std::string volume, mesh, report;
  double isovalue = 0;
  std::int64_t vertices = 0;  // as many as these, by trials of the size; 0: the distance decides
  double distance = 0.1;      // the bound on the distance, in voxels
  int first_points = 0;       // what the triangulation begins with; 0: the mesher's own choice
};

// VOLUME ISOVALUE MESH REPORT vertices N | distance D [FIRST_POINTS]
inline Arguments parse_arguments(int argc, char** argv) {
  if (argc != 7 && argc != 8) {
    throw std::runtime_error("usage: VOLUME ISOVALUE MESH REPORT vertices N | distance D [FIRST_POINTS]");
  }
  Arguments arguments;
  arguments.volume = argv[1];
  arguments.isovalue = std::stod(argv[2]);
  arguments.mesh = argv[3];
  arguments.report = argv[4];
  const std::string by = argv[5];
  if (by == "vertices") {
    arguments.vertices = std::stoll(argv[6]);
  } else if (by == "distance") {
    arguments.distance = std::stod(argv[6]);
  } else {
    throw std::runtime_error("expected 'vertices' or 'distance', found '" + by + "'");
  }
  if (argc == 8) arguments.first_points = std::stoi(argv[7]);
  return arguments;
}

// Bounds in voxels.
struct Sizes {
  double radius = 0;
  double distance = 0;
};

// By a distance the size is left free, but for a bound that no small component is smaller than. By a number of vertices
// the distance is a quarter of the size, as in the examples of CGAL's manual.
constexpr double kFreeRadius = 4;
constexpr double kDistanceOfRadius = 0.25;

struct Trial {
  TriangleMesh mesh;
  double seconds = 0;
};

struct Outcome {
  Trial trial;
  Sizes sizes;
  int trials = 0;
};

// The mesh of the arguments: one trial by distance, else up to eight until the number of vertices is met within 2 %.
// Only the time of the last trial counts.
inline Outcome mesh_as_asked(const Arguments& arguments, const std::function<Trial(const Sizes&)>& mesh) {
  Outcome outcome;
  if (arguments.vertices == 0) {
    outcome.sizes = {kFreeRadius, arguments.distance};
    outcome.trial = mesh(outcome.sizes);
    outcome.trials = 1;
    return outcome;
  }
  constexpr int kMostTrials = 8;
  constexpr double kNear = 0.02;
  double radius = 1;
  while (outcome.trials < kMostTrials) {
    outcome.sizes = {radius, kDistanceOfRadius * radius};
    outcome.trial = mesh(outcome.sizes);
    ++outcome.trials;
    const double ratio =
        static_cast<double>(outcome.trial.mesh.points.size()) / static_cast<double>(arguments.vertices);
    if (std::abs(ratio - 1) <= kNear || ratio == 0) break;
    radius *= std::sqrt(ratio);
  }
  return outcome;
}

// Triangles that close the surface in a face of the box are no part of the isosurface.
inline void drop_caps(TriangleMesh& mesh, const ScalarGrid& grid) {
  constexpr double kNear = 0.01;  // voxels
  const auto& box = grid.box();
  const Vec3& s = grid.spacing();
  const auto lies_in_face = [&](const std::array<std::uint32_t, 3>& t) {
    const auto all = [&](auto&& test) {
      return test(mesh.points[t[0]]) && test(mesh.points[t[1]]) && test(mesh.points[t[2]]);
    };
    return all([&](const Vec3& p) { return p.x < box.low.x + kNear * s.x; }) ||
           all([&](const Vec3& p) { return p.x > box.high.x - kNear * s.x; }) ||
           all([&](const Vec3& p) { return p.y < box.low.y + kNear * s.y; }) ||
           all([&](const Vec3& p) { return p.y > box.high.y - kNear * s.y; }) ||
           all([&](const Vec3& p) { return p.z < box.low.z + kNear * s.z; }) ||
           all([&](const Vec3& p) { return p.z > box.high.z - kNear * s.z; });
  };
  std::erase_if(mesh.triangles, lies_in_face);
  // Vertices without a triangle go, too.
  std::vector<std::uint32_t> number(mesh.points.size(), 0xFFFFFFFFu);
  std::vector<Vec3> points;
  for (auto& triangle : mesh.triangles) {
    for (auto& vertex : triangle) {
      if (number[vertex] == 0xFFFFFFFFu) {
        number[vertex] = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh.points[vertex]);
      }
      vertex = number[vertex];
    }
  }
  mesh.points = std::move(points);
}

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Meshes as asked, once cold and, by a distance, once more warm; writes the mesh and the report.
inline int run(int argc, char** argv, const std::string& version, const std::string& settings,
               const std::function<std::function<Trial(const Sizes&)>(const ScalarGrid&, const Arguments&)>& prepare) {
  try {
    const Arguments arguments = parse_arguments(argc, argv);
    const ScalarGrid grid = read_volume(arguments.volume);
    const auto mesh = prepare(grid, arguments);
    Outcome outcome = mesh_as_asked(arguments, mesh);
    const double warm = outcome.trials == 1 ? mesh(outcome.sizes).seconds : outcome.trial.seconds;
    drop_caps(outcome.trial.mesh, grid);
    write_mesh(outcome.trial.mesh, arguments.mesh);
    std::ofstream report(arguments.report);
    report << "{\"version\": \"" << version << "\", \"settings\": \"" << settings << ", size " << outcome.sizes.radius
           << ", distance " << outcome.sizes.distance << " voxels\", \"trials\": " << outcome.trials;
    report << ", \"total_seconds\": " << outcome.trial.seconds << ", \"warm_seconds\": " << warm << "}\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}

}  // namespace deliso::peers
