// The coding lab: three functions, empty, that a student writes in the page. Instances depend on the seed; what is
// right is found in another way than a good solution would find it, so that no solution stands in the page.
Lesson.codingTasks = (() => {
  const kCount = 60;
  const near = (a, b, tolerance = 1e-6) => Math.abs(a - b) <= tolerance;
  const nearPoints = (p, q) => Array.isArray(p) && p.length === 2 && near(p[0], q[0]) && near(p[1], q[1]);

  // Where a quadratic changes its sign, by halving what a walk in small steps finds.
  const rootsByWalking = (f) => {
    const kSteps = 3000;
    const roots = [];
    for (let k = 0; k < kSteps; ++k) {
      let low = k / kSteps, high = (k + 1) / kSteps;
      const startsBelow = f(low) < 0;
      if (startsBelow === f(high) < 0) continue;
      for (let i = 0; i < 60; ++i) {
        const middle = (low + high) / 2;
        if (f(middle) < 0 === startsBelow)
          low = middle;
        else
          high = middle;
      }
      roots.push((low + high) / 2);
    }
    return roots;
  };

  // The quadratic through three values, as Lagrange has it.
  const quadratic = ([v0, vm, v1]) => (t) => v0 * (2 * t - 1) * (t - 1) + vm * 4 * t * (1 - t) + v1 * t * (2 * t - 1);

  const hits = {
    name: "hits",
    title: "1. hits",
    statement:
        "Along a segment within one cell, g − κ is a quadratic in t. It is v0 at t = 0, vm at t = ½ and v1 at t = 1. " +
        "Return all t in [0, 1] where it is zero, in ascending order. (In space it is a cubic: Figure 12, FindIntersections.)",
    skeleton: "// Returns an array, perhaps an empty one.\nfunction hits(v0, vm, v1) {\n  return [];\n}\n",
    // Values without roots that almost meet, or lie almost at an end, on which rounding might decide.
    instances(random) {
      // Both ends above, both below, a straight line with a root and one without.
      const list = [[1, -0.5, 1], [-1, 0.6, -1], [-1, 0, 1], [1, 2, 3]].map((values) => ({arguments: values}));
      while (list.length < kCount) {
        const values = [0, 0, 0].map(() => random.between(-1, 1));
        const f = quadratic(values);
        const isClear = rootsByWalking(f).every((t) => t > 0.01 && t < 0.99) && Math.abs(values[0]) > 0.01 &&
            Math.abs(values[2]) > 0.01 && !this.nearlyTouches(values);
        if (isClear) list.push({arguments: values});
      }
      return list;
    },
    nearlyTouches([v0, vm, v1]) {
      const a = 2 * (v0 + v1 - 2 * vm), b = 4 * vm - 3 * v0 - v1;
      return Math.abs(quadratic([v0, vm, v1])(-b / (2 * a))) < 0.01;
    },
    answer: ({arguments: values}) => rootsByWalking(quadratic(values)),
    isRight: (given, right) =>
        Array.isArray(given) && given.length === right.length && given.every((t, k) => near(t, right[k])),
    // The graph over t, which is drawn three times as wide as it is.
    picture(instance, given, right) {
      const kWide = 3;
      const f = quadratic(instance.arguments);
      const reach = Math.max(1, ...instance.arguments.map(Math.abs)) * 1.15;
      const scene = new Lesson.Scene([-0.2, -reach, kWide + 0.2, reach]);
      scene.line([[-0.1, 0], [kWide + 0.1, 0]], "grid");
      for (const x of [0, kWide]) scene.line([[x, -reach], [x, reach]], "grid");
      scene.label([0, 0], "t = 0", "softLabel", 1);
      scene.label([kWide, 0], "t = 1", "softLabel", 1);
      const points = Array.from({length: 61}, (_, k) => [kWide * k / 60, f(k / 60)]);
      scene.line(points, "surface");
      [0, 0.5, 1].forEach((t, k) => scene.mark([kWide * t, instance.arguments[k]], "disc", "vertex", 4));
      const onAxis = (times) => times.filter(Number.isFinite).map((t) => [kWide * t, 0]);
      drawRightAndGiven(scene, onAxis(right), onAxis(asArray(given)));
      return scene;
    },
  };

  const asArray = (given) => (Array.isArray(given) ? given : []);

  const isPoint = (p) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite);

  const drawRightAndGiven = (scene, right, given) => {
    for (const p of right) {
      scene.mark(p, "square", "right", 8);
      scene.label(p, "right", "label", 2);
    }
    for (const p of given.filter(isPoint)) {
      scene.mark(p, "cross", "wrong", 8);
      scene.label(p, "yours", "label", 3);
    }
  };

  const boundsOf = (points) => {
    const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])];
    return [Math.min(...xs) - 1, Math.min(...ys) - 1, Math.max(...xs) + 1, Math.max(...ys) + 1];
  };

  // States of runs on fields of the seed: those in which MultiIntersect is asked, or those of stage 2.
  const statesOfRuns = (random, kind, count = kCount) => {
    const states = [];
    for (let tries = 0; states.length < count && tries < 400; ++tries) {
      const field = Lesson.fields.bumps(random, 12);
      const run = new Lesson.Run(field, Lesson.startPoints(field, random, {start: 4, seeding: "random"}));
      const frames = run.frames.filter((frame) => (kind === "stage1" ? frame.next?.kind === "multi" : frame.polyline));
      for (let k = 0; k < 6 && frames.length; ++k) states.push({run, frame: frames[random.below(frames.length)]});
    }
    return states.slice(0, count);
  };

  // Edges with hits on their bisectors, without a triangulation behind them.
  const randomEdges = (random) => Array.from({length: 3 + random.below(6)}, () => {
    const [x, y, angle] = [random.between(0, 10), random.between(0, 10), random.between(0, 7)];
    const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
    const r = random.between(0.2, 3);
    const hits = Array.from({length: random.below(4)}, () => random.between(-3, 3)).sort((s, t) => s - t);
    return {a: [x - r * dx, y - r * dy], b: [x + r * dx, y + r * dy], hits: hits.map((t) => [x - t * dy, y + t * dx])};
  });

  const multiIntersect = {
    name: "multiIntersect",
    title: "2. multiIntersect",
    statement:
        "Each edge of the Delaunay triangulation has ends a and b and the hits of its Voronoi edge, all of them points " +
        "[x, y]. Where a Voronoi edge has several hits, the one farthest from the middle of the edge is a candidate. Return " +
        "the candidate that is farthest from the middle of its edge, or null if there is none (Figure 5, line 2).",
    skeleton:
        "// edges: [{a: [x, y], b: [x, y],\n//          hits: [[x, y], ...]}, ...]\n// Returns a point [x, y] or null.\n" +
        "function multiIntersect(edges) {\n  return null;\n}\n",
    // Half of them from runs, in which few edges ask; half drawn at random, in which many do.
    instances(random) {
      const ofRuns = statesOfRuns(random, "stage1", kCount / 2).map(({frame}) => {
        const {points} = frame.restricted.delaunay;
        const edges = frame.restricted.dualEdges.map(
            (edge) => ({a: points[edge.u], b: points[edge.v], hits: edge.hits.map((hit) => hit.point)}));
        return {arguments: [edges]};
      });
      return [...ofRuns, ...Array.from({length: kCount - ofRuns.length}, () => ({arguments: [randomEdges(random)]}))];
    },
    // All candidates in one list, sorted.
    answer({arguments: [edges]}) {
      const candidates =
          edges.filter((edge) => edge.hits.length > 1)
              .flatMap(
                  ({a, b, hits: points}) =>
                      points.map((p) => ({p, length: (2 * p[0] - a[0] - b[0]) ** 2 + (2 * p[1] - a[1] - b[1]) ** 2})));
      return candidates.sort((s, t) => t.length - s.length)[0]?.p ?? null;
    },
    isRight: (given, right) => (right === null ? given === null : nearPoints(given, right)),
    picture({arguments: [edges]}, given, right) {
      const scene = new Lesson.Scene(boundsOf(edges.flatMap((edge) => [edge.a, edge.b, ...edge.hits])));
      for (const edge of edges) {
        scene.line([edge.a, edge.b], edge.hits.length > 1 ? "target" : edge.hits.length ? "restricted" : "delaunay");
        for (const p of edge.hits) scene.mark(p, "cross", "hit", 4);
        if (edge.hits.length > 1) scene.line(edge.hits, "dualEdge");
      }
      drawRightAndGiven(scene, right ? [right] : [], isPoint(given) ? [given] : []);
      return scene;
    },
  };

  // A mesh of stage 2 and a point; balls are made larger at random, so that paths of several edges occur.
  const diskInstance = (random, polyline) => {
    const edges =
        polyline.edges.filter((edge) => edge.x).map((edge) => ({
                                                      from: edge.a,
                                                      to: edge.b,
                                                      center: edge.x,
                                                      radius: Lesson.distance(edge.x, polyline.points[edge.a]) *
                                                          random.between(0.8, 4)
                                                    }));
    const first = random.below(edges.length);
    return {arguments: [edges, first, edges[first].center], points: polyline.points};
  };

  const disk = {
    name: "disk",
    title: "3. disk",
    statement:
        "The mesh of stage 2 consists of edges, each from one vertex to another, with its ball (center, radius). The " +
        "point p encroaches the edge number 'first'. Find E by walking: the edges whose balls hold p (distance below the " +
        "radius) and that hang together with 'first' through such edges. Return their numbers in any order. An edge whose " +
        "ball holds p but that the walk does not reach is not in E (section 2.2.2, Figure 3).",
    skeleton:
        "// edges: [{from: 0, to: 1, center: [x, y], radius: r}, ...]\n// p: [x, y]\n// Returns an array of numbers.\n" +
        "function disk(edges, first, p) {\n  return [first];\n}\n",
    instances(random) { return statesOfRuns(random, "stage2").map(({frame}) => diskInstance(random, frame.polyline)); },
    // Grows the set until nothing changes.
    answer({arguments: [edges, first, p]}) {
      const E = new Set([first]);
      for (let size = 0; size < E.size;) {
        size = E.size;
        const vertices = new Set([...E].flatMap((k) => [edges[k].from, edges[k].to]));
        edges.forEach((edge, k) => {
          const touches = vertices.has(edge.from) || vertices.has(edge.to);
          if (touches && Math.hypot(edge.center[0] - p[0], edge.center[1] - p[1]) < edge.radius) E.add(k);
        });
      }
      return [...E].sort((s, t) => s - t);
    },
    isRight: (given, right) => Array.isArray(given) && given.length === right.length &&
        [...given].sort((s, t) => s - t).every((k, i) => k === right[i]),
    picture({arguments: [edges, first, p], points}, given, right) {
      const scene = new Lesson.Scene(boundsOf(edges.flatMap((edge) => [points[edge.from], points[edge.to]])));
      const ends = (k) => [points[edges[k].from], points[edges[k].to]];
      edges.forEach((_, k) => scene.line(ends(k), "mesh"));
      const isEdge = (k) => Number.isInteger(k) && k >= 0 && k < edges.length;
      const yours = asArray(given).filter(isEdge);
      for (const k of right) scene.line(ends(k), "right");
      for (const k of yours) scene.line(ends(k), "pathE");
      // The edges on which the two differ, with their balls.
      const differing = [...right.filter((k) => !yours.includes(k)), ...yours.filter((k) => !right.includes(k))];
      for (const k of differing.slice(0, 4)) {
        scene.circle(edges[k].center, edges[k].radius, "ball");
        scene.label(edges[k].center, `${k}: ${right.includes(k) ? "in E" : "not in E"}`, "label", 3);
      }
      scene.mark(p, "star", "point", 7);
      scene.label(p, `p, edge ${first}`, "label", 4);
      return scene;
    },
  };

  return [hits, multiIntersect, disk];
})();
