// Rebuilds the states of a run of the program from its trace, forwards and backwards: every event is applied with a
// record of what it replaced. New tetrahedra are the star of the new vertex over the rim of what is gone.
Lesson.Replay = (() => {
  const byNumber = (a, b) => a - b;
  const sorted = (v) => [...v].sort(byNumber);

  // The key of a triangle or a tetrahedron: its corners in order. Millions are made, so they are sorted by hand.
  const keyOf3 = (a, b, c) => {
    if (a > b) [a, b] = [b, a];
    if (b > c) [b, c] = [c, b];
    return a > b ? `${b},${a},${c}` : `${a},${b},${c}`;
  };
  const keyOf = (v) => (v.length === 3 ? keyOf3(v[0], v[1], v[2]) : sorted(v).join(","));
  const compare = (a, b) => {
    let i = 0;
    while (i < a.length && a[i] === b[i]) ++i;
    return i < a.length ? a[i] - b[i] : 0;
  };
  const facetsOf = (v) => [[v[1], v[2], v[3]], [v[0], v[2], v[3]], [v[0], v[1], v[3]], [v[0], v[1], v[2]]];

  // The facets of some tetrahedra: key -> {f, count}. Those within them are there twice.
  const facetsAround = (tets) => {
    const found = new Map();
    for (const v of tets) {
      for (const f of facetsOf(v)) {
        const key = keyOf(f);
        const its = found.get(key);
        if (its)
          ++its.count;
        else
          found.set(key, {f, count: 1});
      }
    }
    return found;
  };

  const rimIn = (around) => [...around.values()].filter(({count}) => count === 1).map(({f}) => sorted(f)).sort(compare);

  // Events that take as long as the restoring of a state.
  const kWayOfRestoring = 60;

  // What events change in place.
  const copyOf = ({points, tets, sides, between, hits, mesh, ...rest}) => ({
    ...rest,
    points: [...points],
    tets: new Map(tets),
    sides: new Map(sides),
    between: new Map(between),
    hits: new Map(hits),
    mesh: mesh && { ...mesh, points: [...mesh.points], triangles: new Map(mesh.triangles) }
  });

  class Replay {
    // Of the events from `first` on; what is before it leaves no trace in their states. States are saved every so many
    // events, `stride`, so that no way between two of them is long (0: none are).
    constructor(events, first = 0, stride = 0) {
      Object.assign(this, {events, stride});
      this.virtual = new Set([-1]);
      this.saved = [];  // states, by their positions
      this.restore({
        position: first - 1,
        points: [],
        tets: new Map(),     // key -> {v, above}
        sides: new Map(),    // key of a facet -> the keys of the tetrahedra at it
        between: new Map(),  // the facets whose two tetrahedra differ in sign: key -> corners, sorted
        hits: new Map(),     // key of a facet -> {v, t}: the dual edge's hits, as lengths along the normal of v
        mesh: null           // of stage 2: {points, triangles: key -> corners, poles}
      });
      this.save();
    }

    get position() { return this.base + this.undo.length; }

    save() {
      const {position, points, tets, sides, between, hits, mesh} = this;
      this.saved.push(copyOf({position, points, tets, sides, between, hits, mesh}));
    }

    restore(state) {
      const {position, ...its} = copyOf(state);
      // `undo` takes back each event that was applied since; `found`: the restricted facets, once they were asked for.
      Object.assign(this, its, {base: position, undo: [], found: null});
    }

    // The state after event n.
    goTo(n) {
      if (this.position === n) return this;
      this.found = null;
      const nearest =
          this.saved.reduce((best, its) => (its.position <= n && its.position > best.position ? its : best));
      const way = n < this.base ? Infinity : Math.abs(n - this.position);
      if (way > n - nearest.position + kWayOfRestoring) this.restore(nearest);
      while (this.position > n) this.undo.pop()();
      while (this.position < n) this.step();
      return this;
    }

    step() {
      this.undo.push(this.apply(this.events[this.position + 1]));
      const last = this.saved[this.saved.length - 1];
      if (this.stride > 0 && this.position >= last.position + this.stride) this.save();
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
      this.points = [...event.points];
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
      const around = facetsAround(event.gone);
      const changed = [];
      for (const [key, {count}] of around)
        if (count === 2) changed.push(this.dropHits(key));
      this.points.push(event.p);
      const added = rimIn(around).map((f, i) => this.addTet([...f, event.v], event.above[i] === "1"));
      for (const facet of event.facets) changed.push(this.setHits(facet));
      return () => {
        for (const restore of changed.reverse()) restore();
        for (const key of added) this.removeTet(key);
        this.points.pop();
        for (const {v, above} of gone) this.addTet(v, above);
      };
    }

    takeMesh(event) {
      if (event.at) return this.takeChanges(event);
      const before = this.mesh;
      const triangles = new Map(event.triangles.map((t) => [keyOf(t), t]));
      // Points that stay are the same objects, so that nobody takes them for others.
      const known = before?.points ?? [];
      const isKnown = (p, v) => known[v]?.every((x, axis) => x === p[axis]);
      const points = event.points.map((p, v) => (isKnown(p, v) ? known[v] : p));
      this.mesh = {points, triangles, poles: event.poles ?? before?.poles ?? []};
      if (event.e === "mesh") this.first = event;
      return () => (this.mesh = before);
    }

    // Of a mesh of which little is other than before.
    takeChanges(event) {
      const before = this.mesh;
      const points = before.points.slice(0, event.count);
      event.at.forEach((v, i) => (points[v] = event.points[i]));
      const triangles = new Map(before.triangles);
      for (const t of event.gone) triangles.delete(keyOf(t));
      for (const t of event.come) triangles.set(keyOf(t), t);
      this.mesh = {...before, points, triangles};
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
          this.sides.set(side, [...keys, key]);
          if (this.tets.get(keys[0]).above !== above) this.between.set(side, sorted(f));
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
        const keys = this.sides.get(side);
        this.between.delete(side);
        if (keys.length === 1)
          this.sides.delete(side);
        else
          this.sides.set(side, [keys[keys[0] === key ? 1 : 0]]);
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
      for (const v of this.between.values())
        if (!v.some((corner) => this.isVirtual(corner))) found.push(v);
      return found.sort(compare);
    }

    // The facets around some tetrahedra, each sorted, all sorted: the order of `above` in a trace.
    static rimOf(tets) { return rimIn(facetsAround(tets)); }

    // D: the triangles between the new vertex and the rim of E.
    static starOf({v, rim, closed}) {
      const edges = closed ? rim.length : rim.length - 1;
      return Array.from({length: edges}, (_, i) => [v, rim[i], rim[(i + 1) % rim.length]]);
    }
  }

  return Object.assign(Replay, {keyOf, facetsOf, sorted, compare});
})();
