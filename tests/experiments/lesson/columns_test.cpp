// Columns of the page's data, made into values again by a reader of the tests' own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "delaunay/base/rng.h"
#include "experiments/lesson/columns.h"
#include "experiments/lesson/lesson_run.h"
#include "volume/fields/field_slices.h"

namespace deliso::testing {
namespace {

std::vector<unsigned> bytes_of(const std::string& base64_text) {
  const std::string symbols = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned> bytes;
  unsigned held = 0, bits = 0;
  for (const char c : base64_text) {
    if (c == '=') break;
    held = (held << 6 | static_cast<unsigned>(symbols.find(c))) & 0xffffu;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(held >> bits & 255u);
  }
  return bytes;
}

std::vector<Json> values_of(const Json& column, std::size_t count);

std::vector<Json> numbers_of(const Json& column) {
  const std::string text = column.at("ints");
  const std::vector<unsigned> bytes = bytes_of(text.substr(1));
  const std::size_t each = static_cast<std::size_t>(text[0] - '0'), count = bytes.size() / each;
  std::vector<Json> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t code = 0;
    for (std::size_t k = each; k-- > 0;) code = code * 256 + bytes[k * count + i];
    const std::int64_t number = code % 2 == 0 ? code / 2 : -(code + 1) / 2;
    if (column.contains("scaled")) {
      numbers.emplace_back(static_cast<double>(number) / column.at("scaled").get<double>());
    } else {
      numbers.emplace_back(number);
    }
  }
  return numbers;
}

std::vector<Json> arrays_of(const Json& column, std::size_t count) {
  std::vector<Json> arrays(count, Json::array());
  if (column.contains("parts")) {
    for (const Json& part : column.at("parts")) {
      const std::vector<Json> values = values_of(part, count);
      for (std::size_t i = 0; i < count; ++i) arrays[i].push_back(values[i]);
    }
    return arrays;
  }
  const std::vector<Json> sizes = values_of(column.at("sizes"), count);
  std::size_t total = 0, next = 0;
  for (const Json& size : sizes) total += size.get<std::size_t>();
  const std::vector<Json> items = values_of(column.at("items"), total);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < sizes[i].get<std::size_t>(); ++k) arrays[i].push_back(items[next++]);
  }
  return arrays;
}

std::vector<Json> values_of(const Json& column, std::size_t count) {
  if (column.contains("same")) return std::vector<Json>(count, column.at("same"));
  if (column.contains("values")) return column.at("values").get<std::vector<Json>>();
  return column.contains("ints") ? numbers_of(column) : arrays_of(column, count);
}

std::vector<Json> values_of_list(const Json& list) { return values_of(list.at("column"), list.at("count")); }

std::vector<Json> objects_of_list(const Json& list) {
  std::vector<std::vector<Json>> kinds;
  for (const Json& kind : list.at("kinds")) {
    kinds.emplace_back(kind.at("count").get<std::size_t>(), Json::object());
    for (const auto& item : kind.at("columns").items()) {
      const std::vector<Json> values = values_of(item.value(), kinds.back().size());
      for (std::size_t i = 0; i < values.size(); ++i) kinds.back()[i][item.key()] = values[i];
    }
  }
  std::vector<std::size_t> next(kinds.size(), 0);
  std::vector<Json> objects;
  for (const Json& kind : values_of_list(list.at("order"))) objects.push_back(kinds.at(kind)[next.at(kind)++]);
  return objects;
}

Json random_number(Rng& rng) {
  switch (rng.below(5)) {
    case 0:
      return static_cast<std::int64_t>(rng.below(7)) - 3;
    case 1:
      return static_cast<std::int64_t>(rng.below(2'000'000'001)) - 1'000'000'000;
    case 2:
      return static_cast<std::int64_t>(rng.below(1u << 17)) - 70000;
    case 3:
      return 1e9 * (rng.uniform() - 0.5);
    default:
      return static_cast<double>(static_cast<std::int64_t>(rng.below(4'000'000)) - 2'000'000) / 1e5;
  }
}

// Of one kind, that a column may have.
Json random_values(Rng& rng, std::size_t count) {
  const std::uint64_t kind = rng.below(6), size = rng.below(6);
  Json values = Json::array();
  const Json one = random_number(rng);
  for (std::size_t i = 0; i < count; ++i) {
    Json array = Json::array();
    const std::uint64_t its = kind == 1 ? size : rng.below(4);
    for (std::uint64_t k = 0; k < its; ++k) array.push_back(random_number(rng));
    if (kind <= 2) {
      values.push_back(kind == 2 ? Json::array({array, one}) : array);
    } else {
      values.push_back(kind == 3 ? random_number(rng) : kind == 4 ? one : Json("s" + std::to_string(rng.below(3))));
    }
  }
  return values;
}

TEST(LessonColumns, HoldTheirValues) {
  Rng rng(17);
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Json values = random_values(rng, rng.below(12));
    EXPECT_EQ(Json(values_of_list(list_of_values(values))), values);
  }
  for (const char* text : {"[]", "[[]]", "[[],[]]", "[0]", "[null,1]", "[1000000000,-1000000000]", "[3000000000]",
                           "[0.5,1]", "[[1,[2.5]],[3,[]]]", "[true,false]", "[\"\"]"}) {
    EXPECT_EQ(Json(values_of_list(list_of_values(Json::parse(text)))), Json::parse(text)) << text;
  }
}

// Six digits of a number, five behind the point of a coordinate.
bool is_near(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= 1e-5 + 1e-5 * std::abs(x);
  }
  if (a.is_array() && b.is_array()) return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_near);
  if (!a.is_object() || !b.is_object()) return a == b;
  bool are_near = a.size() == b.size();
  for (const auto& item : a.items())
    are_near = are_near && b.contains(item.key()) && is_near(item.value(), b.at(item.key()));
  return are_near;
}

// E in the numbers of the mesh, as the trace has it.
void number_by_mesh(Json& event) {
  if (event.at("e") != "refine") return;
  for (Json& triangle : event["gone"]) {
    for (Json& corner : triangle) corner = event["rim"].at(corner.get<std::size_t>());
  }
  if (!event.contains("t")) event["t"] = event["gone"].at(0);
}

using Triangles = std::multiset<std::set<int>>;

std::set<int> corners_of(const Json& triangle) { return {triangle.at(0), triangle.at(1), triangle.at(2)}; }

// The mesh that all events of a run without a restart make.
struct Mesh {
  std::vector<Json> points;
  Triangles triangles;

  void apply(const Json& event) {
    if (event.at("e") == "mesh") points = event.at("points").get<std::vector<Json>>();
    if (event.at("e") == "refine") points.push_back(event.at("p"));
    if (event.contains("at")) {
      points.resize(event.at("count"));
      for (std::size_t i = 0; i < event.at("at").size(); ++i) points.at(event.at("at")[i]) = event.at("points")[i];
    }
    if (event.at("e") != "mesh" && event.at("e") != "refine" && !event.contains("at")) return;
    for (const char* key : {"triangles", "come"}) {
      if (!event.contains(key)) continue;
      for (const Json& triangle : event.at(key)) triangles.insert(corners_of(triangle));
    }
    if (!event.contains("gone")) return;
    for (const Json& triangle : event.at("gone")) {
      const auto found = triangles.find(corners_of(triangle));
      ASSERT_NE(found, triangles.end()) << triangle << " is not there";
      triangles.erase(found);
    }
    if (event.at("e") != "refine") return;
    const Json& rim = event.at("rim");
    for (std::size_t i = 0; i < rim.size() - (event.at("closed") ? 0 : 1); ++i) {
      triangles.insert(corners_of(Json::array({event.at("v"), rim[i], rim[(i + 1) % rim.size()]})));
    }
  }
};

TEST(LessonColumns, ChangesOfShapeMakeTheMeshOfTheProgram) {
  for (const auto& [name, size, isovalue] : {std::tuple{"torus", 16, 0.7}, {"double_torus", 16, 500.5}}) {
    SCOPED_TRACE(name);
    const LessonRun run = run_observed(name, generate_field(name, size), isovalue, {});
    Mesh mesh;
    bool has_changes = false;
    for (Json event : objects_of_list(lesson_data(run, LessonPart::kWhole, run.events.size()).at("events"))) {
      number_by_mesh(event);
      EXPECT_NE(event.at("e"), "restart") << "another field is needed";
      has_changes = has_changes || event.contains("at");
      mesh.apply(event);
    }
    EXPECT_TRUE(has_changes);
    ASSERT_EQ(mesh.points.size(), run.result.mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const Vec3& p = run.result.mesh.points[v];
      EXPECT_TRUE(is_near(mesh.points[v], Json::array({p.x, p.y, p.z}))) << v << ": " << mesh.points[v];
    }
    Triangles expected;
    for (const auto& t : run.result.mesh.triangles) {
      expected.insert({static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
    }
    EXPECT_EQ(mesh.triangles, expected);
  }
}

TEST(LessonColumns, TheDataOfARunHaveItsWholeTrace) {
  const LessonRun run = run_observed("noise", generate_field("noise", 6), 127.5, {});
  const Json data = lesson_data(run, LessonPart::kWhole, run.events.size());
  std::vector<Json> events = objects_of_list(data.at("events"));
  ASSERT_EQ(events.size(), run.events.size());
  EXPECT_EQ(data.at("left_out"), 0);
  for (std::size_t i = 0; i < events.size(); ++i) {
    number_by_mesh(events[i]);
    if (events[i].contains("at")) continue;  // changes of shape
    const Json& kind = run.events[i].at("e");
    // Whatever stands on circumcenters of stage 1 needs every digit of its points.
    const char* const key = kind == "initial" ? "points" : kind == "insert" ? "p" : "e";
    EXPECT_EQ(events[i].at(key), run.events[i].at(key));
    EXPECT_TRUE(is_near(run.events[i], events[i])) << i << ": " << run.events[i] << " became " << events[i];
  }
}

TEST(LessonColumns, WhatIsLeftOutIsCounted) {
  const LessonRun run = run_observed("torus", generate_field("torus", 12), 0.7, {});
  const Json data = lesson_data(run, LessonPart::kWhole, 10);
  const std::vector<Json> events = objects_of_list(data.at("events"));
  EXPECT_GT(data.at("left_out"), 100);
  EXPECT_EQ(events.size() + data.at("left_out").get<std::size_t>(), run.events.size());
  EXPECT_EQ(events.back().at("e"), "end");
}

}  // namespace
}  // namespace deliso::testing
