// The formats of other programs: what they hold is read back by small parsers of the test's own, and by ours where ours
// reads them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/mesh_topology.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_files.h"

namespace deliso {
namespace {

using testing::MeshIo;

// Two nested spheres, the inner one turned inwards, and a ball beside them.
TriangleMesh shells() {
  TriangleMesh mesh = testing::sphere_mesh(2, 2);
  for (TriangleMesh other : {testing::sphere_mesh(2, 1), testing::sphere_mesh(1, 0.5, {5, 0, 0})}) {
    if (norm(other.points[0]) < 2) {
      for (auto& [a, b, c] : other.triangles) std::swap(b, c);
    }
    const auto base = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({base + a, base + b, base + c});
  }
  return mesh;
}

MeshFileOptions with_comments() {
  MeshFileOptions options;
  options.comments = {"DelIso, isovalue 0.5", "promise.max_distance 0.25", "volume a -- b.nrrd, 100% \"so\"",
                      std::string(200, 'x')};
  options.attributes.vertices = {{"stage", 1, true, std::vector<double>(shells().points.size(), 2)},
                                 {"gradient", 3, false, std::vector<double>(3 * shells().points.size(), 0.1)}};
  options.attributes.triangles = {{"quality", 1, false, std::vector<double>(shells().triangles.size(), 0.5)}};
  return options;
}

TEST_F(MeshIo, CommentsComeBackWhereAFormatHoldsThem) {
  const TriangleMesh mesh = shells();
  for (const bool ascii : {false, true}) {
    MeshFileOptions options = with_comments();
    options.ascii = ascii;
    for (const char* name : {"m.ply", "m.off", "m.obj", "m.mesh", "m.vtk", "m.vtp"}) {
      write_mesh(mesh, file(name), options);
      const MeshFile back = read_mesh_file(file(name));
      const auto first = back.comments.end() - static_cast<std::ptrdiff_t>(options.comments.size());
      EXPECT_EQ(MeshComments(first, back.comments.end()), options.comments) << name << ascii;
      EXPECT_EQ(back.mesh.points, mesh.points) << name;
      EXPECT_EQ(back.mesh.triangles, mesh.triangles) << name;
    }
    write_mesh(mesh, file("m.stl"), options);
    const MeshComments of_stl = read_mesh_file(file("m.stl")).comments;
    ASSERT_GE(of_stl.size(), 2u);
    EXPECT_EQ(of_stl[1], options.comments[1]);
  }
}

TEST_F(MeshIo, FormatsAreToldByTheirContent) {
  MeshFileOptions options = with_comments();
  for (const char* extension : {"ply", "off", "obj", "stl", "mesh", "vtk", "vtp"}) {
    const MeshFormat format = *mesh_format_named(extension);
    const std::string bytes = mesh_bytes(shells(), format, options, "m");
    EXPECT_EQ(mesh_format_of_content(bytes, bytes.size()), format) << extension;
    EXPECT_EQ(read_mesh_file(write_bytes("m", bytes)).format, format) << extension;
    EXPECT_TRUE(is_mesh_content(file("m")));
  }
  EXPECT_FALSE(mesh_format_of_content("NRRD0004\n", 9));
  EXPECT_FALSE(mesh_format_of_content("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n", 99));
  EXPECT_NE(reading_error("m.msh", "").find("written only"), std::string::npos);
}

TEST_F(MeshIo, MeditErrorsNameTheLine) {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n";
  EXPECT_EQ(parse_medit(head + "Triangles 1\n1 2 3 7\nRidges 1\n1\nEnd\nwhatever", "m").triangles.size(), 1u);
  EXPECT_EQ(parse_medit(head + "Quadrilaterals 1\n1 2 3 1 7\nEnd\n", "m").triangles.size(), 2u);
  EXPECT_NE(reading_error("m.mesh", head + "Triangles 1\n1 2 4 7\nEnd\n").find("at most 3, found '4'"),
            std::string::npos);
  EXPECT_EQ(reading_error("m.mesh", head + "Triangles 1\n1 0 2 7\n"),
            ", line 8: expected the number of a vertex, from 1 on, found '0'");
  EXPECT_EQ(reading_error("m.mesh", "MeshVersionFormatted 2\nDimension 2\n"),
            ", line 2: expected the dimension 3, found '2'");
  EXPECT_NE(reading_error("m.mesh", head + "Cubes 1\n").find("line 7: expected a keyword of the Medit format"),
            std::string::npos);
}

TEST_F(MeshIo, VtkFilesOfOtherWritersAreRead) {
  const std::string head = "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET POLYDATA\n";
  const std::string points = "POINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\nMETADATA\nINFORMATION 0\n\n";
  const auto read = [](const std::string& text) { return parse_legacy_vtk(text, "m"); };
  EXPECT_EQ(read(head + points + "POLYGONS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\n")
                .triangles.size(),
            2u);
  EXPECT_EQ(read(head + points + "VERTICES 1 2\n1 0\nPOLYGONS 2 8\n3 0 1 2 3 0 2 3\nPOINT_DATA 4\nSCALARS s int\n")
                .triangles.size(),
            2u);
  const TriangleMesh strip = read(head + points + "TRIANGLE_STRIPS 1 5\n4 0 1 3 2\n");
  ASSERT_EQ(strip.triangles.size(), 2u);
  EXPECT_EQ(strip.triangles[1], (std::array<std::uint32_t, 3>{3, 1, 2}));  // turned like the first
  EXPECT_NE(
      reading_error("m.vtk", head + points + "POLYGONS 1 4\n3 0 1 4\n").find("expected an index below 4, found '4'"),
      std::string::npos);
  EXPECT_NE(reading_error("m.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n")
                .find("no triangle meshes, found 'UNSTRUCTURED_GRID'"),
            std::string::npos);
  EXPECT_NE(reading_error("m.vtp", "<VTKFile type=\"ImageData\"></VTKFile>").find("expected PolyData"),
            std::string::npos);
  // Two pieces, base64 in the text: 0, 1, 2 and the end 3 as Int32 after a UInt32 that counts bytes.
  const std::string piece =
      "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
      "format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
      "format=\"binary\">DAAAAAAAAAABAAAAAgAAAA==</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"binary\">BAAAAAMAAAA=</DataArray></Polys></Piece>";
  const TriangleMesh two =
      parse_vtp("<VTKFile type=\"PolyData\"><PolyData>" + piece + piece + "</PolyData></VTKFile>", "m");
  EXPECT_EQ(two.points.size(), 6u);
  ASSERT_EQ(two.triangles.size(), 2u);
  EXPECT_EQ(two.triangles[1], (std::array<std::uint32_t, 3>{3, 4, 5}));
}

// VTK numbers all cells of a piece: single vertices and lines, then polygons, then strips.
TEST_F(MeshIo, LabelsOfVtkCellsAreThoseOfTheirTriangles) {
  using Labels = std::vector<std::int32_t>;
  const std::string head =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n";
  const std::string cells = "VERTICES 1 2\n1 0\nPOLYGONS 2 9\n4 0 1 2 3\n3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\n";
  const auto labels = [&](const std::string& values) { return parse_legacy_vtk(head + cells + values, "m").labels; };
  const std::string of_points = "POINT_DATA 4\nFIELD f 1\nlabel 1 4 int\n9 9 9 9\n";
  const std::string of_cells = "CELL_DATA 4\nFIELD f 2\nq 2 4 float\n1 2 3 4 5 6 7 8\nlabel 1 4 double\n1 -5 7 1e30\n";
  EXPECT_EQ(labels(of_points + of_cells), (Labels{-5, -5, 7, 0, 0}));
  EXPECT_EQ(labels(of_points), Labels());
  // As VTK writes the array by which a mesh is coloured.
  EXPECT_EQ(
      labels(
          "POINT_DATA 4\nSCALARS label int\nLOOKUP_TABLE default\n9 9 9 9\nMETADATA\nINFORMATION 0\n\nCELL_DATA 4\n"
          "SCALARS q float 2\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\nSCALARS label int 1\nLOOKUP_TABLE t\n1 2 3 4\n"),
      (Labels{2, 2, 3, 4, 4}));
  // What is of no kind that is known, or no number, is no reason to refuse a mesh.
  EXPECT_EQ(labels("CELL_DATA 4\nCOLOR_SCALARS c 1\n1 2 3 4\n"), Labels());
  EXPECT_EQ(labels("CELL_DATA 4\nFIELD f 1\nlabel 1 4 int\n1 2 three\n"), Labels());
  EXPECT_EQ(labels("CELL_DATA 4\nFIELD f 1\nlabel 1 2 int\n8 9\n"), (Labels{9, 9, 0, 0, 0}));
  const auto piece = [](const std::string& values) {
    return "<Piece NumberOfPoints=\"3\" NumberOfLines=\"1\" NumberOfPolys=\"1\">" + values +
           "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray>"
           "</Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>";
  };
  const std::string array = "<DataArray type=\"Int32\" Name=\"label\" format=\"ascii\">4 6</DataArray>";
  const std::string with = piece("<CellData>" + array + "</CellData>"),
                    without = piece("<PointData>" + array + "</PointData>");
  const auto labels_of_pieces = [](const std::string& pieces) {
    return parse_vtp("<VTKFile type=\"PolyData\"><PolyData>" + pieces + "</PolyData></VTKFile>", "m").labels;
  };
  EXPECT_EQ(labels_of_pieces(without + with), (Labels{0, 6}));
  EXPECT_EQ(labels_of_pieces(with + without), (Labels{6, 0}));
  EXPECT_EQ(labels_of_pieces(without), Labels());
  EXPECT_NE(reading_error("m.vtp", "<VTKFile type=\"PolyData\"><PolyData>" +
                                       piece("<CellData><DataArray type=\"Int32\" Name=\"label\" format=\"ascii\">4 x"
                                             "</DataArray></CellData>") +
                                       "</PolyData></VTKFile>")
                .find("\"x\""),
            std::string::npos);
  const std::string medit = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n";
  EXPECT_EQ(parse_medit(medit + "Triangles 1\n1 2 3 7\nQuadrilaterals 1\n1 2 3 4 -2\nEnd\n", "m").labels,
            (Labels{7, -2, -2}));
}

// ---- Gmsh ----

struct GmshMesh {
  std::vector<std::pair<std::size_t, Vec3>> nodes;                    // by tag
  std::vector<std::pair<int, std::array<std::size_t, 3>>> triangles;  // elementary surface, nodes
};

// The section of a name, without its first and last line.
std::istringstream section(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("$" + name + "\n");
  const std::size_t end = text.find("$End" + name);
  EXPECT_NE(begin, std::string::npos) << name;
  return std::istringstream(text.substr(begin + name.size() + 2, end - begin - name.size() - 2));
}

GmshMesh read_gmsh4(const std::string& text) {
  GmshMesh mesh;
  std::istringstream nodes = section(text, "Nodes"), elements = section(text, "Elements");
  std::size_t blocks = 0, count = 0, low = 0, high = 0, in_block = 0;
  int dimension = 0, tag = 0, other = 0;
  nodes >> blocks >> count >> low >> high;
  for (std::size_t b = 0; b < blocks; ++b) {
    nodes >> dimension >> tag >> other >> in_block;
    const std::size_t first = mesh.nodes.size();
    mesh.nodes.resize(first + in_block);
    for (std::size_t i = first; i < mesh.nodes.size(); ++i) nodes >> mesh.nodes[i].first;
    for (std::size_t i = first; i < mesh.nodes.size(); ++i)
      nodes >> mesh.nodes[i].second.x >> mesh.nodes[i].second.y >> mesh.nodes[i].second.z;
  }
  EXPECT_EQ(mesh.nodes.size(), count);
  elements >> blocks >> count >> low >> high;
  for (std::size_t b = 0; b < blocks; ++b) {
    elements >> dimension >> tag >> other >> in_block;
    EXPECT_EQ(other, 2);  // triangles
    for (std::size_t i = 0, number = 0; i < in_block; ++i) {
      mesh.triangles.push_back({tag, {}});
      elements >> number;
      for (std::size_t& v : mesh.triangles.back().second) elements >> v;
    }
  }
  EXPECT_TRUE(nodes && elements);
  EXPECT_EQ(mesh.triangles.size(), count);
  return mesh;
}

GmshMesh read_gmsh2(const std::string& text) {
  GmshMesh mesh;
  std::istringstream nodes = section(text, "Nodes"), elements = section(text, "Elements");
  std::size_t count = 0, number = 0;
  nodes >> count;
  mesh.nodes.resize(count);
  for (auto& [tag, p] : mesh.nodes) nodes >> tag >> p.x >> p.y >> p.z;
  elements >> count;
  int type = 0, tags = 0, physical = 0, surface = 0;
  for (std::size_t i = 0; i < count; ++i) {
    elements >> number >> type >> tags >> physical >> surface;
    EXPECT_EQ(type, 2);
    EXPECT_EQ(tags, 2);
    mesh.triangles.push_back({surface, {}});
    for (std::size_t& v : mesh.triangles.back().second) elements >> v;
  }
  EXPECT_TRUE(nodes && elements);
  return mesh;
}

TEST(OtherFormats, GmshFilesHoldTheMeshWithASurfaceForEachComponent) {
  const TriangleMesh mesh = shells();
  const MeshTopology topology = mesh_topology(mesh);
  for (const GmshVersion version : {GmshVersion::k4, GmshVersion::k2}) {
    MeshFileOptions options;
    options.gmsh_version = version;
    const std::string text = gmsh_bytes(mesh, options, "folder/m.msh");
    const bool is_new = version == GmshVersion::k4;
    EXPECT_TRUE(text.starts_with(is_new ? "$MeshFormat\n4.1 0 8\n" : "$MeshFormat\n2.2 0 8\n"));
    const GmshMesh back = is_new ? read_gmsh4(text) : read_gmsh2(text);
    ASSERT_EQ(back.nodes.size(), mesh.points.size());
    for (const auto& [tag, p] : back.nodes) EXPECT_EQ(p, mesh.points[tag - 1]);
    std::multiset<std::array<std::size_t, 3>> expected, found;
    for (const auto& [a, b, c] : mesh.triangles) expected.insert({a + 1ull, b + 1ull, c + 1ull});
    for (const auto& [surface, corners] : back.triangles) {
      found.insert(corners);
      EXPECT_EQ(static_cast<std::uint32_t>(surface), topology.component_of_vertex[corners[0] - 1] + 1);
    }
    EXPECT_EQ(found, expected);
    EXPECT_NE(text.find("geo Merge \"m.msh\";\n"), std::string::npos);
    EXPECT_NE(text.find("geo Volume(1) = {1, 2};\n"), std::string::npos);  // a ball with a cavity
    EXPECT_NE(text.find("geo Volume(3) = {3};\n"), std::string::npos);
  }
}

// ---- TetGen ----

// The numbers of a text without its comments.
std::istringstream without_comments(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) kept += line.substr(0, line.find('#')) + "\n";
  return std::istringstream(kept);
}

TEST(OtherFormats, SmeshFilesHaveAHolePointAndRegionPoints) {
  const TriangleMesh mesh = shells();
  std::istringstream in = without_comments(smesh_bytes(mesh, with_comments()));
  std::size_t points = 0, facets = 0, holes = 0, regions = 0, number = 0;
  int dimension = 0, attributes = 0, markers = 0;
  in >> points >> dimension >> attributes >> markers;
  ASSERT_EQ(points, mesh.points.size());
  for (const Vec3& p : mesh.points) {
    Vec3 q;
    in >> number >> q.x >> q.y >> q.z;
    EXPECT_EQ(q, p);
  }
  in >> facets >> markers;
  ASSERT_EQ(facets, mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3> read{};
    std::size_t corners = 0;
    in >> corners >> read[0] >> read[1] >> read[2] >> number;
    EXPECT_EQ(corners, 3u);
    EXPECT_EQ(read, triangle);
  }
  Vec3 p;
  in >> holes;
  ASSERT_EQ(holes, 1u);
  in >> number >> p.x >> p.y >> p.z;
  EXPECT_LT(norm(p), 0.99);
  in >> regions;
  ASSERT_EQ(regions, 2u);
  int component = 0;
  in >> number >> p.x >> p.y >> p.z >> component;
  EXPECT_GT(norm(p), 0.95);
  EXPECT_LT(norm(p), 2);
  EXPECT_EQ(component, 1);
  in >> number >> p.x >> p.y >> p.z >> component;
  EXPECT_LT(distance(p, {5, 0, 0}), 0.5);
  EXPECT_EQ(component, 3);
  EXPECT_TRUE(in);
}

TEST(OtherFormats, LabelsAreTheReferencesWhereThereAreAny) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  MeshFileOptions options;
  EXPECT_EQ(triangle_references(mesh, options.attributes), (std::vector<std::int64_t>{1, 1, 1, 1}));
  options.attributes.triangles = {{"label", 1, true, {7, 7, 9, 9}}};
  EXPECT_EQ(triangle_references(mesh, options.attributes), (std::vector<std::int64_t>{7, 7, 9, 9}));
  EXPECT_NE(medit_bytes(mesh, options).find("\n2 3 4 9\n"), std::string::npos);
}

// ---- GLB ----

TEST(OtherFormats, GlbHoldsMetresNormalsAndAPlace) {
  TriangleMesh mesh = testing::sphere_mesh(3, 10);
  for (Vec3& p : mesh.points) p = p + Vec3{1e6, -2e6, 30};
  MeshFileOptions options = with_comments();
  options.metres = 1e-3;
  const std::string bytes = glb_bytes(mesh, options);
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), bytes.size());
  const std::size_t json_size = word(12);
  EXPECT_EQ(json_size % 4, 0u);
  const auto json = nlohmann::json::parse(bytes.substr(20, json_size));
  EXPECT_EQ(json["asset"]["version"], "2.0");
  EXPECT_EQ(json["asset"]["extras"]["comments"][2], options.comments[2]);
  const std::size_t body = 20 + json_size + 8;
  EXPECT_EQ(word(20 + json_size), bytes.size() - body);
  const auto& place = json["nodes"][0]["translation"];
  const std::vector<Vec3> stored = glb_points(mesh, options.metres);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    std::array<float, 3> p{}, n{};
    std::memcpy(p.data(), bytes.data() + body + 12 * v, 12);
    std::memcpy(n.data(), bytes.data() + body + json["bufferViews"][1]["byteOffset"].get<std::size_t>() + 12 * v, 12);
    const Vec3 normal{n[0], n[1], n[2]};
    EXPECT_NEAR(norm(normal), 1, 1e-6);
    EXPECT_GT(dot(normal, mesh.points[v] - Vec3{1e6, -2e6, 30}), 9.9);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double in_file = static_cast<double>(p[axis]) + place[axis].get<double>();
      EXPECT_NEAR(in_file, 1e-3 * mesh.points[v][axis], 2e-9);  // a float alone would be off by 1e-4
      EXPECT_NEAR(stored[v][axis], mesh.points[v][axis], 2e-6);
      EXPECT_GE(p[axis], json["accessors"][0]["min"][axis].get<float>());
      EXPECT_LE(p[axis], json["accessors"][0]["max"][axis].get<float>());
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> corners{};
    std::memcpy(corners.data(), bytes.data() + body + 24 * mesh.points.size() + 12 * t, 12);
    EXPECT_EQ(corners, mesh.triangles[t]);
  }
  mesh.points[0].x = 1e300;
  EXPECT_THROW(static_cast<void>(glb_bytes(mesh)), InputError);
  EXPECT_FALSE(glb_bytes({}).empty());
}

// ---- STL ----

// Points that are one as floats stay apart, next to where they are, so that the mesh read back is the same manifold.
TEST(OtherFormats, StlKeepsAManifoldWherePointsFallTogether) {
  TriangleMesh few = testing::sphere_mesh(1, 4e-5);
  for (Vec3& p : few.points) p = p + Vec3{1000, 1000, 1000};  // floats there are 6e-5 apart
  std::set<std::tuple<float, float, float>> rounded;
  for (const Vec3& p : few.points)
    rounded.insert({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  EXPECT_LT(rounded.size(), few.points.size());
  const TriangleMesh back = parse_stl(stl_bytes(few, false), "m");
  EXPECT_EQ(back.points.size(), few.points.size());
  EXPECT_TRUE(mesh_topology(back).is_oriented());
  EXPECT_EQ(mesh_topology(back).components.size(), 1u);
  // A thousand points in a few floats cannot all stay apart; nothing worse comes of it.
  TriangleMesh many = testing::sphere_mesh(5, 1e-4);
  for (Vec3& p : many.points) p = p + Vec3{1000, 1000, 1000};
  EXPECT_LT(parse_stl(stl_bytes(many, false), "m").points.size(), many.points.size());
  // Two points that fall together beside a third one.
  TriangleMesh pair = testing::tetrahedron_mesh();
  for (Vec3& p : pair.points) p = 1e-9 * p + Vec3{1, 1, 1};
  EXPECT_EQ(parse_stl(stl_bytes(pair, false), "m").points.size(), 4u);
}

}  // namespace
}  // namespace deliso
