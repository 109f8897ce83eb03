// Gmsh's .msh as text, in versions 4.1 and 2.2. Nodes and elements count from 1.
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/solids.h"

namespace deliso {

namespace {

// Lists by component: those of component c are items[begin[c]] to items[begin[c + 1]].
struct ComponentLists {
  std::vector<std::size_t> begin;
  std::vector<std::size_t> items;

  template <class ComponentOf>
  ComponentLists(std::size_t components, std::size_t count, const ComponentOf& component_of) : begin(components + 2) {
    for (std::size_t i = 0; i < count; ++i) {
      if (component_of(i) < components) ++begin[component_of(i) + 2];
    }
    for (std::size_t c = 2; c < begin.size(); ++c) begin[c] += begin[c - 1];
    items.resize(begin.back());
    for (std::size_t i = 0; i < count; ++i) {
      if (component_of(i) < components) items[begin[component_of(i) + 1]++] = i;
    }
  }
  [[nodiscard]] std::span<const std::size_t> of(std::size_t c) const {
    return std::span(items).subspan(begin[c], begin[c + 1] - begin[c]);
  }
};

void append_spaced(std::string& text, std::size_t number) {
  append_number(text, number);
  text += ' ';
}

// The components around each solid: its own first, then those inside it.
std::vector<std::vector<std::size_t>> solid_walls(const EnclosedParts& enclosed) {
  std::vector<std::vector<std::size_t>> walls(enclosed.parts.size());
  const auto is_known = [](const EnclosedPart& part) { return part.is_solid && part.point; };
  for (std::size_t i = 0; i < enclosed.parts.size(); ++i) {
    if (is_known(enclosed.parts[i])) walls[i].push_back(enclosed.parts[i].component);
  }
  for (const EnclosedPart& part : enclosed.parts) {
    if (part.parent && is_known(enclosed.parts[*part.parent])) walls[*part.parent].push_back(part.component);
  }
  std::erase_if(walls, [](const auto& of_solid) { return of_solid.empty(); });
  return walls;
}

// Gmsh fills volumes of a script, not those that a file of meshes describes: the comments hold the script, each line
// after the word `geo`.
void append_script(std::string& text, const std::string& name, const EnclosedParts& enclosed) {
  constexpr std::size_t kMostSolids = 1000;
  const std::vector<std::vector<std::size_t>> walls = solid_walls(enclosed);
  if (walls.empty() || walls.size() > kMostSolids) return;
  const std::size_t slash = name.rfind('/');
  // Gmsh would take triangles that meet at less than a tenth of a degree for overlapping ones.
  text += "geo Mesh.AngleToleranceFacetOverlap = 1e-9;\n";
  text += "geo Merge \"" + name.substr(slash == std::string::npos ? 0 : slash + 1) + "\";\n";
  for (const EnclosedPart& part : enclosed.parts) {
    const std::string tag = std::to_string(part.component + 1);
    text += std::string("geo Surface Loop(").append(tag).append(") = {").append(tag).append("};\n");
  }
  for (const std::vector<std::size_t>& of_solid : walls) {
    text += "geo Volume(" + std::to_string(of_solid.front() + 1) + ") = {";
    for (const std::size_t c : of_solid) text += (text.back() == '{' ? "" : ", ") + std::to_string(c + 1);
    text += "};\n";
  }
}

void append_comments(std::string& text, const MeshComments& comments, const std::string& name,
                     const EnclosedParts& enclosed) {
  text += "$Comments\n";
  for (const std::string& comment : comments) text += comment + "\n";
  append_script(text, name, enclosed);
  text += "$EndComments\n";
}

void append_corners(std::string& text, const std::array<std::uint32_t, 3>& triangle) {
  for (const std::uint32_t v : triangle) append_spaced(text, std::size_t{v} + 1);
  text.back() = '\n';
}

void append_box(std::string& text, const Box3& box) {
  append_point(text, box.low);
  text.back() = ' ';
  append_point(text, box.high);
  text.back() = ' ';
}

class Gmsh4 {
 public:
  Gmsh4(const TriangleMesh& mesh, const MeshTopology& topology)
      : mesh_(mesh),
        components_(topology.components.size()),
        vertices_(components_, mesh.points.size(), [&](std::size_t v) { return topology.component_of_vertex[v]; }),
        triangles_(components_, mesh.triangles.size(),
                   [&](std::size_t t) { return topology.component_of_vertex[mesh.triangles[t][0]]; }) {}

  void append_entities(std::string& text) const {
    text += "$Entities\n0 0 " + std::to_string(components_) + " 0\n";
    for (std::size_t c = 0; c < components_; ++c) {
      append_spaced(text, c + 1);
      append_box(text, box_of_component(c));
      text += "0 0\n";
    }
    text += "$EndEntities\n";
  }

  // Vertices without a triangle belong to no surface, and are left out.
  void append_nodes(std::string& text) const {
    text += "$Nodes\n" + std::to_string(components_) + " " + std::to_string(vertices_.items.size()) + " 1 " +
            std::to_string(mesh_.points.size()) + "\n";
    for (std::size_t c = 0; c < components_; ++c) {
      const auto vertices = vertices_.of(c);
      text += "2 " + std::to_string(c + 1) + " 0 " + std::to_string(vertices.size()) + "\n";
      for (const std::size_t v : vertices) {
        append_number(text, v + 1);
        text += '\n';
      }
      for (const std::size_t v : vertices) append_point(text, mesh_.points[v]);
    }
    text += "$EndNodes\n";
  }

  void append_elements(std::string& text) const {
    text += "$Elements\n" + std::to_string(components_) + " " + std::to_string(mesh_.triangles.size()) + " 1 " +
            std::to_string(mesh_.triangles.size()) + "\n";
    for (std::size_t c = 0; c < components_; ++c) {
      const auto triangles = triangles_.of(c);
      text += "2 " + std::to_string(c + 1) + " 2 " + std::to_string(triangles.size()) + "\n";
      for (const std::size_t t : triangles) {
        append_spaced(text, t + 1);
        append_corners(text, mesh_.triangles[t]);
      }
    }
    text += "$EndElements\n";
  }

 private:
  [[nodiscard]] Box3 box_of_component(std::size_t c) const {
    Box3 box;
    for (const std::size_t v : vertices_.of(c)) box.extend(mesh_.points[v]);
    return box;
  }

  const TriangleMesh& mesh_;
  std::size_t components_;
  ComponentLists vertices_, triangles_;
};

std::string gmsh2_elements(const TriangleMesh& mesh, const MeshFileOptions& options, const MeshTopology& topology) {
  const std::vector<std::int64_t> references = triangle_references(mesh, options.attributes);
  std::string text;
  text.reserve(64 * mesh.points.size() + 48 * mesh.triangles.size());
  text += "$Nodes\n" + std::to_string(mesh.points.size()) + "\n";
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    append_spaced(text, v + 1);
    append_point(text, mesh.points[v]);
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(mesh.triangles.size()) + "\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    append_spaced(text, t + 1);
    text += "2 2 ";  // a triangle with two tags: physical and elementary surface
    append_number(text, references[t]);
    text += ' ';
    append_spaced(text, std::size_t{topology.component_of_vertex[mesh.triangles[t][0]]} + 1);
    append_corners(text, mesh.triangles[t]);
  }
  return text + "$EndElements\n";
}

}  // namespace

std::string gmsh_bytes(const TriangleMesh& mesh, const MeshFileOptions& options, const std::string& name) {
  const MeshTopology topology = mesh_topology(mesh);
  const bool is_old = options.gmsh_version == GmshVersion::k2;
  std::string text = std::string("$MeshFormat\n") + (is_old ? "2.2" : "4.1") + " 0 8\n$EndMeshFormat\n";
  append_comments(text, options.comments, name, enclosed_parts(mesh, topology));
  if (is_old) return text + gmsh2_elements(mesh, options, topology);
  const Gmsh4 gmsh(mesh, topology);
  gmsh.append_entities(text);
  gmsh.append_nodes(text);
  gmsh.append_elements(text);
  return text;
}

}  // namespace deliso
