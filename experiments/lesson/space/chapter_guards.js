// Chapter 8: a gallery of insertions that stage 2 refuses, of every cause that occurs in noise.
Lesson.GuardsChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "guards", title: "8 Guards", code: Lesson.GuardsChapter.code, shownLayers: [5, 7, 8]});
    this.kinds =
        Object.fromEntries(Object.entries(Lesson.GuardsChapter.causes)
                               .map(([cause, {title, key, mark}]) => [cause, {title, key, mark, role: "refused"}]));
    this.kinds.start = {title: "the gallery", mark: "bar", role: "plain"};
    this.list.push({kind: "start", event: Math.max(0, run.meshAt)});
    const found = {};
    run.events.forEach((event, i) => {
      if (event.e !== "keep" || !event.p) return;
      found[event.cause] ??= [];
      // A few of each will do.
      if (found[event.cause].length < 6) found[event.cause].push(i);
    });
    for (const cause of Object.keys(Lesson.GuardsChapter.causes)) {
      for (const i of found[cause] ?? []) this.list.push({kind: cause, event: i});
    }
  }

  draw(picture, step, preview) {
    const {mesh} = this.run.at(this.list[step].event);
    const event = this.event(step);
    if (event.e !== "keep") return picture.mesh(mesh);
    // The surroundings alone, near the point.
    const reach = 3 * Math.max(...event.gone.flat().map((v) => Lesson.vectors.distance(mesh.points[v], event.p)), 0.5);
    for (const t of mesh.triangles.values()) {
      if (t.some((v) => Lesson.vectors.distance(mesh.points[v], event.p) > reach)) continue;
      picture.face(t.map((v) => mesh.points[v]), "meshFace", 5);
    }
    picture.flush();
    // From the triangle in question to where its dual line meets the surface.
    picture.line([Lesson.vectors.mean(event.t.map((v) => mesh.points[v])), event.p], "poleLine", 8);
    return Lesson.drawDisk(picture, mesh.points, event, preview);
  }

  // The picture is as large as what it shows.
  scene(step, options) {
    const scene = super.scene(step, options);
    const event = this.event(step);
    if (event.e !== "keep") return scene;
    const {mesh} = this.run.at(this.list[step].event);
    const seen = [event.p, ...event.gone.flat().map((v) => mesh.points[v])].map((p) => this.run.camera.toPlane(p));
    const range = [0, 1].map((axis) => [Math.min, Math.max].map((pick) => pick(...seen.map((p) => p[axis]))));
    const half = Math.max(0.8 * Math.max(...range.map(([low, high]) => high - low)), 0.9);
    const [x, y] = range.map(([low, high]) => (low + high) / 2);
    scene.bounds = [x - half, y - half, x + half, y + half];
    return scene;
  }

  sentence(step) {
    const event = this.event(step);
    if (event.e !== "keep") {
      const count = this.list.length - 1;
      return "The mesh of random samples that stage 2 begins with. " +
          (count ? `${Lesson.countText(count, "refusal")} to follow; name the guard of each.` :
                   "No insertion into it was refused.");
    }
    return `Triangle ${event.t.join("–")}: ${Lesson.GuardsChapter.causes[event.cause].says}`;
  }

  next(step) {
    if (step + 1 >= this.list.length) return null;
    return {kind: this.list[step + 1].kind, sentence: "Another triangle is coarse, and its insertion is refused. Why?"};
  }

  why() { return {title: "A refused triangle stays, and is tried again when something around it changes.", rows: []}; }

  line(step) { return this.code.lineOf(this.list[step].kind); }
};

Lesson.GuardsChapter.causes = {
  no_hit: {
    title: "no hit",
    key: "h",
    mark: "cross",
    says: "its dual line does not meet the surface, or beyond the box only."
  },
  not_a_disk: {
    title: "not a disk",
    key: "d",
    mark: "diamond",
    says: "the triangles whose balls hold x_σ form no disk: its rim is no single cycle, or a vertex lies within."
  },
  repeated_vertex: {title: "repeated vertex", key: "v", mark: "pentagon", says: "the rim of E passes a vertex twice."},
  flipped_triangle:
      {title: "flipped triangle", key: "f", mark: "triangle", says: "a triangle of D would face the wrong way."},
  too_close:
      {title: "too close", key: "c", mark: "disc", says: "x_σ is nearer to a vertex than half of its ball's radius."},
  too_far: {title: "too far", key: "a", mark: "square", says: "x_σ lies far off the planes of E: D would be a spike."},
  crossing_triangle:
      {title: "crossing triangle", key: "x", mark: "plus", says: "a triangle of D would cross another sheet."},
};

Lesson.GuardsChapter.code = (() => {
  const at = (text, name, kinds, file = "surface/refine/refine_loop.cpp") => ({text, file, name, kinds});
  const lines = [
    at("x_σ: the surface on the triangle's dual line", "kNoHit", ["no_hit"]),
    at("E is a disk without inner vertices", "kNotADisk", ["not_a_disk"]),
    at("its rim passes every vertex once", "kRepeatedVertex", ["repeated_vertex"]),
    at("x_σ is not near a vertex", "kTooClose", ["too_close"]),
    at("every triangle of D faces lower values", "kFlippedTriangle", ["flipped_triangle"]),
    at("x_σ is near the planes of E", "kTooFar", ["too_far"]),
    at("D crosses no other triangle", "kCrossingTriangle", ["crossing_triangle"]),
  ];
  return {
    title: "What an insertion must pass",
    lines,
    lineOf: (kind) => lines.findIndex((line) => line.kinds.includes(kind))
  };
})();
