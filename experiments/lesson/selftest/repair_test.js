// Chapter 10: what is counted here of the meshes of repair, against what the program says of them.
(() => {
  const {test, check, equal} = Lesson.selftest;
  const chapter = () => Lesson.chapters.find((other) => other.name === "repair");

  test("pieces are what the program compares", () => {
    for (const at of chapter()?.comparisons.values() ?? []) {
      const {pieces, components, points} = at.event;
      check(at.pieceOf.every((piece) => piece >= 0), "a vertex without a piece");
      pieces.forEach((piece, p) => {
        const its = at.countOf(p);
        equal([its.vertices, its.chi, its.components], [piece.vertices, piece.chi, 1], `piece ${p}`);
        equal(at.loopsOf(p), piece.loops, `curves of piece ${p}`);
        // They lie on the box.
        const {box: [low, high]} = chapter().run;
        const isOnBox = (v) =>
            points[v].some((x, axis) => Math.abs(x - low[axis]) < 1e-4 || Math.abs(x - high[axis]) < 1e-4);
        check(at.boundaryOf(p).every(([a]) => isOnBox(a)), `piece ${p} has a hole within the box`);
      });
      components.forEach(({chi, loops, piece, is}, c) => {
        const isEqual = piece >= 0 && pieces[piece].chi === chi && pieces[piece].loops === loops;
        equal(is !== "different", isEqual, `component ${c} is ${is}`);
        if (is === "exact") equal([at.strays(c).length, pieces[piece].mixed], [0, false], `component ${c}`);
      });
    }
  });

  // Each component is taken from some comparison that has it right; not all are from the last.
  test("where every component was right once, so is the mesh", () => {
    const {run, comparisons} = chapter() ?? {comparisons: new Map()};
    const last = [...comparisons.values()].pop();
    if (!last) return;
    equal(run.end.repair_rounds, comparisons.size - 1, "rounds");
    const sum = (all) => all.reduce((total, {chi}) => total + chi, 0);
    equal(sum(last.event.components), run.exact().chi, "χ of the surface");
    const isRightOnce = (_, c) => [...comparisons.values()].some((at) => Lesson.Comparison.isRight(at.component(c).is));
    const {verdict} = run.end;
    if (verdict !== "not_checked" && last.event.components.every(isRightOnce))
      equal(verdict, "homeomorphic", "verdict");
  });

  test("one of three cells is sampled, and holds the surface", () => {
    for (const {shown, cells, kind} of chapter()?.list ?? []) {
      if (!shown) continue;
      const isSampled = shown.map((cell) => cells.some((other) => String(other) === String(cell)));
      equal(isSampled, ["x", "y", "z"].map((name) => name === kind), "the answer");
      equal(new Set(shown.map(String)).size, 3, "three cells");
      const active = new Set(chapter().activeCells().map(String));
      check(shown.every((cell) => active.has(String(cell))), "a cell without the surface");
    }
  });
})();
