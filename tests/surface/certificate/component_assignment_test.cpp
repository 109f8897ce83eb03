// Pieces of a mesh and the exact components that they count for, by hand.
#include "surface/certificate/component_assignment.h"

#include <gtest/gtest.h>

#include <vector>

#include "surface/certificate/mesh_pieces.h"

namespace deliso {
namespace {

using Numbers = std::vector<std::uint32_t>;

constexpr ComponentTopology kSphere{2, 0}, kDisk{1, 1};

AssignmentFaults faults(const Numbers& piece_of, const Numbers& component_of,
                        const std::vector<ComponentTopology>& pieces,
                        const std::vector<ComponentTopology>& components) {
  return assignment_faults({piece_of, component_of, pieces, components});
}

TEST(ComponentAssignment, OnePieceOnEachComponentIsRight) {
  EXPECT_TRUE(faults({0, 0, 1, 1}, {1, 1, 0, 0}, {kSphere, kDisk}, {kDisk, kSphere}).is_empty());
  // A few vertices of another component, and one that lies on none or has no triangle, do not count.
  EXPECT_TRUE(
      faults({0, 0, 0, 0, 1, 1, 9}, {0, 0, 1, kNoComponent, 1, 1, 1}, {kDisk, kDisk}, {kDisk, kDisk}).is_empty());
}

// Two components in one piece and one of them once more: the counts are right.
TEST(ComponentAssignment, APieceMayNotLieOnAnotherComponentAsMuchAsItsOwnPiece) {
  const AssignmentFaults found = faults({0, 0, 0, 0, 0, 1, 1}, {0, 0, 0, 1, 1, 1, 1}, {kDisk, kDisk}, {kDisk, kDisk});
  EXPECT_EQ(found.overrunning, Numbers{0});
  EXPECT_TRUE(found.without.empty() && found.repeated.empty() && found.unlike.empty());
}

// Vertices that may as well lie on their own component do not make a piece overrun another one.
TEST(ComponentAssignment, DoubtfulVerticesDoNotCount) {
  const Numbers piece_of{0, 0, 0, 0, 0, 1, 1}, component_of{0, 0, 0, 1, 1, 1, 1};
  const std::vector<ComponentTopology> disks{kDisk, kDisk};
  for (const std::uint32_t doubtful : {3u, 5u}) {
    const auto is_doubtful = [&](std::uint32_t v) { return v == doubtful; };
    const AssignmentFaults found = assignment_faults({piece_of, component_of, disks, disks, is_doubtful});
    EXPECT_EQ(found.overrunning, doubtful == 3 ? Numbers{} : Numbers{0});
  }
}

// A component left out on purpose needs no piece, and what lies on it counts for no fault.
TEST(ComponentAssignment, ComponentsLeftOutAreNotAskedFor) {
  const Numbers piece_of{0, 0, 0, 0}, component_of{0, 0, 0, 1};
  const std::vector<ComponentTopology> disk{kDisk}, disks{kDisk, kDisk};
  for (const bool is_dropped : {false, true}) {
    const std::vector<std::uint8_t> dropped{0, is_dropped ? std::uint8_t{1} : std::uint8_t{0}};
    const AssignmentFaults found = assignment_faults({piece_of, component_of, disk, disks, {}, dropped});
    EXPECT_EQ(found.is_empty(), is_dropped);
  }
}

TEST(ComponentAssignment, ComponentsWithoutAPieceAndWithTwoAreTold) {
  const AssignmentFaults found = faults({0, 0, 1}, {0, 0, 0}, {kDisk, kDisk}, {kDisk, kDisk});
  EXPECT_EQ(found.without, Numbers{1});
  EXPECT_EQ(found.repeated, Numbers{0});
}

TEST(ComponentAssignment, PiecesOfTheRightTopologiesInEachOthersPlacesAreTold) {
  const AssignmentFaults found = faults({0, 1}, {0, 1}, {kSphere, kDisk}, {kDisk, kSphere});
  EXPECT_EQ(found.unlike, (Numbers{0, 1}));
}

TEST(ComponentAssignment, FaultsTakeBackWhatCountsSeemToProve) {
  for (const bool has_faults : {false, true}) {
    Certificate certificate;
    certificate.verdict = Verdict::kHomeomorphic;
    AssignmentFaults found;
    if (has_faults) found.overrunning = {3};
    add_assignment_faults(found, certificate);
    EXPECT_EQ(certificate.verdict, has_faults ? Verdict::kDifferent : Verdict::kHomeomorphic);
    EXPECT_EQ(certificate.differences.size(), has_faults ? 1u : 0u);
  }
}

}  // namespace
}  // namespace deliso
