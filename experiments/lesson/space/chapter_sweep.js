// Chapter 9, first part: the exact topology of the surface in one voxel cell. A slice rises through the cell; its curve
// changes at few heights only, in four ways, and the program counts the pieces below it.
Lesson.SweepChapter = class {
  constructor(run) {
    Object.assign(
        this,
        {run, name: "sweep", title: "9 Sweep", otherWords: ["height", "conflict region"], shownLayers: [1, 2, 3, 4]});
    this.layers = {1: "cell", 2: "surface below", 3: "slice", 4: "slice from above", 5: "surface above"};
    this.kinds = Lesson.SweepChapter.kinds;
    this.code = Lesson.SweepChapter.code;
    this.camera = new Lesson.Camera([[0, 0, 0], [1, 1, 1]]);
    this.camera.rotate(-0.15, -0.4);
    this.context = {redraw() {}, rerun() {}};
    this.height = null;  // chosen by hand; null: that of the step
    this.list = [];
    run.cells.forEach((cell, c) => {
      this.list.push({kind: "bottom", cell: c, done: 0});
      cell.events.forEach(({kind}, i) => this.list.push({kind, cell: c, done: i + 1}));
      this.list.push({kind: "top", cell: c, done: cell.events.length});
    });
    this.surfaces = run.cells.map(({values}) => new Lesson.CellSurface(values));
    this.pointer = this.camera.dragging(() => this.context.redraw());
  }

  open(context) { this.context = context; }

  steps() { return this.list; }

  cell(step) { return this.run.cells[this.list[step].cell]; }

  // Between what has happened and what comes.
  heightOf(step) {
    const {kind, done} = this.list[step];
    const {events} = this.cell(step);
    if (kind === "bottom") return 0;
    if (kind === "top") return 1;
    return (events[done - 1].w + (events[done]?.w ?? 1)) / 2;
  }

  at(step) { return this.height !== null && this.shownStep === step ? this.height : this.heightOf(step); }

  scene(step, {preview}) {
    if (this.shownStep !== step) this.height = null;
    this.shownStep = step;
    const scene = new Lesson.Scene([-0.9, -1.35, 0.9, 0.95]);
    const w = this.at(step);
    const surface = this.surfaces[this.list[step].cell];
    const line = (points, role, layer) => scene.onLayer(layer).line(points.map((p) => this.camera.toPlane(p)), role);
    this.drawCell(scene, surface, line);
    const slices = 40;
    for (let i = 0; i <= slices; ++i) {
      const at = i / slices;
      for (const arc of surface.arcs(at)) line(arc, at <= w ? "sweptArc" : "delaunay", at <= w ? 2 : 5);
    }
    const frame = [[0, 0, w], [1, 0, w], [1, 1, w], [0, 1, w]];
    scene.onLayer(3).polygon(frame.map((p) => this.camera.toPlane(p)), "slicePlane");
    for (const arc of surface.arcs(w)) line(arc, "mesh", 3);
    const next = this.cell(step).events[this.list[step].done];
    if (preview && next) {
      const p = this.camera.toPlane([next.u, next.v, next.w]);
      scene.onLayer(0).mark(p, this.kinds[next.kind].mark, "point", 9);
      scene.label(p, `w = ${Lesson.numberText(next.w)}`, "label", 8);
    }
    this.drawInset(scene, surface, w);
    return scene;
  }

  drawCell(scene, surface, line) {
    const corner = (bits) => [bits & 1, (bits >> 1) & 1, bits >> 2];
    for (let bits = 0; bits < 8; ++bits) {
      for (let axis = 0; axis < 3; ++axis) {
        if (!((bits >> axis) & 1)) line([corner(bits), corner(bits | (1 << axis))], "frame", 1);
      }
      const isAbove = surface.values[bits] >= 0;
      const p = this.camera.toPlane(corner(bits));
      scene.onLayer(1).mark(p, isAbove ? "square" : "disc", isAbove ? "above" : "below", 6);
      scene.label(p, Lesson.numberText(surface.values[bits]), "softLabel", 2);
    }
  }

  // The slice seen from above, in the lower part of the picture.
  drawInset(scene, surface, w) {
    const place = ([u, v]) => [-0.2 + 0.4 * u, -1.3 + 0.4 * v];
    scene.onLayer(4).polygon([[0, 0], [1, 0], [1, 1], [0, 1]].map(place), "slicePlane");
    for (const arc of surface.arcs(w)) scene.line(arc.map(place), "mesh");
    surface.signs(w).forEach(
        (isAbove, c) =>
            scene.mark(place([c % 2, c >> 1]), isAbove ? "square" : "disc", isAbove ? "above" : "below", 6));
    const saddle = surface.saddle(w);
    if (saddle && saddle.slice(0, 2).every((x) => x >= 0 && x <= 1)) scene.mark(place(saddle), "cross", "hit", 6);
    scene.label(place([1, 0.5]), `slice at w = ${Lesson.numberText(w)}`, "softLabel", 5);
  }

  counts({pieces, chi, arcs}) {
    return `${Lesson.countText(arcs, "arc")} in the slice; below it ${Lesson.countText(pieces, "piece")}, χ = ${chi}`;
  }

  sentence(step) {
    const {kind, done} = this.list[step];
    const cell = this.cell(step);
    if (kind === "bottom") {
      return `Cell ${cell.cell.join(", ")} of ${this.run.name}: the slice at its bottom, with ${
          Lesson.countText(
              cell.below[0].arcs, "arc")}. It will change ${Lesson.countText(cell.events.length, "time")}.`;
    }
    if (kind === "top") {
      const {pieces} = cell;
      const text = pieces.map((chi) => (chi === 1 ? "a disk" : chi === 0 ? "a tube (χ = 0)" : `χ = ${chi}`)).join(", ");
      return `The top. The surface in this cell has ${Lesson.countText(pieces.length, "piece")}: ${text}.`;
    }
    return `Height w = ${Lesson.numberText(cell.events[done - 1].w)}. ${Lesson.SweepChapter.says[kind]} ` +
        `Now ${this.counts(cell.below[done])}.`;
  }

  next(step) {
    const coming = this.list[step + 1];
    if (!coming) return null;
    const words = coming.kind === "bottom" ? "Another cell." :
        coming.kind === "top"              ? "Nothing more happens up to the top." :
                                             `At w = ${Lesson.numberText(this.cell(step).events[coming.done - 1].w)}: ` +
            Lesson.SweepChapter.says[coming.kind];
    return {kind: coming.kind, sentence: words};
  }

  question() { return "The slice rises. What happens first?"; }

  choices(step) {
    return this.list[step + 1].kind === "bottom" ? ["bottom"] : ["appear", "vanish", "move", "saddle", "top"];
  }

  why(step) {
    const coming = this.list[step + 1];
    if (!coming || coming.kind === "bottom") return {title: "The sweep has reached the top of the cell.", rows: []};
    const cell = this.cell(step);
    const [f00, f10, f01, f11] = this.surfaces[coming.cell].slice(this.heightOf(step));
    const fact = (name, value) => ({name, value, isFact: true});
    const event = cell.events[coming.done - 1];
    return {
      title: "A corner of the slice changes sign, or f00 f11 − f10 f01 does where the signs alternate.",
      rows: [
        fact("f00, f11 in this slice", `${Lesson.numberText(f00)}, ${Lesson.numberText(f11)}`),
        fact("f10, f01", `${Lesson.numberText(f10)}, ${Lesson.numberText(f01)}`),
        fact("f00 f11 − f10 f01", f00 * f11 - f10 * f01),
        ...(coming.kind === "top" ? [] : [fact("the next height w", event.w)])
      ],
      remark: "The program decides each sign, and which height comes first, exactly; the heights here are rounded."
    };
  }

  line(step) { return this.code.lineOf(this.list[step + 1]?.kind); }

  exercises() {
    const [cell] = this.run.cells;
    const saddles = cell.events.filter(({kind}) => kind === "saddle").length;
    const signs = this.surfaces[0].values;
    const crossed = [
      [0, 1], [2, 3], [0, 2], [1, 3], [4, 5], [6, 7], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]
    ].filter(([a, b]) => (signs[a] < 0) !== (signs[b] < 0));
    return [
      {
        question: "First cell, before you play it: how many of its twelve edges does the surface cross?",
        answer: () => crossed.length,
        because: () => "the signs of the samples at their ends differ.",
      },
      {
        question: `Its slice changes ${cell.events.length} times, ${saddles} of them at saddles. How many pieces has ` +
            "the surface in the cell?",
        answer: () => cell.pieces.length,
        because: (count) => `the sweep ends with ${count}; χ of each: ${cell.pieces.join(", ")}.`,
      }
    ];
  }

  panel() {
    const {element} = Lesson;
    const slider = element("input", {
      type: "range",
      min: 0,
      max: 1,
      step: 0.005,
      "aria-label": "height of the slice",
      oninput: (event) => {
        this.height = Number(event.target.value);
        this.words.textContent = this.heightText();
        this.context.redraw();
      }
    });
    this.words = element("p", {class: "soft", "aria-live": "polite"});
    const turn = (text, label, a, b) => element(
        "button", {"aria-label": label, title: label, onclick: () => (this.camera.rotate(a, b), this.context.redraw())},
        text);
    return element(
        "div", {}, element("h2", {}, "Height"),
        element("label", {class: "setting"}, element("span", {}, "height of the slice"), slider), this.words,
        ...this.exercises().map(Lesson.exercise), element("h2", {}, "View"), turn("←", "turn left", -0.2, 0),
        turn("→", "turn right", 0.2, 0), turn("↑", "tilt up", 0, 0.2), turn("↓", "tilt down", 0, -0.2));
  }

  // The program's counts of the part below the height that was chosen by hand.
  heightText() {
    const cell = this.cell(this.shownStep);
    const done = cell.events.filter(({w}) => w < this.height).length;
    return `w = ${Lesson.numberText(this.height)}, after ${Lesson.countText(done, "event")}: ${
        this.counts(cell.below[done])}.`;
  }
};

Lesson.SweepChapter.says = {
  appear: "A corner of the slice changes sign, and an arc appears there.",
  vanish: "A corner of the slice changes sign, and an arc shrinks to nothing there.",
  move: "A corner of the slice changes sign: the end of an arc passes from one side to the next.",
  saddle: "A saddle: two arcs meet, and part the other way.",
};

Lesson.SweepChapter.kinds = {
  bottom: {title: "the next cell", key: "b", mark: "bar", role: "plain"},
  appear: {title: "an arc appears", key: "a", mark: "triangle", role: "right", rise: 8},
  vanish: {title: "an arc vanishes", key: "v", mark: "down", role: "refused", rise: 8},
  move: {title: "an end moves on", key: "m", mark: "disc", role: "plain", rise: 0},
  saddle: {title: "a saddle", key: "d", mark: "cross", role: "multi", rise: -8},
  top: {title: "nothing, up to the top", key: "n", mark: "square", role: "plain"},
};

Lesson.SweepChapter.code = (() => {
  const at = (text, name, kinds = []) => ({text, file: "volume/topology/cell_sweep.cpp", name, kinds});
  const lines = [
    at("order the heights at which corners change sign", "order_flips"),
    at("the arcs of the bottom slice", "start", ["bottom"]),
    at("between two of them: does D change sign?", "cross_interval"),
    at("  two arcs meet, χ falls by one", "add_saddles", ["saddle"]),
    at("a corner changes sign", "flip", ["appear", "vanish", "move"]),
    at("the arcs of the top slice", "finish", ["top"]),
  ];
  return {
    title: "The sweep of a cell (not in the paper)",
    lines,
    lineOf: (kind) => lines.findIndex((line) => line.kinds.includes(kind))
  };
})();
