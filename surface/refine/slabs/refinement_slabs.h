// Stage 2 in parts: slabs of the volume that are refined independently, each with a mesh of its own.
//
// Triangles strictly within a slab belong to its part. Triangles that meet its planes are frozen: the part has them,
// but replaces none. A part may insert a star only if the star lies strictly between its planes. So the changes of one
// part can neither cross nor alter those of another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/slabs/refinement_planes.h"

namespace deliso {

// Which vertices a part moves at its end: those whose star is not frozen, or those that no other part has tried.
enum class Smoothing { kNone, kAll, kRest };

struct RefinementPart {
  RefinementMesh mesh;
  std::uint32_t frozen = 0;  // the number of frozen triangles, which come first
  Slab slab;
  std::optional<double> plane;  // across the slab's axis: if given, only triangles that meet it are to be refined
  Smoothing smoothing = Smoothing::kNone;
  std::span<const Vec3> coverage_targets;  // that it has to come near to
};

class RefinementSlabs {
 public:
  using RefinePart = std::function<void(std::size_t slab, RefinementPart& part)>;

  // Disjoint slabs of a mesh whose balls are known. `work` estimates the insertions that each triangle needs; room is
  // reserved for them. Keeps a reference to the mesh.
  RefinementSlabs(RefinementMesh& whole, const std::vector<Slab>& slabs, std::span<const float> work, int threads);

  // Cuts out part after part, has each refined, several at a time on several threads, and puts it back in place. Old
  // vertices keep their indices; new ones come in the order of the slabs. A part that is back leaves its memory to a
  // later one. So all parts together rarely need much more than the whole; only parts that wait for an earlier one are
  // stored in addition. Call once; after an exception the whole must not be used.
  void refine_each(const RefinePart& refine);

 private:
  // The indices in the whole of a part's first triangles and vertices.
  struct Origin {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> vertices;
    std::uint32_t frozen = 0;
  };

  void find_triangles();
  void make_room(std::span<const float> work);
  [[nodiscard]] RefinementPart cut_out(std::size_t slab);
  void fill(RefinementMesh& mesh, Origin& origin);
  void hand_in(std::size_t slab, RefinementPart part);
  void keep_memory(RefinementMesh& mesh);
  void put_back(const RefinementPart& part, const Origin& origin);

  RefinementMesh& whole_;
  std::vector<Slab> slabs_;
  int threads_;
  std::vector<Origin> origins_;
  std::size_t room_for_vertices_ = 0, room_for_triangles_ = 0;  // in each part

  // Only one thread at a time cuts out or puts back.
  std::mutex mutex_;
  std::vector<std::optional<RefinementPart>> refined_;  // parts that wait for earlier ones
  std::size_t cut_out_ = 0, put_back_ = 0;              // numbers of parts
  std::vector<RefinementMesh> spare_;                   // empty ones with room
  std::vector<std::uint32_t> local_triangle_;           // of each triangle at the start: its index in the part
  std::vector<std::uint32_t> local_vertex_;
  std::vector<std::uint32_t> suspects_;  // vertices that parts found suspect
};

}  // namespace deliso
