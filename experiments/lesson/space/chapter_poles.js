// Chapter 6: the poles. The surface cuts the Voronoi cell of a vertex in two; on either side the farthest Voronoi
// vertex is a pole, and the nearer one of the two counts. Then the tetrahedra go.
Lesson.PolesChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "poles", title: "6 Poles", code: Lesson.PolesChapter.code, shownLayers: [1, 2, 5, 9]});
    this.kinds = {
      start: {title: "Del S1", mark: "bar", role: "plain"},
      above: {title: "the pole above", key: "a", mark: "square", role: "poles"},
      below: {title: "the pole below", key: "b", mark: "disc", role: "poles"},
      mesh: {title: "BuildTriMesh", mark: "pentagon", role: "plain"},
    };
    this.last = run.meshAt - 1;
    this.found = new Map();  // q -> its poles
    this.rule = run.limits.pole_height ?? "nearer";
    this.asked = this.rule === "farther" ? "farther" : "nearer";
  }

  // Made when it is asked for: the whole of stage 1 comes before it.
  get list() { return (this.made ??= this.makeList()); }

  set list(_) {}

  makeList() {
    const {run} = this;
    const list = [{kind: "start", event: this.last}];
    const replay = run.at(this.last);
    const inMesh = new Set(replay.restricted().flat());
    for (let q = 0; q < replay.points.length && list.length < 60; ++q) {
      const counts = inMesh.has(q) ? this.counting(replay, q) : null;
      if (counts) list.push({kind: counts, event: this.last, q});
    }
    list.push({kind: "mesh", event: run.meshAt});
    return list;
  }

  poles(replay, q) {
    if (!this.found.has(q)) this.found.set(q, this.findPoles(replay, q));
    return this.found.get(q);
  }

  // On either side the farthest Voronoi vertex of q, the circumcenter of one of its tetrahedra; null where there is
  // none. At the hull a side of the cell is unbounded: infinitely far, without a point. On the box all cells are, and
  // only bounded Voronoi vertices count.
  findPoles(replay, q) {
    const found = {above: null, below: null};
    for (const {v, above} of replay.tets.values()) {
      const isUnbounded = v.includes(-1);
      if (!v.includes(q) || (isUnbounded && this.isOnBox(replay.points[q]))) continue;
      const point = isUnbounded ? null : Lesson.vectors.circumcenter(v.map((corner) => replay.points[corner]));
      const distance = isUnbounded ? Infinity : Lesson.vectors.distance(point, replay.points[q]);
      const side = above ? "above" : "below";
      if (!found[side] || distance > found[side].distance) found[side] = {point, distance};
    }
    return found;
  }

  isOnBox(p) {
    const [low, high] = this.run.box;
    return p.some((x, axis) => Math.min(Math.abs(x - low[axis]), Math.abs(x - high[axis])) < 1e-5);
  }

  // The side whose pole counts, the nearer one, or the farther one in runs that take that; null where neither is
  // bounded.
  counting(replay, q) {
    const {above, below} = this.poles(replay, q);
    const [a, b] = [above, below].map((pole) => pole?.distance ?? Infinity);
    if (Math.min(a, b) === Infinity) return null;
    if (this.rule === "farther" && above && below) return a > b ? "above" : "below";
    return a <= b ? "above" : "below";
  }

  // h_q: the distance of the pole that counts, at most the diagonal of the box.
  height(replay, q) {
    const {above, below} = this.poles(replay, q);
    const diagonal = Lesson.vectors.distance(...this.run.box);
    const both = [above, below].filter(Boolean).map(({distance}) => Math.min(distance, diagonal));
    if (!both.length) return diagonal;
    if (this.rule === "mean") return both.reduce((sum, height) => sum + height, 0) / both.length;
    return this.rule === "farther" ? Math.max(...both) : Math.min(...both);
  }

  draw(picture, step) {
    const {q, event, kind} = this.list[step];
    const replay = this.run.at(event);
    if (kind === "mesh") return picture.mesh(replay.mesh);
    picture.restricted(replay);
    const asked = this.list[step + 1]?.q;
    if (asked !== undefined) {
      picture.mark(replay.points[asked], "diamond", "point", 0, 6);
      picture.label(replay.points[asked], `${asked} ?`, 9);
    }
    if (q === undefined) return picture.vertices(replay.points, -1);
    const isAtQ = new RegExp(`(^|,)${q}(,|$)`);
    for (const key of [...replay.sides.keys()].filter((facet) => isAtQ.test(facet)).sort()) {
      if (key.split(",").some((corner) => replay.isVirtual(Number(corner)))) continue;
      picture.line(picture.dualEdge(replay, key), "voronoi", 9);
    }
    const poles = this.poles(replay, q);
    for (const side of ["above", "below"]) {
      const pole = poles[side];
      if (!pole?.point) continue;
      const end = picture.clampTo(this.around(replay, q), pole.point);
      picture.line([replay.points[q], end], side === kind ? "target" : "poleLine", 9);
      picture.mark(end, "diamond", "pole", 9, side === kind ? 8 : 5);
    }
    picture.mark(replay.points[q], "disc", "vertex", 0, 6);
    return picture.label(replay.points[q], String(q), 9);
  }

  // Three vertices near q, for the clamp.
  around(replay, q) { return replay.restricted().find((f) => f.includes(q)).map((v) => replay.points[v]); }

  sentence(step) {
    const {kind, q, event} = this.list[step];
    if (kind === "start") return "Recover has ended. Every Voronoi cell is cut in two by the surface.";
    if (kind === "mesh")
      return "BuildTriMesh: the triangles stay, the tetrahedra go. What needs their empty balls can never be asked again.";
    const replay = this.run.at(event);
    const poles = this.poles(replay, q);
    const text = (side) => !poles[side] ? "no Voronoi vertex" :
        poles[side].point               ? `the pole is ${Lesson.numberText(poles[side].distance)} away` :
                                          "the cell is unbounded";
    const height = this.height(replay, q);
    const both = `Vertex ${q}: above, ${text("above")}; below, ${text("below")}.`;
    if (this.rule === "mean") return `${both} The nearer one: ${kind}. The mean counts, ${Lesson.numberText(height)}.`;
    const limit = poles[kind].distance > height ? `, as far as the box's diagonal, ${Lesson.numberText(height)}` : "";
    return `${both} The ${this.rule} one counts: ${kind}${limit}.`;
  }

  question(step) {
    const {q} = this.list[step + 1];
    return q === undefined ? "What comes after the poles?" :
                             `Vertex ${q}, marked with a diamond: which of its poles is ${this.asked}?`;
  }

  next(step) {
    if (step + 1 >= this.list.length) return null;
    const {kind, q} = this.list[step + 1];
    return {kind, sentence: kind === "mesh" ? "BuildTriMesh." : `Vertex ${q}: which of its poles is ${this.asked}?`};
  }

  why() { return {title: "The pole height bounds the size of triangles: r / h̄ at most ε₂.", rows: []}; }

  line(step) { return this.code.lineOf(this.list[step + 1]?.kind ?? "mesh"); }
};

Lesson.PolesChapter.code = (() => {
  const lines = [
    {
      text: "ComputePoles: the farthest Voronoi vertices",
      file: "surface/restricted/poles.h",
      name: "compute_poles",
      kinds: ["above", "below"]
    },
    {text: "h_q: the nearer one (stage2.pole_height)", file: "surface/base/parameters.h", name: "PoleHeight"},
    {text: "BuildTriMesh", file: "surface/extract/build_triangle_mesh.h", name: "build_triangle_mesh", kinds: ["mesh"]},
  ];
  return {
    title: "Figure 9, lines 2 and 3",
    lines,
    lineOf: (kind) => lines.findIndex((line) => line.kinds?.includes(kind))
  };
})();
