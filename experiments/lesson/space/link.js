// The umbrella of a vertex, flattened to its link: the edges of its facets that lie across from it. A disk has one
// cycle for a link; at the box, one path.
Lesson.link = (() => {
  // Pieces of the link of q in some facets, each {vertices, isCycle, isPath}: in the order of a walk where the piece is
  // a cycle or a path, else as they come, with its edges.
  const of = (facets, q) => {
    const beside = new Map();
    const add = (a, b) => {
      if (!beside.has(a)) beside.set(a, []);
      beside.get(a).push(b);
    };
    for (const f of facets) {
      const [a, b] = f.filter((v) => v !== q);
      add(a, b);
      add(b, a);
    }
    const left = new Set([...beside.keys()].sort((a, b) => a - b));
    const pieces = [];
    while (left.size) {
      const piece = flood(beside, left.values().next().value);
      for (const v of piece) left.delete(v);
      pieces.push(inOrder(beside, piece));
    }
    return pieces;
  };

  const flood = (beside, from) => {
    const seen = new Set([from]);
    for (const v of seen)
      for (const other of beside.get(v)) seen.add(other);
    return [...seen];
  };

  const inOrder = (beside, piece) => {
    const edges = [];
    for (const a of piece)
      for (const b of beside.get(a))
        if (a < b) edges.push([a, b]);
    const ends = piece.filter((v) => beside.get(v).length === 1);
    const isSimple = piece.every((v) => beside.get(v).length <= 2);
    const order = [];
    for (let v = ends[0] ?? piece[0], before = null; isSimple && v !== undefined && !order.includes(v);) {
      order.push(v);
      const next = beside.get(v).find((other) => other !== before && !order.includes(other));
      before = v;
      v = next;
    }
    const isCycle = isSimple && ends.length === 0;
    return {vertices: isSimple ? order : piece, edges, isCycle, isPath: isSimple && !isCycle};
  };

  const describe = (pieces) => {
    if (pieces.length === 0) return "it is empty";
    const words = pieces.map(({vertices, isCycle, isPath}) => {
      const kind = isCycle ? "a cycle" : isPath ? "a path" : "a graph with branches";
      return `${kind} of ${vertices.length} vertices`;
    });
    return words.join(" and ");
  };

  // Beside each other, each around a place of its own; what is broken has a gap, and marks at its ends.
  const draw = (scene, pieces, [left, bottom], size) => {
    scene.onLayer(0);
    pieces.forEach(({vertices, edges, isCycle, isPath}, i) => {
      const middle = [left + size * (1.2 + 2.6 * i), bottom + size * 1.3];
      const share = isPath ? 0.8 : 1;
      const count = isPath ? Math.max(vertices.length - 1, 1) : vertices.length;
      const place = new Map(vertices.map((v, k) => {
        const angle = Math.PI / 2 - share * 2 * Math.PI * k / count;
        return [v, [middle[0] + size * Math.cos(angle), middle[1] + size * Math.sin(angle)]];
      }));
      for (const [a, b] of edges) scene.line([place.get(a), place.get(b)], isCycle ? "right" : "wrong");
      const ends = isPath ? [vertices[0], vertices[vertices.length - 1]] : [];
      for (const [v, p] of place) {
        scene.mark(
            p, ends.includes(v) ? "cross" : "disc", ends.includes(v) ? "hit" : "vertex", ends.includes(v) ? 6 : 3);
        scene.label(p, String(v), "softLabel", 3);
      }
    });
  };

  return {of, describe, draw};
})();
