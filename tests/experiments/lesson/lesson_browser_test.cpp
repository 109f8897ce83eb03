// The page in a real browser: `lesson.html#selftest` runs the tests of the page itself; here its result is read.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "experiments/lesson/lesson_experiments.h"
#include "experiments/lesson/lesson_page.h"
#include "experiments/lesson/lesson_run.h"
#include "tests/support/program_runner.h"
#include "volume/fields/field_slices.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

// Chromium, or what DELISO_BROWSER names; none where none is installed.
std::optional<fs::path> find_browser() {
  const char* const chosen = std::getenv("DELISO_BROWSER");
  if (chosen != nullptr && *chosen != '\0') return chosen;
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      if (fs::exists(fs::path(folder) / name)) return fs::path(folder) / name;
    }
  }
  return std::nullopt;
}

// The runs that the page of `deliso explain` plays.
const std::vector<LessonRun>& runs() {
  static const std::vector<LessonRun> kRuns = [] {
    std::vector<LessonRun> made;
    made.push_back(run_observed("torus", generate_field("torus", 16), 0.7, {}));
    made.push_back(run_observed("noise", generate_field("noise", 8), 127.5, {}));
    return made;
  }();
  return kRuns;
}

// What the browser makes of a page, once it is loaded; while its self-test runs, it counts as loading.
ProgramResult browse_page(const fs::path& browser, const std::string& page, const std::string& address) {
  const TemporaryFolder folder;
  write_file(folder / "lesson.html", page);
  return run_program_at(browser,
                        {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--user-data-dir=" + folder / "profile", "--window-size=1280,720", "--enable-logging=stderr",
                         "--dump-dom", "file://" + folder / "lesson.html" + address});
}

// The same of the page of `deliso explain` with this seed.
ProgramResult browse(const fs::path& browser, std::uint64_t seed, const std::string& address) {
  static const Json kExperiments = lesson_experiments(nullptr);
  return browse_page(browser, lesson_page({.seed = seed, .experiments = &kExperiments, .runs = &runs()}), address);
}

void expect_no_console_error(const ProgramResult& result) {
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(line.find(":CONSOLE"), std::string::npos) << line;
}

std::string text_of_page(const std::string& dom) {
  const std::string body = dom.substr(std::min(dom.find("id=\"lesson\""), dom.size()));
  return std::regex_replace(body.substr(0, 8000), std::regex("<[^>]*>"), "\n");
}

class LessonBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    browser_ = find_browser();
    if (!browser_) GTEST_SKIP() << "no Chromium is installed: apt-get install chromium, or name one in DELISO_BROWSER";
  }
  std::optional<fs::path> browser_;
};

// The self-test has made so many checks at least, and none has failed.
void expect_to_pass(const ProgramResult& result, int least_checks) {
  std::smatch match;
  ASSERT_TRUE(std::regex_search(result.out, match, std::regex(R"((\d+) passed, (\d+) failed)")))
      << text_of_page(result.out) << result.err;
  EXPECT_GT(std::stoi(match[1]), least_checks);
  EXPECT_EQ(match[2], "0") << text_of_page(result.out);
  expect_no_console_error(result);
}

class HeavyLessonBrowser : public LessonBrowser {};

constexpr const char* kWhole = "#selftest";
constexpr const char* kShort = "#selftest/short";

TEST_F(LessonBrowser, TheShortSelfTestPasses) { expect_to_pass(browse(*browser_, 1, kShort), 5000); }
TEST_F(HeavyLessonBrowser, TheSelfTestPasses) { expect_to_pass(browse(*browser_, 1, kWhole), 20000); }

// A run without a single insertion in stage 1, and as the run that shows refusals one without any: chapters of one
// step, and kinds of steps that nobody is asked for soon after the first.
const std::vector<LessonRun>& smallest_runs() {
  const auto run = [](const char* name, std::vector<float> samples, double isovalue) {
    return run_observed(name, ScalarGrid({2, 2, 2}, std::move(samples)), isovalue, {});
  };
  static const std::vector<LessonRun> kRuns = {run("corner", {1, 0, 0, 0, 0, 0, 0, 0}, 0.5),
                                               run("corners", {1, 0, 0, 0, 0, 0, 0, 1}, 0.2)};
  return kRuns;
}

TEST_F(LessonBrowser, TheShortSelfTestPassesOnTheSmallestVolumes) {
  expect_to_pass(browse_page(*browser_, lesson_page({.runs = &smallest_runs()}), kShort), 5000);
}
TEST_F(HeavyLessonBrowser, TheSelfTestPassesOnTheSmallestVolumes) {
  expect_to_pass(browse_page(*browser_, lesson_page({.runs = &smallest_runs()}), kWhole), 20000);
}

// A page opened there shows no failure.
void expect_to_open(const fs::path& browser, const std::string& address) {
  SCOPED_TRACE(address);
  const ProgramResult result = browse(browser, 7, address);
  EXPECT_NE(result.out.find(">2D lab</a>"), std::string::npos) << result.err;
  EXPECT_EQ(result.out.find("role=\"alert\""), std::string::npos) << text_of_page(result.out);
  expect_no_console_error(result);
}

// One of each kind; the self-test opens every chapter. Each takes a browser of its own, and seconds.
TEST_F(LessonBrowser, AddressesOpen) {
  for (const char* address : {"", "#recover/16", "#coding/disk"}) {
    expect_to_open(*browser_, address);
  }
}

TEST_F(HeavyLessonBrowser, EveryAddressOpens) {
  for (const char* address : {"#overview", "#delaunay/4", "#restricted/3", "#recover/9999", "#poles/7", "#refine/900",
                              "#guards/5", "#sweep/3", "#certificate", "#repair/5", "#configs/errata", "#plane/12",
                              "#plane/99999", "#plane/x", "#nowhere"}) {
    expect_to_open(*browser_, address);
  }
}

TEST_F(LessonBrowser, DrawsOneFigure) {
  const TemporaryFolder folder;
  const ProgramResult result = run_deliso({"explain", "--figure", "recover/2", "-o", folder / "a.svg"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string svg = read_file(folder / "a.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns=")) << svg.substr(0, 100);
  EXPECT_NE(svg.find("<title>MultiIntersect inserted vertex 15"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  const ProgramResult refused = run_deliso({"explain", "--figure", "recover/9999", "-o", folder / "b.svg"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("expected a step of recover from 0 to"), std::string::npos) << refused.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.svg"});
}

}  // namespace
}  // namespace deliso::testing
