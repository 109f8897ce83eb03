// Chapter 9, the sweep of a cell: what the program counts below each height, against a fine grid that is flooded here.
(() => {
  const {test, check, equal} = Lesson.selftest;
  const cells = () => (Lesson.data.runs ?? []).flatMap(({cells: its}) => its ?? []);

  // Pieces and the Euler characteristic of the surface below a height, from the cubes of a fine grid: marching cubes by
  // its dual, in which each active cube is a vertex and each crossed edge a square.
  const countPieces = (surface, height, n = 24) => {
    const f = (i, j, k) => {
      const [f00, f10, f01, f11] = surface.slice((height * k) / n);
      const [u, v] = [i / n, j / n];
      return (1 - v) * (f00 + u * (f10 - f00)) + v * (f01 + u * (f11 - f01)) >= 0;
    };
    const parent = new Map();
    const root = (key) => {
      while (parent.get(key) !== key) key = parent.get(key);
      return key;
    };
    const join = (keys) => {
      for (const key of keys) {
        if (!parent.has(key)) parent.set(key, key);
        parent.set(root(key), root(keys[0]));
      }
    };
    for (let k = 0; k <= n; ++k) {
      for (let j = 0; j <= n; ++j) {
        for (let i = 0; i <= n; ++i) {
          for (const [a, b, c] of [[1, 0, 0], [0, 1, 0], [0, 0, 1]]) {
            if (i + a > n || j + b > n || k + c > n || f(i, j, k) === f(i + a, j + b, k + c)) continue;
            const beside = [];
            for (let s = 0; s < 4; ++s) {
              const [x, y] = [s & 1, s >> 1];
              const cube = a ? [i, j - x, k - y] : b ? [i - x, j, k - y] : [i - x, j - y, k];
              if (cube.every((at) => at >= 0 && at < n)) beside.push(cube.join());
            }
            join(beside);
          }
        }
      }
    }
    return new Set([...parent.keys()].map(root)).size;
  };

  test("pieces below a height are those of a fine grid", () => {
    for (const {values, events, below, cell} of cells()) {
      const surface = new Lesson.CellSurface(values);
      for (let i = 0; i <= events.length; ++i) {
        const [from, to] = [events[i - 1]?.w ?? 0, events[i]?.w ?? 1];
        // Events too near to each other for the grid to tell them apart.
        if (to - from < 0.12) continue;
        equal(countPieces(surface, (from + to) / 2), below[i].pieces, `cell ${cell}, after ${i} events`);
      }
    }
  });

  test("heights are those at which the slice changes", () => {
    for (const {values, events, below, pieces, cell} of cells()) {
      const surface = new Lesson.CellSurface(values);
      let before = 0;
      events.forEach(({w, kind, u, v}, i) => {
        check(w > before && w < 1, `cell ${cell}: heights in order`);
        before = w;
        const [f00, f10, f01, f11] = surface.slice(w);
        const size = Math.max(...values.map(Math.abs));
        const at = (1 - v) * (f00 + u * (f10 - f00)) + v * (f01 + u * (f11 - f01));
        check(Math.abs(at) < 1e-6 * size, `cell ${cell}, event ${i}: off the surface`);
        if (kind === "saddle") check(Math.abs(f00 * f11 - f10 * f01) < 1e-6 * size * size, `cell ${cell}: D is not 0`);
        const more = below[i + 1].arcs - below[i].arcs;
        equal(more, {appear: 1, vanish: -1}[kind] ?? 0, `cell ${cell}, event ${i}: ${kind}`);
      });
      // Morse: χ changes by one where an arc appears (of what is below) or at a saddle, and with the arcs of the slice.
      equal(below[events.length].chi, pieces.reduce((sum, chi) => sum + chi, 0), `cell ${cell}: χ at the top`);
      equal(below[events.length].pieces, pieces.length, `cell ${cell}: pieces at the top`);
    }
  });
})();
