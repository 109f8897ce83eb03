// The meshes of several labels in files: one each, where {label} stands in the name, or all in one with a label per
// triangle.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "surface/mesh/io/mesh_io.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// The runs: one for each label, or one of the whole volume.
using Labels = std::vector<std::optional<std::int32_t>>;
Labels runs_of(const std::vector<std::int32_t>& labels);

// The name with the label in place of {label}.
std::string name_for(const std::string& pattern, std::optional<std::int32_t> label);

// Throws InputError when {label} stands in a name and no label is meshed, or several meshes shall be in one file of a
// format that holds no label per triangle. `format`: that of the mesh; none of another file.
void check_label_names(const std::string& pattern, const std::string& option, const std::vector<std::int32_t>& labels,
                       std::optional<MeshFormat> format);

// Meshes by the names of their files; those of one name come into one file.
class MeshFiles {
 public:
  // The options are those of the first mesh of a file, but for the attributes, which are those of all, and for comments
  // that not all have: these come after "label N: ".
  void add(const std::string& name, const TriangleMesh& mesh, std::optional<std::int32_t> label,
           const MeshFileOptions& options);
  // Returns what stderr must tell of options that a file has no room for, a line each.
  [[nodiscard]] std::vector<std::string> write() const;

 private:
  struct File {
    std::string name;
    TriangleMesh mesh;
    std::vector<std::int32_t> labels;  // of the meshes in it
    std::vector<std::vector<std::string>> comments;
    MeshFileOptions options;
  };
  std::vector<File> files_;
};

// The comments of a file that are for a label: those of all, and those of its own without "label N: ".
std::vector<std::string> comments_for(const std::vector<std::string>& comments, std::optional<std::int32_t> label);

// The triangles with a label, and their vertices; all of a mesh whose triangles have none.
TriangleMesh part_with_label(const TriangleMesh& mesh, std::optional<std::int32_t> label);

}  // namespace deliso
