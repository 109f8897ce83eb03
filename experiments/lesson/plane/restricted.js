// The Delaunay triangulation restricted to the level set: the edges whose dual Voronoi edges hit it. In 3D these are
// facets, and their duals are edges, too; so the search along them is the same in both.
Lesson.Restricted = class Restricted {
  // `known` has the dual edges that an earlier triangulation shares with this one; their hits need no second search.
  constructor(field, delaunay, known = new Map()) {
    this.field = field;
    this.delaunay = delaunay;
    this.known = new Map();
    this.searches = 0;
    this.dualEdges = delaunay.allEdges().map((edge) => {
      const key = `${edge.u},${edge.v},${this.apex(edge.left, edge)},${this.apex(edge.right, edge)}`;
      const dual = known.get(key) ?? this.dualEdge(edge);
      this.known.set(key, dual);
      return dual;
    });
    this.edges = this.dualEdges.filter((edge) => edge.hits.length > 0);
    this.umbrellas = delaunay.points.map(() => []);
    for (const edge of this.edges) {
      this.umbrellas[edge.u].push(edge);
      this.umbrellas[edge.v].push(edge);
    }
  }

  // A run keeps every state, but only the last one has to know its dual edges by name.
  insert(p) {
    const after = new Restricted(this.field, this.delaunay.insert(p), this.known);
    this.known = new Map();
    return after;
  }

  apex(triangle, {u, v}) { return triangle.find((w) => w !== u && w !== v); }

  // {u, v, middle, r, ends, hits, x, h}: the Voronoi edge of an edge, its hits, the hit nearest to the edge and how far
  // it lies from the middle. r is half the length: the circumradius of an edge.
  dualEdge({u, v, left, right}) {
    this.searches += 1;
    const {points} = this.delaunay;
    const a = points[u], b = points[v];
    const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    const ends = this.dualEnds(a, b, left, right);
    const hits = this.field.hits(ends[0], ends[1]).map((hit) => ({
                                                         ...hit,
                                                         distance: Lesson.distance(hit.point, middle),
                                                       }));
    const nearest = hits.reduce((best, hit) => (!best || hit.distance < best.distance ? hit : best), null);
    return {
      u,
      v,
      middle,
      r: Lesson.distance(a, b) / 2,
      ends,
      hits,
      x: nearest?.point ?? null,
      h: nearest?.distance ?? Infinity
    };
  }

  // From the Voronoi vertex on the right of a -> b to that on the left. Where a ghost is, the edge goes on past the
  // box.
  dualEnds(a, b, left, right) {
    const {delaunay} = this;
    const out = [a[1] - b[1], b[0] - a[0]];  // to the left
    const far = (4 * (this.field.width + this.field.height)) / Math.hypot(...out);
    const center = (triangle) => (delaunay.isGhost(triangle) ? null : delaunay.circumcenter(triangle));
    const cl = center(left), cr = center(right);
    const beyond = (from, side) => [from[0] + side * far * out[0], from[1] + side * far * out[1]];
    const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    // A center far out: what goes on from there is outside of the box all the more.
    return [cr ?? beyond(cl ?? middle, -1), cl ?? beyond(cr ?? middle, 1)];
  }

  // D_q of a curve is a disk when it consists of two edges.
  isDisk(q) { return this.umbrellas[q].length === 2; }
};

Lesson.distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
