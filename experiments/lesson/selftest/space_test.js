// The player of real runs: its replay against itself backwards and against what the program says of the run, its
// geometry against definitions, the answers of its exercises against the trace.
(() => {
  const {test, check, equal} = Lesson.selftest;
  const runs = () => (Lesson.data.runs ?? []).map((data) => new Lesson.SpaceRun(data));
  const main = () => runs()[0];

  // All that a state is, in an order of its own.
  const stateOf = (replay) => JSON.stringify([
    replay.points,
    [...replay.tets].sort(),
    [...replay.sides].map(([key, tets]) => [key, [...tets].sort()]).sort(),
    [...replay.hits].sort(),
    replay.mesh && [replay.mesh.points, [...replay.mesh.triangles].sort()],
  ]);

  test("the replay goes back the way it came", () => {
    for (const run of runs()) {
      const {replay, events} = run;
      const stops = [0, 1, 5, 20, run.meshAt - 1, run.meshAt, run.meshAt + 1, run.meshAt + 30].filter(
          (n) => n >= 0 && n < events.length);
      const states = stops.map((n) => stateOf(replay.goTo(n)));
      replay.goTo(events.length - 1);
      for (let i = stops.length; i-- > 0;)
        equal(stateOf(replay.goTo(stops[i])), states[i], `${run.name}, event ${stops[i]}`);
    }
  });

  test("a state is the same on every way to it", () => {
    for (const run of runs()) {
      const {events} = run;
      const last = events.length - 1;
      const first = events[0].e === "initial" ? 0 : run.meshAt;
      if (first < 0) continue;
      const stops = [0, 0.9, 0.3, 0.31, 1, 0.1, 0.95, 0.5].map((share) => Math.round(first + share * (last - first)));
      // Nothing is saved here, and every event is taken back.
      const plain = new Lesson.Replay(events, first);
      const saving = new Lesson.Replay(events, first, 25);
      for (const n of stops) {
        while (plain.position > n) plain.undo.pop()();
        equal(stateOf(saving.goTo(n)) === stateOf(plain.goTo(n)), true, `${run.name}, event ${n}`);
      }
      check(saving.saved.length > last / 50, `${run.name}: ${saving.saved.length} states are saved`);
    }
  });

  // The circumball of a tetrahedron. Of the flattest, rounding leaves no center, here as in the program.
  const ballOf = (replay, v) => {
    const corners = v.map((corner) => replay.points[corner]);
    const center = Lesson.vectors.circumcenter(corners);
    const radii = corners.map((p) => Lesson.vectors.distance(center, p));
    return {center, radius: Math.min(...radii), isKnown: Math.max(...radii) < Math.min(...radii) * 1.001};
  };

  test("a state is a triangulation", () => {
    const run = main();
    if (!run) return;
    // Enough states of long runs, too.
    for (let n = 0; n < run.endOfStage1; n += Math.max(7, Math.ceil(run.endOfStage1 / 20))) {
      const replay = run.at(n);
      for (const [key, tets] of replay.sides)
        check(tets.length === 2, `event ${n}: facet ${key} has ${tets.length} sides`);
      const pairs = [...replay.tets.values()];
      // Delaunay: no vertex lies inside a circumball.
      for (const {v} of pairs) {
        if (v.includes(-1)) continue;
        const {center, radius, isKnown} = ballOf(replay, v);
        if (!isKnown || radius > 100) continue;
        check(
            replay.points.every((p) => Lesson.vectors.distance(p, center) > radius - 1e-2),
            `event ${n}: ${v} is not empty`);
      }
    }
  });

  test("hits lie on the surface, and agree with the signs", () => {
    const run = main();
    if (!run || !run.volume.samples.length) return;
    const largest = run.volume.samples.reduce((most, f) => Math.max(most, Math.abs(f)), 0);
    const picture = new Lesson.SpacePicture(run, run.camera);
    for (let n = 0; n < run.endOfStage1; n += Math.max(11, Math.ceil(run.endOfStage1 / 20))) {
      const replay = run.at(n);
      const restricted = new Set(replay.restricted().map(Lesson.Replay.keyOf));
      // Where the signs at the ends of a dual edge contradict its hits, the program adds one at an end.
      const isSure = (key) =>
          replay.sidesOf(key).every((tet) => tet.includes("-1") || ballOf(replay, replay.tets.get(tet).v).isKnown);
      for (const key of replay.hits.keys()) {
        for (const p of picture.hitsOf(replay, key)) {
          check(
              !isSure(key) || Math.abs(Lesson.slice.value(run.volume, p)) < 0.01 * largest,
              `event ${n}: the hit of ${key} is off the surface`);
        }
        check(
            (replay.hits.get(key).t.length % 2 === 1) === restricted.has(key), `event ${n}: hits and signs of ${key}`);
      }
    }
  });

  test("the mesh at the end is what the program says", () => {
    for (const run of runs()) {
      if (run.leftOut || !run.hasStage2) continue;
      const {mesh} = run.at(run.events.length - 1);
      equal([mesh.points.length, mesh.triangles.size], [run.end.vertices, run.end.triangles], run.name);
      if (!run.isChecked) continue;
      const its = Lesson.complexOf([...mesh.triangles.values()]);
      const sum = {chi: 0, components: 0};
      for (const {chi, count} of run.end.mesh) {
        sum.chi += chi * count;
        sum.components += count;
      }
      equal([its.chi, its.components], [sum.chi, sum.components], run.name);
    }
  });

  test("complexes are counted right", () => {
    const tetrahedron = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
    equal([Lesson.complexOf(tetrahedron).chi, Lesson.complexOf(tetrahedron).components], [2, 1], "a tetrahedron");
    // Two that share a vertex are two spheres.
    const two = [...tetrahedron, ...tetrahedron.map((t) => t.map((v) => (v === 0 ? 0 : v + 10)))];
    equal([Lesson.complexOf(two).chi, Lesson.complexOf(two).components], [4, 2], "two at a vertex");
    equal(Lesson.complexOf([[0, 1, 2]]).open, 3, "a triangle has a boundary");
  });

  test("every insertion obeys Euler", () => {
    for (const run of runs()) {
      for (const event of run.events) {
        if (event.e === "insert") {
          const rim = Lesson.Replay.rimOf(event.gone);
          const vertices = new Set(rim.flat()).size;
          check(
              event.above.length === rim.length && rim.length === 2 * vertices - 4,
              `vertex ${event.v}: the rim is no sphere`);
        }
        if (event.e === "refine" && event.closed) {
          check(Lesson.Replay.starOf(event).length === event.gone.length + 2, `vertex ${event.v}: D is not E + 2`);
        }
      }
    }
  });

  // Where no repair has turned signs over. BuildTriMesh moves copies of a vertex at which sheets meet away from it, and
  // leaves them its height. Coordinates of a mesh have five digits.
  test("pole heights are those of the program", () => {
    for (const run of runs()) {
      if (run.events[0].e !== "initial" || !run.hasStage2 || run.events.some(({e}) => e === "compare")) continue;
      const chapter = new Lesson.PolesChapter(run);
      const replay = run.at(run.meshAt - 1);
      const heights = replay.points.map((_, q) => chapter.height(replay, q));
      const {points, poles} = run.events[run.meshAt];
      equal(poles.length, points.length, `${run.name}: pole heights`);
      points.forEach((p, v) => {
        const q = replay.points.findIndex((other) => Lesson.vectors.distance(p, other) < 1e-5);
        const isRight = (height) => Math.abs(height - poles[v]) < 1e-3 * poles[v];
        check(
            q < 0 ? heights.some(isRight) : isRight(heights[q]),
            `${run.name}, vertex ${v}: ${heights[q]}, not ${poles[v]}`);
      });
    }
  });

  test("exercises know their answers", () => {
    for (const chapter of Lesson.chapters) {
      for (const {question, answer, because} of chapter.exercises?.() ?? []) {
        check(Number.isInteger(answer()) && because(answer()).length > 10, `${chapter.name}: ${question}`);
        const box = Lesson.exercise({question, answer, because});
        const field = box.querySelector("input");
        const reply = () => box.querySelector(".score").textContent;
        const [checkButton] = box.querySelectorAll("button");
        field.value = String(answer() + 1);
        checkButton.click();
        check(!reply().startsWith("Right"), `${chapter.name}: a wrong answer passes`);
        field.value = String(answer());
        checkButton.click();
        check(reply().startsWith("Right"), `${chapter.name}: the right answer fails`);
      }
    }
  });

  test("the saddle decides which arcs meet", () => {
    const chapter = new Lesson.CellChapter();
    const random = new Lesson.Random(9);
    // Whether two corners of one sign are joined within the face, by flooding a fine grid.
    const joins = ([f00, f10, f01, f11], from, to) => {
      const n = 160;
      const f = (i, j) => {
        const [u, v] = [i / n, j / n];
        return (1 - v) * (f00 + u * (f10 - f00)) + v * (f01 + u * (f11 - f01));
      };
      const seen = new Set([from.join()]);
      const waiting = [from.map((x) => x * n)];
      while (waiting.length) {
        const [i, j] = waiting.pop();
        if (i === to[0] * n && j === to[1] * n) return true;
        for (const [a, b] of [[i + 1, j], [i - 1, j], [i, j + 1], [i, j - 1]]) {
          if (a < 0 || b < 0 || a > n || b > n || seen.has(`${a},${b}`) || f(a, b) >= 0 !== f00 >= 0) continue;
          seen.add(`${a},${b}`);
          waiting.push([a, b]);
        }
      }
      return false;
    };
    for (let trial = 0; trial < 60; ++trial) {
      const sign = trial % 2 ? 1 : -1;  // of the corners 00 and 11
      chapter.values = [sign, -sign, -sign, sign].map((its) => its * random.between(0.1, 1));
      // Too near to a tie for the grid to tell.
      if (Math.abs(chapter.saddle().value) < 0.02) continue;
      const says = chapter.sentence().includes("the corners 00 and 11");
      check(says === joins(chapter.values, [0, 0], [1, 1]), `trial ${trial}: ${chapter.values}`);
    }
  });

  test("arcs of a slice lie where the bilinear field is zero", () => {
    const random = new Lesson.Random(5);
    for (let trial = 0; trial < 200; ++trial) {
      const [a, b, c, d] = Array.from({length: 4}, () => random.between(-1, 1));
      for (const arc of Lesson.slice.arcs(a, b, c, d)) {
        for (const [u, v] of arc) {
          const f = (1 - v) * (a + u * (b - a)) + v * (c + u * (d - c));
          check(Math.abs(f) < 1e-9, `trial ${trial}: ${f}`);
        }
      }
    }
  });
})();
