// The surface within one voxel cell, slice by slice: in the slice at height w the field is bilinear, so that its curve
// is a part of a hyperbola.
Lesson.CellSurface = class {
  // `values` at the corners i + 2j + 4k, less the isovalue.
  constructor(values) { this.values = values; }

  // At the corners of the slice, u + 2v.
  slice(w) { return [0, 1, 2, 3].map((c) => (1 - w) * this.values[c] + w * this.values[c + 4]); }

  // The point of the cell in the unit cube at which the slice has its saddle, or null.
  saddle(w) {
    const [f00, f10, f01, f11] = this.slice(w);
    const twist = f00 + f11 - f10 - f01;
    return twist === 0 ? null : [(f00 - f01) / twist, (f00 - f10) / twist, w];
  }

  // Polylines of the slice at height w, in the unit cube.
  arcs(w) { return Lesson.slice.arcs(...this.slice(w), 8).map((line) => line.map(([u, v]) => [u, v, w])); }

  // Which corners of the slice lie above.
  signs(w) { return this.slice(w).map((f) => f >= 0); }
};
