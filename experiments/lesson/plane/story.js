// The words of a run: one sentence for what happened, one for what comes, and the numbers beside their thresholds. All
// of them are read off the frames.
Lesson.planeStory = (() => {
  const kinds = {
    start: {title: "InitTriangulation", mark: "bar", role: "plain"},
    multi: {title: "MultiIntersect", key: "m", mark: "square", role: "multi", rise: -8},
    extract: {title: "ExtractManifold", key: "e", mark: "triangle", role: "extract", rise: 0},
    approximate: {title: "ApproximateGeom", key: "a", mark: "disc", role: "approximate", rise: 8},
    poles: {title: "ComputePoles", key: "o", mark: "diamond", role: "poles"},
    build: {title: "BuildTriMesh", key: "b", mark: "pentagon", role: "plain"},
    refine: {title: "RefineGeom", key: "r", mark: "down", role: "refine"},
    refused: {title: "refused", key: "x", mark: "cross", role: "refused"},
    end: {title: "the end", key: "n", mark: "bar", role: "plain"},
  };

  const text = Lesson.numberText;
  const edgeText = ({u, v, a, b}) => `edge ${u ?? a}–${v ?? b}`;

  const umbrellaText = (count) =>
      count === 0 ? "no restricted edge" : `${Lesson.countText(count, "restricted edge")} instead of 2`;

  // What asks for the action.
  const reason = (action) => {
    switch (action.kind) {
      case "multi":
        return `The Voronoi edge of ${edgeText(action.edge)} hits the level set ${action.edge.hits.length} times`;
      case "extract":
        return `Vertex ${action.vertex} has ${umbrellaText(action.umbrella.length)}`;
      case "approximate":
        return `${capital(edgeText(action.edge))} is too far from the curve for its size`;
      default:
        return `${capital(edgeText(action.edge))} is too coarse`;
    }
  };

  const capital = (words) => words[0].toUpperCase() + words.slice(1);

  const coming = (action) => {
    switch (action.kind) {
      case "multi":
        return `${reason(action)}: the hit farthest from the edge goes in.`;
      case "extract":
        return action.umbrella.length ?
            `${reason(action)}: the hit on their Voronoi edges farthest from it goes in.` :
            `${reason(action)}; its Voronoi cell swallows a piece of the curve, whose farthest point goes in.`;
      case "approximate":
        return `${reason(action)}: the hit of its Voronoi edge goes in.`;
      case "poles":
        return "Every vertex has two restricted edges. ComputePoles: on either side of the curve, the Voronoi " +
            "vertex farthest from each vertex.";
      case "build":
        return "BuildTriMesh: the restricted edges become a mesh of their own; the Delaunay triangulation is " +
            "thrown away.";
      case "refine":
        return `${reason(action)}: its ball's center goes in, without any triangulation.`;
      case "refused":
        return `${reason(action)}, but the insertion is refused: ${action.refusal}.`;
      default:
        return "Nothing is left to do.";
    }
  };

  const happened = (run, frame) => {
    const {action} = frame;
    const vertex = (frame.polyline ?? frame.restricted.delaunay).points.length - 1;
    switch (frame.kind) {
      case "start":
        return `InitTriangulation: ${run.startCount} points of the level set and their Delaunay triangulation.`;
      case "multi":
      case "extract":
      case "approximate":
        return `${kinds[frame.kind].title} inserted vertex ${vertex}. ${
            Lesson.countText(frame.restricted.edges.length, "edge is", "edges are")} restricted.`;
      case "poles":
        return "ComputePoles: a diamond for each pole; the nearer one of a vertex counts.";
      case "build":
        return `BuildTriMesh: ${frame.polyline.edges.length} edges. What needs circles through all points can ` +
            "never be asked again.";
      case "refine":
        return `RefineGeom inserted vertex ${vertex}: a path E of ${
            Lesson.countText(action.path.length, "edge")} gave way to ${action.path.length + 1}.`;
      case "refused":
        return `Refused: ${action.refusal}. The edge stays as it is.`;
      default:
        return verdict(run, frame);
    }
  };

  // What the reader can do about a wrong mesh, as far as the algorithm itself would not.
  const remedy = ({missedLoops}, left) => {
    if (missedLoops.length)
      return " No Voronoi edge hits what is missed, so nothing asks for a point there: seed every loop.";
    return left ? " A smaller size bound lets it go on." : "";
  };

  const verdict = (run, frame) => {
    const certificate = run.certificate(frame);
    const {isRight, complaints, pieces, loops} = certificate;
    const left = frame.left?.length ?? 0;
    const forbidden = left ? ` The size bound forbids to mend ${Lesson.countText(left, "violation")}.` : "";
    if (isRight) {
      return `The end: ${Lesson.countText(pieces, "piece")} for ${
                 Lesson.countText(loops, "loop")}, each in its place. ` +
          `The mesh is right.${forbidden}`;
    }
    const cut = frame.kind === "end" ? "" : " The run was cut.";
    return `The end, and the mesh is wrong: ${complaints.join("; ")}.${forbidden}${cut}${remedy(certificate, left)}`;
  };

  const row = (name, value, sign, limit) => ({
    name,
    value,
    sign,
    limit,
    holds: sign === ">" ? value > limit :
        sign === "≠"    ? value !== limit :
                          value >= limit,
  });

  // The card *why* of the next action.
  const why = (run, frame) => {
    const action = frame.next;
    if (!action || action.kind === "end") return null;
    const {epsilon, epsilon1, epsilon2, rMin, sizeBound} = run.options;
    const {edge} = action;
    const kept = action.room === undefined ?
        [] :
        [{...row("room for the point (size bound)", action.room, "≥", sizeBound), isGuard: true}];
    const remark = frame.left.length ? `The size bound forbids ${frame.left.length} more.` : null;
    switch (action.kind) {
      case "multi":
        return {
          title: capital(edgeText(edge)),
          remark,
          rows: [
            row("hits", edge.hits.length, ">", 1), row("farthest hit, nearest", action.measure, ">", edge.h), ...kept
          ]
        };
      case "extract":
        return {
          title: `Vertex ${action.vertex}`,
          remark,
          rows: [row("restricted edges", action.umbrella.length, "≠", 2), ...kept]
        };
      case "approximate":
        return {
          title: capital(edgeText(edge)),
          remark,
          rows: [row("h / r  (ε)", edge.h / edge.r, ">", epsilon), row("r  (r_min)", edge.r, ">", rMin), ...kept]
        };
      case "refine":
      case "refused":
        return {
          title: capital(edgeText(edge)),
          remark: action.refusal,
          rows: [
            row("h / r  (ε₁)", edge.h / edge.r, ">", epsilon1),
            row("r / h̄  (ε₂)", edge.r / frame.polyline.meanHeight(edge), ">", epsilon2),
            row("r  (r_min)", edge.r, ">", rMin),
            {...row("edges in E", action.path.length, "=", 1), holds: action.path.length === 1, isGuard: true}
          ]
        };
      case "build": {
        const heights = frame.poles.map((pole) => pole.height);
        const facts = [["the least pole height", Math.min(...heights)], ["the largest", Math.max(...heights)]];
        return {
          title: "Stage 2 needs the pole heights only:",
          remark:
              "What stays unasked from now on: whether a Voronoi edge has a second hit, whether a point is in a circle.",
          rows: facts.map(([name, value]) => ({name, value, sign: "", limit: NaN, isFact: true}))
        };
      }
      default:
        return {
          title: "Every vertex has two restricted edges, every dual edge one hit, no h / r is above ε.",
          remark,
          rows: []
        };
    }
  };

  return {kinds, coming, happened, verdict, why};
})();
