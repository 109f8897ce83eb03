#include "surface/refinement_slabs.h"

#include <algorithm>

#include "delaunay/base/box3.h"

namespace deliso {

namespace {

constexpr std::size_t kMostParts = 8;
// What is refined in the whole adds less than this part of the joined mesh, as a rule: then its arrays need not grow.
constexpr std::size_t kRoomForRest = 4;

}  // namespace

RefinementSlabs::RefinementSlabs(const RefinementMesh& whole, std::size_t slab_triangles) {
  parts_.resize(std::clamp<std::size_t>(whole.triangles.size() / slab_triangles, 1, kMostParts));
  choose_planes(whole);
  assign(whole);
  for (std::uint32_t k = 0; k < parts_.size(); ++k) fill(whole, k);
}

// Planes at the quantiles of the triangles' centroids.
void RefinementSlabs::choose_planes(const RefinementMesh& whole) {
  Box3 box;
  for (const RefinementMesh::Vertex& v : whole.vertices) box.extend(v.point);
  const Vec3 size = box.size();
  const std::size_t axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  std::vector<double> centroids;
  centroids.reserve(whole.triangles.size());
  for (const RefinementMesh::Triangle& t : whole.triangles) {
    const auto [a, b, c] = whole.corner_points(t.corners);
    centroids.push_back((a[axis] + b[axis] + c[axis]) / 3);
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].axis = axis;
    if (k == 0) continue;
    const auto quantile = centroids.begin() + static_cast<std::ptrdiff_t>(k * centroids.size() / parts_.size());
    std::nth_element(centroids.begin(), quantile, centroids.end());
    parts_[k].low = parts_[k - 1].high = *quantile;
  }
}

// A triangle belongs to the part that contains its corners; else it is frozen in all parts that it reaches.
void RefinementSlabs::assign(const RefinementMesh& whole) {
  part_of_.assign(whole.triangles.size(), kFrozen);
  frozen_in_.resize(parts_.size());
  const std::size_t axis = parts_[0].axis;
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    const auto [a, b, c] = whole.corner_points(whole.triangles[t].corners);
    const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
    for (std::uint32_t k = 0; k < parts_.size(); ++k) {
      if (parts_[k].low < low && high < parts_[k].high) part_of_[t] = k;
    }
    if (part_of_[t] != kFrozen) continue;
    for (std::uint32_t k = 0; k < parts_.size(); ++k) {
      if (low <= parts_[k].high && parts_[k].low <= high) {
        frozen_in_[k].push_back(static_cast<std::uint32_t>(frozen_.size()));
      }
    }
    frozen_.push_back(t);
  }
}

void RefinementSlabs::fill(const RefinementMesh& whole, std::uint32_t k) {
  RefinementPart& part = parts_[k];
  std::vector<std::uint32_t> own;
  for (const std::uint32_t place : frozen_in_[k]) own.push_back(frozen_[place]);
  part.frozen = static_cast<std::uint32_t>(own.size());
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    if (part_of_[t] == k) own.push_back(t);
  }
  std::vector<std::uint32_t> local_triangle(whole.triangles.size(), kNoSide);
  for (std::uint32_t i = 0; i < own.size(); ++i) local_triangle[own[i]] = i;
  std::vector<std::uint32_t> local_vertex(whole.vertices.size(), kNoSide);
  vertices_in_.resize(parts_.size());
  for (const std::uint32_t t : own) {
    RefinementMesh::Triangle triangle = whole.triangles[t];
    for (std::uint32_t& v : triangle.corners) {
      if (local_vertex[v] == kNoSide) {
        local_vertex[v] = static_cast<std::uint32_t>(part.mesh.vertices.size());
        part.mesh.vertices.push_back(whole.vertices[v]);
        vertices_in_[k].push_back(v);
      }
      v = local_vertex[v];
    }
    for (TriangleSide& side : triangle.neighbours) {
      if (side == kNoSide) continue;
      const std::uint32_t across = local_triangle[side >> 2];
      side = across == kNoSide ? kNoSide : 4 * across + (side & 3u);
    }
    part.mesh.triangles.push_back(triangle);
  }
}

void RefinementSlabs::join(RefinementMesh& whole) {
  // The frozen triangles come first; their sides towards a part are as that part left them.
  std::size_t triangle_count = frozen_.size();
  std::size_t vertex_count = whole.vertices.size();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    triangle_count += parts_[k].mesh.triangles.size() - parts_[k].frozen;
    vertex_count += parts_[k].mesh.vertices.size() - vertices_in_[k].size();
  }
  whole.vertices.reserve(vertex_count + vertex_count / kRoomForRest);
  LargeArray<RefinementMesh::Triangle> triangles(frozen_.size());
  triangles.reserve(triangle_count + triangle_count / kRoomForRest);
  std::vector<std::uint32_t> place_of(part_of_.size(), kNoSide);
  for (std::uint32_t i = 0; i < frozen_.size(); ++i) place_of[frozen_[i]] = i;
  for (std::uint32_t i = 0; i < frozen_.size(); ++i) {
    triangles[i] = whole.triangles[frozen_[i]];
    for (TriangleSide& side : triangles[i].neighbours) {
      if (side != kNoSide) side = place_of[side >> 2] == kNoSide ? kNoSide : 4 * place_of[side >> 2] + (side & 3u);
    }
  }
  for (std::uint32_t k = 0; k < parts_.size(); ++k) {
    RefinementPart& part = parts_[k];
    const auto shift = static_cast<std::uint32_t>(triangles.size()) - part.frozen;
    const auto joined_side = [&](TriangleSide side) {
      if (side == kNoSide) return kNoSide;
      const std::uint32_t t = side >> 2;
      return 4 * (t < part.frozen ? frozen_in_[k][t] : t + shift) + (side & 3u);
    };
    std::vector<std::uint32_t>& vertex = vertices_in_[k];
    for (std::size_t v = vertex.size(); v < part.mesh.vertices.size(); ++v) {
      vertex.push_back(static_cast<std::uint32_t>(whole.vertices.size()));
      whole.vertices.push_back(part.mesh.vertices[v]);
    }
    for (std::uint32_t t = 0; t < part.mesh.triangles.size(); ++t) {
      RefinementMesh::Triangle triangle = part.mesh.triangles[t];
      for (TriangleSide& side : triangle.neighbours) side = joined_side(side);
      if (t < part.frozen) {
        auto& kept = triangles[frozen_in_[k][t]].neighbours;
        for (unsigned i = 0; i < 3; ++i) {
          if (kept[i] == kNoSide) kept[i] = triangle.neighbours[i];
        }
        continue;
      }
      for (std::uint32_t& v : triangle.corners) v = vertex[v];
      triangles.push_back(triangle);
    }
    part = {};
  }
  whole.triangles = std::move(triangles);
  whole.forget_attempts();
}

}  // namespace deliso
