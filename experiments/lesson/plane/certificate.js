// The mesh compared with the exact topology: each loop of the level set ought to have one piece of the mesh, made of
// its own points. The answer says what is wrong, if anything is.
Lesson.certify = (levelSet, points, edges) => {
  const parent = points.map((_, k) => k);
  const find = (k) => (parent[k] === k ? k : (parent[k] = find(parent[k])));
  const degree = points.map(() => 0);
  for (const [a, b] of edges) {
    parent[find(a)] = find(b);
    degree[a] += 1;
    degree[b] += 1;
  }
  const complaints = [];
  const brokenVertices = points.map((_, k) => k).filter((k) => degree[k] !== 2);
  const broken = brokenVertices.length;
  if (broken) complaints.push(`${Lesson.countText(broken, "vertex does", "vertices do")} not have two edges`);

  const loopsOf = new Map();  // piece -> the loops that its vertices lie on
  points.forEach((p, k) => {
    if (degree[k] === 0) return;
    const piece = find(k);
    if (!loopsOf.has(piece)) loopsOf.set(piece, new Set());
    loopsOf.get(piece).add(levelSet.loopAt(p));
  });
  const pieces = Array.from({length: levelSet.loopCount}, () => 0);
  let mixed = 0;
  const isMixed = (loop) => [...loopsOf.values()].some((loops) => loops.size > 1 && loops.has(loop));
  for (const loops of loopsOf.values()) {
    if (loops.size > 1)
      mixed += 1;
    else if (!loops.has(-1))
      pieces[[...loops][0]] += 1;
  }
  if (mixed) complaints.push(`${Lesson.countText(mixed, "piece joins", "pieces join")} several loops`);
  const missedLoops =
      pieces.map((count, loop) => (count === 0 ? loop : -1)).filter((loop) => loop >= 0 && !isMixed(loop));
  const missed = missedLoops.length;
  if (missed > 0) complaints.push(`${Lesson.countText(missed, "loop has", "loops have")} no piece of the mesh`);
  const doubled = pieces.filter((count) => count > 1).length;
  if (doubled) complaints.push(`${Lesson.countText(doubled, "loop has", "loops have")} several pieces`);
  const crossings = Lesson.countCrossings(points, edges);
  if (crossings) complaints.push(`${Lesson.countText(crossings, "pair of edges crosses", "pairs of edges cross")}`);
  return {
    isRight: complaints.length === 0,
    complaints,
    missedLoops,
    brokenVertices,
    pieces: loopsOf.size,
    loops: levelSet.loopCount
  };
};

Lesson.countCrossings = (points, edges) => {
  let count = 0;
  edges.forEach(([a, b], i) => {
    const [p, q] = [points[a], points[b]];
    const left = Math.min(p[0], q[0]), right = Math.max(p[0], q[0]);
    for (const [c, d] of edges.slice(i + 1)) {
      const [r, s] = [points[c], points[d]];
      if (Math.min(r[0], s[0]) > right || Math.max(r[0], s[0]) < left) continue;
      if (Lesson.predicates.cross(p, q, r, s)) count += 1;
    }
  });
  return count;
};
