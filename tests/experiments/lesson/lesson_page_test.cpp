// The page of `deliso explain`: one file that holds its modules as they are, names nothing outside of itself, and leads
// to functions that exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "experiments/lesson/lesson_modules.h"
#include "experiments/lesson/lesson_page.h"
#include "tests/support/pages.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

const fs::path& lesson_folder() {
  static const fs::path kFolder = root() / "experiments/lesson";
  return kFolder;
}

bool is_module(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".js" || ending == ".css" || ending == ".html";
}

TEST(LessonPage, HoldsEveryModuleAsItIs) {
  const std::string page = lesson_page({});
  std::set<std::string> embedded;
  for (const LessonModule& module : lesson_modules()) {
    EXPECT_TRUE(embedded.insert(std::string(module.name)).second) << module.name << " stands twice";
    EXPECT_EQ(std::string(module.text), read_text(lesson_folder() / module.name)) << module.name;
    if (!module.name.ends_with(".js") && !module.name.ends_with(".css")) continue;  // put in as data, or around all
    EXPECT_NE(page.find(module.text), std::string::npos) << module.name;
  }
  for (const auto& entry : fs::recursive_directory_iterator(lesson_folder())) {
    if (!is_module(entry.path())) continue;
    const std::string name = fs::relative(entry.path(), lesson_folder()).string();
    EXPECT_TRUE(embedded.contains(name)) << name << " is missing in modules.txt";
  }
}

TEST(LessonPage, IsSmallAndTheSameForTheSameOptions) {
  EXPECT_EQ(lesson_page({}), lesson_page({}));
  EXPECT_NE(lesson_page({.seed = 2}), lesson_page({.seed = 3}));
  EXPECT_LE(lesson_page({}).size(), 2u << 20);
}

// Nothing is fetched: no element has a source or a reference but those within the page, and the policy says so.
TEST(LessonPage, NamesNoAddressOutsideOfIt) {
  const std::string page = lesson_page({});
  static const std::regex kAddress(R"((https?:)?//[a-z0-9.-]+\.[a-z]{2,}[^\s"'`]*)");
  for (std::sregex_iterator match(page.begin(), page.end(), kAddress), end; match != end; ++match) {
    EXPECT_TRUE((*match)[0].str().starts_with("http://www.w3.org/2000/svg")) << (*match)[0];  // the name of a language
  }
  EXPECT_FALSE(std::regex_search(page, std::regex(R"(<(script|img|link|iframe)[^>]*\s(src|href)=)")));
  EXPECT_FALSE(std::regex_search(page, std::regex(R"(\b(fetch|import)\s*\(|XMLHttpRequest|WebSocket)")));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(LessonPage, TitlesAndDataCannotLeaveTheirPlace) {
  const std::string page = lesson_page({.title = "</title></script><b>&"});
  EXPECT_NE(page.find("<title>&lt;/title>&lt;/script>&lt;b>&amp;</title>"), std::string::npos);
  EXPECT_EQ(page.find("\"</title>"), std::string::npos);
}

// The lines of pseudo-code name the file and the function where the same line of the program stands.
TEST(LessonPage, EveryLineOfPseudoCodeHasItsFunction) {
  static const std::regex kPlace(R"re((?:file: |at\("[^"]*",\s*)"(\w+/[^"]+)",\s*(?:name: )?"([^"]+)")re");
  int lines = 0;
  for (const LessonModule& module : lesson_modules()) {
    const std::string text(module.text);
    for (std::sregex_iterator match(text.begin(), text.end(), kPlace), end; match != end; ++match) {
      ++lines;
      const fs::path file = root() / (*match)[1].str();
      ASSERT_TRUE(fs::is_regular_file(file)) << module.name << " names " << file;
      EXPECT_TRUE(std::regex_search(read_text(file), std::regex("\\b" + (*match)[2].str() + "\\b")))
          << module.name << ": " << file << " does not name " << (*match)[2];
    }
  }
  EXPECT_GE(lines, 18);
}

// The rules for sources hold for scripts as well.
TEST(LessonPage, ModulesAreShort) {
  for (const LessonModule& module : lesson_modules()) {
    if (module.name.ends_with(".json") || module.name.ends_with(".md")) continue;  // pages of another folder
    const std::vector<std::string> lines = lines_of(std::string(module.text));
    EXPECT_LE(lines.size(), 300u) << module.name;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_LE(lines[i].size(), module.name.ends_with(".js") ? 130u : 300u) << module.name << ":" << i + 1;
    }
    if (!module.name.ends_with(".js")) continue;
    EXPECT_TRUE(lines[0].starts_with("// ")) << module.name << " does not say what it is for";
  }
}

TEST(ExplainCommand, WritesThePage) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_deliso({"explain", "-o", folder / "lesson.html", "--without-experiments", "--seed", "18446744073709551615"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("lesson.html"), std::string::npos);
  EXPECT_LE(read_file(folder / "lesson.html").size(), 2'000'000u);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"lesson.html"});
  // Nothing stands beside the page where it goes to standard output.
  const ProgramResult piped =
      run_deliso({"explain", "-o", "-", "--without-experiments", "--seed", "18446744073709551615"});
  EXPECT_EQ(piped.out, read_file(folder / "lesson.html"));
}

// A name is bytes to the file system; where JSON holds it, what is not UTF-8 becomes the replacement character.
TEST(ExplainCommand, TakesNamesThatAreNotUtf8) {
  const TemporaryFolder folder;
  const std::string volume = folder / "b\377.nrrd";
  ASSERT_EQ(run_deliso({"generate", "shells", "--size", "16", "-o", volume}).exit_code, 0);
  const ProgramResult result = run_deliso({"explain", volume, "--isovalue", "100.5", "--without-experiments", "-o",
                                           folder / "l.html", "--trace", folder / "t.jsonl"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::exists(folder / "l.html"));
  EXPECT_EQ(Json::parse(lines_of(read_file(folder / "t.jsonl")).at(0))["volume"], "b\uFFFD.nrrd");
}

TEST(ExplainCommand, WritesTraceAndTranscriptOfAVolume) {
  const TemporaryFolder folder;
  const std::string volume = folder / "shells.nrrd", trace = folder / "t.jsonl";
  ASSERT_EQ(run_deliso({"generate", "shells", "--size", "16", "-o", volume}).exit_code, 0);
  const ProgramResult result =
      run_deliso({"explain", volume, "--isovalue", "100.5", "--trace", trace, "--text", "--set", "stage2.rho=1.5"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = lines_of(read_file(trace)), sentences = lines_of(result.out);
  ASSERT_EQ(sentences.size() + 1, lines.size());
  EXPECT_NE(lines.front().find("deliso-trace-1"), std::string::npos);
  EXPECT_TRUE(sentences.front().starts_with("InitTriangulation: ")) << sentences.front();
  EXPECT_TRUE(sentences.back().starts_with("The end: ")) << sentences.back();
  EXPECT_NE(result.out.find("BuildTriMesh"), std::string::npos);
  // The mesh of the trace is that of the program.
  ASSERT_EQ(
      run_deliso({"mesh", volume, "--isovalue", "100.5", "-o", folder / "m.off", "--set", "stage2.rho=1.5"}).exit_code,
      0);
  const std::string counts = lines_of(read_file(folder / "m.off")).at(1);
  const Json end = Json::parse(lines.back());
  EXPECT_TRUE(counts.starts_with(std::to_string(end["vertices"].get<int>()) + " " +
                                 std::to_string(end["triangles"].get<int>()) + " "))
      << counts;
}

TEST(ExplainCommand, SaysWhatStoppedItsRun) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_deliso({"explain", "--set", "budget.max_vertices=16", "--text", "--trace", folder / "t.jsonl"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(result.err.starts_with("deliso: torus: stage ")) << result.err;
  EXPECT_NE(result.err.find("was stopped by budget.max_vertices = 16"), std::string::npos) << result.err;
  EXPECT_TRUE(lines_of(result.out).back().starts_with("The end: ")) << result.out;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"t.jsonl"});
}

TEST(ExplainCommand, RefusesInOneSentence) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"explain"}, "explain: -o LESSON (a page such as lesson.html), --trace or --text is required"},
      {{"explain", folder / "v.nrrd", "-o", folder / "a.html"}, "--isovalue is required with a volume"},
      {{"explain", "--isovalue", "1", "-o", folder / "a.html"}, "--isovalue needs a volume"},
      {{"explain", folder / "v.nrrd", "--isovalue", "1", "--text"}, "v.nrrd"},
      {{"explain", "-o", folder / "a.html", "--seed", "-1"}, "--seed"},
      {{"explain", "-o", folder / "a.html", "--seed", "x"}, "--seed"},
      {{"explain", "-o", folder / "none/a.html"}, "-o"},
      {{"explain", "-o", folder / "a.txt"}, "a.txt: the lesson is written as html, expected a name that ends in .html"},
      {{"explain", "--figure", "recover/3", "-o", folder / "a.png"}, "a.png: the figure is written as svg"},
      {{"explain", "-o", folder / "a.html", "--sede", "1"}, "the nearest is '--seed'"},
      {{"explain", "--text", "-o", "-"}, "-o: standard output is that of --text already"},
      {{"explain", "--text", "--trace", "-"}, "--trace: standard output is that of --text already"},
      {{"explain", "-o", "-", "--trace", "-"}, "--trace: standard output is that of -o already"},
  };
  for (const auto& [arguments, message] : cases) {
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace deliso::testing
