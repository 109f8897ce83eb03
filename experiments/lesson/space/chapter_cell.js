// Chapter 1: one face of a cell. Four samples at its corners, the field bilinear between them, and the curve where it
// equals the isovalue: two arcs, or none, or one, and at the saddle they change partners.
Lesson.CellChapter = class {
  constructor() { Object.assign(this, {name: "cell", title: "1 Cell", values: [1, -0.6, -0.8, 0.9]}); }

  // The saddle of the bilinear field: where it is, and its value there; null where the field has none.
  saddle() {
    const [f00, f10, f01, f11] = this.values;
    const twist = f00 + f11 - f10 - f01;
    if (twist === 0) return null;
    const at = [(f00 - f01) / twist, (f00 - f10) / twist];
    return {at, value: (f00 * f11 - f10 * f01) / twist};
  }

  // What the picture shows, in words.
  sentence() {
    const [f00, f10, f01, f11] = this.values;
    const signs = this.values.map((f) => f >= 0);
    const isAlternating = signs[0] === signs[3] && signs[1] === signs[2] && signs[0] !== signs[1];
    if (!isAlternating) return "The signs do not alternate around the face: one arc at most, and nothing to decide.";
    const difference = f00 * f11 - f10 * f01;
    const joined = difference === 0 ? "none: the curve is a cross, and the isosurface singular" :
        difference > 0              ? "the corners 00 and 11" :
                                      "the corners 10 and 01";
    return `The signs alternate. f00 · f11 − f10 · f01 = ${Lesson.numberText(difference)}: the saddle joins ${joined}.`;
  }

  scene() {
    const scene = new Lesson.Scene([-0.35, -0.2, 1.35, 1.2]);
    scene.polygon([[0, 0], [1, 0], [1, 1], [0, 1]], "grid");
    for (const arc of Lesson.slice.arcs(...this.values, 12)) scene.line(arc, "mesh");
    [[0, 0], [1, 0], [0, 1], [1, 1]].forEach((corner, i) => {
      const isAbove = this.values[i] >= 0;
      scene.mark(corner, isAbove ? "square" : "disc", isAbove ? "above" : "below", 8);
      scene.label(corner, `f${corner.join("")} = ${Lesson.numberText(this.values[i])}`, "label", 5);
    });
    const saddle = this.saddle();
    if (saddle && saddle.at.every((x) => x > 0 && x < 1)) {
      scene.mark(saddle.at, "star", saddle.value >= 0 ? "above" : "hit", 8);
      scene.label(saddle.at, `saddle ${Lesson.numberText(saddle.value)}`, "label", 4);
    }
    return scene;
  }

  draw() {
    const {canvas} = this;
    const [width, height] = [canvas.clientWidth || 560, canvas.clientHeight || 420];
    const context = Lesson.sizedContext(canvas, width, height);
    const scene = this.scene();
    Lesson.paint(
        scene, new Lesson.View(scene.bounds, width, height), new Lesson.CanvasPainter(context),
        {layers: null, dark: Lesson.theme.isDark()});
    this.words.textContent = this.sentence();
  }

  redraw() { this.draw(); }

  // The value of f00 at which the arcs change partners, others as they are.
  turning() {
    const [, f10, f01, f11] = this.values;
    return f10 * f01 / f11;
  }

  exercises() {
    const asked = [0.9, -0.6, -0.8, 0.8];
    return [{
      question:
          `With f10 = ${asked[1]}, f01 = ${asked[2]}, f11 = ${asked[3]}: at which f00, times 10, do the arcs change ` +
          "partners?",
      answer: () => Math.round(10 * asked[1] * asked[2] / asked[3]),
      because: (value) => `f00 · f11 = f10 · f01, so f00 = ${value / 10}. Drag f00 there and look.`,
    }];
  }

  page() {
    const {element} = Lesson;
    this.canvas = element("canvas", {
      role: "img",
      "aria-label": "a face of a cell",
      style: "display: block; width: min(100%, 620px); height: 420px"
    });
    this.words = element("p", {class: "sentence", "aria-live": "polite"});
    const sliders = ["f00", "f10", "f01", "f11"].map(
        (name, i) => element("label", {class: "setting"}, element("span", {}, name), element("input", {
                               type: "range",
                               min: -1,
                               max: 1,
                               step: 0.01,
                               value: this.values[i],
                               "aria-label": name,
                               oninput: (event) => {
                                 this.values[i] = Number(event.target.value);
                                 this.draw();
                               }
                             })));
    const words = element(
        "div", {}, element("h1", {}, "One face of a cell"),
        element(
            "p", {},
            "Samples less the isovalue stand at the corners. Along each side the field is linear, within it is " +
                "bilinear, so the curve is a hyperbola. Where the signs alternate two arcs are possible in two ways; the " +
                "value at the saddle decides (Nielson and Hamann 1991). Where two cells guess differently, the mesh has a hole."),
        ...this.exercises().map(Lesson.exercise), element("div", {class: "settings"}, ...sliders), this.words);
    const box = element("div", {class: "sided"}, words, this.canvas);
    requestAnimationFrame(() => this.draw());
    return box;
  }
};
