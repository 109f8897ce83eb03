// What stays from state to state of a run as the camera sees it, such as the triangles of a mesh: projected once, and
// sorted once. The list of items (frame/sheet.js) depends on the state and the camera alone, not on the states before.
Lesson.KeptItems = class {
  constructor() { Object.assign(this, {view: "", kept: new Map(), items: [], time: 0}); }

  // All items of a state are named between begin() and end().
  begin({turn, tilt}) {
    const view = `${turn} ${tilt}`;
    if (view !== this.view) Object.assign(this, {view, kept: new Map(), items: []});
    this.time += 1;
    this.come = [];
    this.count = 0;
  }

  // The item of a key: the same one as long as a, b and c, from which it is made, are the same objects. It has
  // `order`, numbers by which items are sorted.
  add(key, make, a, b = null, c = null) {
    let its = this.kept.get(key);
    if (!its || its.a !== a || its.b !== b || its.c !== c) {
      its = {a, b, c, item: make(a, b, c)};
      this.kept.set(key, its);
      this.come.push(its.item);
    }
    if (its.item.time !== this.time) this.count += 1;
    its.item.time = this.time;
  }

  end() {
    if (this.come.length === 0 && this.count === this.kept.size) return this.items;
    for (const [key, {item}] of this.kept)
      if (item.time !== this.time) this.kept.delete(key);
    const {compare} = Lesson.Replay;
    const isGone = (item) => item.time !== this.time;
    return (this.items = Lesson.Sheet.merged(this.items, isGone, this.come, (a, b) => compare(a.order, b.order)));
  }
};

// The items that a run keeps, by what they show.
Lesson.RunItems = (() => {
  const {vectors} = Lesson;

  // What one face looks like; from the farthest to the nearest. Equal ones may come in any order.
  const faceOf = (points, name, camera) => {
    const normal = vectors.cross(vectors.sub(points[1], points[0]), vectors.sub(points[2], points[0]));
    const seen = points.map((p) => camera.toPlane(p));
    return {
      kind: "path",
      points: seen,
      closed: true,
      role: `${name}${Lesson.shadeOf(normal, camera.towards)}`,
      order: [camera.nearness(vectors.mean(points)), ...seen[0], ...seen[1], ...seen[2]]
    };
  };

  const lineOf = (ends, role, order, camera) =>
      ({kind: "path", points: ends.map((p) => camera.toPlane(p)), closed: false, role, order});

  const markOf = (p, shape, role, size, order, camera) =>
      ({kind: "mark", point: camera.toPlane(p), shape, role, size, order});

  return class {
    constructor() {
      for (const name of ["surface", "mesh", "edges", "dualEdges", "hits", "vertices"])
        this[name] = new Lesson.KeptItems();
    }

    static faceOf(points, name, camera) { return faceOf(points, name, camera); }

    // Of triangles, key -> corners; `which` keeps them.
    facesOf(which, triangles, points, name, camera) {
      const kept = this[which];
      const make = (a, b, c) => faceOf([a, b, c], name, camera);
      kept.begin(camera);
      // From the smallest number on, wherever a state begins to name the corners.
      for (const [key, v] of triangles) {
        const i = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
        kept.add(key, make, points[v[i]], points[v[(i + 1) % 3]], points[v[(i + 2) % 3]]);
      }
      return kept.end();
    }

    // The edges between vertices that are points of the surface.
    edgesOf(replay, camera) {
      const {points, tets} = replay;
      this.edges.begin(camera);
      for (const {v} of tets.values()) {
        const finite = v.filter((corner) => !replay.isVirtual(corner));
        for (const a of finite) {
          for (const b of finite) {
            if (b <= a) continue;
            const make = (p, q) => lineOf([p, q], "delaunay", [a, b], camera);
            this.edges.add(a * 1048576 + b, make, points[a], points[b]);
          }
        }
      }
      return this.edges.end();
    }

    // `ends(key)` tells where the dual edge of a facet ends; it is that between two tetrahedra.
    dualEdgesOf(replay, ends, camera) {
      this.dualEdges.begin(camera);
      for (const f of replay.restricted()) {
        const key = Lesson.Replay.keyOf(f);
        const [a, b] = replay.sidesOf(key).map((tet) => replay.tets.get(tet));
        this.dualEdges.add(key, () => lineOf(ends(key), "voronoi", f, camera), a, b);
      }
      return this.dualEdges.end();
    }

    // `hits(key)` are those of the dual edge of a facet. Where there are many facets, those with one hit would hide
    // all.
    hitsOf(replay, hits, camera) {
      this.hits.begin(camera);
      const facets = replay.restricted();
      const fewest = facets.length > 300 ? 2 : 1;
      for (const f of facets) {
        const key = Lesson.Replay.keyOf(f);
        const found = replay.hits.get(key);
        if (found && found.t.length < fewest) continue;
        found?.t.forEach((_, i) => {
          const make = () => markOf(hits(key)[i], "cross", "hit", 4, [...f, i], camera);
          this.hits.add(`${key} ${i}`, make, found);
        });
      }
      return this.hits.end();
    }

    verticesOf(points, camera) {
      this.vertices.begin(camera);
      points.forEach((p, v) => this.vertices.add(v, () => markOf(p, "disc", "vertex", 2.2, [v], camera), p));
      return this.vertices.end();
    }
  };
})();
