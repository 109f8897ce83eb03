// The picture of a frame: the same layers, by number, as in the chapters about space. What comes next is drawn over
// what is: the point, its empty circle, the conflict region and its rim.
Lesson.planePicture = (() => {
  const layers = {
    1: "samples",
    2: "level set",
    3: "Voronoi",
    4: "Delaunay",
    5: "restricted, mesh",
    6: "hits",
    7: "conflict region",
    8: "rim, star",
    9: "poles"
  };

  const drawField = (scene, run, showsValues) => {
    const {field} = run;
    scene.onLayer(1);
    for (let j = 0; j < field.height; ++j) {
      for (let i = 0; i < field.width; ++i) {
        const f = field.sample(i, j);
        // The farther from the isovalue, the larger, so that a hand knows what a small change turns over.
        const size = 1.6 + 2.2 * Math.min(1, Math.abs(f) / 3);
        scene.mark([i, j], f < 0 ? "disc" : "square", f < 0 ? "below" : "above", size);
        if (showsValues) scene.label([i, j], Lesson.numberText(f), "softLabel", 0.1);
      }
    }
    scene.onLayer(2);
    run.curves ??= run.levelSet.curves();
    for (const curve of run.curves) scene.line(curve, "surface");
  };

  // Voronoi edges may end far out; only what lies near the box is drawn.
  const clipped = (field, [a, b]) => {
    const part = field.clip(a, b);
    return part && part.map((t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
  };

  const drawTriangulation = (scene, field, restricted) => {
    const {points} = restricted.delaunay;
    scene.onLayer(4);
    for (const {u, v} of restricted.delaunay.allEdges()) scene.line([points[u], points[v]], "delaunay");
    scene.onLayer(3);
    for (const {ends} of restricted.dualEdges) {
      const inside = clipped(field, ends);
      if (inside) scene.line(inside, "voronoi");
    }
    scene.onLayer(5);
    for (const {u, v} of restricted.edges) scene.line([points[u], points[v]], "restricted");
    scene.onLayer(6);
    for (const edge of restricted.edges)
      for (const hit of edge.hits) scene.mark(hit.point, "cross", "hit", 4);
  };

  const drawPoles = (scene, restricted, poles) => {
    scene.onLayer(9);
    poles.forEach((pole, q) => {
      const from = restricted.delaunay.points[q];
      for (const side of [pole.above, pole.below]) {
        if (!side?.point || !restricted.field.holds(side.point)) continue;
        const counts = side.distance === pole.height;
        if (counts) scene.line([from, side.point], "poleLine");
        scene.mark(side.point, "diamond", "pole", counts ? 5 : 2.5);
      }
    });
  };

  const drawVertices = (scene, points, newest) => {
    scene.onLayer(0);
    points.forEach((p, q) => {
      const isNew = q === points.length - 1 && newest;
      scene.mark(p, "disc", "vertex", isNew ? 5 : 3.2);
      scene.label(p, String(q), "label", isNew ? 5 : 1 + q / 10000);
    });
  };

  // What stage 1 is about to do.
  const drawConflict = (scene, {field, delaunay, dualEdges}, action) => {
    const {points} = delaunay;
    const {edge, vertex, umbrella, point, gone, rim} = action;
    scene.onLayer(7);
    for (const triangle of gone) {
      if (!delaunay.isGhost(triangle)) scene.polygon(triangle.map((v) => points[v]), "conflict");
    }
    scene.onLayer(8);
    for (const [u, v] of rim) {
      if (u !== Lesson.kInfinite && v !== Lesson.kInfinite) scene.line([points[u], points[v]], "rim");
    }
    for (const v of new Set(rim.flat()))
      if (v !== Lesson.kInfinite) scene.line([points[v], point], "star");
    scene.onLayer(0);
    if (edge) {
      scene.line([points[edge.u], points[edge.v]], "target");
      const inside = clipped(field, edge.ends);
      if (inside) scene.line(inside, "dualEdge");
      for (const hit of edge.hits) scene.mark(hit.point, "cross", "hit", 7);
      // The circle around the point through the ends of the edge: no vertex lies inside.
      scene.circle(point, Lesson.distance(point, points[edge.u]), "ball");
    } else {
      scene.circle(points[vertex], 0.55, "target");
      for (const other of umbrella) scene.line([points[other.u], points[other.v]], "target");
      for (const dual of dualEdges) {
        if (dual.u !== vertex && dual.v !== vertex) continue;
        const inside = clipped(field, dual.ends);
        if (inside) scene.line(inside, "dualEdge");
      }
    }
    drawPoint(scene, point);
  };

  const drawPoint = (scene, point) => {
    scene.onLayer(0);
    scene.mark(point, "star", "point", 8);
    scene.label(point, "next", "label", 9);
  };

  // What stage 2 is about to do: the ball, the path E and, where it is not refused, D.
  const drawPath = (scene, polyline, {point, path, edge, refusal}) => {
    const {points} = polyline;
    scene.onLayer(7);
    scene.circle(point, Lesson.distance(point, points[edge.a]), "ball");
    for (const other of path) scene.line([points[other.a], points[other.b]], "pathE");
    scene.onLayer(8);
    if (!refusal) scene.line([points[path[0].a], point, points[path[path.length - 1].b]], "pathD");
    drawPoint(scene, point);
  };

  // BuildTriMesh forgets the triangulation: it is seen a last time, faint.
  const drawForgotten = (scene, {delaunay}) => {
    scene.onLayer(4);
    for (const {u, v} of delaunay.allEdges()) scene.line([delaunay.points[u], delaunay.points[v]], "forgotten");
  };

  // At the end, loops that the mesh does not have, and vertices at which it is no curve.
  const drawFaults = (scene, run, frame) => {
    if (frame.kind !== "end") return;
    const {missedLoops, brokenVertices} = run.certificate(frame);
    scene.onLayer(0);
    for (const loop of missedLoops) {
      const curves = run.curves.filter((_, k) => run.levelSet.arcs[k].loop === loop);
      for (const curve of curves) scene.line(curve, "wrong");
      scene.label(curves[0][0], "missed", "label", 8);
    }
    const {points} = run.mesh(frame);
    for (const q of brokenVertices) scene.circle(points[q], 0.35, "wrong");
  };

  const drawAction = (scene, frame) => {
    const action = frame.next;
    if (!action?.point) return;
    if (frame.polyline)
      drawPath(scene, frame.polyline, action);
    else
      drawConflict(scene, frame.restricted, action);
  };

  const scene = (run, frame, {preview, showsValues}) => {
    const {field} = run;
    const picture = new Lesson.Scene([-0.6, -0.6, field.width - 0.4, field.height - 0.4]);
    drawField(picture, run, showsValues);
    if (frame.polyline) {
      const {points, edges} = frame.polyline;
      picture.onLayer(5);
      if (frame.kind === "build") drawForgotten(picture, frame.restricted);
      for (const edge of edges) picture.line([points[edge.a], points[edge.b]], "mesh");
      drawFaults(picture, run, frame);
      if (preview) drawAction(picture, frame);
      drawVertices(picture, points, frame.kind === "refine");
      return picture;
    }
    drawTriangulation(picture, field, frame.restricted);
    drawFaults(picture, run, frame);
    if (frame.poles) drawPoles(picture, frame.restricted, frame.poles);
    if (preview) drawAction(picture, frame);
    drawVertices(picture, frame.restricted.delaunay.points, frame.action?.point);
    return picture;
  };

  return {layers, scene};
})();
