// The looks of things that only space has: faces in five shades, from those seen edge-on to those that face the reader.
Lesson.shadeOf = (() => {
  const {roles} = Lesson.theme;
  const shades = (name, fill, from, to, stroke, width = 1) => {
    for (let i = 0; i < 5; ++i) {
      roles[`${name}${i}`] = {fill, fillOpacity: from + ((to - from) * i) / 4, stroke, width};
    }
  };
  shades("meshFace", "sky", 0.75, 0.3, "blue", 1);
  shades("surfaceFace", "faint", 0.42, 0.16, null);
  shades("conflictFace", "orange", 0.35, 0.15, "orange", 1);
  shades("diskFace", "red", 0.55, 0.3, "red", 2.5);
  shades("starFace", "green", 0.5, 0.25, "green", 1.5);
  shades("askedFace", "orange", 0.5, 0.2, "orange", 1);
  shades("rightFace", "green", 0.5, 0.2, "green", 1);
  shades("wrongFace", "red", 0.5, 0.2, "red", 1);
  roles.boundaryCurve = {stroke: "ink", width: 3};
  roles.frame = {stroke: "faint", width: 1};
  roles.sweptArc = {stroke: "sky", width: 1.5, opacity: 0.8};
  roles.slicePlane = {stroke: "purple", width: 1.5, fill: "purple", fillOpacity: 0.1};
  roles.slice = {stroke: "purple", width: 2};

  // The number of the shade of a face.
  return (normal, towards) => {
    const length = Lesson.vectors.norm(normal);
    const facing = length > 0 ? Math.abs(Lesson.vectors.dot(normal, towards)) / length : 0;
    return Math.min(4, Math.floor(5 * facing));
  };
})();
