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

  // The circumcenter of a triangle, and the unit normal of its plane.
  const circumcircle = ([a, b, c]) => {
    const [u, v] = [sub(b, a), sub(c, a)];
    const n = cross(u, v);
    const to = scale(1 / (2 * dot(n, n)), add(scale(dot(u, u), cross(v, n)), scale(dot(v, v), cross(n, u))));
    return {center: add(a, to), radius: norm(to), normal: scale(1 / norm(n), n)};
  };

  // Six times the signed volume of a tetrahedron, without an error: in whole numbers, as coordinates of a run have no
  // bits below 2^-200.
  const exactVolume = (corners) => {
    const [a, b, c, d] = corners.map((p) => p.map((x) => BigInt(Math.round(x * 2 ** 200))));
    return Number(dot(sub(b, a), cross(sub(c, a), sub(d, a)))) / 2 ** 600;
  };

  // Of a flat tetrahedron rounding leaves nothing of the volume; the program computes it exactly, too.
  const circumcenter = (corners) => {
    const [a, b, c, d] = corners;
    const [u, v, w] = [sub(b, a), sub(c, a), sub(d, a)];
    const quick = dot(u, cross(v, w));
    const volume = 2 * (Math.abs(quick) > 1e-6 * norm(u) * norm(v) * norm(w) ? quick : exactVolume(corners));
    const sum = add(add(scale(dot(u, u), cross(v, w)), scale(dot(v, v), cross(w, u))), scale(dot(w, w), cross(u, v)));
    return add(a, scale(1 / volume, sum));
  };

  return {add, sub, scale, dot, cross, norm, distance, mean, circumcircle, circumcenter};
})();
