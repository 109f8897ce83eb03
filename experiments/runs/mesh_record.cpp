#include "experiments/config/config.h"
#include "experiments/runs/record.h"
#include "experiments/system/program_info.h"
#include "volume/io/sha256.h"

namespace deliso {
namespace {

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace

Json json_of(const JsonTree& tree) { return Json::parse(tree.text()); }

Json program_json() {
  const ProgramInfo info = program_info();
  return Json{{"version", info.version},
              {"commit", info.commit},
              {"compiler", info.compiler},
              {"flags", info.flags},
              {"cpu", info.cpu}};
}

Json volume_json(const std::filesystem::path& path, const ScalarGrid& grid, const std::string& sha256) {
  return Json{{"path", path.string()},
              {"dims", grid.dims()},
              {"samples", std::int64_t{grid.dims()[0]} * grid.dims()[1] * grid.dims()[2]},
              {"spacing", vector_json(grid.spacing())},
              {"origin", vector_json(grid.origin())},
              {"type", grid.type_name()},
              {"range", Json::array({grid.range().first, grid.range().second})},
              {"sha256", sha256.empty() ? sample_sha256(grid) : sha256}};
}

Json topology_json(const std::vector<TopologyCount>& counts) { return json_of(topology_tree(counts)); }

Json certificate_json(const Certificate& certificate) { return json_of(certificate_tree(certificate)); }

Json quality_json(const MeshQuality& quality) { return json_of(quality_tree(quality)); }

Json mesh_report(const MeshRun& run, const MeshingResult& result) {
  Json report{{"schema", kReportSchema},
              {"program", program_json()},
              {"volume", volume_json(run.volume_path, run.grid, run.volume_sha256)}};
  const MeshQuality quality = run.quality ? *run.quality : measure_quality(result.mesh, run.options.threads);
  report.update(json_of(run_report(run.isovalue, run.options, result, quality)));
  report["peak_memory_bytes"] = peak_memory_bytes();
  return report;
}

}  // namespace deliso
