// bench_delaunay POINTS.pts RUNS: times BowyerWatson::build on a file of points (int64 count, then x y z doubles) and
// prints one line. bytes_per_point is the growth of the resident set over the first build, per input point.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/stopwatch.h"
#include "delaunay/bowyer_watson.h"

namespace {

using namespace deliso;

std::vector<Vec3> read_points(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::int64_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  if (!file || count <= 0) throw InputError(std::string(path) + " does not start with a positive number of points");
  std::vector<Vec3> points(static_cast<std::size_t>(count));
  file.read(reinterpret_cast<char*>(points.data()), static_cast<std::streamsize>(sizeof(Vec3) * points.size()));
  if (!file)
    throw InputError(std::string(path) + " holds fewer points than the " + std::to_string(count) + " it states");
  return points;
}

// Bytes of memory of this process that are in use, from Linux's /proc; 0 elsewhere.
double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0;
  file >> pages >> pages;
  return pages * 4096;
}

int run(const char* path, int runs) {
  const std::vector<Vec3> points = read_points(path);
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  std::vector<double> seconds;
  std::size_t tets = 0;
  double bytes = 0;
  for (int i = 0; i < runs; ++i) {
    const double before = resident_bytes();
    const Stopwatch watch;
    BowyerWatson triangulation(box);
    if (!triangulation.build(points)) throw InputError(std::string(path) + " holds coplanar points only");
    seconds.push_back(watch.seconds());
    if (i == 0) bytes = resident_bytes() - before;
    tets = 0;
    for (std::size_t t = 0; t < triangulation.tet_slots(); ++t) {
      tets += triangulation.is_live(TetId(t)) && !triangulation.is_ghost(TetId(t));
    }
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  const auto count = static_cast<double>(points.size());
  std::cout << "n=" << points.size() << " tets=" << tets << " median=" << median
            << " points_per_second=" << count / median << " bytes_per_point=" << bytes / count << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || std::atoi(argv[2]) < 1) {
    std::cerr << "usage: bench_delaunay POINTS.pts RUNS\n";
    return 2;
  }
  try {
    return run(argv[1], std::atoi(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
