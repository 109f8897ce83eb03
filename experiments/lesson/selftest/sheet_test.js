// What a screen keeps of a picture from step to step: it has to look as if all were painted anew.
(() => {
  const {test, check, equal, cases} = Lesson.selftest;
  const [width, height] = [640, 420];

  // The pixels of a sheet as it is painted now.
  const reader = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
  const pixelsOf = (painted) => {
    Object.assign(reader.canvas, {width: painted.canvas.width, height: painted.canvas.height});
    reader.drawImage(painted.canvas, 0, 0);
    return reader.getImageData(0, 0, reader.canvas.width, reader.canvas.height).data;
  };

  // Paints the sheets of a scene with what was kept of them, `kept`, as far as a frame goes.
  const paint = (scene, layers, kept) => {
    const canvas = document.createElement("canvas");
    kept.begin();
    Lesson.paint(
        scene, new Lesson.View(scene.bounds, width, height),
        new Lesson.CanvasPainter(Lesson.sizedContext(canvas, width, height), kept), {layers, dark: false});
  };

  const paintWhole = (scene, layers, kept) => {
    do paint(scene, layers, kept);
    while (!kept.isWhole());
    return kept;
  };

  // Lines that the side of a rectangle cuts through may have other shades there: a few values of a million.
  const kFew = 400;
  const countDifferent = (a, b) => {
    let count = 0;
    for (let i = 0; i < a.length; ++i) count += Math.abs(a[i] - b[i]) > 32 ? 1 : 0;
    return count;
  };

  const walks = (chapter) => {
    const last = chapter.steps().length - 1;
    const middle = last >> 1;
    const steps = [0, 1, 2, 3, 2, middle, middle + 1, middle + 2, middle + 1, last - 2, last - 1, last, last - 1];
    return steps.filter((step) => step >= 0 && step <= last).slice(-cases(steps.length));
  };

  test("a picture that is painted in parts looks like one that is painted anew", () => {
    for (const name of ["rays", "delaunay", "restricted", "recover", "refine"]) {
      const chapter = Lesson.chapters.find((other) => other.name === name);
      if (!chapter) continue;
      const layers = new Set([1, 2, 3, 4, 5, 6]);
      const kept = new Lesson.PaintedSheets();
      for (const step of walks(chapter)) {
        const scene = chapter.scene(step, {preview: false, layers});
        paintWhole(scene, layers, kept);
        const anew = paintWhole(scene, layers, new Lesson.PaintedSheets());
        for (const sheetName of new Set(scene.items.filter(({kind}) => kind === "sheet").map((sheet) => sheet.name))) {
          const [mine, its] = [kept, anew].map((sheets) => pixelsOf(sheets.all.get(sheetName)));
          const count = countDifferent(mine, its);
          check(count <= kFew, `${name}/${step}, ${sheetName}: ${count} values differ`);
        }
      }
    }
  });

  // Steps that come faster than a large picture can be painted.
  test("a reader in a hurry gets the whole picture at last", () => {
    const random = new Lesson.Random(11);
    const polygon = (order, reach) => {
      const [x, y] = [reach * random.uniform(), random.uniform()];
      return {kind: "path", points: [[x, y], [x + 0.014, y], [x, y + 0.012]], closed: true, role: "cell", order};
    };
    let items = Array.from({length: 15000}, (_, i) => polygon([i], 1));
    const kept = new Lesson.PaintedSheets();
    const sceneOf = () => {
      const scene = new Lesson.Scene([0, 0, 1.05, 1.05]);
      scene.sheet("polygons", items);
      return scene;
    };
    const {compare} = Lesson.Replay;
    for (let step = 0; step < 9; ++step) {
      paint(sceneOf(), null, kept);
      // In a part of the picture, so that not all is painted anew.
      const near = items.filter(({points}) => points[0][0] < 0.1);
      const gone = new Set(Array.from({length: 300}, () => near[random.below(near.length)]));
      const come = [polygon([random.between(0, 15000)], 0.1), polygon([random.between(0, 15000)], 0.1)];
      items = Lesson.Sheet.merged(items, (item) => gone.has(item), come, (a, b) => compare(a.order, b.order));
    }
    check(items.every((item, i) => i === 0 || items[i - 1].order[0] < item.order[0]), "items are sorted");
    const [mine, its] = [kept, new Lesson.PaintedSheets()].map(
        (sheets) => pixelsOf(paintWhole(sceneOf(), null, sheets).all.get("polygons")));
    check(countDifferent(mine, its) <= kFew, "pixels");
    check(mine.some((value) => value > 0), "something is painted");
  });

  // The list of a state must not tell what was shown before.
  test("what is kept has the order of what is made anew", () => {
    const {spaceRun: run} = Lesson;
    if (!run?.hasStage2) return;
    const chapter = Lesson.chapters.find((other) => other.name === "refine");
    const orders = (sheet) => JSON.stringify(sheet.items.map(({order, role}) => [order, role]));
    for (const step of walks(chapter)) {
      const layers = new Set([5]);
      const sheetOf = () => chapter.scene(step, {preview: false, layers}).items.find(({name}) => name === "mesh");
      const kept = orders(sheetOf());
      run.shown = new Lesson.RunItems();
      equal(kept === orders(sheetOf()), true, `refine/${step}`);
    }
  });
})();
