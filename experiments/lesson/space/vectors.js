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

  const circumcenter = ([a, b, c, d]) => {
    const [u, v, w] = [sub(b, a), sub(c, a), sub(d, a)];
    const volume = 2 * dot(u, cross(v, w));
    const sum = add(add(scale(dot(u, u), cross(v, w)), scale(dot(v, v), cross(w, u))), scale(dot(w, w), cross(u, v)));
    return add(a, scale(1 / volume, sum));
  };

  return {add, sub, scale, dot, cross, norm, distance, mean, circumcircle, circumcenter};
})();
