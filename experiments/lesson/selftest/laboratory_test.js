// The laboratory under the hand of a reader: whatever is dragged or typed, the run is the one that a fresh start with
// the same points and samples gives.
(() => {
  const {test, check, equal} = Lesson.selftest;

  const digest = (run) => run.frames.map((frame) => [frame.kind, frame.action?.point ?? null]);

  // What a pointer does, without the waiting for the screen.
  const drag = (laboratory, from, to) => {
    const isTaken = laboratory.pointer.down(from, 0.5, 0);
    laboratory.pointer.at = to;
    laboratory.pointer.up();
    return isTaken;
  };

  test("a dragged point stays on the curve", () => {
    const laboratory = new Lesson.Laboratory("1");
    const before = digest(laboratory.run);
    const start = laboratory.points[0];
    for (let k = 0; k < 12; ++k) {
      const at = laboratory.points[0];
      check(drag(laboratory, at, [at[0] + 1.2, at[1] - 0.7]), `drag ${k}: nothing to hold`);
      check(Math.abs(laboratory.field.value(laboratory.points[0])) < 1e-9, `drag ${k}: off the curve`);
      const fresh = new Lesson.Run(laboratory.field, laboratory.points, laboratory.options);
      equal(digest(laboratory.run), digest(fresh), `drag ${k}: a fresh run`);
    }
    laboratory.setPoint(0, start);
    equal(digest(laboratory.run), before, "the point is back");
  });

  test("a dragged sample changes the curve, and points go with it", () => {
    const laboratory = new Lesson.Laboratory("1");
    laboratory.chooseField("touch");
    equal(laboratory.run.levelSet.loopCount, 2, "two discs");
    for (const [i, j] of [[9, 8], [9, 9], [8, 8], [8, 9]]) drag(laboratory, [i, j], [i, j + 3]);
    equal(laboratory.run.levelSet.loopCount, 1, "a bridge between them");
    check(laboratory.run.certificate().isRight, laboratory.sentence(laboratory.steps().length - 1));
    for (const p of laboratory.points) check(Math.abs(laboratory.field.value(p)) < 1e-9, "a point is off the curve");
  });

  // Values less the isovalue: the arcs in a cell change partners where f00 f11 = f01 f10.
  test("a saddle turns over where the products are equal", () => {
    const field = (f) => Lesson.fields.fill(
        4,
        (x, y) =>
            (x === 1 && y === 1     ? f :
                 x === 2 && y === 2 ? 2 :
                 x === y            ? -1 :
                                      -3));
    const loops = (f) => new Lesson.LevelSet(field(f)).loopCount;
    equal([loops(4.4), loops(4.6)], [2, 1], "around 4.5 = 3 * 3 / 2");
  });

  test("without a curve the laboratory says so, and goes on", () => {
    const laboratory = new Lesson.Laboratory("1");
    laboratory.field = Lesson.fields.fill(12, () => -1);
    laboratory.drawPoints();
    check(laboratory.sentence(0).startsWith("No run:"), laboratory.sentence(0));
    check(laboratory.scene(0, {preview: true}).items.length > 0, "the picture stays");
    laboratory.chooseField("ring");
    check(laboratory.sentence(0).startsWith("InitTriangulation"), laboratory.sentence(0));
  });

  test("thresholds of any size give runs that end", () => {
    const laboratory = new Lesson.Laboratory("1");
    const extremes = {
      epsilon: [0.02, 5],
      epsilon1: [0.05, 5],
      epsilon2: [0.1, 9],
      sizeBound: [0.02, 5],
      rMin: [0.03, 5],
      start: [0, 40]
    };
    for (const field of ["ring", "touch", "noise"]) {
      laboratory.chooseField(field);
      for (const [name, values] of Object.entries(extremes)) {
        for (const value of values) {
          laboratory.options = {...Lesson.Run.defaults};
          laboratory.setOption(name, value);
          equal(laboratory.run.last.kind, "end", `${field}, ${name} = ${value}`);
        }
      }
    }
  });

  test("random start points may miss a loop, seeding by components does not", () => {
    const laboratory = new Lesson.Laboratory("1");
    laboratory.field = Lesson.fields.fill(
        24, (x, y) => Math.max(Lesson.fields.disc(x, y, 8, 12, 6.3), Lesson.fields.disc(x, y, 19.4, 12.3, 0.8)));
    laboratory.drawPoints();
    const text = () => laboratory.sentence(laboratory.steps().length - 1);
    check(text().includes("1 loop has no piece"), text());
    laboratory.setOption("seeding", "components");
    check(text().includes("The mesh is right"), text());
  });
})();
