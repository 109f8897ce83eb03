// Poles (Dey and Levine, section 3.2) in the plane: the curve cuts the Voronoi cell of each vertex in two; on either
// side the pole is the Voronoi vertex farthest from the vertex. The nearer one gives the height, the scale of the shape
// there.
Lesson.computePoles = (restricted) => {
  const {field, delaunay} = restricted;
  const most = Math.hypot(field.width - 1, field.height - 1);
  const poles = delaunay.points.map(() => ({above: null, below: null}));
  for (const triangle of delaunay.triangles) {
    const isGhost = delaunay.isGhost(triangle);
    const center = isGhost ? null : delaunay.circumcenter(triangle);
    // Beyond the box everything is below. A cell that goes on for ever has its pole at infinity.
    const side = !isGhost && field.value(center) >= 0 ? "above" : "below";
    for (const q of triangle) {
      if (q === Lesson.kInfinite) continue;
      const distance = isGhost ? Infinity : Lesson.distance(center, delaunay.points[q]);
      const pole = poles[q][side];
      if (!pole || distance > pole.distance) poles[q][side] = {point: center, distance};
    }
  }
  return poles.map(({above, below}) => {
    const distances = [above, below].filter(Boolean).map((pole) => pole.distance);
    return {above, below, height: Math.min(most, ...distances)};
  });
};
