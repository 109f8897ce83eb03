#include "surface/mesh/equal_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

namespace deliso {

namespace {

using Corners = std::array<std::uint32_t, 3>;

bool has(const Corners& triangle, std::uint32_t v) {
  return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
}

// The stars of the vertices that may be merged, kept as they change.
class Contraction {
 public:
  Contraction(std::span<const Vec3> places, SurfaceMesh& mesh)
      : mesh_(mesh), is_gone_(mesh.triangles.size(), false), is_equal_(mesh.points.size(), false) {
    for (const Corners& t : mesh.triangles) {
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        if (places[a] != places[b]) continue;
        edges_.emplace_back(std::min(a, b), std::max(a, b));
        is_equal_[a] = is_equal_[b] = true;
      }
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    if (edges_.empty()) return;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (is_equal_[v]) stars_[v].push_back(t);
      }
    }
  }

  std::int64_t run(std::vector<std::uint32_t>* of_vertex) {
    std::int64_t count = 0;
    for (bool is_any = !edges_.empty(); is_any;) {
      is_any = false;
      for (const auto& [a, b] : edges_) {
        const std::uint32_t kept = now(a), merged = now(b);
        if (kept == merged || !may_merge(kept, merged)) continue;
        merge(kept, merged);
        is_any = true;
        ++count;
      }
    }
    if (count > 0) {
      if (of_vertex != nullptr) take_out_merged(*of_vertex);
      mesh_.neighbours.clear();
      drop_triangles(mesh_, is_gone_);
    }
    return count;
  }

 private:
  // As drop_triangles() does with the vertices.
  void take_out_merged(std::vector<std::uint32_t>& of_vertex) const {
    std::vector<bool> is_used(of_vertex.size(), false);
    for (std::size_t t = 0; t < is_gone_.size(); ++t) {
      if (is_gone_[t]) continue;
      for (const std::uint32_t v : mesh_.triangles[t]) is_used[v] = true;
    }
    std::size_t count = 0;
    for (std::size_t v = 0; v < is_used.size(); ++v) {
      if (is_used[v]) of_vertex[count++] = of_vertex[v];
    }
    of_vertex.resize(count);
  }
  [[nodiscard]] std::uint32_t now(std::uint32_t v) const {
    for (auto at = merged_into_.find(v); at != merged_into_.end(); at = merged_into_.find(v)) v = at->second;
    return v;
  }
  // The vertices that share an edge with v, ascending, one for each triangle with that edge.
  [[nodiscard]] std::vector<std::uint32_t> around(std::uint32_t v) const {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t t : stars_.at(v)) {
      for (const std::uint32_t u : mesh_.triangles[t]) {
        if (u != v) others.push_back(u);
      }
    }
    std::sort(others.begin(), others.end());
    return others;
  }
  // On the boundary some edge of the star has one triangle only.
  static bool is_on_boundary(std::vector<std::uint32_t> around) {
    for (std::size_t i = 0; i < around.size(); i += 2) {
      if (i + 1 == around.size() || around[i] != around[i + 1]) return true;
    }
    return false;
  }
  // They share an edge, and no neighbours but those across from it.
  [[nodiscard]] bool may_merge(std::uint32_t kept, std::uint32_t merged) const {
    std::vector<std::uint32_t> of_kept = around(kept), of_merged = around(merged);
    std::vector<std::uint32_t> across;
    for (const std::uint32_t t : stars_.at(kept)) {
      if (!has(mesh_.triangles[t], merged)) continue;
      for (const std::uint32_t u : mesh_.triangles[t]) {
        if (u != kept && u != merged) across.push_back(u);
      }
    }
    const bool are_on_boundary = is_on_boundary(of_kept) && is_on_boundary(of_merged);
    if (across.empty() || (across.size() == 1) != are_on_boundary) return false;
    // Of a tetrahedron two triangles would be left, one the back of the other.
    if (stars_.at(kept).size() + stars_.at(merged).size() < 2 * across.size() + (are_on_boundary ? 1 : 3)) return false;
    for (auto* others : {&of_kept, &of_merged}) {
      others->erase(std::unique(others->begin(), others->end()), others->end());
    }
    std::vector<std::uint32_t> common;
    std::set_intersection(of_kept.begin(), of_kept.end(), of_merged.begin(), of_merged.end(),
                          std::back_inserter(common));
    std::sort(across.begin(), across.end());
    return common == across;
  }
  void merge(std::uint32_t kept, std::uint32_t merged) {
    std::vector<std::uint32_t>& star = stars_[kept];
    for (const std::uint32_t t : stars_[merged]) {
      Corners& corners = mesh_.triangles[t];
      if (has(corners, kept)) {
        is_gone_[t] = true;
        for (const std::uint32_t v : corners) {
          if (is_equal_[v] && v != merged) std::erase(stars_[v], t);
        }
        continue;
      }
      std::replace(corners.begin(), corners.end(), merged, kept);
      star.push_back(t);
    }
    stars_.erase(merged);
    merged_into_[merged] = kept;
  }

  SurfaceMesh& mesh_;
  std::vector<bool> is_gone_, is_equal_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> stars_;
  std::unordered_map<std::uint32_t, std::uint32_t> merged_into_;
};

}  // namespace

std::int64_t merge_equal_vertices(std::span<const Vec3> places, SurfaceMesh& mesh,
                                  std::vector<std::uint32_t>* of_vertex) {
  return Contraction(places, mesh).run(of_vertex);
}

}  // namespace deliso
