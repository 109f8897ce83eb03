// What a set of triangles is: components, Euler characteristic, boundary. A vertex or an edge where several sheets meet
// counts once for each sheet, as BuildTriMesh separates them.
Lesson.complexOf = (() => {
  const edgeKey = (a, b) => (a < b ? `${a},${b}` : `${b},${a}`);

  // Corners are numbered 3 t + i. Union by the smaller number.
  const unionFind = (count) => {
    const parent = Int32Array.from({length: count}, (_, i) => i);
    const root = (i) => {
      while (parent[i] !== i) i = parent[i] = parent[parent[i]];
      return i;
    };
    return {root, join: (a, b) => (parent[root(b)] = root(a))};
  };

  // `pairUp(edge, triangles)` says which triangles at an edge with more than two continue each other: a list of pairs.
  return (triangles, pairUp = (edge, all) => [all]) => {
    const atEdge = new Map();
    triangles.forEach((t, index) => {
      for (let i = 0; i < 3; ++i) {
        const key = edgeKey(t[(i + 1) % 3], t[(i + 2) % 3]);
        if (!atEdge.has(key)) atEdge.set(key, []);
        atEdge.get(key).push(index);
      }
    });
    const corners = unionFind(3 * triangles.length);
    const pieces = unionFind(triangles.length);
    let edges = 0;
    let open = 0;
    for (const [key, all] of atEdge) {
      const ends = key.split(",").map(Number);
      for (const pair of all.length > 2 ? pairUp(ends, all) : [all]) {
        ++edges;
        if (pair.length < 2) ++open;
        for (let k = 1; k < pair.length; ++k) {
          pieces.join(pair[0], pair[k]);
          for (const v of ends) {
            corners.join(3 * pair[0] + triangles[pair[0]].indexOf(v), 3 * pair[k] + triangles[pair[k]].indexOf(v));
          }
        }
      }
    }
    const roots = (sets, count) => {
      const seen = new Set();
      for (let i = 0; i < count; ++i) seen.add(sets.root(i));
      return seen.size;
    };
    const vertices = roots(corners, 3 * triangles.length);
    return {
      vertices,
      edges,
      triangles: triangles.length,
      chi: vertices - edges + triangles.length,
      components: roots(pieces, triangles.length),
      open
    };
  };
})();

// Restricted facets of a triangulation. Where four or more meet at an edge, they are paired as BuildTriMesh does it:
// around the sectors whose sign is not that of the field at the edge's midpoint.
Lesson.restrictedComplex = (replay, volume) => {
  const facets = replay.restricted();
  const {keyOf} = Lesson.Replay;
  const isAbove = (key) => replay.tets.get(key).above;

  // The facet at which the sector ends that begins at a facet, around the edge ab: from tetrahedron to tetrahedron of
  // one sign.
  const otherEnd = (facet, a, b, sign) => {
    let at = facet;
    let tet = replay.sides.get(keyOf(at)).find((key) => isAbove(key) === sign);
    for (;;) {
      const far = at.find((corner) => corner !== a && corner !== b);
      at = replay.tets.get(tet).v.filter((corner) => corner !== far);
      const next = replay.sides.get(keyOf(at)).find((key) => key !== tet);
      if (isAbove(next) !== sign) return keyOf(at);
      tet = next;
    }
  };

  const pairUp = ([a, b], all) => {
    const middle = Lesson.vectors.mean([replay.points[a], replay.points[b]]);
    const sign = volume.samples.length ? Lesson.slice.value(volume, middle) < 0 : true;
    const pairs = [];
    const left = new Set(all);
    for (const first of all) {
      if (!left.delete(first)) continue;
      const key = otherEnd(facets[first], a, b, sign);
      const second = all.find((index) => keyOf(facets[index]) === key);
      left.delete(second);
      pairs.push(second === undefined ? [first] : [first, second]);
    }
    return pairs;
  };
  return {...Lesson.complexOf(facets, pairUp), facets};
};
