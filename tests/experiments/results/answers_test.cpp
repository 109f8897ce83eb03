// Answers: figures put in from records that were made up, claims that hold and claims that do not, and what is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/results/answers.h"
#include "experiments/runs/answer_config.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

// The small experiment with these answers.
Json document_with(const std::string& answers) {
  Json document = small_document();
  document["question"] = "How many?";
  document["answers"] = parse_json(answers, "answers");
  return document;
}

Json made_up_record(const std::string& variant, int repeat, double vertices, const std::string& verdict) {
  return Json{
      {"experiment", "small"}, {"dataset", "ball"},    {"variant", variant}, {"repeat", repeat},
      {"status", "done"},      {"vertices", vertices}, {"total_seconds", 1}, {"certificate", {{"verdict", verdict}}}};
}

// "fine" has 10, 20 and 30 vertices, "coarse" 5, 5 and 5.
AnswerText answer_of(const std::string& answers) {
  const Experiment experiment = parse_experiment(document_with(answers), "small.json");
  std::vector<Json> records;
  for (int repeat = 1; repeat <= 3; ++repeat) {
    records.push_back(made_up_record("fine", repeat, 10 * repeat, "homeomorphic"));
    records.push_back(made_up_record("coarse", repeat, 5, repeat == 2 ? "different" : "homeomorphic"));
  }
  return answer_text(experiment, make_table(experiment, records));
}

// The sentences that say which of these claims are not true.
std::vector<std::string> untrue(const std::string& claims) {
  return answer_of(R"([{"text": "So.", "holds": [)" + claims + "]}]").untrue;
}

TEST(Answers, FiguresStandInTheText) {
  const std::string text = answer_of(R"([
    {"text": "{ball|fine|vertices} of {ball|coarse|vertices}: {ball|fine over coarse|vertices} times, {ball|fine|verdict}."},
    {"text": "{ball|fine|vertices|smallest} {ball|fine|vertices|median} {ball|fine|vertices|largest} {ball|coarse|verdict}"},
    {"text": "{ring|fine|vertices} { stays"}])")
                               .markdown;
  EXPECT_MESSAGE(text, "\n## Answer\n\n20 (10–30) of 5: 4 times, homeomorphic.\n");
  EXPECT_MESSAGE(text, "\n10 20 30 different (1), homeomorphic (2)\n");
  EXPECT_MESSAGE(text, "\n– { stays\n");  // of runs that were not made
}

TEST(Answers, AClaimHoldsWhenItHoldsInEveryRun) {
  EXPECT_EQ(untrue(R"({"figure": "ball|fine|vertices", "is": "above", "than": 9},
                      {"figure": "ball|fine|vertices", "is": "at_least", "than": 10},
                      {"figure": "ball|fine|vertices", "is": "at_most", "than": 30},
                      {"figure": "ball|fine|vertices", "is": "below", "than": 31},
                      {"figure": "ball|fine|vertices|median", "is": "equal", "than": 20},
                      {"figure": "ball|fine over coarse|vertices", "is": "equal", "than": 4},
                      {"figure": "ball|coarse|vertices", "is": "equal", "than": 5},
                      {"figure": "ball|coarse|vertices", "is": "below", "than": "{ball|fine|vertices}"},
                      {"figure": "ball|fine|verdict", "is": "equal", "than": "homeomorphic"})"),
            std::vector<std::string>());
}

TEST(Answers, AClaimThatOneRunRefutesIsNamedWithWhatWasFound) {
  const std::vector<std::string> sentences = untrue(R"({"figure": "ball|fine|vertices", "is": "above", "than": 10},
                {"figure": "ball|fine|vertices", "is": "equal", "than": 20},
                {"figure": "ball|fine|vertices|smallest", "is": "at_least", "than": "{ball|fine|vertices|median}"},
                {"figure": "ball|coarse|verdict", "is": "equal", "than": "homeomorphic"},
                {"figure": "ball|fine|vertices", "is": "equal", "than": "homeomorphic"},
                {"figure": "ring|fine|vertices", "is": "at_least", "than": 0})");
  EXPECT_EQ(sentences, (std::vector<std::string>{
                           "ball|fine|vertices is 20 (10–30), expected: above 10",
                           "ball|fine|vertices is 20 (10–30), expected: equal to 20",
                           "ball|fine|vertices|smallest is 10, expected: at least 20",
                           "ball|coarse|verdict is different (1), homeomorphic (2), expected: equal to homeomorphic",
                           "ball|fine|vertices is 20 (10–30), expected: equal to homeomorphic",
                           "ring|fine|vertices is –, expected: at least 0"}));
}

TEST(Answers, WhatRefersToNothingIsRefusedWithItsPlace) {
  const auto refusal = [](const std::string& answers) {
    try {
      parse_experiment(document_with(answers), "small.json");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(R"([{"text": "{ball|fine|vertexes}"}])"),
            "small.json#/answers/0/text names no metric: 'vertexes'; the nearest known name is \"vertices\"");
  EXPECT_EQ(refusal(R"([{"text": "{bal|fine|vertices}"}])"),
            "small.json#/answers/0/text names no data set: 'bal'; the nearest known name is \"ball\"");
  EXPECT_MESSAGE(refusal(R"([{"text": "{fine}"}])"), "refers to a figure as DATASET|VARIANT|METRIC, not as 'fine'");
  EXPECT_MESSAGE(refusal(R"([{"text": "{ball|fine|vertices|least}"}])"),
                 "none of smallest, median and largest: 'least'");
  const auto claim = [&](const std::string& rest) {
    return refusal(R"([{"text": "So.", "holds": [{"figure": "ball|fine|vertices", )" + rest + "}]}]");
  };
  EXPECT_MESSAGE(claim(R"("is": "greater", "than": 1)"), "#/answers/0/holds/0/is must be one of 'equal', 'below'");
  EXPECT_MESSAGE(claim(R"("is": "above", "than": "many")"),
                 "#/answers/0/holds/0/is can only be 'equal' where 'than' is a text");
  EXPECT_MESSAGE(claim(R"("is": "above", "than": "{bal|fine|vertices}")"), "holds/0/than names no data set: 'bal'");
  EXPECT_MESSAGE(claim(R"("is": "above", "than": null)"), "holds/0/than must be a number or a string");
  Json document = document_with(R"([{"text": "So."}])");
  document.erase("question");
  EXPECT_THROW(parse_experiment(document, "small.json"), InputError);
}

// A reader who tries other values in a sweep gives its variants other names.
TEST(Answers, WhatIsSaidOfVariantsThatAreGoneIsLeftOutWithALine) {
  const std::string answers = R"([{"text": "{ball|thin|vertices}, {ball|fine|vertices}.", "holds": [
      {"figure": "ball|fine|vertices", "is": "at_least", "than": 10},
      {"figure": "ball|thin|vertices", "is": "equal", "than": 3},
      {"figure": "ball|fine over coars|vertices", "is": "equal", "than": 3},
      {"figure": "ball|fine|vertices", "is": "equal", "than": "{ball||vertices}"}]}])";
  const AnswerText answer = answer_of(answers);
  EXPECT_EQ(answer.untrue, std::vector<std::string>());
  EXPECT_MESSAGE(answer.markdown, "\n–, 20 (10–30).\n");
  const std::string left_out =
      "what the answers say of 'thin', 'coars', '' is left out: the experiment has no such variant\n";
  EXPECT_MESSAGE(answer.markdown, "1 of 1 statements of this answer hold.\n- " + left_out);
  const TemporaryFolder folder;
  write_file(folder / "small.json", json_text(document_with(answers)));
  const ProgramResult run = run_deliso({"run", folder / "small.json", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "deliso: question: How many?\ndeliso: " + left_out);
}

TEST(Answers, AreReadBackAsTheyWereWritten) {
  const Experiment experiment = parse_experiment(
      document_with(R"([{"text": "{ball|fine|vertices}", "holds": [{"figure": "ball|fine|vertices", "is": "at_most",
                         "than": "{ring|fine|vertices|largest}"}]}])"),
      "small.json");
  const Json written = experiment_to_json(experiment);
  EXPECT_EQ(experiment_to_json(parse_experiment(written, "elsewhere/experiment.json")), written);
  EXPECT_EQ(written["answers"], document_with(written["answers"].dump())["answers"]);
}

// As a user meets them: the question before the runs, the answer on request and nowhere else.
TEST(Answers, ArePrintedOnRequestAlone) {
  const TemporaryFolder folder;
  const std::string truth =
      R"([{"text": "Here it is.", "holds": [{"figure": "ball|fine|vertices", "is": "above", "than": 4}]}])";
  write_file(folder / "small.json", json_text(document_with(truth)));
  const ProgramResult run = run_deliso({"run", folder / "small.json", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "deliso: question: How many?\n");
  EXPECT_MESSAGE(run.out, "\nHow many?\n\nDecide what you expect before you read the table;");
  EXPECT_EQ(run.out.find("Here it is"), std::string::npos);

  const ProgramResult table = run_deliso({"table", folder / "out", "--answers"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_EQ(table.out, run.out +
                           "\n## Answer\n\nHere it is.\n\nCompared with the records: 1 of 1 statements of this "
                           "answer hold.\n");
  EXPECT_EQ(read_file(folder / "out/table.md"), run.out);

  // Other words for the same runs, untrue ones: said, with exit code 1.
  const std::string wrong =
      R"([{"text": "Here it is.", "holds": [{"figure": "ball|fine|vertices", "is": "below", "than": 4}]}])";
  std::filesystem::create_directory(folder / "new");
  write_file(folder / "new/small.json", json_text(document_with(wrong)));
  const ProgramResult untrue =
      run_deliso({"table", folder / "out", "--answers", "--experiment", folder / "new/small.json"});
  EXPECT_EQ(untrue.exit_code, 1);
  EXPECT_MESSAGE(untrue.out, "0 of 1 statements of this answer hold.\n- not so: ball|fine|vertices is ");
  EXPECT_MESSAGE(untrue.err, "deliso: the answer does not hold: ball|fine|vertices is ");

  write_file(folder / "new/small.json", kSmallExperiment);
  const ProgramResult none =
      run_deliso({"table", folder / "out", "--answers", "--experiment", folder / "new/small.json"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err, "deliso: --answers: the experiment small has no answers (its key 'answers')\n");
}

}  // namespace
}  // namespace deliso::testing
