// Chapter 3: one insertion into the Delaunay triangulation in three steps: the conflict region, its rim, the star.
Lesson.DelaunayChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "delaunay", title: "3 Delaunay", code: Lesson.DelaunayChapter.code, shownLayers: [4, 7, 8]});
    this.kinds = {
      state: {title: "the triangulation", mark: "bar", role: "plain"},
      region: {title: "conflict region", key: "c", mark: "square", role: "extract"},
      rim: {title: "rim", key: "r", mark: "diamond", role: "multi"},
      star: {title: "star", key: "s", mark: "star", role: "refine"},
    };
    this.list.push({kind: "state", event: 0, insert: -1});
    // Enough to see small regions and large ones.
    const inserts = run.events.map((event, i) => [event, i]).filter(([event]) => event.e === "insert").slice(0, 40);
    for (const [, i] of inserts) {
      for (const kind of ["region", "rim", "star"])
        this.list.push({kind, event: kind === "star" ? i : i - 1, insert: i});
    }
  }

  draw(picture, step) {
    const {kind, event, insert} = this.list[step];
    const replay = this.run.at(event);
    picture.triangulation(replay);
    if (insert >= 0) {
      const its = this.run.events[insert];
      const rim = Lesson.Replay.rimOf(its.gone).filter((f) => f.every((v) => v >= 0));
      if (kind === "region") picture.tets(its.gone, replay.points, its.p, 0, "conflictFace", 7);
      for (const f of rim) {
        const p = f.map((v) => replay.points[v]);
        if (kind === "rim") picture.line([...p, p[0]], "rim", 8);
        if (kind === "star") picture.face([its.p, p[0], p[1]], "starFace", 8);
      }
      picture.flush();
      picture.mark(its.p, "star", "point", 0, 8);
    }
    picture.vertices(replay.points, kind === "star" ? this.run.events[insert].v : -1);
  }

  counts(insert) {
    const {gone, above} = this.run.events[insert];
    const rim = Lesson.Replay.rimOf(gone);
    return {gone: gone.length, facets: rim.length, vertices: new Set(rim.flat()).size, star: above.length};
  }

  sentence(step) {
    const {kind, insert} = this.list[step];
    if (insert < 0) return "The Delaunay triangulation of the first points: no vertex lies inside any circumball.";
    const {gone, facets, vertices, star} = this.counts(insert);
    switch (kind) {
      case "region":
        return `The circumballs of ${Lesson.countText(gone, "tetrahedron", "tetrahedra")} hold the new point: ` +
            "they are in conflict with it and go.";
      case "rim":
        return `Their rim is a sphere of ${facets} facets on ${
            vertices} vertices, the infinite one among them if it is there.`;
      default:
        return `The star of the new vertex over the rim: ${star} new tetrahedra, one a facet.`;
    }
  }

  next(step) {
    if (step + 1 >= this.list.length) return null;
    const {kind} = this.list[step + 1];
    const words = {
      region: "Which tetrahedra are in conflict with the next point?",
      rim: "What bounds the conflict region?",
      star: "How many tetrahedra fill the hole?"
    };
    return {kind, sentence: words[kind]};
  }

  why() { return {title: "A tetrahedron is in conflict with a point that its circumball holds.", rows: []}; }

  line(step) { return this.list[step + 1] ? this.code.lineOf(this.list[step + 1].kind) : -1; }

  // None where the first points are enough, and nothing is inserted.
  exercises() {
    if (this.list.length < 2) return [];
    const {insert} = this.list[1];
    const {vertices, star} = this.counts(insert);
    return [{
      question: `The rim of the first insertion has ${vertices} vertices. How many tetrahedra are new?`,
      answer: () => star,
      because: (value) => `the rim is a sphere, so that Euler gives 2 V − 4 = 2 · ${vertices} − 4 = ${value} facets.`,
    }];
  }
};

Lesson.DelaunayChapter.code = (() => {
  const lines = [
    {
      text: "find the tetrahedra whose circumballs hold p",
      file: "delaunay/bowyer_watson.h",
      name: "find_conflicts",
      kinds: ["region"]
    },
    {text: "the facets around them: the rim", file: "delaunay/bowyer_watson.h", name: "rim", kinds: ["rim"]},
    {text: "join p to the rim: its star", file: "delaunay/bowyer_watson.h", name: "fill_cavity", kinds: ["star"]},
  ];
  return {title: "Bowyer and Watson", lines, lineOf: (kind) => lines.findIndex((line) => line.kinds.includes(kind))};
})();
