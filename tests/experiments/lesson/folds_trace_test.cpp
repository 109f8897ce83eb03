// Runs with stage2.h_min: their traces have the flips of edges across folds, so that they can be replayed, too.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "experiments/lesson/followed_mesh.h"
#include "experiments/lesson/trace/trace_writer.h"
#include "experiments/lesson/trace/transcript.h"
#include "surface/deliso.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "tests/experiments/lesson/trace_replay.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

// Replays the trace as it comes, and compares with the live mesh of stage 2 before each insertion and at its end. The
// changes that the lesson is given are applied to a set of triangles of their own.
class FoldsWriter : public TraceWriter {
 public:
  FoldsWriter() : TraceWriter([this](const TraceEvent& event) { follow(event); }) {}

  void disk(const RefinementMesh& mesh, const RefinementDisk& e, const RefinementCandidate& candidate) override {
    if (flips > 0 && compared < 50) compare(mesh);
    TraceWriter::disk(mesh, e, candidate);
  }
  void improved(const RefinementMesh& mesh, std::string_view why) override {
    TraceWriter::improved(mesh, why);
    ++(why == "folds" ? flips : moves);
    compare(mesh);
  }
  void refined(const RefinementMesh& mesh) override {
    TraceWriter::refined(mesh);
    compare(mesh);
  }

  int flips = 0, moves = 0, compared = 0, as_changes = 0;

 private:
  void follow(const TraceEvent& event) {
    const TraceReplay::Json json = TraceReplay::Json::parse(event.dump());
    if (json.at("e") == "shape" && json.contains("why")) {
      const bool is_of_folds = json.at("why") == "folds";
      EXPECT_NE(sentence_of(event).find(is_of_folds ? "folds" : "angles"), std::string::npos);
      expect_changes(followed_.changes(json), json);
    }
    if (json.at("e") != "compare") followed_.follow(json);
    replay_.play(json);
  }

  void expect_changes(const TraceReplay::Json& changes, const TraceReplay::Json& shape) {
    EXPECT_EQ(changes.at("why"), shape.at("why"));
    if (!changes.contains("at")) return;  // the whole mesh
    ++as_changes;
    EXPECT_EQ(changes.at("at").empty(), shape.at("why") == "folds") << "flips move no vertex";
    std::multiset<TraceReplay::Corners> changed = replay_.triangles, expected;
    for (const auto& t : changes.at("gone")) changed.erase(changed.find(rotated(t)));
    for (const auto& t : changes.at("come")) changed.insert(rotated(t));
    for (const auto& t : shape.at("triangles")) expected.insert(rotated(t));
    EXPECT_EQ(changed, expected);
  }

  static TraceReplay::Corners rotated(const TraceReplay::Json& t) {
    return TraceReplay::rotated({t.at(0).get<int>(), t.at(1).get<int>(), t.at(2).get<int>()});
  }

  void compare(const RefinementMesh& mesh) {
    ++compared;
    std::multiset<TraceReplay::Corners> live;
    for (const auto& t : mesh.triangles) {
      live.insert(TraceReplay::rotated({int(t.corners[0]), int(t.corners[1]), int(t.corners[2])}));
    }
    EXPECT_EQ(replay_.triangles, live);
    ASSERT_EQ(replay_.mesh_points.size(), mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vec3& p = mesh.vertices[v].point;
      ASSERT_EQ(replay_.mesh_points[v], (std::array<double, 3>{p.x, p.y, p.z})) << v;
    }
  }

  TraceReplay replay_;
  FollowedMesh followed_;
};

TEST(TraceWithFlips, IsReplayedAndChangesNothing) {
  int told = 0, moves = 0, insertions_after = 0, as_changes = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ScalarGrid grid = generate_field("noise", 8, seed);
    MeshingOptions options;
    options.parameters.stage2.h_min = 0.05;
    const MeshingResult plain = mesh_isosurface(grid, 127.5, options);
    FoldsWriter writer;
    options.observer = &writer;
    const MeshingResult watched = mesh_isosurface(grid, 127.5, options);
    EXPECT_EQ(watched.mesh.points, plain.mesh.points) << seed;
    EXPECT_EQ(watched.mesh.triangles, plain.mesh.triangles) << seed;
    EXPECT_EQ(watched.refine.flips, plain.refine.flips) << seed;
    told += writer.flips;
    insertions_after += writer.compared - writer.flips - writer.moves;
    moves += writer.moves;
    EXPECT_EQ(writer.moves > 0, plain.refine.moves > 0) << seed;
    as_changes += writer.as_changes;
  }
  EXPECT_GE(told, 3);
  EXPECT_GT(moves, 0);
  EXPECT_GT(insertions_after, 6);
  EXPECT_GT(as_changes, 0);
}

}  // namespace
}  // namespace deliso
