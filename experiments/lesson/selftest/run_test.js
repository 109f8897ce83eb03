// Runs of the laboratory: of thousands of random fields each ends right, or says why not; and what it says is true by a
// second method.
(() => {
  const {test, check, equal, cases} = Lesson.selftest;

  const randomRun = (seed) => {
    const random = new Lesson.Random(seed);
    const size = 6 + (seed % 5);
    const field =
        seed % 2 ? Lesson.fields.fill(size, () => random.between(-1, 1)) : Lesson.fields.bumps(random, size + 2);
    const options = {
      start: 3 + (seed % 4),
      seeding: seed % 3 ? "random" : "components",
      sizeBound: [0.3, 0.1, 0.03][seed % 3],
      rMin: 0.06,
      epsilon2: 0.5,
      epsilon1: 0.2,
    };
    return {field, run: new Lesson.Run(field, Lesson.startPoints(field, random, options), options)};
  };

  // The pieces of a mesh by walking along them: the length of each cycle, or null.
  const cyclesOf = (edges) => {
    const beside = new Map();
    for (const [a, b] of edges) {
      beside.set(a, [...(beside.get(a) ?? []), b]);
      beside.set(b, [...(beside.get(b) ?? []), a]);
    }
    if ([...beside.values()].some((others) => others.length !== 2)) return null;
    const lengths = [];
    const seen = new Set();
    for (const start of beside.keys()) {
      if (seen.has(start)) continue;
      let length = 0;
      for (let at = start; at !== undefined; at = beside.get(at).find((other) => !seen.has(other))) {
        seen.add(at);
        length += 1;
      }
      lengths.push(length);
    }
    return lengths;
  };

  test("two thousand random fields end right, or say why not", () => {
    const tally = {right: 0, wrong: 0, none: 0};
    const count = cases(2000);
    for (let seed = 0; seed < count; ++seed) {
      const {field, run} = randomRun(seed);
      const loops = Lesson.countLoopsByRegions(field);
      if (run.failure) {
        tally.none += 1;
        check(loops === 0, `seed ${seed}: no run, though there is a curve: ${run.failure}`);
        continue;
      }
      const end = run.last;
      const {edges} = run.mesh(end);
      const cycles = cyclesOf(edges);
      const verdict = run.certificate();
      const said = Lesson.planeStory.happened(run, end);
      check(end.kind === "end" && end.next === null, `seed ${seed} does not end`);
      if (verdict.isRight) {
        tally.right += 1;
        check(
            cycles && cycles.length === loops, `seed ${seed}: called right, with ${cycles?.length} pieces of ${loops}`);
        check(said.includes("The mesh is right"), `seed ${seed}: ${said}`);
      } else {
        tally.wrong += 1;
        check(verdict.complaints.length > 0 && said.includes(verdict.complaints[0]), `seed ${seed} does not say why`);
        // A mesh that is broken is so because the size bound forbade to go on.
        check(cycles !== null || end.left.length > 0, `seed ${seed}: broken, and nothing was forbidden`);
      }
      if (seed % 40 === 0) Lesson.selftest.checkDelaunay(end.restricted.delaunay, `seed ${seed}`);
    }
    const {right, wrong, none} = tally;
    check(right > 0.6 * count, `only ${right} of ${count} right, ${wrong} wrong, ${none} without a curve`);
    Lesson.selftest.tally = tally;
  });

  test("every step does what it says", () => {
    for (let seed = 0; seed < 60; ++seed) {
      const {field, run} = randomRun(seed);
      run.frames.forEach((frame, k) => checkStep(field, run, k, `seed ${seed}, step ${k}`));
    }
  });

  const checkStep = (field, run, k, what) => {
    const frame = run.frames[k], before = run.frames[k - 1];
    if (!before) return;
    equal(frame.kind, before.next.kind, `${what}: the announced kind`);
    const {action} = frame;
    if (!action.point || action.refusal) return;
    const points = (frame.polyline ?? frame.restricted.delaunay).points;
    equal(points[points.length - 1], action.point, `${what}: the announced point`);
    check(Math.abs(field.value(action.point)) < 1e-6, `${what}: the point is off the level set`);
    if (frame.polyline) {
      // D has one edge more than E, and the mesh has the pieces that it had.
      equal(frame.polyline.edges.length, before.polyline.edges.length + 1, `${what}: edges`);
      equal(run.certificate(frame).pieces, run.certificate(before).pieces, `${what}: pieces`);
    } else {
      const room = Math.min(...before.restricted.delaunay.points.map((p) => Lesson.distance(p, action.point)));
      check(room >= run.options.sizeBound, `${what}: nearer than the size bound`);
      checkEmptyCircle(before.restricted.delaunay, action, what);
    }
  };

  // The circle around the new point through the ends of its edge holds no vertex: this is what a Voronoi edge means.
  const checkEmptyCircle = (delaunay, {edge, point}, what) => {
    if (!edge) return;
    const radius = Lesson.distance(point, delaunay.points[edge.u]);
    check(
        delaunay.points.every((p) => Lesson.distance(p, point) > radius - 1e-6),
        `${what}: a vertex lies in the circle`);
  };

  test("dual edges that are kept are those of a fresh search", () => {
    for (let seed = 0; seed < 20; ++seed) {
      const {field, run} = randomRun(seed);
      if (run.failure) continue;
      const {restricted} = run.last;
      const fresh = new Lesson.Restricted(field, restricted.delaunay);
      const hits = (edges) => edges.map((edge) => [edge.u, edge.v, edge.hits.map((hit) => hit.point)]);
      equal(hits(restricted.dualEdges), hits(fresh.dualEdges), `seed ${seed}`);
    }
  });

  test("restricted edges separate the signs of Voronoi vertices", () => {
    for (let seed = 0; seed < 60; ++seed) {
      const {field, run} = randomRun(seed);
      if (run.failure) continue;
      for (const edge of run.last.restricted.dualEdges) {
        const differ = field.value(edge.ends[0]) < 0 !== field.value(edge.ends[1]) < 0;
        check(differ === (edge.hits.length % 2 === 1), `seed ${seed}, edge ${edge.u}-${edge.v}`);
      }
    }
  });

  test("no pole is nearer than half of the way to the nearest vertex", () => {
    const field = Lesson.fields.named("ring", 1);
    const points = Lesson.startPoints(field, new Lesson.Random(1), Lesson.Run.defaults);
    const run = new Lesson.Run(field, points);
    const frame = run.frames.find((other) => other.kind === "poles");
    frame.poles.forEach((pole, q) => {
      const p = frame.restricted.delaunay.points[q];
      const others = frame.restricted.delaunay.points.filter((_, k) => k !== q);
      const nearest = Math.min(...others.map((other) => Lesson.distance(other, p)));
      check(pole.height >= nearest / 2 - 1e-9, `vertex ${q}: pole height ${pole.height}, nearest vertex ${nearest}`);
    });
  });
})();
