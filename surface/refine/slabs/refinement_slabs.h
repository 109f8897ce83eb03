// Stage 2 in parts: slabs of the volume that are refined apart from each other, each with a mesh of its own.
//
// Triangles that lie strictly within a slab belong to its part. Those that its planes meet are frozen: the part has
// them, but replaces none. A star belongs to a part only when it lies strictly between its planes, so what one part
// does can neither cross nor change what another does.
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

struct RefinementPart {
  RefinementMesh mesh;
  std::uint32_t frozen = 0;  // the first triangles are
  Slab slab;
  std::optional<double> plane;  // across the slab's axis: if given, only triangles that meet it are to be refined
  std::span<const Vec3> coverage_targets;  // that it has to come near to
};

class RefinementSlabs {
 public:
  using RefinePart = std::function<void(std::size_t slab, RefinementPart& part)>;

  // Disjoint slabs of a mesh whose balls are known. `work` estimates the insertions that each triangle needs: there is
  // room for them. Keeps a reference to the mesh.
  RefinementSlabs(RefinementMesh& whole, const std::vector<Slab>& slabs, std::span<const float> work, int threads);

  // Cuts out part after part, has each refined, on several threads at a time, and puts it back in place of what was cut
  // out. Old vertices keep their places; new ones come in the order of the slabs. The memory of a part that is back
  // serves a later one, so that as a rule all parts together need little more than the whole; only parts that wait for
  // an earlier one are kept beside it. To be called once; after an exception the whole is of no use.
  void refine_each(const RefinePart& refine);

 private:
  // Where the first triangles and vertices of a part are in the whole.
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

  // One thread at a time cuts out or puts back.
  std::mutex mutex_;
  std::vector<std::optional<RefinementPart>> refined_;  // parts that wait for earlier ones
  std::size_t cut_out_ = 0, put_back_ = 0;              // so many parts are
  std::vector<RefinementMesh> spare_;                   // empty ones with room
  std::vector<std::uint32_t> local_triangle_;           // of each triangle at the start: its place in the part
  std::vector<std::uint32_t> local_vertex_;
  std::vector<std::uint32_t> suspects_;  // vertices that parts found suspect
};

}  // namespace deliso
