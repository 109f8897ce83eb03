// The Delaunay triangulation of points of the plane (Bowyer and Watson), never changed, only followed by another one:
// every step of a run keeps its own. Triangles turn to the left; a ghost joins an edge of the hull to the infinite
// vertex, so that there is no big triangle whose corners might matter.
Lesson.kInfinite = -1;

Lesson.Delaunay = class Delaunay {
  constructor(points, triangles) {
    this.points = points;
    this.triangles = triangles;  // [a, b, c]; of a ghost c is infinite, and what is outside lies to the left of a b
    this.edges = null;
  }

  // Of at least three points. Null when all are collinear.
  static of(points) {
    const {orient, same} = Lesson.predicates;
    const second = points.findIndex((p) => !same(p, points[0]));
    const third = second < 0 ? -1 : points.findIndex((p) => orient(points[0], points[second], p) !== 0);
    if (third < 0) return null;
    const [a, b, c] = [points[0], points[second], points[third]];
    const first = orient(a, b, c) > 0 ? [a, b, c] : [a, c, b];
    let delaunay =
        new Delaunay(first, [[0, 1, 2], [1, 0, Lesson.kInfinite], [2, 1, Lesson.kInfinite], [0, 2, Lesson.kInfinite]]);
    for (const p of points) {
      if (!delaunay.points.some((q) => same(p, q))) delaunay = delaunay.insert(p);
    }
    return delaunay;
  }

  isGhost(triangle) { return triangle[2] === Lesson.kInfinite; }

  // Whether the circle of a triangle holds p. That of a ghost is the half plane outside of its edge, and the edge.
  conflicts(triangle, p) {
    const {orient, inCircle} = Lesson.predicates;
    const [a, b] = [this.points[triangle[0]], this.points[triangle[1]]];
    if (!this.isGhost(triangle)) return inCircle(a, b, this.points[triangle[2]], p) > 0;
    const side = orient(a, b, p);
    if (side !== 0) return side > 0;
    const along = (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]);
    return along < 0;
  }

  // What an insertion would remove, and the rim around it: directed edges, the hole on their left.
  conflictRegion(p) {
    const gone = this.triangles.filter((triangle) => this.conflicts(triangle, p));
    const sides = new Set();
    const key = (u, v) => (u + 1) * 65536 + v + 1;
    for (const [a, b, c] of gone)
      for (const [u, v] of [[a, b], [b, c], [c, a]]) sides.add(key(u, v));
    const rim = [];
    for (const [a, b, c] of gone) {
      for (const [u, v] of [[a, b], [b, c], [c, a]])
        if (!sides.has(key(v, u))) rim.push([u, v]);
    }
    return {gone, rim};
  }

  // The triangulation with p: the conflict region replaced by the star of p over its rim. p must not be a vertex.
  insert(p) {
    const {gone, rim} = this.conflictRegion(p);
    const vertex = this.points.length;
    const removed = new Set(gone);
    const triangles = this.triangles.filter((triangle) => !removed.has(triangle));
    for (const [u, v] of rim) {
      // The infinite vertex stands last.
      if (u === Lesson.kInfinite)
        triangles.push([v, vertex, u]);
      else if (v === Lesson.kInfinite)
        triangles.push([vertex, u, v]);
      else
        triangles.push([u, v, vertex]);
    }
    return new Delaunay([...this.points, p], triangles);
  }

  // All edges between finite vertices, each once: {u, v, left, right}, the triangles on either side of u -> v.
  allEdges() {
    if (this.edges) return this.edges;
    const sides = new Map();
    const key = (u, v) => u * 65536 + v;
    for (const triangle of this.triangles) {
      const [a, b, c] = triangle;
      for (const [u, v] of [[a, b], [b, c], [c, a]]) {
        if (u !== Lesson.kInfinite && v !== Lesson.kInfinite) sides.set(key(u, v), triangle);
      }
    }
    this.edges = [];
    for (const [side, left] of sides) {
      const u = Math.floor(side / 65536), v = side % 65536;
      if (u < v) this.edges.push({u, v, left, right: sides.get(key(v, u))});
    }
    return this.edges;
  }

  // The circumcenter of a triangle, rounded: a Voronoi vertex. That of a ghost lies at infinity.
  circumcenter([i, j, k]) {
    const a = this.points[i], b = this.points[j], c = this.points[k];
    const bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const d = 2 * (bx * cy - by * cx);
    const bl = bx * bx + by * by, cl = cx * cx + cy * cy;
    return [a[0] + (cy * bl - by * cl) / d, a[1] + (bx * cl - cx * bl) / d];
  }
};
