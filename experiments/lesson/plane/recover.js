// Stage 1 (Dey and Levine, Figure 5) in the plane: what MultiIntersect, ExtractManifold and ApproximateGeom ask for, by
// priority, the worst first, as the program does it. No point may come nearer to a vertex than the size bound; without
// it the loop need not end.
Lesson.recover = (() => {
  // {kind, point, measure, ...what the card shows}
  const multiIntersect = (restricted, edge) => {
    if (edge.hits.length <= 1) return null;
    const farthest = edge.hits.reduce((best, hit) => (hit.distance > best.distance ? hit : best));
    return {kind: "multi", point: farthest.point, measure: farthest.distance, edge};
  };

  // The hit on the dual edges of D_q farthest from q.
  const extractManifold = (restricted, q) => {
    if (restricted.isDisk(q)) return null;
    const umbrella = restricted.umbrellas[q];
    const from = restricted.delaunay.points[q];
    const hits = umbrella.length ? umbrella.flatMap((edge) => edge.hits.map((hit) => hit.point)) :
                                   hitsInVoronoiCell(restricted, q);
    let best = null;
    for (const point of hits) {
      const measure = Lesson.distance(point, from);
      if (!best || measure > best.measure) best = {kind: "extract", point, measure, vertex: q, umbrella};
    }
    return best;
  };

  // An empty umbrella, which the paper leaves out: the Voronoi cell swallows a piece of the curve. Rays from q find it.
  const hitsInVoronoiCell = (restricted, q) => {
    const {field, delaunay} = restricted;
    const from = delaunay.points[q];
    const [gx, gy] = field.gradient(from);
    const first = Math.atan2(gy, gx);
    const points = [];
    for (let k = 0; k < 16; ++k) {
      const angle = first + (k * Math.PI) / 8;
      const direction = [Math.cos(angle), Math.sin(angle)];
      // The cell ends where the ray meets the nearest bisector.
      let end = 4 * (field.width + field.height);
      delaunay.points.forEach((p) => {
        const d = [p[0] - from[0], p[1] - from[1]];
        const along = d[0] * direction[0] + d[1] * direction[1];
        if (along > 0) end = Math.min(end, (d[0] * d[0] + d[1] * d[1]) / (2 * along));
      });
      const to = [from[0] + direction[0], from[1] + direction[1]];
      points.push(...field.hits(from, to, 1e-6, end).map((hit) => hit.point));
    }
    return points;
  };

  const approximateGeometry = (restricted, edge, {epsilon, rMin}) => {
    if (edge.r <= rMin || edge.h / edge.r <= epsilon) return null;
    return {kind: "approximate", point: edge.x, measure: edge.h / edge.r, edge};
  };

  const distanceToVertices = (points, p) => {
    let least = Infinity;
    for (const q of points) least = Math.min(least, Lesson.distance(p, q));
    return least;
  };

  // All violations of one kind.
  const violationsOf = (restricted, options) =>
      [() => restricted.edges.map((edge) => multiIntersect(restricted, edge)),
       () => restricted.delaunay.points.map((_, q) => extractManifold(restricted, q)),
       () => restricted.edges.map((edge) => approximateGeometry(restricted, edge, options)),
  ];

  // The next action of stage 1: {violation, left}, where `left` are those that the size bound forbids to mend.
  const next = (restricted, options) => {
    const left = [];
    for (const ofKind of violationsOf(restricted, options)) {
      let worst = null;
      for (const violation of ofKind()) {
        if (!violation) continue;
        const point = Lesson.predicates.snap(violation.point);
        const room = distanceToVertices(restricted.delaunay.points, point);
        if (room < options.sizeBound || room === 0)
          left.push(violation);
        else if (!worst || violation.measure > worst.measure)
          worst = {...violation, point, room};
      }
      if (worst) return {violation: {...worst, ...restricted.delaunay.conflictRegion(worst.point)}, left};
    }
    return {violation: null, left};
  };

  return {next, multiIntersect, extractManifold, approximateGeometry};
})();
