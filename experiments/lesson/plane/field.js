// The volume of the plane: samples on pixels, bilinear between them, all below the isovalue on the border of the box,
// so that the level set consists of loops. Along a line g is a quadratic in every cell (in 3D: a cubic), whose signs
// and roots tell the hits.
Lesson.Field = class {
  // values[j * width + i] belongs to the point (i, j).
  constructor(width, height, values, isovalue = 0) {
    this.width = width;
    this.height = height;
    this.values = Float64Array.from(values);
    this.isovalue = isovalue;
    this.box = [0, 0, width - 1, height - 1];
    this.makeBorderBelow();
  }

  // A copy with one other sample, for the reader who drags it.
  withSample(i, j, value) {
    const values = Float64Array.from(this.values);
    values[j * this.width + i] = value;
    return new Lesson.Field(this.width, this.height, values, this.isovalue);
  }

  isOnBorder(i, j) { return i === 0 || j === 0 || i === this.width - 1 || j === this.height - 1; }

  makeBorderBelow() {
    for (let j = 0; j < this.height; ++j) {
      for (let i = 0; i < this.width; ++i) {
        const at = j * this.width + i;
        if (this.isOnBorder(i, j) && this.values[at] >= this.isovalue) this.values[at] = this.isovalue - 1;
      }
    }
  }

  // A sample less the isovalue. One that equals it would make the level set singular, so it counts as slightly above.
  sample(i, j) {
    const f = this.values[j * this.width + i] - this.isovalue;
    return f === 0 ? 1e-6 : f;
  }

  // The samples around a cell: lower left, lower right, upper left, upper right.
  corners(i, j) { return [this.sample(i, j), this.sample(i + 1, j), this.sample(i, j + 1), this.sample(i + 1, j + 1)]; }

  holds([x, y]) { return x >= 0 && y >= 0 && x <= this.width - 1 && y <= this.height - 1; }

  cellOf([x, y]) {
    return [
      Math.min(this.width - 2, Math.max(0, Math.floor(x))), Math.min(this.height - 2, Math.max(0, Math.floor(y)))
    ];
  }

  valueIn(i, j, [x, y]) {
    const [f00, f10, f01, f11] = this.corners(i, j);
    const u = x - i, v = y - j;
    return (1 - v) * ((1 - u) * f00 + u * f10) + v * ((1 - u) * f01 + u * f11);
  }

  // g less the isovalue; outside the box everything lies below.
  value(p) { return this.holds(p) ? this.valueIn(...this.cellOf(p), p) : -1; }

  gradient(p) {
    const [i, j] = this.cellOf(p);
    const [f00, f10, f01, f11] = this.corners(i, j);
    const u = p[0] - i, v = p[1] - j;
    return [(1 - v) * (f10 - f00) + v * (f11 - f01), (1 - u) * (f01 - f00) + u * (f11 - f10)];
  }

  // The part of a + t (b - a), t in [from, to], that lies in the box: [t0, t1], or null.
  clip(a, b, from = 0, to = 1) {
    for (const axis of [0, 1]) {
      const d = b[axis] - a[axis], high = this.box[axis + 2];
      if (d === 0) {
        if (a[axis] < 0 || a[axis] > high) return null;
        continue;
      }
      const t0 = -a[axis] / d, t1 = (high - a[axis]) / d;
      from = Math.max(from, Math.min(t0, t1));
      to = Math.min(to, Math.max(t0, t1));
    }
    return from < to ? [from, to] : null;
  }

  // Where the line passes from cell to cell, with its ends.
  breaks(a, b, from, to) {
    const times = [from, to];
    for (const axis of [0, 1]) {
      const d = b[axis] - a[axis];
      if (d === 0) continue;
      const first = a[axis] + from * d, last = a[axis] + to * d;
      for (let k = Math.ceil(Math.min(first, last)); k <= Math.max(first, last); ++k) {
        const t = (k - a[axis]) / d;
        if (t > from && t < to) times.push(t);
      }
    }
    return times.sort((s, t) => s - t);
  }

  // All hits of a + t (b - a) with t from `from` to `to`: {t, point, rises}, in order. Signs at the ends of each piece
  // decide whether the number of its roots is odd, so hits alternate, whatever the rounding.
  hits(a, b, from = 0, to = 1) {
    const part = this.clip(a, b, from, to);
    if (!part) return [];
    const at = (t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    const times = this.breaks(a, b, ...part);
    const hits = [];
    // Where a line enters the box, rounding may leave the point outside; there the nearest cell tells.
    const valueAt = (p) => this.valueIn(...this.cellOf(p), p);
    const startsBelow = valueAt(at(times[0])) < 0;
    let v0 = valueAt(at(times[0]));
    for (let k = 0; k + 1 < times.length; ++k) {
      const t0 = times[k], t1 = times[k + 1];
      const v1 = valueAt(at(t1));
      const cell = this.cellOf(at((t0 + t1) / 2));
      const vm = this.valueIn(...cell, at((t0 + t1) / 2));
      for (const s of Lesson.quadraticRoots(v0, vm, v1)) {
        const t = t0 + s * (t1 - t0);
        const rises = hits.length ? !hits[hits.length - 1].rises : startsBelow;
        hits.push({t, point: at(t), rises});
      }
      v0 = v1;
    }
    return hits;
  }
};

// The roots in [0, 1] of the quadratic with these values at 0, 1/2 and 1: one when the ends differ in sign (0 counts as
// above), else none or two.
Lesson.quadraticRoots = (v0, vm, v1) => {
  const a = 2 * (v0 + v1 - 2 * vm), b = 4 * vm - 3 * v0 - v1, c = v0;
  const differ = v0 < 0 !== v1 < 0;
  const discriminant = b * b - 4 * a * c;
  if (!differ && !(discriminant > 0)) return [];
  const root = Math.sqrt(Math.max(discriminant, 0));
  const q = -(b + (b < 0 ? -root : root)) / 2;
  const roots = [q / a, c / q].filter((s) => s >= 0 && s <= 1);
  if (differ) {
    // Rounding may put the one root barely outside, or show its twin from beyond the end.
    const linear = v0 / (v0 - v1);
    if (roots.length === 0) return [Math.min(1, Math.max(0, linear))];
    return [roots.length === 1 ? roots[0] : roots[Math.abs(roots[0] - linear) < Math.abs(roots[1] - linear) ? 0 : 1]];
  }
  return roots.length === 2 && roots[0] !== roots[1] ? roots.sort((s, t) => s - t) : [];
};
