#include "experiments/lesson/trace/trace_writer.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "surface/deliso.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/restricted/restricted_delaunay.h"
#include "tests/experiments/lesson/trace_replay.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

// Compares the state that the trace gives with the live one after every insertion.
class CheckedWriter : public TraceWriter {
 public:
  explicit CheckedWriter(std::string& trace)
      : TraceWriter([this, &trace](const TraceEvent& event) {
          const std::string line = event.dump();
          replay.play(TraceReplay::Json::parse(line));
          trace += line + "\n";
        }) {}

  void triangulated(const RestrictedDelaunay& del_s) override {
    TraceWriter::triangulated(del_s);
    compare(del_s);
  }
  void inserted(const RestrictedDelaunay& del_s) override {
    TraceWriter::inserted(del_s);
    ++insertions;
    // In a part, ids are not the numbers of the trace; what parts did is compared when they have joined.
    if (!del_s.is_part()) compare(del_s);
  }
  void refined(const RefinementMesh& mesh) override {
    TraceWriter::refined(mesh);
    std::multiset<TraceReplay::Corners> live;
    for (const auto& t : mesh.triangles) {
      live.insert(TraceReplay::rotated({int(t.corners[0]), int(t.corners[1]), int(t.corners[2])}));
    }
    EXPECT_EQ(replay.triangles, live);
    ASSERT_EQ(replay.mesh_points.size(), mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      EXPECT_EQ(replay.mesh_points[v][0], mesh.vertices[v].point.x);
    ++refinements;
  }

  TraceReplay replay;
  int insertions = 0, compared = 0, refinements = 0;

 private:
  void compare(const RestrictedDelaunay& del_s) {
    ++compared;
    const Tetrahedralization& delaunay = del_s.delaunay();
    const auto number = [](VertexId v) { return v == kInfiniteVertex ? -1 : int(v.value); };
    std::map<TraceReplay::Tet, bool> above;
    std::set<TraceReplay::Triangle> restricted;
    for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
      const TetId t(i);
      if (!delaunay.is_live(t)) continue;
      const auto& v = delaunay.vertices(t);
      above[TraceReplay::sorted(TraceReplay::Tet{number(v[0]), number(v[1]), number(v[2]), number(v[3])})] =
          del_s.is_above(t);
      for (unsigned face = 0; face < 4; ++face) {
        if (!del_s.is_restricted(FacetId(t, face))) continue;
        const auto f = delaunay.facet_vertices(FacetId(t, face));
        restricted.insert(TraceReplay::sorted(TraceReplay::Triangle{number(f[0]), number(f[1]), number(f[2])}));
      }
    }
    EXPECT_EQ(replay.above, above);
    EXPECT_EQ(replay.restricted(), restricted);
    std::map<TraceReplay::Triangle, std::vector<double>> hits;
    for (std::size_t e = 0; e < del_s.dual_edge_slots(); ++e) {
      if (!del_s.is_alive(DualEdgeId(e))) continue;
      const DualEdge& edge = del_s.dual_edge(DualEdgeId(e));
      const auto& v = edge.vertices;
      auto& its = hits[TraceReplay::sorted(TraceReplay::Triangle{number(v[0]), number(v[1]), number(v[2])})];
      for (const Hit& hit : edge.hits) its.push_back(hit.t);
    }
    EXPECT_EQ(replay.hits, hits);
  }
};

struct TracedField {
  const char* name;
  int size;
  double isovalue;

  friend std::ostream& operator<<(std::ostream& out, const TracedField& field) { return out << field.name; }
};

class Trace : public ::testing::TestWithParam<TracedField> {};

std::string trace_of(const ScalarGrid& grid, double isovalue, int threads) {
  std::string trace;
  TraceWriter writer([&](const TraceEvent& event) { trace += event.dump() + "\n"; });
  MeshingOptions options;
  options.threads = threads;
  options.observer = &writer;
  mesh_isosurface(grid, isovalue, options);
  return trace;
}

TEST_P(Trace, RebuildsEveryStateOfTheLiveTriangulation) {
  const auto& [name, size, isovalue] = GetParam();
  const ScalarGrid grid = generate_field(name, size, 1);
  MeshingOptions options;
  const MeshingResult plain = mesh_isosurface(grid, isovalue, options);
  std::string trace;
  CheckedWriter writer(trace);
  options.observer = &writer;
  const MeshingResult watched = mesh_isosurface(grid, isovalue, options);
  // Watching changes nothing.
  EXPECT_EQ(watched.mesh.points, plain.mesh.points);
  EXPECT_EQ(watched.mesh.triangles, plain.mesh.triangles);
  EXPECT_EQ(writer.insertions, watched.recover.insertions);
  EXPECT_GT(writer.compared, 10);
  EXPECT_GE(writer.refinements, 1);
  for (const int threads : {1, 2, 3}) EXPECT_EQ(trace_of(grid, isovalue, threads), trace) << threads;
}

INSTANTIATE_TEST_SUITE_P(Fields, Trace,
                         ::testing::Values(TracedField{"torus", 16, 0.7}, TracedField{"double_torus", 24, 500.5},
                                           TracedField{"shells", 24, 100.5}, TracedField{"gyroid", 16, 0.1},
                                           TracedField{"plane", 8, 0.123457}, TracedField{"noise", 8, 127.5}),
                         [](const auto& field) { return std::string(field.param.name); });

// Decimation, for one, is not followed step by step.
TEST(TraceOfAStatedError, EndsWithTheMeshOfTheRun) {
  std::string trace;
  CheckedWriter writer(trace);
  MeshingOptions options;
  options.parameters.size.max_error = 0.1;
  options.observer = &writer;
  const MeshingResult result = mesh_isosurface(generate_field("torus", 10, 1), 0.7, options);
  EXPECT_EQ(writer.replay.mesh_points.size(), result.mesh.points.size());
  EXPECT_EQ(writer.replay.triangles.size(), result.mesh.triangles.size());
  EXPECT_NE(trace.find("\"rest\""), std::string::npos) << "another field is needed";
}

TEST(TraceOfALargeRun, IsRefusedWhereSlabsBegin) {
  const ScalarGrid grid = generate_field("gyroid", 80, 1);
  std::string trace;
  TraceWriter writer([](const TraceEvent&) {});
  MeshingOptions options;
  options.observer = &writer;
  try {
    mesh_isosurface(grid, 0.1, options);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("triangles"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace deliso
