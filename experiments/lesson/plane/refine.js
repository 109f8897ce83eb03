// Stage 2 (Dey and Levine, section 3.2 and Figure 9) in the plane: a mesh of edges without a triangulation. A new point
// encroaches a path E, found by walking from edge to edge; D, two edges that join the point to the ends of E, replaces
// it. In 3D E is a disk, and D has two triangles more.
Lesson.Polyline = class Polyline {
  // edges: {a, b, middle, r, x, h}, above on the left of a -> b. Every vertex has one edge in and one out.
  constructor(field, points, heights, edges) {
    this.field = field;
    this.points = points;
    this.heights = heights;  // h_q of the vertices
    this.edges = edges;
    this.from = new Map(edges.map((edge) => [edge.a, edge]));
    this.to = new Map(edges.map((edge) => [edge.b, edge]));
  }

  // BuildTriMesh: the restricted edges, turned so that the values above lie on the left. Null if they are no loops.
  static build(restricted, heights) {
    const {field, delaunay} = restricted;
    if (!delaunay.points.every((_, q) => restricted.isDisk(q))) return null;
    const edges = restricted.edges.map((edge) => {
      const left = edge.ends[1];
      const [a, b] = field.value(left) >= 0 ? [edge.u, edge.v] : [edge.v, edge.u];
      return Polyline.measure(field, delaunay.points, a, b);
    });
    const polyline = new Polyline(field, delaunay.points, heights, edges);
    return polyline.from.size === edges.length && polyline.to.size === edges.length ? polyline : null;
  }

  // x is the hit of the dual line nearest to the edge, among those that face as the edge does.
  static measure(field, points, a, b) {
    const p = points[a], q = points[b];
    const middle = [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
    const left = [middle[0] - (q[1] - p[1]), middle[1] + (q[0] - p[0])];
    const reach = (2 * (field.width + field.height)) / Lesson.distance(p, q);
    let nearest = null;
    for (const hit of field.hits(middle, left, -reach, reach)) {
      if (hit.rises && (!nearest || Math.abs(hit.t) < Math.abs(nearest.t))) nearest = hit;
    }
    const x = nearest?.point ?? null;
    return {a, b, middle, r: Lesson.distance(p, q) / 2, x, h: x ? Lesson.distance(x, middle) : Infinity, refusal: null};
  }

  meanHeight(edge) { return (this.heights[edge.a] + this.heights[edge.b]) / 2; }

  // How far an edge is beyond the thresholds: above 1 when x is to be inserted.
  badness(edge, {epsilon1, epsilon2, rMin}) {
    if (edge.r <= rMin || !edge.x) return 0;
    return Math.max(edge.h / edge.r / epsilon1, edge.r / this.meanHeight(edge) / epsilon2);
  }

  // E: the edges reached from the first whose balls hold p, in order along the curve.
  path(first, p) {
    const holds = (edge) => edge.x && Lesson.distance(edge.x, p) < Lesson.distance(edge.x, this.points[edge.a]);
    const path = [first];
    for (let e = this.from.get(first.b); e !== first && holds(e); e = this.from.get(e.b)) path.push(e);
    if (path.length === this.edges.length) return path;
    for (let e = this.to.get(first.a); !path.includes(e) && holds(e); e = this.to.get(e.a)) path.unshift(e);
    return path;
  }

  // Why a point is not inserted, or null. Each guard of the program has its counterpart.
  refusalOf(p, path) {
    const from = path[0].a, to = path[path.length - 1].b;
    if (from === to) return "E is a whole loop, which no disk can replace";
    if (path.length > 1) return `E has ${path.length} edges: the vertices within would be lost`;
    if (this.points.some((q) => Lesson.predicates.same(p, q))) return "the point is a vertex already";
    for (const edge of this.edges) {
      if (path.includes(edge)) continue;
      const [c, d] = [this.points[edge.a], this.points[edge.b]];
      const {cross} = Lesson.predicates;
      if (cross(this.points[from], p, c, d) || cross(p, this.points[to], c, d)) return "D would cross another edge";
    }
    return null;
  }

  // The next action of stage 2, or null: {kind: "refine" or "refused", edge, point, path, refusal}.
  next(options) {
    let worst = null;
    for (const edge of this.edges) {
      const badness = edge.refusal ? 0 : this.badness(edge, options);
      if (badness > 1 && (!worst || badness > worst.badness)) worst = {edge, badness};
    }
    if (!worst) return null;
    const point = Lesson.predicates.snap(worst.edge.x);
    const path = this.path(worst.edge, point);
    const refusal = this.refusalOf(point, path);
    return {kind: refusal ? "refused" : "refine", ...worst, measure: worst.badness, point, path, refusal};
  }

  // The mesh after the action. A new vertex inherits its height from its neighbours.
  after({edge, point, path, refusal}) {
    if (refusal) {
      return new Polyline(
          this.field, this.points, this.heights,
          this.edges.map((other) => (other === edge ? {...edge, refusal} : other)));
    }
    const from = path[0].a, to = path[path.length - 1].b, vertex = this.points.length;
    const points = [...this.points, point];
    const edges = this.edges.filter((other) => !path.includes(other));
    edges.push(Polyline.measure(this.field, points, from, vertex), Polyline.measure(this.field, points, vertex, to));
    return new Polyline(this.field, points, [...this.heights, (this.heights[from] + this.heights[to]) / 2], edges);
  }
};
