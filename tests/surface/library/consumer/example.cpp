// DelIso as a library, on a page: a torus in memory, its mesh, a second opinion, a run that is stopped, an error.
#include <deliso/deliso.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  // Samples in the program's own memory, x fastest; they are not copied.
  constexpr int n = 32;
  std::vector<float> samples;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double x = i - 15.6, y = j - 15.4, z = k - 15.5, ring = std::hypot(x, y) - 9;
        samples.push_back(static_cast<float>(4 - std::hypot(ring, z)));
      }
  const deliso::VolumeView volume = deliso::view_of(samples.data(), {n, n, n}, {0.5, 0.5, 0.5});

  // Before any mesh: what the isosurface is.
  const deliso::TopologyReport topology = deliso::topology(volume, 0);
  std::printf("isosurface: %lld component, Euler characteristic %lld\n", static_cast<long long>(topology.components),
              static_cast<long long>(topology.euler_characteristic));

  // A mesh within a tenth of a voxel, with as few vertices as that takes.
  deliso::MeshOptions options;
  options.parameters.set("size.max_error", 0.1);
  options.threads = 2;
  const deliso::MeshResult result = deliso::mesh(volume, 0, options);
  std::printf("mesh: %zu vertices, %zu triangles, %s\n", result.mesh.vertices.size(), result.mesh.triangles.size(),
              result.report.proven ? "proven" : "not proven");

  // A second opinion, on this mesh or any other.
  deliso::VerifyOptions as_meshed;
  as_meshed.parameters = options.parameters;
  const deliso::VerifyReport verified = deliso::verify(result.mesh, volume, 0, as_meshed);
  std::printf("verify: %s\n", verified.proven ? "proven" : "not proven");

  // A run that is stopped in stage 2 gives what it has.
  options.parameters.set("size.max_error", 0.001);
  options.progress = [](const deliso::StageProgress& progress) { return progress.stage != "refine"; };
  const deliso::MeshResult partial = deliso::mesh(volume, 0, options);
  std::printf("stopped in %s: %zu vertices\n", partial.report.stopped_in.c_str(), partial.mesh.vertices.size());

  // A mistake is told in one sentence.
  try {
    deliso::mesh(volume, 1000);
  } catch (const deliso::Error& error) {
    std::printf("error: %s\n", error.what());
  }
  return result.report.proven && verified.proven && partial.report.stopped ? 0 : 1;
}
