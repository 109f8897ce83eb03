// same_mesh VOLUME ISOVALUE MESH: whether the library makes the mesh that the program has written, to the last bit.
#include <deliso/deliso.h>

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int, char** arguments) {
  const deliso::LoadedVolume volume = deliso::load_volume(arguments[1]);
  deliso::MeshOptions options;
  options.parameters.set("stage2.epsilon1", 0.15);
  const deliso::Mesh own = deliso::mesh(volume.view, std::strtod(arguments[2], nullptr), options).mesh;
  const deliso::Mesh other = deliso::load_mesh(arguments[3]);
  const bool is_same = own.vertices == other.vertices && own.triangles == other.triangles && !own.triangles.empty();
  std::printf("%s: %zu and %zu vertices\n", is_same ? "same" : "different", own.vertices.size(), other.vertices.size());
  return is_same ? 0 : 1;
}
