// The paper's Figures 4, 5 and 9 as they read in the plane, each line with the place in the program where the same line
// of space stands. A test looks all of them up.
Lesson.planeCode = (() => {
  const lines = [
    {
      text: "Del S ← InitTriangulation()",
      file: "surface/recover/init_triangulation.h",
      name: "init_triangulation",
      kinds: ["start"]
    },
    {text: "Recover: repeat until nothing holds", file: "surface/recover/recover_loop.h", name: "RecoverLoop"},
    {
      text: "  MultiIntersect: a dual edge with > 1 hits\n    → insert the hit farthest from the edge",
      file: "surface/recover/refinement_points.cpp",
      name: "multi_intersect",
      kinds: ["multi"]
    },
    {
      text: "  ExtractManifold: D_q is not 2 edges\n    → insert the hit of D_q farthest from q",
      file: "surface/recover/refinement_points.cpp",
      name: "extract_manifold",
      kinds: ["extract"]
    },
    {
      text: "  ApproximateGeom: r > r_min and h/r > ε\n    → insert x, the hit of the dual edge",
      file: "surface/recover/refinement_points.cpp",
      name: "approximate_geometry",
      kinds: ["approximate"]
    },
    {
      text: "ComputePoles(Del S): h_q for every vertex q",
      file: "surface/restricted/poles.h",
      name: "compute_poles",
      kinds: ["poles"]
    },
    {
      text: "T ← BuildTriMesh(Del S); forget Del S",
      file: "surface/extract/build_triangle_mesh.h",
      name: "build_triangle_mesh",
      kinds: ["build"]
    },
    {
      text: "RefineGeom: r > r_min and (h/r > ε₁ or r/h̄ > ε₂)",
      file: "surface/refine/refine.h",
      name: "refine_geometry"
    },
    {
      text: "  E ← the path of edges whose balls hold x",
      file: "surface/refine/disk/refinement_disk.h",
      name: "RefinementDisk",
      kinds: ["refused"]
    },
    {
      text: "  T ← T − E + D, D joins x to the ends of E",
      file: "surface/refine/refine_loop.cpp",
      name: "replace_disk",
      kinds: ["refine"]
    },
    {text: "return T", file: "surface/deliso.cpp", name: "Pipeline", kinds: ["end"]},
  ];

  const lineOf = (kind) => lines.findIndex((line) => line.kinds?.includes(kind));

  return {title: "Figures 4, 5, 9 in the plane", lines, lineOf};
})();
