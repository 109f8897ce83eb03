// A run of the algorithm in the plane: one frame a step, each with the whole state after it and the next action, known
// before it happens. The same field, points and options give the same frames.
Lesson.Run = class Run {
  static defaults =
      {epsilon: 0.2, epsilon1: 0.1, epsilon2: 0.2, sizeBound: 0.3, rMin: 0.024, start: 4, seeding: "random"};

  // `points` lie on the level set, at least three, not all on a line.
  constructor(field, points, options = {}) {
    this.field = field;
    this.options = {...Run.defaults, ...options};
    this.levelSet = new Lesson.LevelSet(field);
    this.frames = [];
    const delaunay = points.length < 3 ? null : Lesson.Delaunay.of(points.map(Lesson.predicates.snap));
    if (!delaunay) {
      this.failure = "the start needs three points of the curve that are not on one line";
      return;
    }
    this.startCount = delaunay.points.length;
    this.push({kind: "start", action: null, restricted: new Lesson.Restricted(field, delaunay)});
    // Enough for every field of this size; a run that is longer is cut, and says so.
    while (this.frames[this.frames.length - 1].next && this.frames.length < 1500) this.advance();
  }

  get last() { return this.frames[this.frames.length - 1]; }

  push(frame) {
    const next = this.nextOf(frame);
    this.frames.push({...frame, next: next.action, left: next.left ?? []});
  }

  // What the state asks for.
  nextOf({kind, restricted, polyline, poles, left}) {
    if (kind === "end") return {action: null, left};
    if (polyline) return {action: polyline.next(this.options) ?? { kind: "end" }};
    if (poles) return {action: {kind: "build"}};
    const stage1 = Lesson.recover.next(restricted, this.options);
    if (stage1.violation) return {action: stage1.violation, left: stage1.left};
    // Without an umbrella that is a disk at every vertex there are no two sides, hence no poles, and no mesh.
    const isManifold = restricted.delaunay.points.every((_, q) => restricted.isDisk(q));
    return {action: {kind: isManifold ? "poles" : "end"}, left: stage1.left};
  }

  advance() {
    const {restricted, polyline, poles, next, left} = this.last;
    const frame = {kind: next.kind, action: next, restricted, polyline, poles};
    if (next.kind === "poles")
      frame.poles = Lesson.computePoles(restricted);
    else if (next.kind === "build")
      this.build(frame);
    else if (next.kind === "end")
      frame.left = left;
    else if (polyline)
      frame.polyline = polyline.after(next);
    else
      frame.restricted = restricted.insert(next.point);
    this.push(frame);
  }

  // BuildTriMesh, after which the Delaunay triangulation is gone.
  build(frame) {
    const heights = frame.poles.map((pole) => pole.height);
    frame.polyline = Lesson.Polyline.build(frame.restricted, heights);
    if (!frame.polyline) Object.assign(frame, {kind: "end", left: []});
  }

  // The vertices and edges of the mesh that a frame has.
  mesh({restricted, polyline}) {
    if (polyline) return {points: polyline.points, edges: polyline.edges.map((edge) => [edge.a, edge.b])};
    return {points: restricted.delaunay.points, edges: restricted.edges.map((edge) => [edge.u, edge.v])};
  }

  certificate(frame = this.last) {
    if (!frame.certificate) {
      const {points, edges} = this.mesh(frame);
      frame.certificate = Lesson.certify(this.levelSet, points, edges);
    }
    return frame.certificate;
  }
};

// InitTriangulation: hits of random lines through the box; with `components` one point of every loop before.
Lesson.startPoints = (field, random, {start, seeding}) => {
  const points = [];
  if (seeding === "components") {
    const seen = new Set();
    for (const arc of new Lesson.LevelSet(field).arcs) {
      if (!seen.has(arc.loop)) points.push(arc.ends[0].point);
      seen.add(arc.loop);
    }
  }
  const wanted = points.length + start;
  const isFlat = () => points.length < 3 || !Lesson.Delaunay.of(points.map(Lesson.predicates.snap));
  for (let tries = 0; tries < 3000 && (points.length < wanted || isFlat()); ++tries) {
    const end = () => [random.between(0, field.width - 1), random.between(0, field.height - 1)];
    const [a, b] = [end(), end()];
    const hits = field.hits(a, b);
    if (hits.length) points.push(hits[random.below(hits.length)].point);
  }
  return points;
};
