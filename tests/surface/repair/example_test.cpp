// The example of surface/repair/README.md: its numbers are those of a run.

#include <gtest/gtest.h>

#include <cstdint>
#include <regex>
#include <string>
#include <vector>

#include "surface/deliso.h"
#include "tests/support/pages.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

constexpr double kIsovalue = 127.5;

// The first match of a pattern in the page, line breaks read as blanks; its groups as numbers.
std::vector<std::int64_t> numbers_in_page(const std::string& pattern) {
  static const std::string page =
      std::regex_replace(testing::page_text("surface/repair/README.md"), std::regex("\\s+"), " ");
  std::smatch match;
  if (!std::regex_search(page, match, std::regex(pattern))) {
    ADD_FAILURE() << "the page has no \"" << pattern << '"';
    return {};
  }
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 1; i < match.size(); ++i) numbers.push_back(std::stoll(match[i]));
  return numbers;
}

using Numbers = std::vector<std::int64_t>;

struct Run {
  MeshingResult result;
  std::vector<Numbers> before_rounds;  // samples and error
};

Run run(std::int32_t max_rounds) {
  const Numbers field = numbers_in_page(R"(generate noise -o noise.nrrd --size (\d+) --seed (\d+)`)");
  const ScalarGrid grid =
      generate_field("noise", static_cast<std::int32_t>(field.at(0)), static_cast<std::uint64_t>(field.at(1)));
  Run run;
  MeshingOptions options;
  options.parameters.repair.max_rounds = max_rounds;
  options.progress = [&](const Progress& progress) {
    if (progress.stage == "repair" && progress.vertices > 0) {
      run.before_rounds.push_back({progress.vertices, progress.queued});
    }
  };
  run.result = mesh_isosurface(grid, kIsovalue, options);
  return run;
}

// The (Euler characteristic, boundary loops) of the component or piece that is no disk.
Numbers largest(const std::vector<TopologyCount>& components) {
  for (const TopologyCount& c : components) {
    if (c.topology.euler_characteristic != 1) return {c.topology.euler_characteristic, c.topology.boundary_loops};
  }
  return {};
}

TEST(RepairExample, TellsTheSurfaceAndTheMeshOfStage1) {
  const Certificate certificate = run(0).result.certificate;
  EXPECT_EQ(largest(certificate.isosurface), numbers_in_page(R"(characteristic (-\d+) with (\d+) boundary loops)"));
  EXPECT_EQ(largest(certificate.mesh), numbers_in_page(R"(the other one with (-\d+) and (\d+):)"));
}

TEST(RepairExample, TellsTheRounds) {
  const auto [result, before_rounds] = run(8);
  EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic);
  EXPECT_EQ(result.repair.components_before, 1);
  EXPECT_EQ(result.repair.components_polygonized, 0);
  ASSERT_EQ(result.repair.rounds, 2);
  ASSERT_EQ(before_rounds.size(), 2u);
  EXPECT_EQ(before_rounds[0], numbers_in_page(R"(\| round 1 \| (\d+) \| (\d+) \|)"));
  EXPECT_EQ(before_rounds[1], numbers_in_page(R"(\| round 2 \| (\d+) \| (\d+) \|)"));
  EXPECT_EQ((Numbers{result.repair.cells_refined}), numbers_in_page(R"(by then (\d+) cells are refined)"));
  EXPECT_EQ((Numbers{result.repair.inverted_umbrellas_removed, result.repair.vertices_after}),
            numbers_in_page(R"(Of the mesh (\d+) inverted umbrellas are removed, (\d+) vertices)"));
}

}  // namespace
}  // namespace deliso
