// Exact predicates of the plane. Vertices lie on a fine lattice (snap), so that differences of their coordinates are
// exact in doubles and products are exact in integers; doubles decide alone where their rounding cannot matter.
Lesson.predicates = (() => {
  const kStep = 2 ** -30;  // of the lattice; coordinates below 64 have 36 bits, their differences 37
  const kUnit = 2 ** -53;
  const kOrientBound = (3 + 16 * kUnit) * kUnit;
  const kInCircleBound = (10 + 96 * kUnit) * kUnit;

  const snap = ([x, y]) => [Math.round(x / kStep) * kStep, Math.round(y / kStep) * kStep];

  const integer = (difference) => BigInt(difference / kStep);
  const signOf = (value) => (value > 0n ? 1 : value < 0n ? -1 : 0);

  const exactOrient = (ax, ay, bx, by) => signOf(integer(ax) * integer(by) - integer(ay) * integer(bx));

  // Above 0 when a, b, c turn to the left, 0 when they are collinear.
  const orient = (a, b, c) => {
    const ax = a[0] - c[0], ay = a[1] - c[1], bx = b[0] - c[0], by = b[1] - c[1];
    const left = ax * by, right = ay * bx;
    const determinant = left - right;
    if (Math.abs(determinant) > kOrientBound * (Math.abs(left) + Math.abs(right))) return Math.sign(determinant);
    return exactOrient(ax, ay, bx, by);
  };

  const exactInCircle = (differences) => {
    const [ax, ay, bx, by, cx, cy] = differences.map(integer);
    const lift = (x, y) => x * x + y * y;
    return signOf(
        lift(ax, ay) * (bx * cy - cx * by) + lift(bx, by) * (cx * ay - ax * cy) + lift(cx, cy) * (ax * by - bx * ay));
  };

  // Above 0 when d lies inside the circle through a, b, c, which turn to the left.
  const inCircle = (a, b, c, d) => {
    const ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1], cx = c[0] - d[0], cy = c[1] - d[1];
    const bcl = bx * cy, bcr = cx * by, cal = cx * ay, car = ax * cy, abl = ax * by, abr = bx * ay;
    const al = ax * ax + ay * ay, bl = bx * bx + by * by, cl = cx * cx + cy * cy;
    const determinant = al * (bcl - bcr) + bl * (cal - car) + cl * (abl - abr);
    const permanent = (Math.abs(bcl) + Math.abs(bcr)) * al + (Math.abs(cal) + Math.abs(car)) * bl +
        (Math.abs(abl) + Math.abs(abr)) * cl;
    if (Math.abs(determinant) > kInCircleBound * permanent) return Math.sign(determinant);
    return exactInCircle([ax, ay, bx, by, cx, cy]);
  };

  // Whether the open segments ab and cd meet in one point, which is no end of either.
  const cross = (a, b, c, d) => orient(a, b, c) * orient(a, b, d) < 0 && orient(c, d, a) * orient(c, d, b) < 0;

  const same = (a, b) => a[0] === b[0] && a[1] === b[1];

  return {snap, orient, inCircle, cross, same, kStep};
})();
