// The exact curve of the surface in a plane of samples: in a square of the grid the field is bilinear, so that the
// curve is a part of a hyperbola, of which points are computed one by one.
Lesson.slice = (() => {
  // f00, f10, f01, f11 less the isovalue: the points of one square with f = 0, as polylines in [0, 1]^2.
  const arcs = (f00, f10, f01, f11, pieces = 6) => {
    const along = (u) => {
      // f is linear in v for a fixed u.
      const [low, high] = [f00 + u * (f10 - f00), f01 + u * (f11 - f01)];
      if (low === high) return null;
      const v = low / (low - high);
      return v >= 0 && v <= 1 ? [u, v] : null;
    };
    const across = (v) => {
      const [low, high] = [f00 + v * (f01 - f00), f10 + v * (f11 - f10)];
      if (low === high) return null;
      const u = low / (low - high);
      return u >= 0 && u <= 1 ? [u, v] : null;
    };
    const found = [];
    for (const walk of [along, across]) {
      let line = [];
      for (let i = 0; i <= pieces * 4; ++i) {
        const p = walk(i / (pieces * 4));
        if (p) line.push(p);
        if (!p || i === pieces * 4) {
          if (line.length > 1) found.push(line);
          line = [];
        }
      }
    }
    return found;
  };

  // Polylines in mesh space of the slice at height k of the samples; none for a volume without samples.
  const curves = ({dims, step, samples}, k) => {
    const [nx, ny] = dims;
    const lines = [];
    if (!samples.length) return lines;
    const at = (i, j) => samples[i + nx * (j + ny * k)];
    for (let j = 0; j + 1 < ny; ++j) {
      for (let i = 0; i + 1 < nx; ++i) {
        const f = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        if (f.every((x) => x >= 0) || f.every((x) => x < 0)) continue;
        for (const arc of arcs(...f))
          lines.push(arc.map(([u, v]) => [(i + u) * step[0], (j + v) * step[1], k * step[2]]));
      }
    }
    return lines;
  };

  // The trilinear field at a point of mesh space, less the isovalue; beyond the box that of the nearest point.
  const value = ({dims, step, samples}, p) => {
    const cell = p.map((x, axis) => Math.max(0, Math.min(x / step[axis], dims[axis] - 1)));
    const first = cell.map((x, axis) => Math.min(Math.floor(x), dims[axis] - 2));
    const [u, v, w] = cell.map((x, axis) => x - first[axis]);
    const at = (i, j, k) => samples[first[0] + i + dims[0] * (first[1] + j + dims[1] * (first[2] + k))];
    const mix = (t, a, b) => a + t * (b - a);
    const row = (j, k) => mix(u, at(0, j, k), at(1, j, k));
    return mix(w, mix(v, row(0, 0), row(1, 0)), mix(v, row(0, 1), row(1, 1)));
  };

  return {arcs, curves, value};
})();
