// The tables that put other meshers beside ours (experiments/regenerate_tables.py), from made-up results.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/support/pages.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

// Prints the section of two data sets and two meshers; the arguments are the states of the other mesher's two rows.
constexpr const char* kScript = R"script(
import sys, types
sys.path.insert(0, sys.argv[1])
import regenerate_tables as tables

def row(dataset, variant, state, figure):
    metrics = {"vertices": 100, "components": 1, "components missed": 0, "pairs of triangles that cross": 0,
               "surface to mesh, mean (voxels)": figure, "surface to mesh, max (voxels)": figure,
               "smallest angle (degrees)": 10, "cold (s)": figure, "whole program (s)": figure,
               "peak memory (bytes)": figure}
    cells = [{"metric": name, "median": value} for name, value in metrics.items()]
    cells += [{"metric": name, "text": "true"} for name in ("topology is right", "proven")]
    return {"dataset": dataset, "variant": variant, "state": state, "cells": cells}

rows = []
for dataset, state in zip(("ball", "ring"), sys.argv[2:]):
    rows += [row(dataset, "DelIso", "done", 1), row(dataset, "Other", state, 2)]
results = types.SimpleNamespace(
    rows=rows, table={"experiment": "fields_error", "rows": rows}, datasets=lambda: ["ball", "ring"],
    variants=lambda: ["DelIso", "Other"], provenance=lambda: "Made up.", runs=lambda with_spread: "One run each.")
try:
    print(tables.compared_section(results))
except tables.Failure as failure:
    sys.exit(str(failure))
)script";

ProgramResult section(const std::string& of_ball, const std::string& of_ring) {
  return run_program_at("/usr/bin/python3", {"-B", "-c", kScript, (root() / "experiments").string(), of_ball, of_ring});
}

TEST(ComparedTables, AreNotMadeWithoutAnOpponent) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "needs python3";
  const ProgramResult none = section("failed", "failed");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_EQ(none.out, "");
  EXPECT_NE(none.err.find("fields_error: no run of Other ended well"), std::string::npos) << none.err;
}

TEST(ComparedTables, HaveACellUnderEveryHeader) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "needs python3";
  const ProgramResult one = section("done", "failed");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_NE(one.out.find("\nOurs loses nowhere.\n"), std::string::npos) << one.out;
  EXPECT_NE(one.out.find("\nFailed or not run: ring with Other.\n"), std::string::npos) << one.out;
  std::size_t wide = 0;
  for (const std::string& line : lines_of(one.out)) {
    const auto bars = std::count(line.begin(), line.end(), '|');
    if (bars <= 4) continue;
    EXPECT_EQ(bars, 13) << line;
    ++wide;
  }
  EXPECT_EQ(wide, 4u);  // a head, the line below it and two meshers
}

}  // namespace
}  // namespace deliso::testing
