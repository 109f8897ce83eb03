#include "experiments/commands/label_files.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "delaunay/base/check.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/mesh_output.h"

namespace deliso {
namespace {

constexpr std::string_view kLabelInName = "{label}";

void append(const TriangleMesh& from, std::optional<std::int32_t> label, TriangleMesh& to) {
  const auto first = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({first + a, first + b, first + c});
  if (label) to.labels.resize(to.triangles.size(), *label);
}

// Those of a mesh after those of the others in the file: all have the same names.
void append(const std::vector<MeshAttribute>& from, std::vector<MeshAttribute>& to) {
  for (std::size_t i = 0; i < to.size() && i < from.size(); ++i) {
    to[i].values.insert(to[i].values.end(), from[i].values.begin(), from[i].values.end());
  }
}

MeshAttribute label_attribute(const TriangleMesh& mesh) {
  MeshAttribute attribute{.name = "label", .width = 1, .is_whole = true, .values = {}};
  attribute.values.assign(mesh.labels.begin(), mesh.labels.end());
  return attribute;
}

// The formats with a number for each triangle in which surfaces may touch each other.
bool holds_labels(MeshFormat format) {
  return format == MeshFormat::kPly || format == MeshFormat::kLegacyVtk || format == MeshFormat::kVtp ||
         format == MeshFormat::kMedit;
}

// Stands before a comment for one label.
std::string before_comments_of(std::int32_t label) { return "label " + std::to_string(label) + ": "; }

bool holds(const std::vector<std::string>& list, const std::string& line) {
  return std::find(list.begin(), list.end(), line) != list.end();
}

// What all have once, in the order of the first; then what they do not share.
std::vector<std::string> joined_comments(const std::vector<std::vector<std::string>>& comments,
                                         const std::vector<std::int32_t>& labels) {
  const auto is_shared = [&](const std::string& line) {
    return std::all_of(comments.begin(), comments.end(), [&](const auto& list) { return holds(list, line); });
  };
  std::vector<std::string> joined;
  for (const std::string& line : comments.front()) {
    if (is_shared(line)) joined.push_back(line);
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (const std::string& line : comments[i]) {
      if (!is_shared(line)) joined.push_back(before_comments_of(labels[i]) + line);
    }
  }
  return joined;
}

}  // namespace

Labels runs_of(const std::vector<std::int32_t>& labels) {
  if (labels.empty()) return {std::nullopt};
  return {labels.begin(), labels.end()};
}

std::string name_for(const std::string& pattern, std::optional<std::int32_t> label) {
  std::string name = pattern;
  const std::size_t at = name.find(kLabelInName);
  if (label && at != std::string::npos) name.replace(at, kLabelInName.size(), std::to_string(*label));
  return name;
}

void check_label_names(const std::string& pattern, const std::string& option, const std::vector<std::int32_t>& labels,
                       std::optional<MeshFormat> format) {
  if (pattern.find(kLabelInName) != std::string::npos) {
    if (!labels.empty()) return;
    throw InputError(option + ": {label} stands for a label, but none is meshed, expected --label N or another name");
  }
  if (!format || labels.size() < 2 || holds_labels(*format)) return;
  throw InputError(option +
                   ": several labels in one file need a .ply, .vtk, .vtp or .mesh, which hold a label per triangle, or "
                   "{label} in the name for a file each, found '" +
                   pattern + "'");
}

void MeshFiles::add(const std::string& name, const TriangleMesh& mesh, std::optional<std::int32_t> label,
                    const MeshFileOptions& options) {
  auto file = std::find_if(files_.begin(), files_.end(), [&](const File& f) { return f.name == name; });
  if (file == files_.end()) {
    file = files_.insert(file, File{name, {}, {}, {}, options});
  } else {
    append(options.attributes.vertices, file->options.attributes.vertices);
    append(options.attributes.triangles, file->options.attributes.triangles);
  }
  append(mesh, label, file->mesh);
  file->comments.push_back(options.comments);
  if (label) file->labels.push_back(*label);
}

std::vector<std::string> MeshFiles::write() const {
  std::vector<std::string> remarks;
  for (const File& file : files_) {
    MeshFileOptions options = file.options;
    if (file.labels.size() > 1) options.comments = joined_comments(file.comments, file.labels);
    if (!file.labels.empty()) options.comments.push_back(label_note(file.labels));
    // A file of one label needs none at its triangles.
    TriangleMesh mesh = file.mesh;
    if (file.labels.size() < 2) {
      mesh.labels.clear();
    } else {
      options.attributes.triangles.push_back(label_attribute(mesh));
    }
    const std::string needed = write_mesh_output(mesh, file.name, options);
    if (needed.empty()) continue;
    remarks.push_back(file.name + ": the header of a binary STL file has no room for all that verify needs, which " +
                      "has to be given " + needed + " (other formats and --ascii have the room)");
  }
  return remarks;
}

std::vector<std::string> comments_for(const std::vector<std::string>& comments, std::optional<std::int32_t> label) {
  if (!label) return comments;
  const std::string mine = before_comments_of(*label);
  std::vector<std::string> found;
  found.reserve(comments.size());
  for (const std::string& line : comments) found.push_back(line.starts_with(mine) ? line.substr(mine.size()) : line);
  return found;
}

TriangleMesh part_with_label(const TriangleMesh& mesh, std::optional<std::int32_t> label) {
  if (!label || mesh.labels.empty()) return mesh;
  constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
  TriangleMesh part;
  std::vector<std::uint32_t> name(mesh.points.size(), kUnused);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.labels[t] != *label) continue;
    part.triangles.push_back(mesh.triangles[t]);
    for (std::uint32_t& v : part.triangles.back()) {
      if (name[v] == kUnused) {
        name[v] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(mesh.points[v]);
      }
      v = name[v];
    }
  }
  return part;
}

}  // namespace deliso
