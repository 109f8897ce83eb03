// The validator must find what is broken: each test damages a good triangulation in one way.
#include "delaunay/validate.h"

#include <gtest/gtest.h>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

class Damaged : public BowyerWatson {
 public:
  explicit Damaged(std::uint64_t seed) : BowyerWatson({{-9, -9, -9}, {9, 9, 9}}) {
    Rng rng(seed);
    build(test::random_points(60, rng));
  }
  // A finite tetrahedron, or a ghost.
  TetId first(bool ghost) {
    for (std::size_t i = 0; i < tet_slots(); ++i) {
      if (is_live(TetId(i)) && is_ghost(TetId(i)) == ghost) return TetId(i);
    }
    return TetId();
  }
  using BowyerWatson::incident_;
  using BowyerWatson::points_;
  using BowyerWatson::tets_;
};

bool contains(const std::optional<std::string>& violation, const std::string& part) {
  return violation && violation->find(part) != std::string::npos;
}

TEST(Validate, AcceptsAGoodTriangulation) {
  const Damaged tets(1);
  EXPECT_EQ(find_violation(tets), std::nullopt);
  EXPECT_EQ(find_delaunay_violation_by_brute_force(tets), std::nullopt);
}

TEST(Validate, FindsATurnedTetrahedron) {
  Damaged tets(2);
  auto& tet = tets.tets_[tets.first(false).index()];
  std::swap(tet.vertices[0], tet.vertices[1]);
  std::swap(tet.mirrors[0], tet.mirrors[1]);
  EXPECT_TRUE(find_violation(tets));
  EXPECT_TRUE(contains(find_orientation_violation(tets), "is not positively oriented"));
}

TEST(Validate, FindsAWrongMirror) {
  Damaged tets(3);
  auto& tet = tets.tets_[tets.first(false).index()];
  tet.mirrors[2] = tet.mirrors[1];
  EXPECT_TRUE(contains(find_combinatorial_violation(tets), "is not the mirror of its mirror"));
}

TEST(Validate, FindsADeadNeighbour) {
  Damaged tets(4);
  const TetId dead = tets.neighbour(tets.first(false), 0);
  tets.tets_[dead.index()].vertices[0] = VertexId::none();
  EXPECT_TRUE(contains(find_combinatorial_violation(tets), "has no live neighbour"));
}

TEST(Validate, FindsARepeatedVertexAndAMisplacedInfiniteOne) {
  Damaged twice(5);
  auto& tet = twice.tets_[twice.first(false).index()];
  tet.vertices[1] = tet.vertices[2];
  EXPECT_TRUE(contains(find_combinatorial_violation(twice), "twice"));
  Damaged misplaced(5);
  auto& ghost = misplaced.tets_[misplaced.first(true).index()];
  std::swap(ghost.vertices[2], ghost.vertices[3]);
  EXPECT_TRUE(contains(find_combinatorial_violation(misplaced), "no valid vertex in slot 2"));
}

TEST(Validate, FindsAForeignVertex) {
  Damaged tets(6);
  auto& tet = tets.tets_[tets.first(false).index()];
  for (std::size_t v = 0; v < tets.vertex_count(); ++v) {
    if (std::find(tet.vertices.begin(), tet.vertices.end(), VertexId(v)) != tet.vertices.end()) continue;
    tet.vertices[3] = VertexId(v);
    break;
  }
  EXPECT_TRUE(contains(find_combinatorial_violation(tets), "have different vertices"));
}

TEST(Validate, FindsAWrongIncidentTetrahedron) {
  Damaged tets(7);
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) {
    const auto& v = tets.vertices(TetId(i));
    if (std::find(v.begin(), v.end(), VertexId(std::size_t{5})) == v.end()) tets.incident_[5] = TetId(i);
  }
  EXPECT_TRUE(contains(find_combinatorial_violation(tets), "vertex 5 has no live incident tetrahedron"));
}

// A vertex moves within its star: orientations stay good, circumballs do not.
TEST(Validate, FindsAVertexInAForeignBall) {
  int found = 0;
  for (std::uint64_t seed = 10; seed < 60; ++seed) {
    Damaged tets(seed);
    Rng rng(seed);
    tets.points_[30] += Vec3{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)};
    if (find_orientation_violation(tets)) continue;
    // The local and the exhaustive check agree (Delaunay lemma).
    EXPECT_EQ(find_delaunay_violation(tets).has_value(), find_delaunay_violation_by_brute_force(tets).has_value());
    found += contains(find_violation(tets), "is in conflict with");
  }
  EXPECT_GT(found, 5);
}

// The hull must be convex: pull a hull vertex deep inside.
TEST(Validate, FindsADentInTheHull) {
  Damaged tets(8);
  const VertexId hull = tets.vertices(tets.first(true))[0];
  tets.points_[hull.index()] = {0.5, 0.5, 0.5};
  EXPECT_TRUE(find_orientation_violation(tets));
}

}  // namespace
}  // namespace deliso
