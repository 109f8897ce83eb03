// deliso::verify, topology and info: what is true of a volume and of anybody's mesh.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "delaunay/base/stopwatch.h"
#include "surface/base/sizes.h"
#include "surface/certificate/certificate.h"
#include "surface/library/call.h"
#include "surface/library/json_tree.h"
#include "surface/library/placed_grid.h"
#include "surface/library/run_report.h"
#include "surface/library/verification_report.h"
#include "surface/mesh/mesh_frame.h"
#include "surface/verification/verification.h"
#include "volume/filters/isovalue_choice.h"
#include "volume/filters/labels.h"
#include "volume/filters/meshed_field.h"
#include "volume/not_finite.h"

namespace deliso {
namespace {

std::vector<ComponentCount> counts_of(const std::vector<TopologyCount>& counts) {
  std::vector<ComponentCount> given;
  given.reserve(counts.size());
  for (const TopologyCount& entry : counts)
    given.push_back({entry.topology.euler_characteristic, entry.topology.boundary_loops, entry.count});
  return given;
}

// The grid as it is meshed: with a spacing of 1 where the volume's is to be ignored.
ScalarGrid grid_to_judge(const PlacedGrid& placed, const Parameters& parameters) {
  if (parameters.spacing == SpacingUse::kUse) return placed.grid;
  return {placed.grid.dims(), placed.grid.samples()};
}

MeshedField field_of(const ScalarGrid& grid, double isovalue, const Parameters& parameters, int threads) {
  return meshed_field(grid, isovalue_of_field(parameters, isovalue), parameters.field,
                      parameters.boundary == Boundary::kClosed, grid.spacing(), threads);
}

// From the caller's coordinates to those of the grid that is judged.
TriangleMesh mesh_to_judge(const Mesh& mesh, const PlacedGrid& placed, const Parameters& parameters) {
  TriangleMesh own = engine_mesh(mesh);
  if (!(placed.to_world == Affine())) own = transformed(std::move(own), placed.to_world.inverse());
  if (parameters.spacing == SpacingUse::kIgnore) {
    const Vec3& s = placed.grid.spacing();
    for (Vec3& p : own.points) p = scaled(p - placed.grid.origin(), {1 / s.x, 1 / s.y, 1 / s.z});
  }
  if (parameters.field.invert) {
    for (auto& [a, b, c] : own.triangles) std::swap(b, c);
  }
  return own;
}

VerifyReport report_of_verification(const Verification& v, double isovalue, const Promise& promise) {
  VerifyReport report;
  report.proven = v.proven;
  report.failures = v.failures;
  report.checks = {{"manifold", v.manifold.pass},
                   {"orientation", v.orientation.pass},
                   {"boundary", v.boundary.pass},
                   {"topology", v.topology.verdict == Verdict::kHomeomorphic},
                   {"self_intersection", v.self_intersection.pass},
                   {"residual", v.residual.pass},
                   {"distance", v.distance.pass},
                   {"normals", v.normals.pass},
                   {"delaunay_balls", v.delaunay_balls.pass}};
  report.isovalue_used = v.isovalue_used;
  report.mesh = counts_of(v.topology.mesh);
  report.isosurface = counts_of(v.topology.isosurface);
  report.crossing_pairs = static_cast<std::int64_t>(v.self_intersection.found.crossing_pairs);
  report.residual = v.residual.distance.max_voxels;
  report.mesh_to_isosurface = v.distance.mesh_to_isosurface.max_voxels;
  report.isosurface_to_mesh = v.distance.isosurface_to_mesh.max_voxels;
  report.min_angle_degrees = v.quality.min_angle_degrees;
  report.max_angle_degrees = v.quality.max_angle_degrees;
  report.seconds = v.seconds;
  report.json = JsonTree{
      {"schema", "deliso-verification-1"},
      {"program", JsonTree{{"version", version()}}},
      {"isovalue", isovalue},
      {"isovalue_used", v.isovalue_used},
      {"vertices", v.vertices},
      {"triangles", v.triangles},
      {"promise", JsonTree{{"max_distance", promise.max_distance}, {"dropped_components", promise.dropped_components}}},
      {"proven", v.proven},
      {"failures", v.failures},
      {"checks", checks_tree(v)},
      {"quality", quality_tree(v.quality)},
      {"total_seconds",
       v.seconds}}.text();
  return report;
}

}  // namespace

VerifyReport verify(const Mesh& mesh, const VolumeView& volume, double isovalue, const VerifyOptions& options) {
  return call_watched(options.progress, [&](const VerificationProgress& step) {
    const Parameters parameters = engine_parameters(options.parameters);
    const PlacedGrid placed = placed_grid(volume, region_of(parameters.region));
    const TriangleMesh own = mesh_to_judge(mesh, placed, parameters);
    const MeshedField field =
        field_of(grid_to_judge(placed, parameters), isovalue, parameters, thread_count(options.threads));
    if (!(options.max_distance >= 0))
      throw InputError("max_distance: expected a number >= 0, found " + shortest_text(options.max_distance));
    if (options.dropped_components < 0) {
      throw InputError("dropped_components: expected a number >= 0, found " +
                       std::to_string(options.dropped_components));
    }
    const Promise promise{
        .max_distance = options.max_distance > 0 ? options.max_distance : promised_distance(parameters),
        .dropped_components = options.dropped_components};
    Verification v = verify_mesh(own, field.grid, field.isovalue, promise, step, engine_mesh(mesh).points);
    if (parameters.spacing == SpacingUse::kUse) move_places(v, placed.to_world);
    return report_of_verification(v, isovalue_of_field(parameters, isovalue), promise);
  });
}

TopologyReport topology(const VolumeView& volume, double isovalue, const TopologyOptions& options) {
  return call_watched(options.progress, [&](const VerificationProgress& step) {
    const Stopwatch watch;
    const Parameters parameters = engine_parameters(options.parameters);
    const int threads = thread_count(options.threads);
    step(0, "samples");
    const PlacedGrid placed = placed_grid(volume, region_of(parameters.region));
    const MeshedField field = field_of(grid_to_judge(placed, parameters), isovalue, parameters, threads);
    step(0.5, "topology");
    const RegularTopology regular = regular_topology(field.grid, field.isovalue, threads);
    // certify() counts equal components; an empty mesh is enough for that.
    const std::vector<TopologyCount> counts = certify(TriangleMesh(), regular.topology.components).isosurface;
    const TopologySum sum = sum_of(counts);
    TopologyReport report{regular.isovalue,
                          counts_of(counts),
                          sum.components,
                          sum.euler_characteristic,
                          sum.boundary_loops,
                          !regular.topology.singular_cells.empty(),
                          ""};
    report.json = JsonTree{{"schema", "deliso-topology-1"},
                           {"program", JsonTree{{"version", version()}}},
                           {"isovalue", isovalue_of_field(parameters, isovalue)},
                           {"isovalue_used", regular.isovalue},
                           {"components", sum.components},
                           {"euler_characteristic", sum.euler_characteristic},
                           {"boundary_loops", sum.boundary_loops},
                           {"crossings", regular.topology.crossings.size()},
                           {"singular_cells", regular.topology.singular_cells.size()},
                           {"isosurface", topology_tree(counts)},
                           {"total_seconds", watch.seconds()}}
                      .text();
    return report;
  });
}

double named_isovalue(const VolumeView& volume, std::string_view name, const ParameterSet& parameters) {
  return call_guarded([&] {
    std::optional<NamedIsovalue> known;
    try {
      known = parse_isovalue_name(name);
    } catch (const InputError& error) {
      throw InputError(std::string("isovalue: ") + error.what());
    }
    if (!known) {
      throw InputError("isovalue: expected a number, 'otsu', 'mean', 'median' or 'P%', found '" + std::string(name) +
                       "'");
    }
    const Samples all = samples_of(volume, region_of(engine_parameters(parameters).region)).samples;
    return isovalue_of(count_not_finite(all).count() == 0 ? all : finite_samples(all), *known);
  });
}

VolumeInfo info(const VolumeView& volume) {
  return call_guarded([&] {
    const PlainSamples all = samples_of(volume, {});
    const NotFiniteCounts counts = count_not_finite(all.samples);
    const bool is_finite = counts.count() == 0;
    const Samples finite = is_finite ? all.samples : finite_samples(all.samples);
    const auto [low, high] = finite_range(finite);
    const ScalarGrid grid(all.dims, is_finite ? all.samples : with_finite_samples(all.samples, low, low, high));
    const SampleKind kind = kind_of_samples(grid).kind;
    VolumeInfo given;
    given.lowest = low;
    given.highest = high;
    given.nan = counts.nan;
    given.infinite = counts.count() - counts.nan;
    given.kind = kind == SampleKind::kMask ? "mask" : kind == SampleKind::kLabels ? "labels" : "field";
    given.otsu = otsu_isovalue(finite);
    given.mean = mean_isovalue(finite);
    given.median = median_isovalue(finite);
    given.json =
        JsonTree{{"schema", "deliso-info-1"},
                 {"program", JsonTree{{"version", version()}}},
                 {"dims", volume.dims},
                 {"range", std::array{low, high}},
                 {"not_finite", JsonTree{{"nan", given.nan}, {"infinite", given.infinite}}},
                 {"kind", given.kind},
                 {"named_isovalues", JsonTree{{"otsu", given.otsu}, {"mean", given.mean}, {"median", given.median}}}}
            .text();
    return given;
  });
}

}  // namespace deliso
