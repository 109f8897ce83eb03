// Rebuilds the states of a run of the program from its trace, forwards and backwards: every event is applied with a
// record of what it replaced. New tetrahedra are the star of the new vertex over the rim of what is gone.
Lesson.Replay = (() => {
  const byNumber = (a, b) => a - b;
  const sorted = (v) => [...v].sort(byNumber);
  const keyOf = (v) => sorted(v).join(",");
  const compare = (a, b) => {
    let i = 0;
    while (i < a.length && a[i] === b[i]) ++i;
    return i < a.length ? a[i] - b[i] : 0;
  };
  const facetsOf = (v) => [[v[1], v[2], v[3]], [v[0], v[2], v[3]], [v[0], v[1], v[3]], [v[0], v[1], v[2]]];

  class Replay {
    constructor(events) {
      this.events = events;
      this.points = [];
      this.virtual = new Set([-1]);
      this.tets = new Map();     // key -> {v, above}
      this.sides = new Map();    // key of a facet -> the keys of the tetrahedra at it
      this.between = new Set();  // the keys of facets whose two tetrahedra differ in sign
      this.hits = new Map();     // key of a facet -> {v, t}: the dual edge's hits, as lengths along the normal of v
      this.found = null;         // the restricted facets, once they were asked for
      this.mesh = null;          // of stage 2: {points, triangles: key -> corners, poles}
      this.undo = [];            // of each event that is applied
    }

    get position() { return this.undo.length - 1; }

    // The state after event n.
    goTo(n) {
      if (this.position !== n) this.found = null;
      while (this.position < n) this.undo.push(this.apply(this.events[this.position + 1]));
      while (this.position > n) this.undo.pop()();
      return this;
    }

    apply(event) {
      switch (event.e) {
        case "initial":
          return this.begin(event);
        case "insert":
          return this.insert(event);
        case "mesh":
        case "shape":
          return this.takeMesh(event);
        case "refine":
          return this.refine(event);
        case "restart":
          return this.takeBack();
        case "refined":
          return Array.isArray(event.triangles) ? this.takeMesh(event) : () => {};
        default:
          return () => {};
      }
    }

    begin(event) {
      this.points = event.points.map((p) => [...p]);
      for (const v of event.virtual) this.virtual.add(v);
      event.tets.forEach((v, i) => this.addTet(v, event.above[i] === "1"));
      for (const facet of event.facets) this.setHits(facet);
      return () => {
        this.points = [];
        for (const map of [this.tets, this.sides, this.between, this.hits]) map.clear();
      };
    }

    insert(event) {
      const gone = event.gone.map((v) => this.removeTet(keyOf(v)));
      const times = new Map();
      for (const {v} of gone) {
        for (const f of facetsOf(v)) {
          const key = keyOf(f);
          times.set(key, (times.get(key) ?? 0) + 1);
        }
      }
      const changed = [];
      for (const [key, count] of times)
        if (count === 2) changed.push(this.dropHits(key));
      this.points.push(event.p);
      const rim = Replay.rimOf(event.gone);
      const added = rim.map((f, i) => this.addTet([...f, event.v], event.above[i] === "1"));
      for (const facet of event.facets) changed.push(this.setHits(facet));
      return () => {
        for (const restore of changed.reverse()) restore();
        for (const key of added) this.removeTet(key);
        this.points.pop();
        for (const {v, above} of gone) this.addTet(v, above);
      };
    }

    takeMesh(event) {
      const before = this.mesh;
      const triangles = new Map(event.triangles.map((t) => [keyOf(t), t]));
      this.mesh = {points: [...event.points], triangles, poles: event.poles ?? before?.poles ?? []};
      if (event.e === "mesh") this.first = event;
      return () => (this.mesh = before);
    }

    takeBack() {
      const before = this.mesh;
      this.takeMesh(this.first);
      return () => (this.mesh = before);
    }

    refine(event) {
      const {points, triangles} = this.mesh;
      points.push(event.p);
      for (const t of event.gone) triangles.delete(keyOf(t));
      const star = Replay.starOf(event);
      for (const t of star) triangles.set(keyOf(t), t);
      return () => {
        for (const t of star) triangles.delete(keyOf(t));
        for (const t of event.gone) triangles.set(keyOf(t), t);
        points.pop();
      };
    }

    addTet(v, above) {
      const key = keyOf(v);
      this.tets.set(key, {v, above});
      for (const f of facetsOf(v)) {
        const side = keyOf(f);
        const keys = this.sides.get(side);
        if (!keys) {
          this.sides.set(side, [key]);
        } else {
          keys.push(key);
          if (this.tets.get(keys[0]).above !== above) this.between.add(side);
        }
      }
      return key;
    }

    removeTet(key) {
      const tet = this.tets.get(key);
      if (!tet) throw new Error(`the trace takes away the tetrahedron ${key}, which is not there`);
      this.tets.delete(key);
      for (const f of facetsOf(tet.v)) {
        const side = keyOf(f);
        const left = this.sides.get(side).filter((other) => other !== key);
        this.between.delete(side);
        if (left.length)
          this.sides.set(side, left);
        else
          this.sides.delete(side);
      }
      return tet;
    }

    dropHits(key) {
      const before = this.hits.get(key);
      this.hits.delete(key);
      return () => before && this.hits.set(key, before);
    }

    setHits([a, b, c, t]) {
      const key = keyOf([a, b, c]);
      const before = this.hits.get(key);
      if (t.length)
        this.hits.set(key, {v: [a, b, c], t});
      else
        this.hits.delete(key);
      return () => (before ? this.hits.set(key, before) : this.hits.delete(key));
    }

    isVirtual(v) { return this.virtual.has(v); }

    // The keys of the two tetrahedra at a facet, in an order that no history tells.
    sidesOf(key) { return [...this.sides.get(key)].sort(); }

    // The facets whose two tetrahedra differ in sign, those with virtual vertices left out; sorted.
    restricted() { return (this.found ??= this.findRestricted()); }

    findRestricted() {
      const found = [];
      for (const key of this.between) {
        const v = key.split(",").map(Number);
        if (!v.some((corner) => this.isVirtual(corner))) found.push(v);
      }
      return found.sort(compare);
    }

    // The facets around some tetrahedra, each sorted, all sorted: the order of `above` in a trace.
    static rimOf(tets) {
      const times = new Map();
      for (const v of tets) {
        for (const f of facetsOf(v)) {
          const facet = sorted(f);
          const key = facet.join(",");
          times.set(key, {facet, count: (times.get(key)?.count ?? 0) + 1});
        }
      }
      return [...times.values()].filter(({count}) => count === 1).map(({facet}) => facet).sort(compare);
    }

    // D: the triangles between the new vertex and the rim of E.
    static starOf({v, rim, closed}) {
      const edges = closed ? rim.length : rim.length - 1;
      return Array.from({length: edges}, (_, i) => [v, rim[i], rim[(i + 1) % rim.length]]);
    }
  }

  return Object.assign(Replay, {keyOf, facetsOf, sorted, compare});
})();
