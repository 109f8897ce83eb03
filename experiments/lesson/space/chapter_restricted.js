// Chapter 4: a facet and its dual edge. One facet of the triangulation a step; restricted or not?
Lesson.RestrictedChapter = class extends Lesson.SpaceChapter {
  // Hits of other facets than the one in question would tell what comes.
  constructor(run) {
    super(
        run, {name: "restricted", title: "4 Restricted", code: Lesson.RestrictedChapter.code, shownLayers: [1, 2, 4]});
    this.kinds = {
      start: {title: "the triangulation", mark: "bar", role: "plain"},
      restricted: {title: "restricted", key: "r", mark: "triangle", role: "approximate"},
      clear: {title: "not restricted", key: "n", mark: "disc", role: "plain"},
    };
    this.list.push({kind: "start", event: 0});
    // Restricted facets and others in turn, as far as both last.
    const replay = run.at(0);
    const facets = {restricted: [], clear: []};
    for (const key of [...replay.sides.keys()].sort()) {
      const v = key.split(",").map(Number);
      if (v.some((corner) => replay.isVirtual(corner))) continue;
      facets[this.signs(replay, key)[0] === this.signs(replay, key)[1] ? "clear" : "restricted"].push(key);
    }
    const random = new Lesson.Random(Lesson.data.seed);
    for (let i = 0; i < 24; ++i) {
      const kind = random.uniform() < 0.5 ? "restricted" : "clear";
      const key = facets[kind].splice(random.below(facets[kind].length), 1)[0];
      if (key) this.list.push({kind, event: 0, key});
    }
  }

  signs(replay, key) { return replay.sidesOf(key).map((tet) => replay.tets.get(tet).above); }

  draw(picture, step) {
    const replay = this.run.at(0);
    picture.triangulation(replay);
    const {key} = this.list[step];
    if (key) {
      const facet = key.split(",").map((v) => replay.points[Number(v)]);
      picture.face(facet, "diskFace", 0);
      picture.flush();
      const ends = picture.dualEdge(replay, key);
      picture.line(ends, "dualEdge", 0);
      replay.sidesOf(key).forEach((tet, i) => {
        const {above} = replay.tets.get(tet);
        picture.mark(ends[i], above ? "square" : "disc", above ? "above" : "below", 0, 6);
      });
      for (const p of picture.hitsOf(replay, key)) picture.mark(p, "cross", "hit", 0, 8);
    }
    // What is asked about next, without the signs that answer it.
    const asked = this.list[step + 1]?.key.split(",").map((v) => replay.points[Number(v)]);
    if (asked) {
      picture.line([...asked, asked[0]], "rim", 0);
      picture.line(picture.dualEdge(replay, this.list[step + 1].key), "voronoi", 0);
      picture.label(Lesson.vectors.mean(asked), "?", 9);
    }
    picture.vertices(replay.points, -1);
  }

  sentence(step) {
    const {key, kind} = this.list[step];
    if (!key)
      return "A facet is restricted where its dual edge, between the circumcenters on both sides, meets the surface.";
    const replay = this.run.at(0);
    const [a, b] = this.signs(replay, key).map((above) => (above ? "above" : "below"));
    const hits = replay.hits.get(key)?.t.length ?? 0;
    return `Facet ${key.replaceAll(",", "–")}: its circumcenters lie ${a} and ${b} the isovalue, the dual edge has ` +
        `${Lesson.countText(hits, "hit")}: ${kind === "restricted" ? "restricted" : "not restricted"}.`;
  }

  question() { return "The facet with the dashed rim, marked with a question mark: is it restricted?"; }

  next(step) {
    if (step + 1 >= this.list.length) return null;
    const {kind, key} = this.list[step + 1];
    return {kind, sentence: `Is facet ${key.replaceAll(",", "–")} restricted?`};
  }

  why() {
    return {
      title: "The signs at the ends of its dual edge decide; the number of hits is odd just when they differ.",
      rows: []
    };
  }

  line() { return 1; }

  exercises() {
    const replay = this.run.at(0);
    const odd = [...replay.hits.values()].filter(({t}) => t.length % 2 === 0).length;
    return [{
      question:
          "How many dual edges have an even number of hits, so that their facets are not restricted though there is one?",
      answer: () => odd,
      because: () =>
          "with one sign a tetrahedron their facets do not count. MultiIntersect inserts hits until no such edge is " +
          "left; an insertion often removes several of them.",
    }];
  }
};

Lesson.RestrictedChapter.code = (() => {
  const lines = [
    {
      text: "V_σ: from circumcenter to circumcenter",
      file: "surface/restricted/restricted_delaunay.h",
      name: "DualEdge"
    },
    {
      text: "restricted: the signs at its ends differ",
      file: "surface/restricted/signed_delaunay.h",
      name: "is_restricted"
    },
    {
      text: "x_σ: the hit nearest to the facet's plane",
      file: "surface/restricted/restricted_delaunay.h",
      name: "surface_hit"
    },
  ];
  return {title: "Del S restricted to the surface", lines, lineOf: () => 1};
})();
