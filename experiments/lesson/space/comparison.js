// A mesh that repair compares with the exact topology (`compare` in a trace): which triangles belong to which piece,
// the curves that bound a piece, and what is counted of it here, not by the program.
Lesson.Comparison = class {
  constructor(event, before) {
    Object.assign(this, {event, before, counts: [], boundaries: []});
    const {points, triangles, pieces} = event;
    this.pieceOf = new Int32Array(points.length).fill(-1);
    const at = points.map(() => []);
    triangles.forEach((t, i) => t.forEach((v) => at[v].push(i)));
    pieces.forEach(({vertex}, piece) => {
      const waiting = [vertex];
      this.pieceOf[vertex] = piece;
      while (waiting.length) {
        for (const t of at[waiting.pop()]) {
          for (const v of triangles[t]) {
            if (this.pieceOf[v] >= 0) continue;
            this.pieceOf[v] = piece;
            waiting.push(v);
          }
        }
      }
    });
  }

  // Whether a mesh can give the component: pieces beside the one that is right are left out.
  static isRight(is) { return is === "exact" || is === "with_strays"; }

  component(c) { return this.event.components[c]; }

  trianglesOf(piece) { return this.event.triangles.filter((t) => this.pieceOf[t[0]] === piece); }

  // V, E, F, χ and boundary edges of a piece, counted.
  countOf(piece) { return (this.counts[piece] ??= Lesson.complexOf(this.trianglesOf(piece))); }

  // The edges of a piece with one triangle.
  boundaryOf(piece) { return (this.boundaries[piece] ??= this.findBoundary(piece)); }

  findBoundary(piece) {
    const edges = new Map();
    for (const t of this.trianglesOf(piece)) {
      for (let i = 0; i < 3; ++i) {
        const [a, b] = [t[i], t[(i + 1) % 3]];
        if (!edges.delete(`${b},${a}`)) edges.set(`${a},${b}`, [a, b]);
      }
    }
    return [...edges.values()];
  }

  // How many curves the boundary edges of a piece form: each vertex of it has one edge that comes and one that goes.
  loopsOf(piece) {
    const to = new Map(this.boundaryOf(piece));
    let loops = 0;
    while (to.size) {
      ++loops;
      for (let v = to.keys().next().value; to.has(v);) {
        const next = to.get(v);
        to.delete(v);
        v = next;
      }
    }
    return loops;
  }

  // Pieces that lie on a component beside its main one.
  strays(c) {
    return this.event.pieces.filter(({component}, piece) => component === c && piece !== this.component(c).piece);
  }

  countRight() { return this.event.components.filter(({is}) => is === "exact").length; }

  // Vertices that the mesh before has not, and those of it that are gone.
  changes() { return (this.changed ??= this.findChanges()); }

  findChanges() {
    if (!this.before) return {come: [], gone: []};
    const keys = (points) => new Map(points.map((p) => [p.join(), p]));
    const [mine, its] = [keys(this.event.points), keys(this.before.points)];
    const without = (all, others) => [...all].filter(([key]) => !others.has(key)).map(([, p]) => p);
    return {come: without(mine, its), gone: without(its, mine)};
  }
};
