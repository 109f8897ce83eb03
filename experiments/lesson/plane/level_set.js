// The level set exactly, known before any mesh: in each cell the arcs of a hyperbola between crossings of grid edges
// (marching squares), joined in an ambiguous cell as the sign at its saddle says (Nielson and Hamann's asymptotic
// decider). What the mesh ought to be is read from here.
Lesson.LevelSet = class {
  constructor(field) {
    this.field = field;
    this.arcs = [];           // {cell, ends: [crossing, crossing], loop}
    this.arcsOf = new Map();  // cell -> its arcs
    this.crossings = new Map();
    for (let j = 0; j + 1 < field.height; ++j)
      for (let i = 0; i + 1 < field.width; ++i) this.addCell(i, j);
    this.joinLoops();
  }

  // The crossing of a grid edge from (i, j) in direction x (axis 0) or y (axis 1); null without a change of sign.
  crossing(i, j, axis) {
    const {field} = this;
    const f0 = field.sample(i, j), f1 = axis === 0 ? field.sample(i + 1, j) : field.sample(i, j + 1);
    if (f0 < 0 === f1 < 0) return null;
    const key = 2 * (j * field.width + i) + axis;
    if (!this.crossings.has(key)) {
      const t = f0 / (f0 - f1);
      this.crossings.set(key, {key, point: axis === 0 ? [i + t, j] : [i, j + t], arcs: []});
    }
    return this.crossings.get(key);
  }

  addCell(i, j) {
    const left = this.crossing(i, j, 1), right = this.crossing(i + 1, j, 1);
    const bottom = this.crossing(i, j, 0), top = this.crossing(i, j + 1, 0);
    const found = [left, bottom, right, top].filter(Boolean);
    if (found.length === 2) this.addArc(i, j, found);
    if (found.length < 4) return;
    // All four: the saddle joins the corners of its own sign, so the arcs cut off the other two.
    const corners = this.field.corners(i, j);
    const cutsLowerLeft = this.saddle(i, j).value < 0 !== corners[0] < 0;
    this.addArc(i, j, cutsLowerLeft ? [left, bottom] : [left, top]);
    this.addArc(i, j, cutsLowerLeft ? [right, top] : [right, bottom]);
  }

  // Where the bilinear polynomial of a cell is stationary.
  saddle(i, j) {
    const [f00, f10, f01, f11] = this.field.corners(i, j);
    const d = f00 + f11 - f10 - f01;
    return {x: i + (f00 - f01) / d, y: j + (f00 - f10) / d, value: (f00 * f11 - f10 * f01) / d};
  }

  addArc(i, j, ends) {
    const arc = {cell: [i, j], ends, loop: -1};
    this.arcs.push(arc);
    for (const end of ends) end.arcs.push(arc);
    const key = j * this.field.width + i;
    if (!this.arcsOf.has(key)) this.arcsOf.set(key, []);
    this.arcsOf.get(key).push(arc);
  }

  // Every crossing has two arcs, one in each cell beside its grid edge.
  joinLoops() {
    this.loopCount = 0;
    for (const first of this.arcs) {
      if (first.loop >= 0) continue;
      const open = [first];
      first.loop = this.loopCount;
      while (open.length) {
        for (const end of open.pop().ends) {
          for (const arc of end.arcs) {
            if (arc.loop >= 0) continue;
            arc.loop = this.loopCount;
            open.push(arc);
          }
        }
      }
      this.loopCount += 1;
    }
  }

  // The loop that a point of the level set lies on; -1 for a point in a cell without arcs, which lies on none.
  loopAt(p) {
    const [i, j] = this.field.cellOf(p);
    const arcs = this.arcsOf.get(j * this.field.width + i) ?? [];
    if (arcs.length < 2) return arcs.length ? arcs[0].loop : this.loopNearby(p, i, j);
    // The branches of a hyperbola lie on either side of its center; the first arc has the crossing on the left.
    return arcs[p[0] < this.saddle(i, j).x ? 0 : 1].loop;
  }

  // A point on a grid line, or rounded across it, may belong to the cell beyond.
  loopNearby(p, i, j) {
    for (const arc of this.arcs) {
      const [k, l] = arc.cell;
      if (Math.abs(k - i) > 1 || Math.abs(l - j) > 1) continue;
      const isNear = p[0] > k - 1e-6 && p[0] < k + 1 + 1e-6 && p[1] > l - 1e-6 && p[1] < l + 1 + 1e-6;
      if (isNear) return arc.loop;
    }
    return -1;
  }

  // The arcs as lines to draw: points of the hyperbola, found on lines across the chord.
  curves(pieces = 6) {
    return this.arcs.map((arc) => {
      const [a, b] = arc.ends.map((end) => end.point);
      const across = [a[1] - b[1], b[0] - a[0]];
      const points = [a];
      for (let k = 1; k < pieces; ++k) {
        const s = k / pieces;
        const m = [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
        const near =
            this.field.hits(m, [m[0] + across[0], m[1] + across[1]], -1, 1)
                .filter(
                    (hit) => hit.point.every((x, axis) => x >= arc.cell[axis] - 1e-9 && x <= arc.cell[axis] + 1 + 1e-9))
                .sort((h, k2) => Math.abs(h.t) - Math.abs(k2.t));
        if (near.length) points.push(near[0].point);
      }
      return [...points, b];
    });
  }
};

// The number of loops by a second method, which knows regions and no curves: samples of one sign are joined along grid
// edges and, where a saddle has their sign, across it. Loops separate the regions like the edges of a tree.
Lesson.countLoopsByRegions = (field) => {
  const parent = Array.from({length: field.width * field.height}, (_, k) => k);
  const find = (k) => {
    while (parent[k] !== k) k = parent[k] = parent[parent[k]];
    return k;
  };
  const join = (i, j, k, l) => {
    if (field.sample(i, j) < 0 === field.sample(k, l) < 0)
      parent[find(j * field.width + i)] = find(l * field.width + k);
  };
  for (let j = 0; j < field.height; ++j) {
    for (let i = 0; i < field.width; ++i) {
      if (i + 1 < field.width) join(i, j, i + 1, j);
      if (j + 1 < field.height) join(i, j, i, j + 1);
      if (i + 1 === field.width || j + 1 === field.height) continue;
      const [f00, f10, f01, f11] = field.corners(i, j);
      const isAmbiguous = f00 < 0 === f11 < 0 && f10 < 0 === f01 < 0 && f00 < 0 !== f10 < 0;
      if (!isAmbiguous) continue;
      const isSaddleBelow = (f00 * f11 - f10 * f01) / (f00 + f11 - f10 - f01) < 0;
      if (isSaddleBelow === f00 < 0)
        join(i, j, i + 1, j + 1);
      else
        join(i + 1, j, i, j + 1);
    }
  }
  const regions = new Set(parent.map((_, k) => find(k)));
  return regions.size - 1;
};
