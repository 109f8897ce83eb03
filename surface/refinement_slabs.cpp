#include "surface/refinement_slabs.h"

#include <algorithm>
#include <cstddef>

#include "delaunay/base/parallel.h"
#include "surface/blocks.h"

namespace deliso {

namespace {

// What is refined once parts are joined adds less than this part of the mesh, as a rule: then its arrays need not grow.
constexpr std::size_t kRoomForRest = 4;
// There is room for at most so many insertions per triangle from the start.
constexpr double kMostGrowth = 32;

}  // namespace

RefinementSlabs::RefinementSlabs(const RefinementMesh& whole, const std::vector<Slab>& slabs,
                                 std::span<const float> work, int threads)
    : parts_(slabs.size()), origins_(slabs.size()) {
  for (std::size_t k = 0; k < slabs.size(); ++k) parts_[k].slab = slabs[k];
  find_triangles(whole);
  run_tasks(parts_.size(), threads, [&](std::size_t k) { fill(whole, work, k); });
}

// The triangles that meet each slab: those that its planes meet come first.
void RefinementSlabs::find_triangles(const RefinementMesh& whole) {
  if (parts_.empty()) return;
  const std::size_t axis = parts_.front().slab.axis;
  std::vector<std::vector<std::uint32_t>> within(parts_.size());
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    const auto [a, b, c] = whole.corner_points(whole.triangles[t].corners);
    const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const Slab& slab = parts_[k].slab;
      if (high < slab.low || slab.high < low) continue;
      const bool is_within = slab.low < low && high < slab.high;
      (is_within ? within[k] : origins_[k].triangles).push_back(t);
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    std::vector<std::uint32_t>& own = origins_[k].triangles;
    parts_[k].frozen = static_cast<std::uint32_t>(own.size());
    own.insert(own.end(), within[k].begin(), within[k].end());
  }
}

void RefinementSlabs::fill(const RefinementMesh& whole, std::span<const float> work, std::size_t k) {
  RefinementMesh& mesh = parts_[k].mesh;
  const std::vector<std::uint32_t>& own = origins_[k].triangles;
  // Room for the insertions that are expected.
  double expected = 0;
  for (const std::uint32_t t : own) expected += work[t];
  const auto added = static_cast<std::size_t>(std::min(expected, kMostGrowth * static_cast<double>(own.size())));
  mesh.triangles.reserve(own.size() + 2 * added);
  mesh.vertices.reserve(own.size() + added);
  std::vector<std::uint32_t> local_triangle(whole.triangles.size(), kNoSide);
  for (std::uint32_t i = 0; i < own.size(); ++i) local_triangle[own[i]] = i;
  std::vector<std::uint32_t> local_vertex(whole.vertices.size(), kNoSide);
  for (const std::uint32_t t : own) {
    RefinementMesh::Triangle triangle = whole.triangles[t];
    for (std::uint32_t& v : triangle.corners) {
      if (local_vertex[v] == kNoSide) {
        local_vertex[v] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(whole.vertices[v]);
        origins_[k].vertices.push_back(v);
      }
      v = local_vertex[v];
    }
    for (TriangleSide& side : triangle.neighbours) {
      if (side == kNoSide) continue;
      const std::uint32_t across = local_triangle[side >> 2];
      side = across == kNoSide ? kNoSide : 4 * across + (side & 3u);
    }
    mesh.triangles.push_back(triangle);
  }
}

void RefinementSlabs::join(RefinementMesh& whole, int threads) {
  std::size_t triangle_count = whole.triangles.size();
  std::size_t vertex_count = whole.vertices.size();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    triangle_count += parts_[k].mesh.triangles.size() - origins_[k].triangles.size();
    vertex_count += parts_[k].mesh.vertices.size() - origins_[k].vertices.size();
  }
  if (triangle_count > whole.triangles.capacity()) {
    whole.vertices.reserve(vertex_count + vertex_count / kRoomForRest);
    whole.triangles.reserve(triangle_count + triangle_count / kRoomForRest);
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    put_back(parts_[k], origins_[k], whole, threads);
    parts_[k] = {};
    origins_[k] = {};
  }
  whole.forget_attempts();
}

void RefinementSlabs::put_back(const RefinementPart& part, const Origin& origin, RefinementMesh& whole, int threads) {
  const RefinementMesh& mesh = part.mesh;
  // What is new comes behind all that is there.
  const std::size_t old_vertices = origin.vertices.size(), old_triangles = origin.triangles.size();
  const std::size_t first_vertex = whole.vertices.size(), first_triangle = whole.triangles.size();
  const auto behind = [](const auto& array, std::size_t place) {
    return array.begin() + static_cast<std::ptrdiff_t>(place);
  };
  whole.vertices.insert(whole.vertices.end(), behind(mesh.vertices, old_vertices), mesh.vertices.end());
  whole.triangles.insert(whole.triangles.end(), behind(mesh.triangles, old_triangles), mesh.triangles.end());
  for (std::size_t v = 0; v < old_vertices; ++v) {
    if (mesh.vertices[v].is_suspect) whole.vertices[origin.vertices[v]].is_suspect = true;
  }
  const auto place = [](const std::vector<std::uint32_t>& old, std::size_t first, std::uint32_t i) {
    return i < old.size() ? old[i] : static_cast<std::uint32_t>(first + i - old.size());
  };
  const auto place_of_triangle = [&](std::uint32_t t) { return place(origin.triangles, first_triangle, t); };
  for_each_block(mesh.triangles.size(), threads, [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      const RefinementMesh::Triangle& from = mesh.triangles[t];
      RefinementMesh::Triangle& to = whole.triangles[place_of_triangle(t)];
      // A frozen triangle stays; its sides towards the part are as the part left them.
      if (t >= part.frozen) {
        to = from;
        for (std::uint32_t& v : to.corners) v = place(origin.vertices, first_vertex, v);
      }
      for (unsigned i = 0; i < 3; ++i) {
        const TriangleSide side = from.neighbours[i];
        if (side != kNoSide) to.neighbours[i] = 4 * place_of_triangle(side >> 2) + (side & 3u);
      }
    }
  });
}

}  // namespace deliso
