// What a set of triangles is: components, Euler characteristic, boundary. A vertex or an edge where several sheets meet
// counts once for each sheet, as BuildTriMesh separates them.
Lesson.complexOf = (() => {
  // Corners are numbered 3 t + i.
  const unionFind = (count) => {
    const parent = Int32Array.from({length: count}, (_, i) => i);
    const root = (i) => {
      while (parent[i] !== i) i = parent[i] = parent[parent[i]];
      return i;
    };
    const roots = () => {
      let found = 0;
      for (let i = 0; i < count; ++i) found += parent[i] === i ? 1 : 0;
      return found;
    };
    return {join: (a, b) => (parent[root(b)] = root(a)), roots};
  };

  // Edges as numbers: triangles by edge, in the order of the triangles.
  const trianglesAtEdges = (triangles) => {
    const size = triangles.reduce((most, t) => Math.max(most, t[0], t[1], t[2]), 0) + 1;
    const atEdge = new Map();
    triangles.forEach((t, index) => {
      for (let i = 0; i < 3; ++i) {
        const [a, b] = [t[i], t[i === 2 ? 0 : i + 1]];
        const key = a < b ? a * size + b : b * size + a;
        const all = atEdge.get(key);
        if (all)
          all.push(index);
        else
          atEdge.set(key, [index]);
      }
    });
    return {size, atEdge};
  };

  // `pairUp(edge, triangles)` says which triangles at an edge with more than two continue each other: a list of pairs.
  return (triangles, pairUp = (edge, all) => [all]) => {
    const {size, atEdge} = trianglesAtEdges(triangles);
    const corners = unionFind(3 * triangles.length);
    const pieces = unionFind(triangles.length);
    let edges = 0;
    let open = 0;
    for (const [key, all] of atEdge) {
      const ends = [Math.floor(key / size), key % size];
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
    const vertices = corners.roots();
    return {
      vertices,
      edges,
      triangles: triangles.length,
      chi: vertices - edges + triangles.length,
      components: pieces.roots(),
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
  return Lesson.complexOf(facets, pairUp);
};
