// Chapter 7: stage 2, on the surface alone. E is what the new vertex replaces, D what replaces it.
Lesson.RefineChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "refine", title: "7 Refine", code: Lesson.spaceCode.stage2, shownLayers: [1, 5, 7, 8]});
    this.keepKinds(["mesh", "refine", "keep", "restart", "refined", "shape", "certify", "end"]);
    for (let i = run.meshAt; i >= 0 && i < run.events.length; ++i) {
      this.list.push({kind: Lesson.spaceStory.kindOf(run.events[i]), event: i});
    }
  }

  draw(picture, step, preview) {
    const {mesh} = this.run.at(this.list[step].event);
    picture.mesh(mesh);
    const next = this.nextEvent(step);
    if (preview && next?.p) Lesson.drawDisk(picture, mesh.points, next);
    const named = preview && next?.t ? next.t : [];
    if (mesh.points.length <= 160) return picture.vertices(mesh.points, this.event(step).v, named);
    if (this.event(step).p) picture.mark(this.event(step).p, "disc", "vertex", 0, 5);
    for (const v of named) picture.label(mesh.points[v], String(v), 6);
    return undefined;
  }

  exercises() {
    const first = this.run.events.find((event) => event.e === "refine" && event.closed);
    if (!first) return [];
    const gone = first.gone.length;
    return [{
      question: `E of vertex ${first.v} has ${gone} triangles and no vertex inside. How many triangles has D?`,
      answer: () => Lesson.Replay.starOf(first).length,
      because: (value) =>
          `a disk of ${gone} triangles without inner vertices has ${gone} + 2 edges on its rim, and D one ` +
          `triangle for each: ${value}.`,
    }];
  }
};

// E, its rim, and where there is one the star D.
Lesson.drawDisk = (picture, points, event) => {
  for (const t of event.gone) picture.face(t.map((v) => points[v]), "diskFace", 7);
  picture.flush();
  const p = event.p;
  if (event.rim)
    for (const v of event.rim) picture.line([points[v], p], "pathD", 8);
  picture.mark(p, "star", "point", 0, 8);
  picture.label(p, "x_σ", 9);
};
