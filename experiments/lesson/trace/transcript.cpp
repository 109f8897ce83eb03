#include "experiments/lesson/trace/transcript.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace deliso {
namespace {

std::string number_of(const TraceEvent& value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value.get<double>());
  return text;
}

std::string names_of(const TraceEvent& vertices) {
  std::string text;
  for (const TraceEvent& v : vertices) {
    if (v.is_number()) text += (text.empty() ? "" : "-") + std::to_string(v.get<int>());
  }
  return text;
}

std::string count_of(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// What asks for a point in stage 1.
std::string reason_of(const TraceEvent& event) {
  const std::string why = event.at("why");
  if (why == "multi_intersect") {
    return "MultiIntersect: the dual edge of facet " + names_of(event.at("sigma")) + " has " +
           std::to_string(event.at("sigma").at(3).size()) + " hits; the farthest from the facet goes in";
  }
  if (why == "extract_manifold") {
    const std::size_t size = event.at("disk").size();
    return "ExtractManifold: the umbrella of vertex " + std::to_string(event.at("q").get<int>()) + ", " +
           count_of(size, "facet", "facets") + ", is no disk; " +
           (size == 0 ? "a point in its Voronoi cell goes in" : "its farthest hit goes in");
  }
  if (why == "approximate_geometry") {
    return "ApproximateGeom: facet " + names_of(event.at("sigma")) + " has h " + number_of(event.at("h")) + ", r " +
           number_of(event.at("r")) + ", l " + number_of(event.at("l")) + "; its hit goes in";
  }
  return "Coverage: the mesh is far from a part of the isosurface; a sample of it goes in";
}

std::string insertion(const TraceEvent& event) {
  const std::size_t gone = event.at("gone").size(), star = event.at("above").get_ref<const std::string&>().size();
  return reason_of(event) + ", as vertex " + std::to_string(event.at("v").get<int>()) + ": " +
         count_of(gone, "tetrahedron gives", "tetrahedra give") + " way to " + std::to_string(star) + ".";
}

std::string refinement(const TraceEvent& event) {
  const std::size_t gone = event.at("gone").size(), rim = event.at("rim").size();
  const std::size_t star = event.at("closed").get<bool>() ? rim : rim - 1;
  return "RefineGeom: triangle " + names_of(event.at("t")) + " (" + event.at("why").get<std::string>() + ": h " +
         number_of(event.at("h")) + ", r " + number_of(event.at("r")) + ", l " + number_of(event.at("l")) + ", pole " +
         number_of(event.at("pole")) + ") gives vertex " + std::to_string(event.at("v").get<int>()) + ": E of " +
         count_of(gone, "triangle", "triangles") + " gives way to D of " + std::to_string(star) + ".";
}

std::string comparison(const TraceEvent& event) {
  const TraceEvent& components = event.at("components");
  const auto right = std::count_if(components.begin(), components.end(),
                                   [](const TraceEvent& component) { return component.at("is") == "exact"; });
  return "Compared with the exact topology: " + std::to_string(right) + " of " +
         count_of(components.size(), "component is", "components are") + " right; the mesh has " +
         count_of(event.at("triangles").size(), "triangle", "triangles") + " in " +
         count_of(event.at("pieces").size(), "piece", "pieces") + ".";
}

std::string certificate(const TraceEvent& event) {
  const auto figure = [&](const char* key) { return std::to_string(event.at(key).get<std::int64_t>()); };
  return "Certificate: topology " + std::string(event.at("homeomorphic").get<bool>() ? "equal" : "different") +
         ", pairs of crossing triangles: " + figure("crossing") +
         ", vertices off the isosurface: " + figure("vertices_off") +
         ", points too far from it: " + figure("mesh_off") +
         ", points of it too far from the mesh: " + figure("isosurface_off") + ".";
}

std::string ending(const TraceEvent& event) {
  return "The end: " + std::to_string(event.at("vertices").get<std::int64_t>()) + " vertices, " +
         std::to_string(event.at("triangles").get<std::int64_t>()) + " triangles, verdict " +
         event.at("verdict").get<std::string>() + ".";
}

}  // namespace

std::string sentence_of(const TraceEvent& event) {
  std::string kind = event.at("e");
  if (kind == "initial") {
    return "InitTriangulation: " + count_of(event.at("points").size(), "point", "points") + ", " +
           count_of(event.at("tets").size(), "tetrahedron", "tetrahedra") + " with those at infinity.";
  }
  if (kind == "insert") return insertion(event);
  if (kind == "refuse") return reason_of(event) + ": refused, " + event.at("cause").get<std::string>() + ".";
  if (kind == "compare") return comparison(event);
  if (kind == "sample") {
    return "Repair: " + count_of(event.at("cells").size(), "voxel cell is", "voxel cells are") +
           " sampled anew where the mesh is wrong; this is not in the paper.";
  }
  if (kind == "certify") return certificate(event);
  if (kind == "mesh") {
    return "ComputePoles, BuildTriMesh: a mesh of " + count_of(event.at("points").size(), "vertex", "vertices") +
           " and " + count_of(event.at("triangles").size(), "triangle", "triangles") +
           "; the tetrahedra are thrown away.";
  }
  if (kind == "refine") return refinement(event);
  if (kind == "keep") {
    return "Refused: triangle " + names_of(event.at("t")) + " stays for now, " + event.at("cause").get<std::string>() +
           ".";
  }
  if (kind == "restart") return "Triangles came to meet: everything since BuildTriMesh is taken back.";
  if (kind == "refined") return "RefineGeom has ended.";
  if (kind == "shape" && event.contains("why")) {
    if (event.at("why") == "rest") return "Steps that are not told one by one; they are not in the paper.";
    return event.at("why") == "folds"
               ? "Edges across folds were flipped to run along them; this is not in the paper."
               : "Vertices were moved to where the angles around them are larger; this is not in the paper.";
  }
  if (kind == "shape") return "Badly shaped triangles were improved; this is not in the paper.";
  if (kind == "end") return ending(event);
  return kind;
}

}  // namespace deliso
