// Chapter 5: Recover, from Del S0 until the restricted facets are what the surface is.
Lesson.RecoverChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "recover", title: "5 Recover", code: Lesson.spaceCode.stage1, shownLayers: [1, 5, 6, 7, 8]});
    this.keepKinds([
      "initial", "multi_intersect", "extract_manifold", "approximate_geometry", "coverage", "refuse", "mesh", "certify",
      "end"
    ]);
    for (let i = 0; i <= run.endOfStage1 && i < run.events.length; ++i) {
      if (run.events[i].e === "compare" || run.events[i].e === "sample") continue;  // chapter 10
      this.list.push({kind: Lesson.spaceStory.kindOf(run.events[i]), event: i});
    }
    this.explode = 0;
  }

  draw(picture, step, preview) {
    // The last step is the mesh; the triangulation it was built from is shown until then.
    const replay = this.run.at(this.list[step].event);
    if (this.event(step).e === "mesh") {
      picture.mesh(replay.mesh);
      return picture.vertices(replay.mesh.points, -1);
    }
    picture.triangulation(replay);
    const next = this.nextEvent(step);
    if (preview && next) this.drawAction(picture, replay, next);
    this.drawLink(picture, replay, step, preview);
    return picture.vertices(replay.points, this.event(step).v, preview && next ? this.inQuestion(next) : []);
  }

  // The vertices that the sentence about an event names.
  inQuestion({q, sigma}) { return [...(q === undefined ? [] : [q]), ...(sigma ? sigma.slice(0, 3) : [])]; }

  // The link of the umbrella in question; else that of the newest vertex.
  linkOf(replay, step, preview) {
    const next = preview ? this.nextEvent(step) : null;
    if (next?.why === "extract_manifold" && next.disk.length)
      return {q: next.q, pieces: Lesson.link.of(next.disk, next.q)};
    const {v} = this.event(step);
    const facets = v === undefined ? [] : replay.restricted().filter((f) => f.includes(v));
    return facets.length ? {q: v, pieces: Lesson.link.of(facets, v)} : null;
  }

  drawLink(picture, replay, step, preview) {
    const link = this.linkOf(replay, step, preview);
    if (!link) return;
    const [left, bottom, right] = this.run.camera.bounds();
    const size = 0.08 * (right - left);
    Lesson.link.draw(picture.scene, link.pieces, [left, bottom], size);
    picture.scene.label([left, bottom + 3 * size], `link of ${link.q}`, "label", 7);
  }

  // What is about to happen: the element in question, the conflict region, and the star over its rim.
  drawAction(picture, replay, event) {
    const {keyOf, rimOf} = Lesson.Replay;
    const points = (v) => v.map((corner) => replay.points[corner]);
    for (const f of event.disk ?? [])
      if (f.every((v) => v >= 0)) picture.line([...points(f), replay.points[f[0]]], "target", 0);
    if (event.sigma) {
      const facet = event.sigma.slice(0, 3);
      picture.line([...points(facet), replay.points[facet[0]]], "target", 0);
      picture.line(picture.dualEdge(replay, keyOf(facet)), "dualEdge", 0);
      for (const p of picture.hitsOf(replay, keyOf(facet))) picture.mark(p, "cross", "hit", 0, 7);
    }
    if (!event.p) return;
    picture.tets(event.gone, replay.points, event.p, this.explode, "conflictFace", 7);
    for (const f of rimOf(event.gone)) {
      const finite = f.filter((v) => v >= 0);
      picture.line(points(finite), "rim", 8);
      for (const v of finite) picture.line([replay.points[v], event.p], "star", 8);
    }
    picture.mark(event.p, "star", "point", 0, 8);
    picture.label(event.p, "next", 9);
  }

  extra(step) {
    if (this.event(step).e === "mesh") return "";
    const {chi, components} = this.run.complex(this.list[step].event);
    const exact = this.run.exact();
    return ` The restricted facets: χ = ${chi} in ${Lesson.countText(components, "component")}` +
        (this.run.isChecked ? `; the surface: χ = ${exact.chi} in ${exact.components}.` : ".");
  }

  exercises() {
    const {run} = this;
    if (!run.isChecked) return [];
    const insertions = () =>
        run.events.slice(0, run.homeomorphicAt() + 1).filter((event) => event.e === "insert").length;
    return [{
      question: "After how many insertions do χ and the number of components become those of the surface? (Never: 0.)",
      answer: insertions,
      because: () => run.homeomorphicAt() < 0 ?
          "never in stage 1; repair has to act, chapter 10." :
          `address #recover/${run.homeomorphicAt()}; everything that Recover does after it serves umbrellas and shape.`,
    }];
  }

  viewPanel() {
    const slider = Lesson.element("input", {
      type: "range",
      min: 0,
      max: 1.5,
      step: 0.05,
      value: this.explode,
      "aria-label": "explode the conflict region",
      oninput: (event) => {
        this.explode = Number(event.target.value);
        this.context.redraw();
      }
    });
    const box = super.viewPanel();
    box.append(
        Lesson.element("label", {class: "setting"}, Lesson.element("span", {}, "explode the conflict region"), slider));
    return box;
  }
};
