#include "surface/base/parameter_table.h"

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace deliso {
namespace {

// The names of an enumeration's values in JSON, in the order of its enumerators.
constexpr std::array<std::string_view, 2> kAlgorithmNames = {"two_stage", "full3d"};
constexpr std::array<std::string_view, 2> kSeedingNames = {"components", "random"};
constexpr std::array<std::string_view, 2> kBoundaryNames = {"open", "closed"};
constexpr std::array<std::string_view, 2> kSpacingNames = {"use", "ignore"};
constexpr std::array<std::string_view, 2> kRMinOfNames = {"voxels", "box"};
constexpr std::array<std::string_view, 3> kQueueOrderNames = {"worst_first", "fifo", "largest_radius"};
constexpr std::array<std::string_view, 2> kCriterion2Names = {"circumradius", "shortest_edge"};
constexpr std::array<std::string_view, 2> kNewPoleNames = {"mean", "nearest"};
constexpr std::array<std::string_view, 3> kPoleHeightNames = {"nearer", "farther", "mean"};
constexpr std::array<std::string_view, 2> kSolverNames = {"schwarze", "bracketed"};
constexpr std::array<std::string_view, 2> kTraversalNames = {"kd_tree", "cell_walk"};

constexpr std::span<const std::string_view> names_of(Algorithm) { return kAlgorithmNames; }
constexpr std::span<const std::string_view> names_of(Seeding) { return kSeedingNames; }
constexpr std::span<const std::string_view> names_of(Boundary) { return kBoundaryNames; }
constexpr std::span<const std::string_view> names_of(SpacingUse) { return kSpacingNames; }
constexpr std::span<const std::string_view> names_of(RMinOf) { return kRMinOfNames; }
constexpr std::span<const std::string_view> names_of(QueueOrder) { return kQueueOrderNames; }
constexpr std::span<const std::string_view> names_of(Criterion2) { return kCriterion2Names; }
constexpr std::span<const std::string_view> names_of(NewPole) { return kNewPoleNames; }
constexpr std::span<const std::string_view> names_of(PoleHeight) { return kPoleHeightNames; }
constexpr std::span<const std::string_view> names_of(CubicSolver) { return kSolverNames; }
constexpr std::span<const std::string_view> names_of(Traversal) { return kTraversalNames; }

template <class T>
struct OptionalTraits {
  static constexpr bool kIsOptional = false;
  using Inner = T;
};
template <class T>
struct OptionalTraits<std::optional<T>> {
  static constexpr bool kIsOptional = true;
  using Inner = T;
};

// The table's type for each type of member. A number in a file may be written as an integer.
template <class T>
struct Codec {
  static constexpr ParameterType type() {
    if constexpr (std::is_enum_v<T>) return ParameterType::kChoice;
    if constexpr (std::is_same_v<T, bool>) return ParameterType::kBoolean;
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) return ParameterType::kInteger;
    return ParameterType::kNumber;
  }
  static ParameterValue encode(T value) {
    if constexpr (std::is_enum_v<T>) return names_of(value)[static_cast<std::size_t>(value)];
    if constexpr (std::is_same_v<T, bool>) return value;
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) return static_cast<std::int64_t>(value);
    if constexpr (std::is_floating_point_v<T>) return static_cast<double>(value);
  }
  static T decode(const ParameterValue& value) {
    if constexpr (std::is_enum_v<T>) {
      const std::span<const std::string_view> names = names_of(T{});
      std::size_t index = 0;
      while (names[index] != std::get<std::string_view>(value)) ++index;
      return static_cast<T>(index);
    } else if constexpr (std::is_same_v<T, bool>) {
      return std::get<bool>(value);
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(std::get<std::int64_t>(value));
    } else {
      return std::get<double>(value);
    }
  }
};

// The member that a path of member pointers leads to.
template <auto... Path, class Object>
constexpr auto& follow(Object& object) {
  return (object.*....*Path);
}

// A row of the table: the key path, then its description. Type, access and choices follow from the members.
template <auto... Path>
constexpr ParameterField row(std::string_view path, ParameterRange range, std::string_view unit,
                             std::string_view effect) {
  using Member = std::remove_cvref_t<decltype(follow<Path...>(std::declval<Parameters&>()))>;
  using Optional = OptionalTraits<Member>;
  using Value = typename Optional::Inner;
  ParameterField field;
  field.path = path;
  field.type = Codec<Value>::type();
  field.nullable = Optional::kIsOptional;
  field.range = range;
  field.unit = unit;
  field.effect = effect;
  if constexpr (std::is_enum_v<Value>) field.choices = names_of(Value{});
  if constexpr (std::is_same_v<Value, std::int32_t>) field.range.high = std::numeric_limits<std::int32_t>::max();
  // Beyond 2^53 the doubles of JSON cannot distinguish integers.
  if constexpr (std::is_same_v<Value, std::int64_t>) field.range.high = 0x1p53;
  field.get = [](const Parameters& parameters) -> ParameterValue {
    const Member& member = follow<Path...>(parameters);
    if constexpr (Optional::kIsOptional) {
      return member ? Codec<Value>::encode(*member) : ParameterValue();
    } else {
      return Codec<Value>::encode(member);
    }
  };
  field.set = [](Parameters& parameters, const ParameterValue& value) {
    Member& member = follow<Path...>(parameters);
    if constexpr (Optional::kIsOptional) {
      if (std::holds_alternative<std::monostate>(value)) return member.reset();
    }
    member = Codec<Value>::decode(value);
  };
  return field;
}

constexpr ParameterRange kAny{};
constexpr ParameterRange kPositive{0, true};
constexpr ParameterRange kNotNegative{0, false};
constexpr ParameterRange kDistance{kLeastDistance, false};
constexpr ParameterRange kEdge{kLeastMaxEdge, false};
constexpr ParameterRange kAtLeastOne{1, false};
constexpr ParameterRange kAtLeastThree{3, false};
constexpr ParameterRange kAtLeastFour{4, false};
constexpr ParameterRange kAngle{0, true, 35};
constexpr ParameterRange kAnyInteger{std::numeric_limits<std::int32_t>::min(), false};

// What both stages do.
constexpr std::string_view kTooHigh = "refine a triangle whose height over its circumradius is above this";
constexpr std::string_view kTooThin = "refine a triangle whose circumradius over its shortest edge is above this";

constexpr std::string_view kFirst = "the first sample along this axis; null: that of the volume";
constexpr std::string_view kLast = "the last sample along this axis, included; null: that of the volume";

using P = Parameters;
constexpr std::array kTable = {
    row<&P::algorithm>("algorithm", kAny, "",
                       "two_stage: recover the topology in 3D, then refine the surface alone; full3d: keep the 3D "
                       "triangulation to the end"),
    row<&P::initial, &InitialParameters::random_points>("initial.random_points", kNotNegative, "points",
                                                        "start with this many hits of random rays"),
    row<&P::initial, &InitialParameters::seeding>("initial.seeding", kAny, "",
                                                  "components: start with points on every component of the "
                                                  "isosurface; random: the random points alone"),
    row<&P::stage1, &Stage1Parameters::epsilon>("stage1.epsilon", kPositive, "-", kTooHigh),
    row<&P::stage1, &Stage1Parameters::rho>("stage1.rho", kAtLeastOne, "-", kTooThin),
    row<&P::stage1, &Stage1Parameters::r_min>("stage1.r_min", kNotNegative, "smallest side of the box",
                                              "no refinement for shape at or below this circumradius"),
    row<&P::stage1, &Stage1Parameters::size_bound_voxels>("stage1.size_bound_voxels", kNotNegative, "voxels",
                                                          "no insertion of any kind nearer than this to a vertex"),
    row<&P::stage1, &Stage1Parameters::coverage>(
        "stage1.coverage", kAny, "",
        "also sample parts of the surface that the mesh misses; the paper does "
        "not"),
    row<&P::stage1, &Stage1Parameters::one_sign_per_tetrahedron>(
        "stage1.one_sign_per_tetrahedron", kAny, "",
        "a facet is restricted when its tetrahedra differ in sign; false: when its own dual edge has an odd number of "
        "hits; needs certify, no coverage and repair.max_rounds = 0"),
    row<&P::stage2, &Stage2Parameters::epsilon1>("stage2.epsilon1", kPositive, "-", kTooHigh),
    row<&P::stage2, &Stage2Parameters::epsilon2>("stage2.epsilon2", kPositive, "-",
                                                 "refine a triangle whose circumradius over its mean pole height is "
                                                 "above this"),
    row<&P::stage2, &Stage2Parameters::rho>("stage2.rho", kAtLeastOne, "-", kTooThin),
    row<&P::stage2, &Stage2Parameters::r_min>("stage2.r_min", kNotNegative, "smallest side of the box",
                                              "no refinement at or below this circumradius"),
    row<&P::stage2, &Stage2Parameters::max_distance>("stage2.max_distance", kPositive, "voxels",
                                                     "refine a triangle whose height is above this; null: no bound"),
    row<&P::stage2, &Stage2Parameters::h_min>(
        "stage2.h_min", kNotNegative, "voxels",
        "no refinement for epsilon1 and epsilon2 of a triangle no larger than a voxel whose height is at or below "
        "this: at creases they would ask for r_min everywhere; null: 0.025, less with epsilons below the defaults, 0 "
        "with a stage2.rho below 2; 0: as in the paper"),
    row<&P::stage2, &Stage2Parameters::criterion2>("stage2.criterion2", kAny, "",
                                                   "which length of a triangle epsilon2 compares with the mean pole "
                                                   "height; circumradius is our reading of the paper"),
    row<&P::stage2, &Stage2Parameters::new_pole>("stage2.new_pole", kAny, "",
                                                 "a new vertex takes the mean pole height of its neighbours, as in the "
                                                 "paper, or that of the nearest"),
    row<&P::stage2, &Stage2Parameters::store_hits>("stage2.store_hits", kAny, "",
                                                   "keep the surface point of each triangle, as the paper does; false: "
                                                   "search it whenever it is needed"),
    row<&P::stage2, &Stage2Parameters::pole_height>("stage2.pole_height", kAny, "",
                                                    "which of a vertex's two poles gives its pole height; nearer is "
                                                    "the paper's, the others need repair.max_rounds = 0"),
    row<&P::r_min_of>("r_min_of", kAny, "",
                      "what r_min is a fraction of: 256 smallest spacings, whatever the volume's size, or the smallest "
                      "side of its box, as in the paper"),
    row<&P::queue_order>("queue_order", kAny, "", "which violation of the same kind is mended first"),
    row<&P::field, &FieldParameters::label>("field.label", kAnyInteger, "",
                                            "mesh the surface of the samples with this value, half-way between them "
                                            "and all others, whatever the isovalue; null: the samples as they are"),
    row<&P::field, &FieldParameters::smooth>("field.smooth", kPositive, "voxels",
                                             "mesh the field smoothed by a Gaussian of this standard deviation; null: "
                                             "the samples as they are"),
    row<&P::field, &FieldParameters::invert>("field.invert", kAny, "",
                                             "inside is below the isovalue: triangles face higher values, and closed "
                                             "closes that side"),
    row<&P::boundary>("boundary", kAny, "",
                      "open: the surface ends where it meets the box; closed: it goes on along the faces of the box, "
                      "around all that is inside"),
    row<&P::search, &SearchOptions::solver>("search.solver", kAny, "",
                                            "how the cubic of a ray in a voxel cell is solved; schwarze is the "
                                            "paper's"),
    row<&P::search, &SearchOptions::min_max_pruning>("search.min_max_pruning", kAny, "",
                                                     "drop nodes of the kd-tree whose values cannot hold the "
                                                     "isovalue"),
    row<&P::search, &SearchOptions::leaf_cells>("search.leaf_cells", kAtLeastOne, "voxel cells",
                                                "at most this many cells in a leaf of the kd-tree"),
    row<&P::search, &SearchOptions::incremental>("search.incremental", kAny, "",
                                                 "find the nearest hit by growing segments, not over the whole line"),
    row<&P::search, &SearchOptions::traversal>("search.traversal", kAny, "",
                                               "how the voxel cells of a segment are found; kd_tree is the paper's, "
                                               "with the two keys above; cell_walk goes from cell to cell"),
    row<&P::spacing>("spacing", kAny, "", "ignore: treat the volume as if its spacing were 1, as the paper does"),
    row<&P::certify>("certify", kAny, "", "compare the mesh with the exact topology of the isosurface"),
    row<&P::shape, &ShapeParameters::min_angle>("shape.min_angle", kAngle, "degrees",
                                                "improve triangles with a smaller angle after stage 2; null: 10, or "
                                                "the angle that a stage2.rho below 2 bounds, 30 for 1"),
    row<&P::shape, &ShapeParameters::smoothing>(
        "shape.smoothing", kNotNegative, "passes",
        "at the end of stage 2 move vertices along the isosurface so often to where the angles around them are larger; "
        "0: never, nor if shape.rounds is 0 or size.max_error or size.target_vertices is given"),
    row<&P::shape, &ShapeParameters::rounds>("shape.rounds", kNotNegative, "rounds",
                                             "improve badly shaped triangles at most this often, each time in wider "
                                             "surroundings; 0: never, nor if repair.max_rounds is 0"),
    row<&P::promise, &PromiseParameters::max_distance>(
        "promise.max_distance", kDistance, "voxels",
        "a proven mesh and its isosurface are within this of each other; where they are not, refinement goes on "
        "(unless repair.max_rounds is 0)"),
    row<&P::size, &SizeParameters::max_error>("size.max_error", kDistance, "voxels",
                                              "mesh and isosurface are within this of each other: promised in place of "
                                              "promise.max_distance; the mesh gets as "
                                              "few vertices as that allows, without criteria 1 and 2 of stage 2"),
    row<&P::size, &SizeParameters::max_edge>("size.max_edge", kEdge, "voxels", "no edge is longer, if possible"),
    row<&P::size, &SizeParameters::min_angle>("size.min_angle", kAngle, "degrees",
                                              "no angle is smaller, as far as that can be: sets both rho and "
                                              "shape.min_angle"),
    row<&P::size, &SizeParameters::max_aspect>("size.max_aspect", kAtLeastThree, "-",
                                               "no triangle's longest edge over its smallest height is larger, as far "
                                               "as that can be: a size.min_angle"),
    row<&P::size, &SizeParameters::target_vertices>(
        "size.target_vertices", kAtLeastFour, "vertices",
        "so many vertices within 2 %, the least error first; what is promised grows to the distance that takes, unless "
        "size.max_error is given"),
    row<&P::components, &ComponentParameters::fill_cavities>(
        "components.fill_cavities", kAny, "",
        "leave out closed components that bound a hole in what is inside, and all within them"),
    row<&P::components, &ComponentParameters::min_vertices>(
        "components.min_vertices", kAtLeastOne, "vertices",
        "leave out components with fewer vertices, before a stated size removes some"),
    row<&P::components, &ComponentParameters::min_area>("components.min_area", kPositive, "voxels^2",
                                                        "leave out components of a smaller area"),
    row<&P::components, &ComponentParameters::min_volume>(
        "components.min_volume", kPositive, "voxels^3",
        "leave out closed components that enclose less; open ones stay"),
    row<&P::components, &ComponentParameters::keep_largest>("components.keep_largest", kAtLeastOne, "components",
                                                            "keep so many components, those of the largest area"),
    row<&P::region, &RegionParameters::i0>("region.i0", kNotNegative, "samples", kFirst),
    row<&P::region, &RegionParameters::i1>("region.i1", kNotNegative, "samples", kLast),
    row<&P::region, &RegionParameters::j0>("region.j0", kNotNegative, "samples", kFirst),
    row<&P::region, &RegionParameters::j1>("region.j1", kNotNegative, "samples", kLast),
    row<&P::region, &RegionParameters::k0>("region.k0", kNotNegative, "samples", kFirst),
    row<&P::region, &RegionParameters::k1>("region.k1", kNotNegative, "samples", kLast),
    row<&P::repair, &RepairParameters::max_rounds>("repair.max_rounds", kNotNegative, "rounds",
                                                   "mend at most this often where the topology differs; 0: never"),
    row<&P::budget, &BudgetParameters::seconds>("budget.seconds", kPositive, "seconds",
                                                "stop after this wall-clock time; null: no limit"),
    row<&P::budget, &BudgetParameters::max_vertices>("budget.max_vertices", kAtLeastFour, "vertices",
                                                     "stop at this many vertices; null: no limit"),
};

}  // namespace

std::span<const ParameterField> parameter_table() { return kTable; }

}  // namespace deliso
