// What the paper's lines ask for, written down once more: every action of a run is compared with all that could have
// been done instead.
(() => {
  const {test, check, equal} = Lesson.selftest;

  const runOf = (name, seed, options = {}) => {
    const field = Lesson.fields.named(name, seed);
    const all = {...Lesson.Run.defaults, ...options};
    return new Lesson.Run(field, Lesson.startPoints(field, new Lesson.Random(seed), all), all);
  };

  const runs = () =>
      [runOf("ring", 1), runOf("touch", 2), runOf("finger", 3), runOf("bumps", 4, {sizeBound: 0.1}),
       runOf("noise", 5, {sizeBound: 0.1, rMin: 0.1}), runOf("flower", 6, {seeding: "components"})];

  const middleOf = (points, {u, v}) => [(points[u][0] + points[v][0]) / 2, (points[u][1] + points[v][1]) / 2];

  // All points that Figure 5 would insert in a state, by its three lines, each with how bad it is.
  const candidates = ({field, delaunay, dualEdges}, {epsilon, rMin}) => {
    const {points} = delaunay;
    const hitsOf = (edge) => field.hits(edge.ends[0], edge.ends[1]).map((hit) => hit.point);
    const farthest = (hits, from) => hits.reduce(
        (best, p) => (!best || Lesson.distance(p, from) > best.size ? {p, size: Lesson.distance(p, from)} : best),
        null);
    const restricted = dualEdges.map((edge) => ({edge, hits: hitsOf(edge)})).filter(({hits}) => hits.length > 0);
    const multi =
        restricted.filter(({hits}) => hits.length > 1).map(({edge, hits}) => farthest(hits, middleOf(points, edge)));
    const extract = points.map((q, k) => [q, restricted.filter(({edge}) => edge.u === k || edge.v === k)])
                        .filter(([, umbrella]) => umbrella.length !== 2 && umbrella.length > 0)
                        .map(([q, umbrella]) => farthest(umbrella.flatMap(({hits}) => hits), q));
    const approximate = restricted
                            .map(({edge, hits}) => {
                              const h = Math.min(...hits.map((p) => Lesson.distance(p, middleOf(points, edge))));
                              const p = hits.find((x) => Lesson.distance(x, middleOf(points, edge)) === h);
                              const r = Lesson.distance(points[edge.u], points[edge.v]) / 2;
                              return {p, size: h / r, isBad: r > rMin && h / r > epsilon};
                            })
                            .filter(({isBad}) => isBad);
    return {multi, extract, approximate};
  };

  const kinds = ["multi", "extract", "approximate"];

  test("stage 1 inserts the worst of the first kind that asks", () => {
    for (const run of runs()) {
      run.frames.forEach((frame, k) => {
        if (frame.polyline || frame.poles || frame.kind === "end") return;
        const possible = candidates(frame.restricted, run.options);
        const {points} = frame.restricted.delaunay;
        const hasRoom = ({p}) => points.every((q) => Lesson.distance(p, q) >= run.options.sizeBound + 1e-8);
        const first = kinds.find((kind) => possible[kind].some(hasRoom));
        const {next} = frame;
        const isEmptyUmbrella = next.kind === "extract" && next.umbrella.length === 0;
        if (isEmptyUmbrella) return;
        if (!first) return check(!kinds.includes(next.kind), `step ${k}: ${next.kind}, and nothing asks`);
        if (!equal(next.kind, first, `step ${k}`)) return;
        const most = Math.max(...possible[first].filter(hasRoom).map(({size}) => size));
        const isKnown =
            possible[first].some(({p, size}) => Lesson.distance(p, next.point) < 1e-8 && size > most - 1e-8);
        check(isKnown, `step ${k}: ${first} takes a point that is not the farthest`);
      });
    }
  });

  test("stage 2 inserts the center of the worst ball, and stops where none is coarse", () => {
    for (const run of runs()) {
      const {epsilon1, epsilon2, rMin} = run.options;
      run.frames.forEach((frame, k) => {
        if (!frame.polyline) return;
        const {points, heights, edges} = frame.polyline;
        const badness = ({a, b, x}) => {
          const r = Lesson.distance(points[a], points[b]) / 2;
          const h = Lesson.distance(x, [(points[a][0] + points[b][0]) / 2, (points[a][1] + points[b][1]) / 2]);
          return r > rMin ? Math.max(h / r / epsilon1, r / ((heights[a] + heights[b]) / 2) / epsilon2) : 0;
        };
        const open = edges.filter((edge) => edge.x && !edge.refusal);
        const most = Math.max(0, ...open.map(badness));
        if (frame.kind === "end")
          return check(most <= 1 + 1e-12, `step ${k}: ends with an edge ${most} times too coarse`);
        if (most <= 1) return check(frame.next.kind === "end", `step ${k}: ${frame.next.kind}, and nothing is coarse`);
        check(Math.abs(badness(frame.next.edge) - most) < 1e-9, `step ${k}: not the worst edge`);
        // The ball goes through both ends of its edge.
        const [to, from] =
            [frame.next.edge.a, frame.next.edge.b].map((v) => Lesson.distance(points[v], frame.next.point));
        check(Math.abs(to - from) < 1e-7, `step ${k}: the center is not between the ends`);
      });
    }
  });

  test("pole heights are those of the Voronoi cells' corners", () => {
    for (const run of runs()) {
      const frame = run.frames.find((other) => other.kind === "poles");
      if (!frame) continue;
      const {field, delaunay, dualEdges} = frame.restricted;
      delaunay.points.forEach((q, k) => {
        const corners = dualEdges.filter((edge) => edge.u === k || edge.v === k).flatMap((edge) => edge.ends);
        const far = (isAbove) =>
            Math.max(...corners.filter((p) => field.value(p) >= 0 === isAbove).map((p) => Lesson.distance(p, q)));
        const height = Math.min(far(true), far(false), Math.hypot(field.width - 1, field.height - 1));
        check(Math.abs(frame.poles[k].height - height) < 1e-9, `vertex ${k}: ${frame.poles[k].height}, not ${height}`);
      });
    }
  });

  test("stage 2 begins with the hits that stage 1 ends with", () => {
    for (const run of runs()) {
      const frame = run.frames.find((other) => other.kind === "build");
      if (!frame) continue;
      const hits = new Map(frame.restricted.edges.map((edge) => [`${edge.u},${edge.v}`, edge.x]));
      for (const {a, b, x} of frame.polyline.edges) {
        const before = hits.get(`${Math.min(a, b)},${Math.max(a, b)}`);
        check(x && Lesson.distance(x, before) < 1e-6, `edge ${a}-${b}: another point of the curve`);
      }
    }
  });

  test("a new vertex inherits the mean of its neighbours' pole heights", () => {
    const run = runOf("ring", 1);
    for (const {kind, action, polyline} of run.frames) {
      if (kind !== "refine") continue;
      const {heights} = polyline;
      equal(heights[heights.length - 1], (heights[action.edge.a] + heights[action.edge.b]) / 2, "height");
    }
  });

  // A chord of the outer circle whose middle is nearer to the inner one, which faces the other way.
  test("the hit of an edge faces as the edge does", () => {
    const field = Lesson.fields.named("ring", 1);
    const center = [11.6, 11.4];
    const on = (angle) => {
      const far = [center[0] + 20 * Math.cos(angle), center[1] + 20 * Math.sin(angle)];
      return field.hits(far, center)[0].point;
    };
    const edge = Lesson.Polyline.measure(field, [on(0), on(1.6)], 0, 1);
    const other = Lesson.Polyline.measure(field, [on(0), on(1.6)], 1, 0);
    check(Lesson.distance(edge.x, center) > 8, `the outer circle: ${edge.x}`);
    check(Lesson.distance(other.x, center) < 6, `turned around, the inner one: ${other.x}`);
  });

  // A mesh by hand: a loop through these points whose balls have these radii.
  const loop = (points, radius) => {
    const field = Lesson.fields.named("ring", 1);
    const edges = points.map((p, a) => {
      const b = (a + 1) % points.length;
      const x = [(p[0] + points[b][0]) / 2, (p[1] + points[b][1]) / 2];
      return {a, b, x, r: 1, h: 0, middle: x, refusal: null, radius};
    });
    return new Lesson.Polyline(field, points, points.map(() => 1), edges);
  };

  test("guards of stage 2 refuse what would break the mesh", () => {
    const square = loop([[0, 0], [8, 0], [8, 8], [0, 8]]);
    const [bottom] = square.edges;
    equal(square.path(bottom, [4, 0]).length, 1, "one ball holds the point");
    equal(square.refusalOf([4, -1], [bottom]), null, "a point outside");
    check(square.refusalOf([4, 9], [bottom])?.includes("cross"), "D through the opposite edge");
    check(square.refusalOf([8, 8], [bottom])?.includes("vertex"), "a vertex");
    check(square.refusalOf([4, -1], square.edges.slice(0, 2))?.includes("2 edges"), "a vertex would be lost");
    check(square.refusalOf([4, -1], square.edges)?.includes("whole loop"), "a whole loop");
    // The middle is as far from all edges as their balls reach, or a little less.
    equal(square.path(bottom, [4, 3.9]).map((edge) => edge.a), [0], "a path does not jump");
    const path = square.path(bottom, [7.9, 0.1]);
    equal(path.map((edge) => edge.a), [0, 1], "around the corner, in order");
    const back = square.path(square.edges[1], [7.9, 0.1]);
    equal(back.map((edge) => edge.a), [0, 1], "the other way around the corner");
  });
})();
