// Tables: what becomes of records, against figures worked out by hand; and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/results/table.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/record_file.h"
#include "experiments/runs/run_record.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

// One data set, two variants; a reference, quotients and texts.
Experiment example(const std::string& rows) {
  Json document = small_document();
  document["datasets"] = Json::array({Json{{"name", "ball"}, {"field", "sphere"}, {"size", 8}}});
  document["rows"] = rows;
  document["metrics"] = parse_json(R"([
    {"name": "n", "value": "vertices", "variant": "fine", "reference": "n_paper", "ratio": true},
    {"name": "speedup", "value": "total_seconds", "variant": "coarse", "over": "fine"},
    {"name": "per", "value": "triangles", "per": "vertices", "variant": "fine"},
    {"name": "verdict", "value": "certificate.verdict", "variant": "fine"}])",
                                   "metrics");
  document["reference"] = Json{{"source", "a paper"}, {"rows", {{"ball", {{"n_paper", 40}}}}}};
  return parse_experiment(document, "small.json");
}

Json record(const std::string& variant, int repeat, double vertices, double triangles, double seconds,
            const std::string& verdict) {
  return Json{{"experiment", "small"},  {"dataset", "ball"},        {"variant", variant},
              {"repeat", repeat},       {"status", "done"},         {"vertices", vertices},
              {"triangles", triangles}, {"total_seconds", seconds}, {"certificate", {{"verdict", verdict}}}};
}

std::vector<Json> example_records() {
  return {record("fine", 3, 30, 60, 4, "different"), record("fine", 1, 10, 30, 1, "homeomorphic"),
          record("fine", 2, 20, 40, 2, "homeomorphic"), record("coarse", 1, 5, 9, 6, "homeomorphic"),
          record("coarse", 2, 5, 9, 8, "homeomorphic")};
}

TEST(TableCommand, FiguresAreMediansSpreadsQuotientsAndCounts) {
  const Table table = make_table(example("datasets"), example_records());
  ASSERT_EQ(table.rows.size(), 1u);
  const std::vector<TableCell>& cells = table.rows[0].cells;
  EXPECT_EQ(cells[0].ours.numbers, (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(cells[0].ours.median(), 20);
  EXPECT_EQ(cells[0].reference, 40);
  EXPECT_EQ(cells[0].ratio, 0.5);
  EXPECT_EQ(cells[1].ours.numbers, (std::vector<double>{3, 4}));  // 6 and 8 over the median 2
  EXPECT_EQ(cells[1].ours.median(), 3.5);
  EXPECT_EQ(cells[2].ours.numbers, (std::vector<double>{2, 2, 3}));
  EXPECT_EQ(cells[3].ours.text, "different (1), homeomorphic (2)");
  // One run is missing, and that is said.
  ASSERT_EQ(table.remarks.size(), 1u);
  EXPECT_EQ(table.remarks[0], "ball: 5 of 6 runs are finished");
}

TEST(TableCommand, TheOrderOfRecordsDoesNotMatter) {
  std::vector<Json> records = example_records();
  const std::string expected = table_markdown(example("datasets"), make_table(example("datasets"), records));
  std::sort(records.begin(), records.end());
  do {
    ASSERT_EQ(table_markdown(example("datasets"), make_table(example("datasets"), records)), expected);
  } while (std::next_permutation(records.begin(), records.end()));
}

TEST(TableCommand, MarkdownShowsPaperOursAndRatio) {
  const std::string text = table_markdown(example("datasets"), make_table(example("datasets"), example_records()));
  EXPECT_MESSAGE(text, "| data set | n, paper | n, ours | n, ours / paper | speedup | per | verdict |\n");
  EXPECT_MESSAGE(text, "| ball | 40 | 20 (10–30) | 0.5 | 3.5 (3–4) | 2 (2–3) | different (1), homeomorphic (2) |\n");
  EXPECT_MESSAGE(text, "Paper: a paper");
}

// Also what the base sets, which all variants share.
TEST(TableCommand, MarkdownNamesEveryParameterThatIsNotTheDefault) {
  Json document = small_document();
  const auto markdown = [&document] {
    const Experiment experiment = parse_experiment(document, "small.json");
    return table_markdown(experiment, make_table(experiment, {}));
  };
  EXPECT_MESSAGE(markdown(),
                 "\nThe parameters 'default' are the program's defaults with `initial.random_points` = 10.\n");
  EXPECT_MESSAGE(markdown(), "\n- fine: the parameters 'default'\n");
  EXPECT_MESSAGE(markdown(), "\n- coarse: the parameters 'default' with `stage2.epsilon1` = 0.3\n");
  document["base"]["set"] = Json{{"repair.max_rounds", 0}, {"queue_order", "fifo"}};
  EXPECT_MESSAGE(markdown(), " with `initial.random_points` = 10, `queue_order` = fifo, `repair.max_rounds` = 0.\n");
  document["base"] = Json{{"name", "plain"}, {"parameters", Json::object()}};
  document["variants"][0].erase("extends");
  EXPECT_MESSAGE(markdown(), "\nThe parameters 'plain' are the program's defaults.\n");
}

TEST(TableCommand, PublishedFiguresKeepAllTheirDigits) {
  Experiment experiment = example("datasets");
  const auto paper = [&experiment](const Json& value) {
    experiment.reference.rows["ball"]["n_paper"] = value;
    const std::string text = table_markdown(experiment, make_table(experiment, example_records()));
    const std::size_t begin = text.find("| ball | ") + 9;
    return text.substr(begin, text.find(" |", begin) - begin);
  };
  EXPECT_EQ(paper(1033.56), "1033.56");
  EXPECT_EQ(paper(2.8), "2.8");
  EXPECT_EQ(paper(1.54e-3), "1.54e-3");
  EXPECT_EQ(paper(280953), "280953");
  EXPECT_EQ(paper("64 64 64"), "64 64 64");
}

TEST(TableCommand, RunsWithoutRecordsAreNotRun) {
  const Table table = make_table(example("runs"), {});
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].state, RowState::kNotRun);
  EXPECT_MESSAGE(table_markdown(example("runs"), table), "| ball | fine | 40 | not run |");
}

TEST(TableCommand, RecordsOfAnotherExperimentAreRefused) {
  std::vector<Json> records = example_records();
  records[0]["experiment"] = "large";
  EXPECT_THROW(make_table(example("datasets"), records), InputError);
  records = example_records();
  records[0]["variant"] = "finer";
  EXPECT_THROW(make_table(example("datasets"), records), InputError);
}

TEST(TableCommand, CsvQuotesAndKeepsAllDigits) {
  Experiment experiment = example("datasets");
  experiment.metrics[0].name = "a, \"b\"";
  std::vector<Json> records = example_records();
  for (Json& one : records) one["total_seconds"] = 0.1;
  records[3]["total_seconds"] = 0.1 + 0.2;
  const std::string text = table_csv(experiment, make_table(experiment, records));
  EXPECT_MESSAGE(text, "ball,,done,\"a, \"\"b\"\"\",3,20.0,10.0,30.0,,40,0.5\n");
  EXPECT_MESSAGE(text, Json((0.1 + 0.2) / 0.1).dump());
}

TEST(TableCommand, FinishedRecordsGoBeforeOthersAndDuplicatesAreNoted) {
  const TemporaryFolder folder;
  Json failed = record("fine", 1, 0, 0, 0, "");
  failed["status"] = "failed";
  const Json done = record("fine", 1, 10, 30, 1, "homeomorphic");
  Json slower = done;
  slower["total_seconds"] = 7;
  write_file(folder / "records.1-of-2.jsonl", failed.dump() + "\n" + done.dump() + "\n");
  write_file(folder / "records.2-of-2.jsonl", slower.dump() + "\n" + failed.dump() + "\n");
  std::vector<std::string> notes;
  const std::vector<Json> merged = merge_records(example("datasets"), {folder.path()}, notes);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0], done);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_MESSAGE(notes[0], "ball, fine, repeat 1 is recorded twice");
  // The same run with another result cannot be: equal runs give equal meshes.
  Json other = done;
  other["vertices"] = 11;
  write_file(folder / "records.2-of-2.jsonl", other.dump() + "\n");
  EXPECT_THROW(merge_records(example("datasets"), {folder.path()}, notes), InputError);
}

TEST(TableCommand, ACutLastLineIsLeftOutAndABrokenOneNamed) {
  const TemporaryFolder folder;
  const std::string line = record("fine", 1, 10, 30, 1, "homeomorphic").dump();
  write_file(folder / "records.jsonl", line + "\n" + line.substr(0, 30));
  std::vector<std::string> notes;
  EXPECT_EQ(read_records(folder / "records.jsonl", notes).size(), 1u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_MESSAGE(notes[0], "line 2 is incomplete");
  for (const std::string& broken : {line.substr(0, 30), std::string("{}"), std::string("7")}) {
    write_file(folder / "records.jsonl", line + "\n" + broken + "\n" + line + "\n");
    try {
      read_records(folder / "records.jsonl", notes);
      FAIL() << broken;
    } catch (const InputError& error) {
      EXPECT_MESSAGE(std::string(error.what()), "records.jsonl line 2");
    }
  }
}

TEST(TableCommand, FiguresAreShortAndNeverLikeCode) {
  EXPECT_EQ(figure_text(0), "0");
  EXPECT_EQ(figure_text(-7), "-7");
  EXPECT_EQ(figure_text(184228), "184228");
  EXPECT_EQ(figure_text(181072.5), "181072");
  EXPECT_EQ(figure_text(999.96), "1000");
  EXPECT_EQ(figure_text(0.123456), "0.1235");
  EXPECT_EQ(figure_text(0.00154), "1.54e-3");
  EXPECT_EQ(figure_text(-1.36e-5), "-1.36e-5");
  EXPECT_EQ(figure_text(2e-10), "2e-10");
}

TEST(TableCommand, EveryPathOfARecordLeadsToAFigure) {
  for (const Task task : {Task::kMesh, Task::kTopology}) {
    const Json empty = empty_record(task, task == Task::kMesh);
    const std::vector<std::string> paths = record_paths(task, task == Task::kMesh);
    EXPECT_GT(paths.size(), 15u);
    for (const std::string& path : paths) EXPECT_FALSE(value_at(empty, path).is_object()) << path;
  }
  EXPECT_TRUE(value_at(Json{{"a", {{"b", 3}}}}, "a.c").is_null());
  EXPECT_EQ(value_at(Json{{"a", {{"b", 3}}}}, "a.b"), 3);
}

TEST(TableCommand, AnotherTableOfTheSameRunsNeedsNoNewRuns) {
  const TemporaryFolder folder;
  write_file(folder / "small.json", kSmallExperiment);
  ASSERT_EQ(run_deliso({"run", folder / "small.json", "--out", folder / "out"}).exit_code, 0);
  Json document = small_document();
  document["title"] = "Another table";
  document["metrics"] = parse_json(R"([{"name": "corners", "value": "triangles"}])", "metrics");
  document["plots"] = parse_json(R"([{"name": "bars", "title": "Bars", "kind": "bars", "y": ["corners"]}])", "plots");
  std::filesystem::create_directory(folder / "new");
  write_file(folder / "new/small.json", json_text(document));
  const std::vector<std::string> command = {"table",         folder / "out", "-o",
                                            folder / "more", "--experiment", folder / "new/small.json"};
  const ProgramResult result = run_deliso(command);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_MESSAGE(result.out, "# Another table\n");
  EXPECT_MESSAGE(result.out, "| data set | variant | corners |\n");
  EXPECT_EQ(read_file(folder / "more/table.md"), result.out);
  EXPECT_MESSAGE(read_file(folder / "more/bars.svg"), "ball, fine");
  // Other runs are refused, with what differs.
  document["variants"][1]["set"]["stage2.epsilon1"] = 0.4;
  write_file(folder / "new/small.json", json_text(document));
  const ProgramResult other = run_deliso(command);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_MESSAGE(other.err, "is not the experiment of these records: its key 'variants' differs");
}

// With file and line: a folder may hold many shards.
TEST(TableCommand, ARecordThatDoesNotBelongHereIsNamedWithItsPlaceAndWhatIsWrong) {
  const TemporaryFolder folder;
  write_file(folder / "small.json", kSmallExperiment);
  ASSERT_EQ(run_deliso({"run", folder / "small.json", "--out", folder / "out"}).exit_code, 0);
  std::vector<std::string> notes;
  const Json first = read_records(folder / "out/records.jsonl", notes).front();
  const std::string place = folder / "out/records.2-of-2.jsonl line 2: does not belong here: ";
  const auto expect_refused = [&](const std::string& key, const Json& value, const std::string& sentence) {
    Json record = first;
    record[key] = value;
    write_file(folder / "out/records.2-of-2.jsonl", first.dump() + "\n" + record.dump() + "\n");
    const ProgramResult result = run_deliso({"table", folder / "out"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, "deliso: " + place + sentence + "\n");
  };
  expect_refused("repeat", 99, "its repeat 99 is none of the experiment small, whose repeats are 1 to 3");
  expect_refused("repeat", 0, "its repeat 0 is none of the experiment small, whose repeats are 1 to 3");
  expect_refused("variant", "fin",
                 "its variant 'fin' is none of the experiment small; the nearest known name is \"fine\"");
  expect_refused("dataset", "rin",
                 "its data set 'rin' is none of the experiment small; the nearest known name is \"ring\"");
  expect_refused("experiment", "large", "it is of the experiment \"large\", not of the experiment small");
}

// The name, too, must be that of the records; most files have no key for it.
TEST(TableCommand, AnExperimentOfAnotherNameIsToldWhereTheNameComesFrom) {
  const TemporaryFolder folder;
  write_file(folder / "small.json", kSmallExperiment);
  ASSERT_EQ(run_deliso({"run", folder / "small.json", "--out", folder / "out"}).exit_code, 0);
  const std::string other = folder / "other.json";
  const auto refusal = [&](const Json& document) {
    write_file(other, json_text(document));
    const ProgramResult result = run_deliso({"table", folder / "out", "--experiment", other});
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  const std::string begin = "deliso: --experiment: " + other + " is not the experiment of these records: its name is ";
  Json document = small_document();
  EXPECT_EQ(refusal(document), begin + "'other' (that of the file, for it has no key 'name'), theirs is 'small'\n");
  document["name"] = "third";
  EXPECT_EQ(refusal(document), begin + "'third' (its key 'name'), theirs is 'small'\n");
  document["name"] = "small";
  write_file(other, json_text(document));
  EXPECT_EQ(run_deliso({"table", folder / "out", "--experiment", other}).exit_code, 0);
}

TEST(TableCommand, FoldersOfDifferentExperimentsAreRefused) {
  const TemporaryFolder folder;
  write_file(folder / "small.json", kSmallExperiment);
  Json other = small_document();
  other["repeats"] = 1;
  write_file(folder / "other.json", json_text(other));
  for (const std::string name : {"small", "other"}) {
    EXPECT_EQ(run_deliso({"run", folder / (name + ".json"), "--out", folder / name}).exit_code, 0);
  }
  const ProgramResult mixed = run_deliso({"table", folder / "small", folder / "other"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_MESSAGE(mixed.err, "another experiment");
  EXPECT_EQ(run_deliso({"table", folder / "nowhere"}).exit_code, 2);
}

}  // namespace
}  // namespace deliso::testing
