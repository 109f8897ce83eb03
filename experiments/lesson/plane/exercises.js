// The exercises of the laboratory. Their answers are read off the run, so that every field, seed and threshold has its
// own.
Lesson.planeExercises = (() => {
  const loops = (run) => ({
    question: "How many loops does the level set have?",
    answer: () => run.levelSet.loopCount,
    because: (count) => `${Lesson.countText(count, "loop")}, counted by following arcs from cell to cell.`,
  });

  // Figure 5 does not ask whether the mesh is right; it may be so long before nothing is left to do.
  const firstRight = (run) => {
    const first = run.frames.findIndex((frame) => run.certificate(frame).isRight);
    return first < 0 ? null : {
      question: "After which step is the mesh right for the first time: a piece for every loop?",
      answer: () => first,
      because: (step) => `after step ${step}; the card says so below the sentence. Recover ends ` +
          `${run.frames.filter((frame) => !frame.poles).length - 1 - step} steps later.`,
    };
  };

  // The rim of a region without ghosts is a cycle, the region a disk without inner vertices.
  const region = (run) => {
    const step = run.frames.findIndex(
        ({next}) => next?.gone?.length > 2 && next.gone.every((triangle) => !triangle.includes(Lesson.kInfinite)));
    if (step < 0) return null;
    const {gone, rim} = run.frames[step].next;
    return {
      question:
          `The rim of the conflict region at step ${step} has ${rim.length} vertices. How many triangles lie within?`,
      answer: () => gone.length,
      because: (count) =>
          `${count} = ${rim.length} − 2; the star that takes their place has ${rim.length}. (In space the ` +
          "star over a rim of V vertices has 2V − 4 tetrahedra.)",
    };
  };

  const finalEdges = (run) => {
    const build = run.frames.find((frame) => frame.kind === "build");
    if (!build) return null;
    const first = build.polyline.edges.length, points = run.frames.filter((frame) => frame.kind === "refine").length;
    return {
      question: `BuildTriMesh gives ${first} edges, and RefineGeom inserts ${
          points} points. How many edges has the mesh then?`,
      answer: () => run.last.polyline.edges.length,
      because: (count) => `${count} = ${first} + ${points}: D has one edge more than the path E.`,
    };
  };

  return (run) => [loops, firstRight, region, finalEdges].map((make) => make(run)).filter(Boolean);
})();
