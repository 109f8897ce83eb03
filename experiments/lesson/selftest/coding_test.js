// The coding lab: a right solution of every task passes for many seeds, wrong ones are caught, and whatever a student
// writes leaves the page alive. The solutions stand here, not in the chapter.
(() => {
  const {test, check, equal} = Lesson.selftest;

  const right = {
    hits: `function hits(v0, vm, v1) {
      const a = 2 * (v0 + v1 - 2 * vm), b = 4 * vm - 3 * v0 - v1, c = v0;
      if (Math.abs(a) < 1e-12) return b === 0 ? [] : [-c / b].filter((t) => t >= 0 && t <= 1);
      const d = b * b - 4 * a * c;
      if (d < 0) return [];
      return [(-b - Math.sqrt(d)) / (2 * a), (-b + Math.sqrt(d)) / (2 * a)]
          .filter((t) => t >= 0 && t <= 1).sort((s, t) => s - t);
    }`,
    multiIntersect: `function multiIntersect(edges) {
      let best = null, most = -1;
      for (const {a, b, hits} of edges) {
        if (hits.length < 2) continue;
        for (const p of hits) {
          const d = Math.hypot(p[0] - (a[0] + b[0]) / 2, p[1] - (a[1] + b[1]) / 2);
          if (d > most) { most = d; best = p; }
        }
      }
      return best;
    }`,
    disk: `function disk(edges, first, p) {
      const E = [first];
      for (let i = 0; i < E.length; ++i) {
        const e = edges[E[i]];
        edges.forEach((f, k) => {
          const meets = f.from === e.to || f.to === e.from;
          if (!E.includes(k) && meets && Math.hypot(f.center[0] - p[0], f.center[1] - p[1]) < f.radius) E.push(k);
        });
      }
      return E;
    }`,
  };

  // Each has one mistake that a student might make.
  const wrong = {
    hits: [
      ["one root only", "function hits(v0, vm, v1) { return v0 * v1 < 0 ? [v0 / (v0 - v1)] : []; }"],
      ["roots beyond the ends", right.hits.replace(/\.filter\(\(t\) => t >= 0 && t <= 1\)\.sort/, ".sort")],
      ["not in order", right.hits.replace(".sort((s, t) => s - t)", ".sort((s, t) => t - s)")],
      ["no straight lines", right.hits.replace(/if \(Math.abs[^;]*;/, "")],
    ],
    multiIntersect: [
      ["the nearest hit", right.multiIntersect.replace("d > most", "best === null || d < most")],
      ["single hits, too", right.multiIntersect.replace("hits.length < 2", "hits.length < 1")],
      [
        "measured from an end",
        right.multiIntersect.replace("(a[0] + b[0]) / 2, p[1] - (a[1] + b[1]) / 2", "a[0], p[1] - a[1]")
      ],
    ],
    disk: [
      ["the first edge only", "function disk(edges, first, p) { return [first]; }"],
      [
        "no walk", `function disk(edges, first, p) { return edges.map((_, k) => k).filter((k) =>
         Math.hypot(edges[k].center[0] - p[0], edges[k].center[1] - p[1]) < edges[k].radius); }`
      ],
      ["one way only", right.disk.replace("|| f.to === e.from", "")],
    ],
  };

  test("right solutions pass, wrong ones are caught", async () => {
    for (const task of Lesson.codingTasks) {
      for (const seed of [String(Lesson.data.seed), "2", "3", "18446744073709551615"]) {
        const verdict = await Lesson.judge.judge(task, right[task.name], seed, Lesson.judge.runHere);
        equal(
            [verdict.passed, verdict.error ?? null, verdict.case ?? null], [verdict.total, null, null],
            `${task.name}, seed ${seed}`);
        check(verdict.total >= 40, `${task.name}, seed ${seed}: ${verdict.total} instances`);
        for (const [what, code] of wrong[task.name]) await checkCaught(task, code, seed, what);
      }
    }
  });

  const checkCaught = async (task, code, seed, what) => {
    const verdict = await Lesson.judge.judge(task, code, seed, Lesson.judge.runHere);
    if (!check(verdict.case, `${task.name}, seed ${seed}: "${what}" passes`)) return;
    const {instance, given, right: answer} = verdict.case;
    const svg = Lesson.svgOf(task.picture(instance, given, answer), "counter-example");
    check(svg.includes("</svg>") && !svg.includes("NaN"), `${task.name}: the picture of "${what}"`);
  };

  test("instances differ by seed, and are the same for the same", () => {
    for (const task of Lesson.codingTasks) {
      const of = (seed) => JSON.stringify(Lesson.judge.instancesOf(task, seed));
      check(of("1") === of("1"), `${task.name}: the same seed`);
      check(of("1") !== of("2"), `${task.name}: another seed`);
    }
  });

  test("what a student returns never breaks the page", async () => {
    const values =
        ["undefined", "null", "NaN", "[NaN, NaN]", "'text'", "{}", "[[1]]", "() => 1", "[1e308, -1]", "-1", "[99999]"];
    for (const task of Lesson.codingTasks) {
      for (const value of values) {
        const code = `function ${task.name}() { return ${value}; }`;
        const {case: found} = await Lesson.judge.judge(task, code, "1", Lesson.judge.runHere);
        const svg = found && Lesson.svgOf(task.picture(found.instance, found.given, found.right), "counter-example");
        check(svg && !svg.includes("NaN"), `${task.name} that returns ${value}`);
      }
      const broken = [["function (", "SyntaxError"], ["let x = 1;", "there is no function"]];
      for (const [code, message] of broken) {
        const {error} = await Lesson.judge.judge(task, code, "1", Lesson.judge.runHere);
        check(error?.includes(message), `${task.name}: "${code}" gives "${error}"`);
      }
      const thrown = await Lesson.judge.judge(
          task, `function ${task.name}() { throw new Error("no"); }`, "1", Lesson.judge.runHere);
      equal(thrown.case?.error, "Error: no", `${task.name} that throws`);
    }
  });

  test("a worker gives the same, and an endless loop ends", async () => {
    if (typeof Worker === "undefined") return;
    const [task] = Lesson.codingTasks;
    const inWorker = await Lesson.judge.judge(task, right.hits, "1");
    equal([inWorker.passed, inWorker.error ?? null], [inWorker.total, null], "in a worker");
    const endless = await Lesson.judge.runInWorker("function hits() { for (;;); }", "hits", [[1, 2, 3]], 300);
    check(endless.error?.includes("did not end"), `an endless loop: ${JSON.stringify(endless)}`);
  });
})();
