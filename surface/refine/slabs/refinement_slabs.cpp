#include "surface/refine/slabs/refinement_slabs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// Arrays get room for the expected size times this, so that they need not grow, which would copy them and take new
// pages twice. The estimates are too low for small rho, and joined parts are refined further. Unused room takes no
// pages.
constexpr std::size_t kRoom = 2;
// The largest number of insertions per initial triangle for which room is reserved.
constexpr double kMostGrowth = 32;

// The positions of vertices relative to the planes of disjoint slabs, one number per vertex. Triangles read these at
// random, and the numbers take less memory than points.
class PlacesAmongPlanes {
 public:
  PlacesAmongPlanes(const RefinementMesh& mesh, const std::vector<Slab>& slabs, int threads)
      : slabs_(slabs.size()), place_(mesh.vertices.size()) {
    std::vector<std::size_t> in_order(slabs.size());
    std::iota(in_order.begin(), in_order.end(), std::size_t{0});
    std::sort(in_order.begin(), in_order.end(), [&](std::size_t a, std::size_t b) {
      return std::tie(slabs[a].low, slabs[a].high) < std::tie(slabs[b].low, slabs[b].high);
    });
    for (const std::size_t k : in_order) {
      slabs_[k].low = add_plane(slabs[k].low);
      slabs_[k].high = add_plane(slabs[k].high);
    }
    const std::size_t axis = slabs.front().axis;
    for_each_block(place_.size(), threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) place_[v] = place_of(mesh.vertices[v].point[axis]);
    });
  }

  // Calls visit(slab, is_within) for the slabs that a triangle meets; a slab includes its planes here.
  template <class Visit>
  void for_each_slab(const std::array<std::uint32_t, 3>& corners, Visit&& visit) const {
    const auto [low, high] = std::minmax({place_[corners[0]], place_[corners[1]], place_[corners[2]]});
    for (std::size_t k = 0; k < slabs_.size(); ++k) {
      if (high < slabs_[k].low || slabs_[k].high < low) continue;
      visit(k, slabs_[k].low < low && high < slabs_[k].high);
    }
  }

 private:
  using Place = std::uint16_t;  // even: between planes; odd: on a plane

  // Adds a plane, which must not lie below those added before, and returns its position.
  Place add_plane(double x) {
    DELISO_CHECK(planes_.empty() || planes_.back() <= x, "slabs are disjoint");
    if (planes_.empty() || planes_.back() < x) planes_.push_back(x);
    return static_cast<Place>(2 * planes_.size() - 1);
  }
  [[nodiscard]] Place place_of(double x) const {
    const auto plane = std::lower_bound(planes_.begin(), planes_.end(), x);
    const auto below = static_cast<std::size_t>(plane - planes_.begin());
    return static_cast<Place>(2 * below + (plane != planes_.end() && *plane == x ? 1 : 0));
  }

  struct Between {
    Place low, high;
  };
  std::vector<double> planes_;  // strictly ascending
  std::vector<Between> slabs_;  // the positions of their two planes
  std::vector<Place> place_;    // of each vertex
};

}  // namespace

RefinementSlabs::RefinementSlabs(RefinementMesh& whole, const std::vector<Slab>& slabs, std::span<const float> work,
                                 int threads)
    : whole_(whole),
      slabs_(slabs),
      threads_(threads),
      origins_(slabs.size()),
      refined_(slabs.size()),
      local_triangle_(whole.triangles.size(), kNoSide),
      local_vertex_(whole.vertices.size(), kNoSide) {
  if (slabs_.empty()) return;
  find_triangles();
  make_room(work);
}

// Finds the triangles that meet each slab; those that its planes meet come first. Works block by block.
void RefinementSlabs::find_triangles() {
  struct Found {
    std::vector<std::uint32_t> cut, within;
  };
  const std::size_t count = whole_.triangles.size();
  const PlacesAmongPlanes places(whole_, slabs_, threads_);
  std::vector<std::vector<Found>> found(count / kBlockSize + 1, std::vector<Found>(slabs_.size()));
  for_each_block(count, threads_, [&](std::size_t first, std::size_t last) {
    std::vector<Found>& in_block = found[first / kBlockSize];
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      places.for_each_slab(whole_.triangles[t].corners, [&](std::size_t slab, bool is_within) {
        (is_within ? in_block[slab].within : in_block[slab].cut).push_back(t);
      });
    }
  });
  for (std::size_t k = 0; k < slabs_.size(); ++k) {
    std::vector<std::uint32_t>& own = origins_[k].triangles;
    const auto append = [&](const std::vector<std::uint32_t>& some) {
      own.insert(own.end(), some.begin(), some.end());
    };
    for (const std::vector<Found>& in_block : found) append(in_block[k].cut);
    origins_[k].frozen = static_cast<std::uint32_t>(own.size());
    for (const std::vector<Found>& in_block : found) append(in_block[k].within);
  }
}

// Reserves room in the whole for the expected insertions of all parts, and in each part for those of the largest part,
// because a part's arrays are reused by the next.
void RefinementSlabs::make_room(std::span<const float> work) {
  std::size_t insertions = 0;
  for (const Origin& origin : origins_) {
    double expected = 0;
    for (const std::uint32_t t : origin.triangles) expected += work[t];
    const std::size_t own = origin.triangles.size();
    const auto added = static_cast<std::size_t>(std::min(expected, kMostGrowth * static_cast<double>(own)));
    insertions += added;
    room_for_vertices_ = std::max(room_for_vertices_, own + kRoom * added);
    room_for_triangles_ = std::max(room_for_triangles_, own + 2 * kRoom * added);
  }
  whole_.vertices.reserve(whole_.vertices.size() + kRoom * insertions);
  whole_.triangles.reserve(whole_.triangles.size() + 2 * kRoom * insertions);
}

void RefinementSlabs::refine_each(const RefinePart& refine) {
  run_tasks(slabs_.size(), threads_, [&](std::size_t k) {
    RefinementPart part = cut_out(k);
    refine(k, part);
    hand_in(k, std::move(part));
  });
  for (const std::uint32_t v : suspects_) whole_.vertices[v].is_suspect = true;
  whole_.forget_attempts(threads_);
}

// The result does not depend on which other parts have been put back already: no part touches what belongs to another,
// and suspect vertices are noted only after all parts are back.
RefinementPart RefinementSlabs::cut_out(std::size_t slab) {
  const std::lock_guard lock(mutex_);
  ++cut_out_;
  RefinementPart part;
  if (!spare_.empty()) {
    part.mesh = std::move(spare_.back());
    spare_.pop_back();
  }
  part.frozen = origins_[slab].frozen;
  part.slab = slabs_[slab];
  fill(part.mesh, origins_[slab]);
  return part;
}

void RefinementSlabs::fill(RefinementMesh& mesh, Origin& origin) {
  const std::vector<std::uint32_t>& own = origin.triangles;
  mesh.triangles.reserve(room_for_triangles_);
  mesh.vertices.reserve(room_for_vertices_);
  for (std::uint32_t i = 0; i < own.size(); ++i) local_triangle_[own[i]] = i;
  for (const std::uint32_t t : own) {
    RefinementMesh::Triangle triangle = whole_.triangles[t];
    for (std::uint32_t& v : triangle.corners) {
      if (local_vertex_[v] == kNoSide) {
        local_vertex_[v] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(whole_.vertices[v]);
        origin.vertices.push_back(v);
      }
      v = local_vertex_[v];
    }
    for (TriangleSide& side : triangle.neighbours) {
      // Out of range for no neighbour, and for triangles that other parts have added.
      const std::uint32_t across = side >> 2;
      const bool is_own = across < local_triangle_.size() && local_triangle_[across] != kNoSide;
      side = is_own ? 4 * local_triangle_[across] + (side & 3u) : kNoSide;
    }
    mesh.triangles.push_back(triangle);
  }
  for (const std::uint32_t t : own) local_triangle_[t] = kNoSide;
  for (const std::uint32_t v : origin.vertices) local_vertex_[v] = kNoSide;
}

// Parts are put back in their order, so the result does not depend on which was finished first.
void RefinementSlabs::hand_in(std::size_t slab, RefinementPart part) {
  const std::lock_guard lock(mutex_);
  refined_[slab] = std::move(part);
  for (; put_back_ < refined_.size() && refined_[put_back_]; ++put_back_) {
    put_back(*refined_[put_back_], origins_[put_back_]);
    origins_[put_back_] = {};
    keep_memory(refined_[put_back_]->mesh);
    refined_[put_back_].reset();
  }
}

void RefinementSlabs::keep_memory(RefinementMesh& mesh) {
  if (spare_.size() == slabs_.size() - cut_out_) return;  // enough for the parts still to come
  mesh.vertices.clear();
  mesh.triangles.clear();
  spare_.push_back(std::move(mesh));
}

void RefinementSlabs::put_back(const RefinementPart& part, const Origin& origin) {
  const RefinementMesh& mesh = part.mesh;
  // New vertices and triangles are appended to the whole.
  const std::size_t old_vertices = origin.vertices.size(), old_triangles = origin.triangles.size();
  const std::size_t first_vertex = whole_.vertices.size(), first_triangle = whole_.triangles.size();
  check_triangle_count(first_triangle + mesh.triangles.size() - old_triangles);
  const auto behind = [](const auto& array, std::size_t place) {
    return array.begin() + static_cast<std::ptrdiff_t>(place);
  };
  whole_.vertices.insert(whole_.vertices.end(), behind(mesh.vertices, old_vertices), mesh.vertices.end());
  whole_.triangles.insert(whole_.triangles.end(), behind(mesh.triangles, old_triangles), mesh.triangles.end());
  for (std::size_t v = 0; v < old_vertices; ++v) {
    RefinementMesh::Vertex& old = whole_.vertices[origin.vertices[v]];
    if (old.point != mesh.vertices[v].point) {
      old.point = mesh.vertices[v].point;
      old.clearance = mesh.vertices[v].clearance;
    }
    old.is_smoothed = old.is_smoothed || mesh.vertices[v].is_smoothed;
    if (mesh.vertices[v].is_suspect) suspects_.push_back(origin.vertices[v]);
  }
  const auto place = [](const std::vector<std::uint32_t>& old, std::size_t first, std::uint32_t i) {
    return i < old.size() ? old[i] : static_cast<std::uint32_t>(first + i - old.size());
  };
  const auto place_of_triangle = [&](std::uint32_t t) { return place(origin.triangles, first_triangle, t); };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const RefinementMesh::Triangle& from = mesh.triangles[t];
    RefinementMesh::Triangle& to = whole_.triangles[place_of_triangle(t)];
    // A frozen triangle is unchanged, but may be tried again; its sides towards the part are as the part left them.
    if (t >= part.frozen) {
      to = from;
      for (std::uint32_t& v : to.corners) v = place(origin.vertices, first_vertex, v);
    } else if (from.is_coarse()) {
      to.set(RefinementMesh::Triangle::kCoarse, true);
    }
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide side = from.neighbours[i];
      if (side != kNoSide) to.neighbours[i] = 4 * place_of_triangle(side >> 2) + (side & 3u);
    }
  }
}

}  // namespace deliso
