// Points of space as [x, y, z].
Lesson.vectors = (() => {
  const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const scale = (s, a) => [s * a[0], s * a[1], s * a[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const norm = (a) => Math.sqrt(dot(a, a));
  const distance = (a, b) => norm(sub(a, b));
  const mean = (points) => scale(1 / points.length, points.reduce(add, [0, 0, 0]));

  // A unit vector across another.
  const across = (a) => {
    const sizes = a.map(Math.abs);
    const least = sizes.indexOf(Math.min(...sizes));
    const n = cross(a, [0, 1, 2].map((axis) => (axis === least ? 1 : 0)));
    return scale(1 / norm(n), n);
  };

  // The circumcenter of a triangle, and the unit normal of its plane. As in the program: from the corner opposite the
  // longest edge, and from its middle where the corners lie on a line.
  const circumcircle = (corners) => {
    const lengths = [0, 1, 2].map((i) => distance(corners[(i + 1) % 3], corners[(i + 2) % 3]));
    const first = lengths.indexOf(Math.max(...lengths));
    const [a, b, c] = [0, 1, 2].map((i) => corners[(first + i) % 3]);
    const [u, v] = [sub(b, a), sub(c, a)];
    const n = cross(u, v);
    const to = scale(1 / (2 * dot(n, n)), add(scale(dot(u, u), cross(v, n)), scale(dot(v, v), cross(n, u))));
    if (to.every(Number.isFinite)) return {center: add(a, to), radius: norm(to), normal: scale(1 / norm(n), n)};
    return {center: mean([b, c]), radius: Infinity, normal: across(sub(c, b))};
  };

  // Six times the signed volume of a tetrahedron, without an error: in whole numbers, as coordinates of a run have no
  // bits below 2^-200.
  const exactVolume = (corners) => {
    const [a, b, c, d] = corners.map((p) => p.map((x) => BigInt(Math.round(x * 2 ** 200))));
    return Number(dot(sub(b, a), cross(sub(c, a), sub(d, a)))) / 2 ** 600;
  };

  const kFarthest = 2 ** 500;

  // Of a flat tetrahedron rounding leaves nothing of the volume; the program computes it exactly, too.
  const circumcenter = (corners) => {
    const [a, b, c, d] = corners;
    const [u, v, w] = [sub(b, a), sub(c, a), sub(d, a)];
    const quick = dot(u, cross(v, w));
    const volume = 2 * (Math.abs(quick) > 1e-6 * norm(u) * norm(v) * norm(w) ? quick : exactVolume(corners));
    const sum = add(add(scale(dot(u, u), cross(v, w)), scale(dot(v, v), cross(w, u))), scale(dot(w, w), cross(u, v)));
    const size = Math.max(...sum.map(Math.abs));
    if (!(size > 0)) return a;
    // Direction times length: a tiny volume gives a distant point instead of an infinite one.
    const length = Math.max(-kFarthest, Math.min(kFarthest, size / volume));
    return add(a, scale(length, scale(1 / size, sum)));
  };

  return {add, sub, scale, dot, cross, norm, distance, mean, circumcircle, circumcenter};
})();
