// deliso topology: the exact topology of an isosurface, without a mesh.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "delaunay/base/stopwatch.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/world.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/text_table.h"
#include "surface/certificate/certificate.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

struct TopologyCommandOptions {
  VolumeOptions volume;
  FieldOptions field;
  std::string report;
  bool closed = false;
};

// What a component with this topology is called where it has a common name.
std::string common_name(const ComponentTopology& topology) {
  if (topology == ComponentTopology{2, 0}) return "sphere";
  if (topology == ComponentTopology{0, 0}) return "torus";
  if (topology == ComponentTopology{1, 1}) return "disk";
  if (topology == ComponentTopology{0, 2}) return "annulus";
  const std::int64_t genus = (2 - topology.euler_characteristic - topology.boundary_loops) / 2;
  return "genus " + std::to_string(genus);
}

void print_counts(const std::vector<TopologyCount>& counts, std::ostream& stream) {
  TextTable table;
  table.row({"surface", "count", "euler characteristic", "boundary loops"});
  for (const TopologyCount& entry : counts) {
    table.row({common_name(entry.topology), std::to_string(entry.count),
               std::to_string(entry.topology.euler_characteristic), std::to_string(entry.topology.boundary_loops)});
  }
  const TopologySum sum = sum_of(counts);
  table.row({"all", std::to_string(sum.components), std::to_string(sum.euler_characteristic),
             std::to_string(sum.boundary_loops)});
  table.print(stream, true);
}

ExitCode run_topology(const TopologyCommandOptions& options) {
  check_field_options(options.field);
  if (!options.report.empty()) check_writable(options.report, "--report");
  check_distinct({{"VOLUME", options.volume.path}}, {{"--report", options.report}});
  const Volume volume = load_volume(options.volume);
  check_apart_from_data(volume.data_files, {{"--report", options.report}});
  const Stopwatch stopwatch;
  const FieldOfOptions field = field_of_options(options.volume.path, volume, options.field, options.closed);
  const RegularTopology regular = regular_topology(field.meshed.grid, field.meshed.isovalue);
  const double used = regular.isovalue;
  const IsosurfaceTopology& topology = regular.topology;
  const double seconds = stopwatch.seconds();

  // certify() counts equal components; an empty mesh is enough for that.
  const std::vector<TopologyCount> counts = certify(TriangleMesh(), topology.components).isosurface;
  if (!options.report.empty()) {
    const TopologySum sum = sum_of(counts);
    const Json report = {{"schema", "deliso-topology-1"},
                         {"program", program_json()},
                         {"volume", volume_json(options.volume.path, volume.grid, sha256_as_read(volume))},
                         {"field", field_json(options.field, field.chosen)},
                         {"isovalue", field.chosen.isovalue},
                         {"isovalue_used", used},
                         {"closed", options.closed},
                         {"components", sum.components},
                         {"euler_characteristic", sum.euler_characteristic},
                         {"boundary_loops", sum.boundary_loops},
                         {"crossings", topology.crossings.size()},
                         {"singular_cells", topology.singular_cells.size()},
                         {"isosurface", topology_json(counts)},
                         {"total_seconds", seconds}};
    write_text(json_text(report), options.report);
  }
  // Where the report goes to standard output, nothing else does.
  print_counts(counts, is_standard_stream(options.report) ? std::cerr : std::cout);
  for (const std::string& remark : field_remarks(volume, options.field, field.chosen)) {
    std::cerr << "deliso: " << remark << '\n';
  }
  print_units_remark(options.volume.path, volume, {options.field.smooth});
  remark_isovalue(&field.meshed.grid, field.chosen.isovalue, used);
  return ExitCode::kDone;
}

}  // namespace

void add_topology_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<TopologyCommandOptions>();
  Command command = line.add_command("topology", "Exact topology of an isosurface, without a mesh");
  add_volume_options(command, options->volume);
  add_region_option(command, options->volume);
  add_isovalue_option(command, options->field);
  add_field_options(command, options->field);
  command.add_option("--report", options->report, "Write the result as JSON")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.add_flag("--closed", options->closed, "Close the surface along the faces of the box (boundary = closed)");
  command.examples("deliso topology head.nrrd --isovalue 50 --report -");
  command.callback(exit_code, [options] { return run_topology(*options); });
}

}  // namespace deliso
