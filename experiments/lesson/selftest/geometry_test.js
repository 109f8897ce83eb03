// The geometry of the plane against brute force: predicates in fractions of integers, circles against every point, hits
// against a walk in small steps, loops counted by regions.
(() => {
  const {test, check, equal} = Lesson.selftest;

  // A number of the lattice as an integer, in another way than the predicates have it.
  const whole = (x) => BigInt(Math.round(x * 2 ** 30));
  const sign = (value) => (value > 0n ? 1 : value < 0n ? -1 : 0);

  const determinant = (rows) => {
    if (rows.length === 1) return rows[0][0];
    return rows[0].reduce((sum, x, k) => {
      const minor = rows.slice(1).map((row) => row.filter((_, i) => i !== k));
      return sum + (k % 2 ? -x : x) * determinant(minor);
    }, 0n);
  };

  const orientOracle = (points) => sign(determinant(points.map(([x, y]) => [whole(x), whole(y), 1n])));
  const inCircleOracle = (points) => sign(determinant(points.map((p) => {
    const [x, y] = p.map(whole);
    return [x, y, x * x + y * y, 1n];
  })));

  // Points that are random, on a small grid, almost on a line, on a circle as far as the lattice has it.
  const pointSets = (random, count) => {
    const {snap} = Lesson.predicates;
    const make = (f) => Array.from({length: count}, f).map(snap);
    return {
      random: make(() => [random.between(0, 24), random.between(0, 24)]),
      grid: make(() => [random.below(5), random.below(5)]),
      line: make(() => {
        const x = random.between(0, 24);
        return [x, x / 3 + random.below(3) * 2 ** -30];
      }),
      circle: make(() => {
        const angle = (random.below(64) * Math.PI) / 32;
        return [12 + 8 * Math.cos(angle), 12 + 8 * Math.sin(angle)];
      }),
    };
  };

  test("predicates are exact", () => {
    const random = new Lesson.Random(1);
    for (let round = 0; round < 150; ++round) {
      for (const [kind, points] of Object.entries(pointSets(random, 4))) {
        const [a, b, c, d] = points;
        equal(Lesson.predicates.orient(a, b, c), orientOracle([a, b, c]), `orient, ${kind}, round ${round}`);
        equal(
            Lesson.predicates.inCircle(a, b, c, d), inCircleOracle([a, b, c, d]), `inCircle, ${kind}, round ${round}`);
      }
    }
  });

  // Neighbours in the sequence of Fibonacci span an area of one step of the lattice: far below what doubles see.
  test("orient sees a single step of the lattice", () => {
    const step = 2 ** -30;
    for (let n = 3, a = 1, b = 2; b < 2 ** 34; ++n, [a, b] = [b, a + b]) {
      const points = [[b * step, a * step], [(a + b) * step, b * step], [0, 0]];
      equal(Lesson.predicates.orient(...points), orientOracle(points), `Fibonacci number ${n}`);
      check(orientOracle(points) !== 0, `Fibonacci number ${n} spans nothing`);
    }
  });

  const checkDelaunay = (delaunay, what) => {
    const {points, triangles} = delaunay;
    const real = triangles.filter((triangle) => !delaunay.isGhost(triangle));
    let inside = 0, turned = 0;
    for (const triangle of real) {
      const corners = triangle.map((v) => points[v]);
      if (orientOracle(corners) <= 0) turned += 1;
      for (const p of points)
        if (inCircleOracle([...corners, p]) > 0) inside += 1;
    }
    check(inside === 0, `${what}: ${inside} points inside of circles`);
    check(turned === 0, `${what}: ${turned} triangles do not turn to the left`);
    // A sphere, with the infinite vertex.
    check(
        triangles.length === 2 * points.length - 2,
        `${what}: ${triangles.length} triangles of ${points.length} points`);
    return real;
  };

  test("no point lies inside of a circle", () => {
    const random = new Lesson.Random(2);
    for (let round = 0; round < 12; ++round) {
      for (const [kind, points] of Object.entries(pointSets(random, 10 + 2 * round))) {
        const delaunay = Lesson.Delaunay.of(points);
        if (delaunay) checkDelaunay(delaunay, `${kind}, round ${round}`);
      }
    }
    check(Lesson.Delaunay.of([[0, 0], [1, 1], [2, 2]]) === null, "points on a line have no triangulation");
  });

  test("hits are those that a walk in small steps finds", () => {
    const random = new Lesson.Random(3);
    for (let round = 0; round < 60; ++round) {
      const field = Lesson.fields.named(round % 2 ? "noise" : "bumps", round);
      const end = () => [random.between(-2, field.width + 1), random.between(-2, field.height + 1)];
      const [a, b] = [end(), end()];
      const at = (t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
      const hits = field.hits(a, b);
      const found = [];
      const kSteps = 4000;
      for (let k = 0; k < kSteps; ++k) {
        if (field.value(at(k / kSteps)) < 0 !== field.value(at((k + 1) / kSteps)) < 0) found.push(k);
      }
      // Two hits within one step are seen by the quadratic alone.
      const steps = hits.map((hit) => Math.floor(hit.t * kSteps));
      const visible = steps.filter((k) => steps.filter((l) => l === k).length % 2 === 1);
      equal([...new Set(visible)], found, `round ${round}`);
      check(hits.every((hit) => Math.abs(field.value(hit.point)) < 1e-9), `round ${round}: a hit is off the curve`);
      check(hits.every((hit, k) => k === 0 || hit.rises !== hits[k - 1].rises), `round ${round}: hits alternate`);
      const isOdd = field.value(a) < 0 !== field.value(b) < 0;
      check((hits.length % 2 === 1) === isOdd, `round ${round}: the signs at the ends tell the parity`);
    }
  });

  test("loops of curves and of regions are as many", () => {
    for (let seed = 0; seed < 1500; ++seed) {
      const field = Lesson.fields.named(seed % 3 ? "noise" : "bumps", seed);
      equal(new Lesson.LevelSet(field).loopCount, Lesson.countLoopsByRegions(field), `seed ${seed}`);
    }
  });

  test("a point of a curve lies on the loop of its arc", () => {
    for (let seed = 0; seed < 40; ++seed) {
      const levelSet = new Lesson.LevelSet(Lesson.fields.named("noise", seed));
      levelSet.curves().forEach((curve, k) => {
        const {cell, loop} = levelSet.arcs[k];
        for (const p of curve.slice(1, -1)) equal(levelSet.loopAt(p), loop, `seed ${seed}, cell ${cell}`);
      });
    }
  });

  Lesson.selftest.checkDelaunay = checkDelaunay;
})();
