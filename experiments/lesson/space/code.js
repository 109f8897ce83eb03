// Figures 4, 5, 9 and 3 of the paper, line by line, with the place in the program where each line stands. A test looks
// all of them up.
Lesson.spaceCode = (() => {
  const at = (file, name) => ({file, name});
  const figure4 = [
    {
      text: "Del S ← InitTriangulation()",
      ...at("surface/recover/init_triangulation.h", "init_triangulation"),
      kinds: ["initial"]
    },
    {text: "Del S ← Recover(Del S)", ...at("surface/recover/recover.h", "recover")},
    {text: "T ← Refine(Del S)", ...at("surface/refine/refine.h", "refine_geometry")},
  ];
  const figure5 = [
    {
      text: "MultiIntersect: a dual edge with > 1 hits",
      ...at("surface/recover/refinement_points.cpp", "multi_intersect"),
      kinds: ["multi_intersect"]
    },
    {
      text: "ExtractManifold: D_q is no disk",
      ...at("surface/recover/refinement_points.cpp", "extract_manifold"),
      kinds: ["extract_manifold"]
    },
    {
      text: "ApproximateGeom: r > r_min and (h/r > ε or r/l > ρ)",
      ...at("surface/recover/refinement_points.cpp", "approximate_geometry"),
      kinds: ["approximate_geometry"]
    },
    {text: "ExtractManifold", ...at("surface/recover/recover_loop.h", "RecoverLoop")},
    {
      text: "(ours) samples of parts that are missed",
      ...at("surface/recover/coverage.h", "recover_missed_parts"),
      kinds: ["coverage"]
    },
    {
      text: "(ours) no insertion nearer than the size bound",
      ...at("surface/recover/recover.cpp", "size_bound"),
      kinds: ["refuse"]
    },
  ];
  const figure9 = [
    {text: "ComputePoles(Del S)", ...at("surface/restricted/poles.h", "compute_poles")},
    {
      text: "T ← BuildTriMesh(Del S); forget Del S",
      ...at("surface/extract/build_triangle_mesh.h", "build_triangle_mesh"),
      kinds: ["mesh"]
    },
    {
      text: "RefineGeom: r > r_min and\n  (h/r > ε₁ or r/h̄ > ε₂ or r/l > ρ)",
      ...at("surface/base/criteria.h", "refine_geometry_badness")
    },
    {
      text: "  E ← triangles whose balls hold x_σ",
      ...at("surface/refine/disk/refinement_disk.h", "RefinementDisk"),
      kinds: ["keep"]
    },
    {
      text: "  T ← T − E + D, D the star of x_σ",
      ...at("surface/refine/refine_loop.cpp", "replace_disk"),
      kinds: ["refine"]
    },
    {text: "(ours) take back what came to meet", ...at("surface/refine/refine.cpp", "take_back"), kinds: ["restart"]},
    {text: "(ours) better angles", ...at("surface/shape/shape.h", "improve_shape"), kinds: ["shape"]},
    {text: "return T", ...at("surface/deliso.cpp", "certify"), kinds: ["refined", "certify", "end"]},
  ];
  const make = (title, lines) =>
      ({title, lines, lineOf: (kind) => lines.findIndex((line) => line.kinds?.includes(kind))});
  return {
    stage1: make("Figures 4, 5 and 9", [...figure4.slice(0, 1), ...figure5, ...figure9.slice(0, 2)]),
    stage2: make("Figures 9 and 3", figure9),
    whole: make("Figure 4", figure4),
  };
})();
