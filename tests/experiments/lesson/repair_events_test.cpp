// What a trace tells of repair, against the meshes themselves: every round is compared, with counts made anew here.
#include "experiments/lesson/trace/repair_events.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <vector>

#include "experiments/lesson/trace/trace_writer.h"
#include "surface/deliso.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

struct TracedRun {
  std::vector<TraceEvent> events;
  MeshingResult result;

  [[nodiscard]] std::vector<TraceEvent> of(const std::string& kind) const {
    std::vector<TraceEvent> found;
    for (const TraceEvent& event : events) {
      if (event.at("e") == kind) found.push_back(event);
    }
    return found;
  }
};

TracedRun traced(const char* field, int size, double isovalue) {
  TracedRun run;
  TraceWriter writer([&](const TraceEvent& event) { run.events.push_back(event); });
  MeshingOptions options;
  options.observer = &writer;
  run.result = mesh_isosurface(generate_field(field, size, 1), isovalue, options);
  return run;
}

// V − E + F of all triangles together, and the number of edges with one triangle.
std::pair<int, int> chi_and_border(const TraceEvent& triangles) {
  std::set<int> vertices;
  std::map<std::array<int, 2>, int> edges;
  for (const TraceEvent& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t.at(i), b = t.at((i + 1) % 3);
      vertices.insert(a);
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  }
  int border = 0;
  for (const auto& [edge, count] : edges) border += count == 1 ? 1 : 0;
  return {int(vertices.size()) - int(edges.size()) + int(triangles.size()), border};
}

TEST(RepairEvents, CompareTheMeshBeforeAndAfterEachRound) {
  const TracedRun run = traced("noise", 8, 127.5);
  const std::vector<TraceEvent> comparisons = run.of("compare"), samplings = run.of("sample");
  ASSERT_GT(run.result.repair.rounds, 0);
  ASSERT_EQ(samplings.size(), static_cast<std::size_t>(run.result.repair.rounds));
  ASSERT_EQ(comparisons.size(), samplings.size() + 1);
  for (const TraceEvent& comparison : comparisons) {
    int chi = 0, loops = 0;
    for (const TraceEvent& piece : comparison.at("pieces")) {
      chi += piece.at("chi").get<int>();
      loops += piece.at("loops").get<int>();
      EXPECT_GE(piece.at("vertex"), 0);
    }
    const auto [counted, border] = chi_and_border(comparison.at("triangles"));
    EXPECT_EQ(chi, counted);
    EXPECT_EQ(loops > 0, border > 0);
    EXPECT_GE(border, 3 * loops);
  }
  // The errors that the program counts go to 0, and so do the components that are wrong.
  const auto count_wrong = [](const TraceEvent& comparison) {
    int wrong = 0;
    for (const TraceEvent& component : comparison.at("components")) wrong += component.at("is") == "exact" ? 0 : 1;
    return wrong;
  };
  EXPECT_EQ(count_wrong(comparisons.front()), run.result.repair.components_before);
  EXPECT_EQ(count_wrong(comparisons.back()), 0);
  EXPECT_GT(comparisons.front().at("error"), 0);
  EXPECT_EQ(comparisons.back().at("error"), 0);
}

TEST(RepairEvents, NameEachCellOnceWithinTheGrid) {
  for (const TraceEvent& sampling : traced("noise", 8, 127.5).of("sample")) {
    std::set<std::array<int, 3>> cells;
    for (const TraceEvent& cell : sampling.at("cells")) {
      EXPECT_TRUE(cells.insert(cell.get<std::array<int, 3>>()).second);
      for (const int i : cell.get<std::array<int, 3>>()) EXPECT_TRUE(i >= 0 && i < 7) << i;
    }
    EXPECT_EQ(cells.size(), sampling.at("levels").size());
    EXPECT_FALSE(cells.empty());
  }
}

TEST(RepairEvents, TellTheCertificateOfEveryRun) {
  for (const char* field : {"torus", "noise"}) {
    const TracedRun run = traced(field, 8, field[0] == 't' ? 0.7 : 127.5);
    const std::vector<TraceEvent> certificates = run.of("certify");
    ASSERT_EQ(certificates.size(), 1u) << field;
    const bool is_right = certificates[0].at("homeomorphic").get<bool>() && certificates[0].at("crossing") == 0 &&
                          certificates[0].at("mesh_off") == 0 && certificates[0].at("vertices_off") == 0 &&
                          certificates[0].at("isosurface_off") == 0;
    EXPECT_EQ(is_right, is_proven(run.result.certificate)) << field;
    EXPECT_EQ(run.events.back(), certificates[0]) << field;
  }
}

// Where nothing has to be repaired no round is told of.
TEST(RepairEvents, AreNoneWhereTheMeshIsRight) {
  const TracedRun run = traced("torus", 16, 0.7);
  EXPECT_EQ(run.result.repair.rounds, 0);
  EXPECT_TRUE(run.of("compare").empty() && run.of("sample").empty());
}

}  // namespace
}  // namespace deliso
