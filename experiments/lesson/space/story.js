// The words of a run in space. What happened, what comes and why are read off the events of the trace.
Lesson.spaceStory = (() => {
  const text = Lesson.numberText;
  const count = Lesson.countText;
  const name = (v) => v.slice(0, 3).join("–");

  const kinds = {
    initial: {title: "InitTriangulation", mark: "bar", role: "plain"},
    multi_intersect: {title: "MultiIntersect", key: "m", mark: "square", role: "multi", rise: -8},
    extract_manifold: {title: "ExtractManifold", key: "e", mark: "triangle", role: "extract", rise: 0},
    approximate_geometry: {title: "ApproximateGeom", key: "a", mark: "disc", role: "approximate", rise: 8},
    coverage: {title: "coverage (ours)", key: "c", mark: "plus", role: "poles"},
    refuse: {title: "refused", key: "x", mark: "cross", role: "refused"},
    mesh: {title: "BuildTriMesh", key: "b", mark: "pentagon", role: "plain"},
    refine: {title: "RefineGeom", key: "r", mark: "down", role: "refine"},
    keep: {title: "refused", key: "x", mark: "cross", role: "refused"},
    restart: {title: "taken back", key: "t", mark: "diamond", role: "refused"},
    refined: {title: "the end of stage 2", mark: "bar", role: "plain"},
    shape: {title: "shape (ours)", mark: "star", role: "plain"},
    certify: {title: "certificate (ours)", mark: "square", role: "plain"},
    end: {title: "the end", key: "n", mark: "bar", role: "plain"},
  };

  const kindOf = (event) => (event.e === "insert" ? event.why : event.e);

  const reasons = {
    multi_intersect: (e) => `The dual edge of facet ${name(e.sigma)} hits the surface ${e.sigma[3].length} times`,
    extract_manifold: (e) => e.disk.length ?
        `The umbrella of vertex ${e.q}, ${count(e.disk.length, "facet")}, is no disk` :
        `Vertex ${e.q} has no restricted facet`,
    approximate_geometry: (e) => `Facet ${name(e.sigma)} is too coarse`,
    coverage: () => "The mesh is far from a part of the surface",
  };

  const moves = {
    multi_intersect: "the hit farthest from the facet goes in",
    extract_manifold: "the farthest hit of its facets goes in",
    approximate_geometry: "its hit x_σ goes in",
    coverage: "a sample of that part goes in",
  };

  const criteria = {
    criterion1: "h / r > ε₁",
    criterion2: "r / h̄ > ε₂",
    criterion3: "r / l > ρ",
    max_distance: "h > max_distance",
    boundary: "a boundary edge is too long",
    halving: "x_σ was refused; its longest edge is halved",
    coverage: "a sample of the surface is far"
  };

  const coming = (e) => {
    switch (e.e) {
      case "insert":
        return `${reasons[e.why](e)}: ${moves[e.why]}.`;
      case "refuse":
        return `${reasons[e.why](e)}, but the point is refused (${e.cause.replace("_", " ")}).`;
      case "mesh":
        return "All umbrellas are disks. ComputePoles, then BuildTriMesh; the tetrahedra are thrown away.";
      case "refine":
        return `Triangle ${name(e.t)}: ${criteria[e.why]}. E is replaced by the star of its x_σ.`;
      case "keep":
        return `Triangle ${name(e.t)} is coarse, but the insertion is refused: ${e.cause.replaceAll("_", " ")}.`;
      case "restart":
        return "Triangles came to meet: all of stage 2 is taken back, and begins again with more care.";
      case "shape":
        return e.why === "folds"  ? "Edges across folds are flipped to run along them (not in the paper)." :
               e.why === "angles" ? "Vertices move to where the angles around them are larger (not in the paper)." :
               e.why === "rest"   ? "Steps for what is promised, which are not told one by one (not in the paper)." :
                                    "Badly shaped triangles are improved (not in the paper).";
      case "refined":
        return "No triangle is left that can be refined.";
      case "certify":
        return "The certificate: the mesh is compared with the exact topology, crossings and distances are looked for.";
      case "end":
        return "Nothing is left to do.";
      default:
        return kinds[kindOf(e)].title;
    }
  };

  const starOf = (e) => e.above?.length ?? Lesson.Replay.starOf(e).length;

  const happened = (e) => {
    switch (e.e) {
      case "initial":
        return `InitTriangulation: ${e.points.length} points of the surface, ${e.tets.length} tetrahedra ` +
            "with those at infinity.";
      case "insert":
        return `${kinds[e.why].title} inserted vertex ${e.v}: ${
            count(e.gone.length, "tetrahedron gave", "tetrahedra gave")} way to ${starOf(e)}.`;
      case "refuse":
        return `Refused: ${e.cause.replace("_", " ")}. ${reasons[e.why](e)} still.`;
      case "mesh":
        return `BuildTriMesh: ${e.points.length} vertices, ${e.triangles.length} triangles. What needs ` +
            "tetrahedra can never be asked again.";
      case "refine":
        return `RefineGeom inserted vertex ${e.v}: E of ${count(e.gone.length, "triangle")} gave way to D of ` +
            `${starOf(e)}.`;
      case "keep":
        return `Refused: ${e.cause.replaceAll("_", " ")}. Triangle ${name(e.t)} stays as it is for now.`;
      case "restart":
        return "Everything since BuildTriMesh was taken back.";
      case "shape":
        return e.why === "folds"  ? "Edges across folds were flipped to run along them." :
               e.why === "angles" ? "Vertices were moved to where the angles around them are larger." :
               e.why === "rest"   ? "The mesh that leaves the program, after steps that are not told one by one." :
                                    "Flips, moves and merges have improved small angles.";
      case "certify":
        return `Certificate: topology ${e.homeomorphic ? "equal" : "different"}, ${
            count(e.crossing, "pair of triangles crosses", "pairs of triangles cross")}, ${
            count(e.vertices_off + e.mesh_off + e.isosurface_off, "place", "places")} too far off.`;
      case "end":
        return `The end: ${e.vertices} vertices, ${e.triangles} triangles, ${e.verdict}` +
            `${e.proven ? ", proven" : ""}.`;
      default:
        return `${kinds[kindOf(e)].title}.`;
    }
  };

  const row = (label, value, sign, limit, holds = value > limit) => ({name: label, value, sign, limit, holds});

  const why = (e, limits) => {
    if (!e) return null;
    const title = coming(e);
    if (e.e === "insert" || e.e === "refuse") {
      switch (e.why) {
        case "multi_intersect":
          return {title, rows: [row("hits of the dual edge", e.sigma[3].length, ">", 1)]};
        case "extract_manifold":
          return {
            title,
            rows: [],
            remark: "A disk has one cycle for its link (at the box, one path). " +
                `Here: ${Lesson.link.describe(Lesson.link.of(e.disk, e.q))}.`
          };
        case "approximate_geometry":
          return {
            title,
            rows: [row("h / r  (ε)", e.h / e.r, ">", limits.epsilon), row("r / l  (ρ)", e.r / e.l, ">", limits.rho)]
          };
        default:
          return {title, rows: []};
      }
    }
    if (e.e !== "refine") return {title, rows: []};
    return {
      title,
      rows: [
        row("h / r  (ε₁)", e.h / e.r, ">", limits.epsilon1), row("r / h̄  (ε₂)", e.r / e.pole, ">", limits.epsilon2),
        row("r / l  (ρ)", e.r / e.l, ">", limits.rho), row("r  (r_min)", e.r, ">", limits.r_min)
      ]
    };
  };

  return {kinds, kindOf, coming, happened, why, reasons, text};
})();
